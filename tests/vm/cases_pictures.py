# SPDX-License-Identifier: MIT
"""What is shown is what is drawn without a display, bit for bit."""

import time

import program
from bench import Guest


def vkms_tells_the_pattern(bench):
    """vkms: the CRC of the test pattern is what is computed for it"""
    held = program.hold(bench, 'vkms', '640x480')
    program.expect_crc(bench, program.crc_of(bench, 'pattern:640x480'))
    assert held.stop() == 0


def virtio_tells_the_pattern(bench):
    """virtio-gpu: a screendump of the test pattern is the pattern, and so is a grab"""
    held = program.hold(bench, 'virtio_gpu', '320x240')
    program.expect_screen(bench, 'pattern:320x240')
    bench.guest.check(f'{bench.tool("vm_grab")} {bench.card("virtio_gpu")} >/run/share/grab.ppm')
    equal, difference = program.vm_picture(bench, 'pattern:320x240', bench.guest.share('grab.ppm'))
    assert equal, difference
    assert held.stop() == 0


def lists_all(bench):
    """show --list names the cards, and why one without monitors is of no use"""
    listed = bench.guest.check(program.command(bench, 'show --list'), 60)
    for text in (bench.card('vkms'), bench.card('virtio_gpu'), 'Virtual-1', '640x480', 'RG16'):
        assert text.lower() in listed.lower() or text == 'RG16' and 'rgb565' in listed, listed


def shows_on_vkms(bench, arguments, *conversion, **options):
    expected = program.crc_of(bench, *conversion, *program.picture(bench, '640x480'))
    job = program.show(bench, 'vkms', f'--mode 640x480 {arguments}', **options)
    program.expect_crc(bench, expected)
    assert job.stop() == 0, job.err


def atomic_xrgb8888(bench):
    """vkms, atomic, XRGB8888: the CRC of the CRTC is that of the picture"""
    shows_on_vkms(bench, '--format xrgb8888')


def atomic_rgb565(bench):
    """vkms, atomic, RGB565: the CRC of the CRTC is that of the dithered picture"""
    shows_on_vkms(bench, '--format rgb565', '--rgb565')


def legacy_xrgb8888(bench):
    """vkms, legacy, XRGB8888: the CRC of the CRTC is that of the picture"""
    shows_on_vkms(bench, '--legacy --format xrgb8888')


def legacy_rgb565(bench):
    """vkms, legacy, RGB565: the CRC of the CRTC is that of the dithered picture"""
    shows_on_vkms(bench, '--legacy --format rgb565', '--rgb565')


def gbm_xrgb8888(bench):
    """vkms, buffers of GBM: the CRC of the CRTC is that of the picture"""
    shows_on_vkms(bench, '', buffers='gbm')


def gbm_rgb565(bench):
    """vkms, buffers of GBM, RGB565: the CRC of the CRTC is that of the dithered picture"""
    shows_on_vkms(bench, '--format rgb565', '--rgb565', buffers='gbm')


def keeps_the_current_mode(bench):
    """--mode current keeps a mode that is not the preferred one"""
    held = program.hold(bench, 'vkms', '640x480')
    job = program.show(bench, 'vkms', '--mode current')
    program.expect_crc(bench, program.crc_of(bench, *program.picture(bench, '640x480')))
    assert job.stop('INT') == 0
    program.expect_crc(bench, program.crc_of(bench, 'pattern:640x480'))
    held.stop()


# The CRC of a display without a picture, as it is before and after.
DARK = '0x00000000'


