# SPDX-License-Identifier: MIT
"""A page in headless Chromium, through the DevTools protocol over a pipe."""

import base64
import fcntl
import json
import os
import select
import shutil
import struct
import subprocess
import tempfile
import time
import zlib

NAMES = 'chromium', 'chromium-browser', 'google-chrome'
PATIENCE = 120  # seconds that an answer may take, on a busy machine


def find():
    return next(filter(None, map(shutil.which, NAMES)), None)


def pipe():
    """Both ends above what the browser expects as its own, 3 and 4."""
    ends = os.pipe()
    moved = [fcntl.fcntl(end, fcntl.F_DUPFD_CLOEXEC, 10) for end in ends]
    for end in ends:
        os.close(end)
    return moved


class Page:
    """A page, with nothing to reach on any network. `requests` has the URLs that it asked for."""

    def __init__(self):
        self.profile = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
        commands, self.commands = pipe()
        self.answers, answers = pipe()
        self.process = subprocess.Popen(
            [find(), '--headless=new', '--no-sandbox', '--disable-gpu', '--no-first-run',
             '--disable-background-networking', '--hide-scrollbars', '--disable-dev-shm-usage',
             '--host-resolver-rules=MAP * ~NOTFOUND', f'--user-data-dir={self.profile.name}',
             '--remote-debugging-pipe'],
            stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
            close_fds=False, preexec_fn=lambda: (os.dup2(commands, 3), os.dup2(answers, 4)))
        os.close(commands)
        os.close(answers)
        self.received, self.count, self.session, self.requests = b'', 0, None, []
        self.loaded = False
        target = self.call('Target.createTarget', url='about:blank')['targetId']
        self.session = self.call(
            'Target.attachToTarget', targetId=target, flatten=True)['sessionId']
        for domain in 'Page', 'Network', 'Accessibility':
            self.call(f'{domain}.enable')

    def close(self):
        self.process.terminate()
        self.process.wait()
        os.close(self.commands)
        os.close(self.answers)
        self.profile.cleanup()

    def receive(self):
        """The next message; keeps what events tell."""
        end = time.monotonic() + PATIENCE
        while b'\0' not in self.received:
            if not select.select([self.answers], [], [], max(0, end - time.monotonic()))[0]:
                raise TimeoutError('no answer from Chromium')
            part = os.read(self.answers, 1 << 20)
            if not part:
                raise EOFError('Chromium has ended')
            self.received += part
        text, self.received = self.received.split(b'\0', 1)
        message = json.loads(text)
        if message.get('method') == 'Network.requestWillBeSent':
            self.requests.append(message['params']['request']['url'])
        self.loaded |= message.get('method') == 'Page.loadEventFired'
        return message

    def call(self, method, **parameters):
        self.count += 1
        message = {'id': self.count, 'method': method, 'params': parameters}
        if self.session is not None:
            message['sessionId'] = self.session
        os.write(self.commands, json.dumps(message).encode() + b'\0')
        while (answer := self.receive()).get('id') != self.count:
            pass
        if 'error' in answer:
            raise RuntimeError(f'{method}: {answer["error"]["message"]}')
        return answer['result']

    def open(self, path, width, height, scheme):
        """Loads a file; scheme: "light" or "dark"."""
        self.call('Emulation.setDeviceMetricsOverride', width=width, height=height,
                  deviceScaleFactor=1, mobile=False)
        self.call('Emulation.setEmulatedMedia',
                  features=[{'name': 'prefers-color-scheme', 'value': scheme}])
        self.requests, self.loaded = [], False
        self.call('Page.navigate', url=path.as_uri())
        while not self.loaded:
            self.receive()

    def evaluate(self, script):
        answer = self.call('Runtime.evaluate', expression=script, returnByValue=True,
                           awaitPromise=True)
        if 'exceptionDetails' in answer:
            raise RuntimeError(answer['exceptionDetails']['exception']['description'])
        return answer['result'].get('value')

    def press(self, key, code):
        """A key by its name, such as "ArrowLeft", and number of Windows."""
        for kind in 'keyDown', 'keyUp':
            self.call('Input.dispatchKeyEvent', type=kind, key=key, code=key,
                      windowsVirtualKeyCode=code)

    def drag(self, start, end):
        """The mouse, pressed, from a point to another."""
        for kind, (x, y), buttons in (('mousePressed', start, 1), ('mouseMoved', end, 1),
                                      ('mouseReleased', end, 0)):
            self.call('Input.dispatchMouseEvent', type=kind, x=x, y=y, button='left',
                      buttons=buttons, clickCount=1)

    def accessible(self, role, count):
        """Name and value of what is told as that role to who cannot see it: waits until there are
        so many, since Chromium tells them some time after the page is loaded."""
        end = time.monotonic() + PATIENCE
        while True:
            nodes = self.call('Accessibility.getFullAXTree')['nodes']
            found = [(node['name']['value'], node.get('value', {}).get('value'))
                     for node in nodes if node.get('role', {}).get('value') == role]
            if len(found) >= count or time.monotonic() > end:
                return found
            time.sleep(0.05)

    def shoot(self, path):
        """Takes the viewport as a Picture, kept at the path."""
        data = self.call('Page.captureScreenshot', format='png')['data']
        path.write_bytes(base64.b64decode(data))
        return Picture(path)


class Picture:
    """A PNG file of 8-bit RGB or RGBA."""

    def __init__(self, path):
        data, at, packed = path.read_bytes(), 8, b''
        while at < len(data):
            size, kind = struct.unpack('>I4s', data[at:at + 8])
            if kind == b'IHDR':
                self.width, self.height, depth, colour = struct.unpack(
                    '>IIBB', data[at + 8:at + 18])
            elif kind == b'IDAT':
                packed += data[at + 8:at + 8 + size]
            at += size + 12
        assert depth == 8 and colour in (2, 6)
        self.channels = 3 if colour == 2 else 4
        self.rows = self.unfilter(zlib.decompress(packed))

    def unfilter(self, data):
        """PNG, section 9.2."""
        stride, step, rows = self.width * self.channels, self.channels, []
        above = bytearray(stride)
        for start in range(0, self.height * (stride + 1), stride + 1):
            kind, row = data[start], bytearray(data[start + 1:start + 1 + stride])
            for i in range(stride if kind else 0):
                left = row[i - step] if i >= step else 0
                corner = above[i - step] if i >= step else 0
                row[i] = (row[i] + self.predict(kind, left, above[i], corner)) & 255
            rows.append(row)
            above = row
        return rows

    @staticmethod
    def predict(kind, left, up, corner):
        if kind == 4:
            guess = left + up - corner
            return min((left, up, corner), key=lambda value: abs(guess - value))
        return (0, left, up, (left + up) // 2)[kind]

    def at(self, x, y):
        first = int(x) * self.channels
        return tuple(self.rows[int(y)][first:first + 3])
