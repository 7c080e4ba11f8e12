# SPDX-License-Identifier: MIT
"""Clients of QEMU: its monitor protocol (QMP), and its VNC server as far as a monitor's size."""

import json
import socket
import struct


class Monitor:
    """QMP on a unix socket."""

    def __init__(self, path, limit=10):
        self._socket = socket.socket(socket.AF_UNIX)
        self._socket.settimeout(limit)
        self._socket.connect(path)
        self._lines = self._socket.makefile('rw', encoding='utf-8')
        self._lines.readline()
        self.call('qmp_capabilities')

    def call(self, command, **arguments):
        """Carries a command out and returns what it returns; "_" in names stands for "-"."""
        arguments = {name.replace('_', '-'): value for name, value in arguments.items()}
        self._lines.write(json.dumps({'execute': command, 'arguments': arguments}) + '\n')
        self._lines.flush()
        while True:
            answer = json.loads(self._lines.readline())
            if 'error' in answer:
                raise RuntimeError(f'{command}: {answer["error"]["desc"]}')
            if 'return' in answer:
                return answer['return']

    def close(self):
        self._socket.close()


class Screen:
    """A viewer of QEMU's VNC server, whose window is the guest's monitor."""

    RAW, EXTENDED_DESKTOP_SIZE = 0, -308

    def __init__(self, path, limit=10):
        self._socket = socket.socket(socket.AF_UNIX)
        self._socket.settimeout(limit)
        self._socket.connect(path)
        self._read(12)
        self._socket.sendall(b'RFB 003.008\n')
        self._read(self._read(1)[0])
        self._socket.sendall(b'\x01')  # no authentication
        self._read(4)
        self._socket.sendall(b'\x01')  # shared
        _, _, _, name = struct.unpack('>HH16sI', self._read(24))
        self._read(name)
        encodings = (self.RAW, self.EXTENDED_DESKTOP_SIZE)
        self._socket.sendall(struct.pack('>BxH2i', 2, len(encodings), *encodings))

    def resize(self, width, height):
        """Asks for another size, as a window does (RFB, SetDesktopSize); 0x0 unplugs."""
        self._socket.sendall(struct.pack('>BxHHBxIHHHHI', 251, width, height, 1,
                                         0, 0, 0, width, height, 0))

    def _read(self, size):
        data = b''
        while len(data) < size:
            more = self._socket.recv(size - len(data))
            if not more:
                raise ConnectionError('the VNC server hung up')
            data += more
        return data

    def close(self):
        self._socket.close()