def motion(bench):
    """vkms: 60 frames of a moving scene, each CRC that of the picture of its tick, in order"""
    # of 640x480, in Hz and pixels; after these ticks the camera is where it was
    clock, total, ticks = 25175000, 800 * 525, 16
    setting = ('--set camera.eye=40,30,40 --set motion.turns=camera '  # from afar: fewer pixels
               f'--set motion.period={ticks * total / clock}')
    pictures = program.picture(bench, '640x480',
                               f'{setting} --frames {ticks} --fps {clock}/{total}')
    of_tick = [program.crc_of(bench, file) for file in pictures]
    assert len(set(of_tick)) == ticks, 'two pictures are equal'

    job = program.show(bench, 'vkms', f'--mode 640x480 {setting} --frames 64 --stats')
    crc = f'{bench.debug("vkms")}/crtc-0/crc'
    watch = bench.guest.start(f'echo auto >{crc}/control; exec cat {crc}/data >/tmp/crcs')
    assert job.wait(120) == 0, job.err
    watch.stop()
    shown = without_repeats(bench.guest.check("awk 'NF == 2 { print $2 }' /tmp/crcs").split())
    if shown[-1] == DARK:
        shown.pop()
    expected = without_repeats([of_tick[tick % ticks] for tick in program.flips(job)])
    assert program.fact(job, 'flips') == '64'
    # the first may have gone before somebody looked, the last is taken off at once
    missing = len(expected) - len(shown)
    assert missing <= 4, f'only {len(shown)} frames were seen'
    assert any(shown == expected[first:first + len(shown)] for first in range(missing + 1)), \
        f'{program.flips(job)}\n{shown}\n{expected}'


def without_repeats(values):
    return [value for i, value in enumerate(values) if i == 0 or value != values[i - 1]]


def sleeps(bench):
    """A scene that stands still is drawn and flipped once, and takes under 1 % of a processor"""
    job = program.show(bench, 'vkms', '--mode 640x480 --stats')
    time.sleep(1)
    before = program.processor_time(bench, job)
    time.sleep(5)
    used = program.processor_time(bench, job) - before
    assert used < 50, f'{used} ms of 5 s'
    assert job.stop() == 0
    assert (program.fact(job, 'frames drawn'), program.fact(job, 'flips')) == ('1', '1')


def says_that_vsync_stays(bench):
    """--vsync off says where the driver cannot"""
    job = program.show(bench, 'virtio_gpu', '--vsync off --frames 2')
    assert job.wait(program.REDRAW_LIMIT) == 0
    assert 'without vsync' in job.err, job.err


def upright(bench):
    """virtio-gpu: a screendump is the picture"""
    job = program.show(bench, 'virtio_gpu')
    program.expect_screen(bench, *program.picture(bench, '320x240'))
    assert job.stop() == 0


def turned_by(degrees, buffers=''):
    def case(bench):
        size = '320x240' if degrees % 180 == 0 else '240x320'
        job = program.show(bench, 'virtio_gpu', f'--rotate {degrees}', buffers=buffers)
        expected, = program.picture(bench, size)
        program.expect_screen(bench, expected, '--rotate', str(degrees))
        assert job.stop() == 0

    kind = ', buffers of GBM' if buffers else ''
    case.__doc__ = f'virtio-gpu, --rotate {degrees}{kind}: a screendump is the turned picture'
    return case


def headless_node(bench):
    """render --device with a render node that cannot be drawn on goes on with what can"""
    node = bench.guest.check('grep -l vgem /sys/kernel/debug/dri/1??/name').split('/')[-2]
    expected, = program.picture(bench, '320x240')
    made, = program.picture(bench, '320x240', f'--device /dev/dri/renderD{node}')
    equal, difference = program.vm_picture(bench, expected, made)
    assert equal, difference


def second_start(bench):
    """A second start with the same caches compiles no program"""
    for compiled in (True, False):
        job = program.show(bench, 'virtio_gpu', '--stats', programs='/tmp/programs')
        assert job.stop() == 0
        assert (program.fact(job, 'programs compiled') != '0') == compiled, job.out


GUESTS = [
    Guest(['virtio-gpu-pci,id=screen,xres=320,yres=240'], ['vkms', 'virtio-gpu', 'vgem'], [
        vkms_tells_the_pattern, virtio_tells_the_pattern, lists_all,
        atomic_xrgb8888, atomic_rgb565, legacy_xrgb8888, legacy_rgb565, gbm_xrgb8888, gbm_rgb565,
        keeps_the_current_mode, motion, sleeps, says_that_vsync_stays,
        upright, turned_by(90), turned_by(180), turned_by(270),
        turned_by(90, 'gbm'), headless_node, second_start]),
]
