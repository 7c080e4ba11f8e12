# SPDX-License-Identifier: MIT
"""A guest of QEMU that has the host's root, and runs commands for the host.

The guest is emulated (TCG), because not every machine that builds has KVM. Every wait has a
limit; when one passes, the kernel tells what its tasks are waiting for."""

import ctypes
import os
import shlex
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time

import qmp

HERE = os.path.dirname(os.path.abspath(__file__))
QEMU = 'qemu-system-x86_64'
# Without AVX, which is slow to emulate; pinned, because pixels depend on it.
CPU = 'Nehalem'
BOOT_LIMIT, ANSWER_LIMIT = 90, 20
CONSOLE_TAIL = 300
PR_SET_PDEATHSIG = 1


class Late(Exception):
    """A limit passed."""


class Hang(Late):
    """A limit passed, and the guest does not answer any more; it is gone."""


class Job:
    """A command in the guest. Its outputs grow while it runs."""

    def __init__(self, machine, name, command):
        self.machine, self.name, self.command = machine, name, command
        self.status = None
        self.lasting = False  # goes on when a case has passed

    def _text(self, suffix):
        try:
            with open(self.machine.share(f'{self.name}.{suffix}'), encoding='utf-8',
                      errors='replace') as file:
                return file.read()
        except FileNotFoundError:
            return ''

    @property
    def out(self):
        return self._text('out')

    @property
    def err(self):
        return self._text('err')

    @property
    def pid(self):
        """The process, which leads a session of its own."""
        self.machine.wait_until(lambda: self._text('pid').endswith('\n'), 10, f'{self.name} starts')
        return int(self._text('pid'))

    def wait(self, limit):
        """Waits for the end and returns the status."""
        self.machine.wait_until(lambda: self.status is not None, limit,
                                f'the end of: {self.command}')
        return self.status

    def says(self, text, limit, times=1):
        """Waits until one of the outputs has the text so often."""
        def said():
            return (self.out + self.err).count(text) >= times

        self.machine.wait_until(lambda: said() or self.status is not None, limit,
                                f'"{text}" from: {self.command}')
        if not said():
            raise AssertionError(f'ended ({self.status}) without "{text}": {self.command}\n'
                                 f'{self.err}')

    def kill(self, name='TERM'):
        """Sends a signal to the command and what it started."""
        if self.status is None:
            self.machine.run(f'kill -s {name} -- -{self.pid} 2>/dev/null; true', 10)

    def stop(self, name='TERM', limit=20):
        self.kill(name)
        return self.wait(limit)


