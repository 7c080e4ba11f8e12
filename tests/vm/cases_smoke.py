# SPDX-License-Identifier: MIT
"""That the guests themselves are what the other suites take them for."""

import subprocess

import services
from suite import Guest


def has_crc_of_the_pattern(bench):
    """vkms has the CRC that is computed for what it shows"""
    hold = bench.guest.start(f'exec {bench.tool("vm_hold")} {bench.card("vkms")} 640x480')
    hold.says('shown: 640x480', 20)
    crc = f'{bench.debug("vkms")}/crtc-0/crc'
    shown = bench.guest.check(f'echo auto >{crc}/control; timeout 5 head -n 3 {crc}/data')
    expected = subprocess.run([bench.tool('vm_picture'), 'pattern:640x480'], check=True,
                              stdout=subprocess.PIPE, text=True).stdout.strip()
    assert {line.split()[1] for line in shown.splitlines()} == {f'0x{expected}'}, (shown, expected)
    assert hold.stop() == 0


def screendump_is_the_pattern(bench):
    """A screendump of virtio-gpu is what it shows, and so is a grab"""
    hold = bench.guest.start(f'exec {bench.tool("vm_hold")} {bench.card("virtio_gpu")} 640x480')
    hold.says('shown: 640x480', 20)
    bench.guest.check(f'{bench.tool("vm_grab")} {bench.card("virtio_gpu")} >/run/share/grab.ppm')
    for picture in (bench.guest.screendump('screen.ppm'), bench.guest.share('grab.ppm')):
        subprocess.run([bench.tool('vm_picture'), 'pattern:640x480', picture], check=True)
    assert hold.stop() == 0


def monitor_is_resized(bench):
    """A monitor that is resized, unplugged and plugged in sends events of udev"""
    services.start_udev(bench)
    watch = bench.guest.start('exec udevadm monitor --udev --subsystem-match=drm')
    watch.says('UDEV - the event', 20)
    connector = bench.connector('virtio_gpu')
    screen = bench.guest.screen()
    for number, (size, state, mode) in enumerate([((800, 600), 'connected', '800x600'),
                                                  ((0, 0), 'disconnected', ''),
                                                  ((640, 480), 'connected', '640x480')], 1):
        screen.resize(*size)
        watch.says('change', 20, times=number)
        bench.guest.check(f'echo detect >{connector}/status')
        assert bench.guest.check(f'cat {connector}/status') == state
        assert bench.guest.check(f'head -n 1 {connector}/modes') == mode
    screen.close()
    watch.stop()


def seatd_starts(bench):
    """seatd opens its socket to an unprivileged user"""
    seatd = services.start_seatd(bench)
    assert bench.guest.start('test -w /run/seatd.sock', user=services.NOBODY).wait(10) == 0
    assert bench.guest.start('test -w /run/seatd.sock', user=1).wait(10) != 0
    seatd.stop()


GUESTS = [
    Guest(['virtio-gpu-pci,id=screen,xres=640,yres=480'], ['vkms', 'virtio-gpu'],
          [has_crc_of_the_pattern, screendump_is_the_pattern, monitor_is_resized, seatd_starts]),
]