class Machine:
    """A running guest; a context manager.

    `devices` are arguments of QEMU's -device. One with id "screen" is what the VNC server and
    screendumps show."""

    def __init__(self, image, devices=(), memory=1024, cpu=CPU):
        self.image, self.jobs, self.failed = image, {}, False
        self._folder = tempfile.mkdtemp(prefix='smoothie-vm-')
        self._buffer = b''
        os.mkdir(self.share())
        shutil.copy(os.path.join(HERE, 'runner.sh'), self.share('runner.sh'))
        self._console_shown = 0
        self._console_log = os.path.join(self._folder, 'console')
        start = time.monotonic()
        self._qemu = subprocess.Popen(self._command(devices, memory, cpu), stdin=subprocess.DEVNULL,
                                      stdout=sys.stderr, start_new_session=True,
                                      preexec_fn=die_with_parent)
        try:
            self._runner, self._console = (self._connect(name) for name in ('runner', 'serial'))
            self.monitor = qmp.Monitor(self._path('qmp'))
            self._read_runner(BOOT_LIMIT, 'the guest is up')
        except BaseException:
            self.close()
            raise
        self.boot_time = time.monotonic() - start

    def _path(self, name):
        return os.path.join(self._folder, name)

    def share(self, name=''):
        """A file in the folder that the guest has as /run/share."""
        return os.path.join(self._folder, 'share', name).rstrip('/')

    def _command(self, devices, memory, cpu):
        arguments = 'quiet panic=-1 mitigations=off sysrq_always_enabled=1 console=ttyS0 ' \
            'drm_kms_helper.fbdev_emulation=0'
        command = [QEMU, '-nodefaults', '-no-reboot', '-display', 'none', '-machine', 'q35',
                   '-accel', 'tcg,thread=multi', '-cpu', cpu, '-smp', '2', '-m', str(memory),
                   '-kernel', self.image.kernel, '-initrd', self.image.initramfs,
                   '-append', arguments, '-vga', 'none',
                   '-chardev', f'socket,id=serial,path={self._path("serial")},server=on,wait=off,'
                   f'logfile={self._console_log}', '-serial', 'chardev:serial',
                   '-qmp', f'unix:{self._path("qmp")},server=on,wait=off',
                   '-device', 'virtio-serial-pci',
                   '-chardev', f'socket,id=runner,path={self._path("runner")},server=on,wait=off',
                   '-device', 'virtserialport,chardev=runner']
        for tag, path, options in (('root', '/', ',readonly=on'), ('share', self.share(), '')):
            command += ['-virtfs', f'local,path={path},mount_tag={tag},security_model=none,'
                        f'multidevs=remap{options}']
        for device in devices:
            command += ['-device', device]
        if any('id=screen' in device for device in devices):
            command += ['-vnc', f'unix:{self._path("vnc")},display=screen']
        return command

    def _connect(self, name):
        end = time.monotonic() + 10
        while True:
            connection = socket.socket(socket.AF_UNIX)
            try:
                connection.connect(self._path(name))
                connection.settimeout(0.05)
                return connection
            except OSError:
                connection.close()
                if time.monotonic() > end or self._qemu.poll() is not None:
                    raise Hang(f'{QEMU} does not start') from None
                time.sleep(0.02)

    def screen(self):
        """Connects to the guest's monitor (the one that is looked at)."""
        return qmp.Screen(self._path('vnc'))

    def screendump(self, name):
        """Takes a picture (PPM) of the screen into the shared folder."""
        self.monitor.call('screendump', filename=self.share(name), device='screen')
        return self.share(name)

    def run(self, command, limit=20):
        """Runs a shell command to its end: its status and its standard output."""
        job = self.start(command)
        return job.wait(limit), job.out

    def check(self, command, limit=20):
        """Runs a shell command that must succeed; its output without the last newline."""
        job = self.start(command)
        if job.wait(limit) != 0:
            raise AssertionError(f'status {job.status}: {command}\n{job.err}{job.out}')
        return job.out.rstrip('\n')

    def start(self, command, name=None, user=None):
        """Starts a shell command, as another user if told, in the background; returns its Job."""
        name = f'{len(self.jobs) + 1}-{name or "run"}'
        if user is not None:
            command = (f'exec setpriv --reuid={user} --regid={user} --clear-groups '
                       f'sh -c {shlex.quote(command)}')
        with open(self.share(f'{name}.sh'), 'w', encoding='utf-8') as script:
            script.write(command + '\n')
        self.jobs[name] = Job(self, name, command)
        self._runner.sendall(f'{name}\n'.encode())
        return self.jobs[name]

    def _receive(self):
        """Takes what the runner says: "ready", or the name and status of a job."""
        try:
            data = self._runner.recv(4096)
        except socket.timeout:
            return False
        if not data:
            raise self._hang(f'{QEMU} ended')
        *lines, self._buffer = (self._buffer + data).split(b'\n')
        for line in lines:
            name, _, status = line.decode().partition(' ')
            if name in self.jobs:
                self.jobs[name].status = int(status)
        return bool(lines)

    def _read_runner(self, limit, what):
        end = time.monotonic() + limit
        while not self._receive():
            if time.monotonic() > end:
                raise self._hang(what)

    def wait_until(self, condition, limit, what):
        end = time.monotonic() + limit
        while not condition():
            self._receive()
            if time.monotonic() > end:
                self._late(f'{what}: not within {limit} s')

    def _late(self, what):
        """Shows what hangs and raises Late, or Hang where the guest does not answer."""
        self._show_tasks('w')
        answer = self.start('true')
        end = time.monotonic() + ANSWER_LIMIT
        while answer.status is None and time.monotonic() < end:
            self._receive()
        raise Late(what) if answer.status == 0 else self._hang(what)

    def _hang(self, what):
        self.failed = True
        if self._qemu.poll() is None:
            self._show_tasks('t')
        self.close()
        return Hang(what)

    def _show_tasks(self, key):
        """Has the kernel list its blocked tasks (w) or all (t), and prints the console."""
        self._console_key('9')
        self._console_key(key)
        size, end = -1, time.monotonic() + 15
        while size < os.path.getsize(self._console_log) and time.monotonic() < end:
            size = os.path.getsize(self._console_log)
            time.sleep(1)
        self.show_console()
        self._console_key('4')

    def stop_jobs(self, lasting):
        """Ends whatever still runs; lasting: also what is there for several cases."""
        for job in list(self.jobs.values()):
            if job.status is None and (lasting or not job.lasting):
                job.stop('KILL')

    def _console_key(self, key):
        """Magic SysRq: a break on the serial line, then the key."""
        self.monitor.call('chardev-send-break', id='serial')
        time.sleep(0.2)
        self._console.sendall(key.encode())
        time.sleep(0.2)

    def show_console(self):
        """Prints what the console said since the last time, or the end of it."""
        with open(self._console_log, encoding='utf-8', errors='replace') as log:
            log.seek(self._console_shown)
            lines = log.read().splitlines()
            self._console_shown = log.tell()
        for line in lines[-CONSOLE_TAIL:]:
            print(f'# console: {line}', file=sys.stderr)

    def close(self):
        if self._qemu.poll() is None:
            os.killpg(self._qemu.pid, signal.SIGKILL)
        self._qemu.wait()
        shutil.rmtree(self._folder, ignore_errors=True)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()


def die_with_parent():
    ctypes.CDLL(None).prctl(PR_SET_PDEATHSIG, signal.SIGKILL)
