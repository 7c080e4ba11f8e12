# SPDX-License-Identifier: MIT
"""What goes wrong on a display: afterwards the picture is right again, or the program has ended as
it should."""

import time

import program
import services
from bench import Guest

BOCHS, SOCKET = 'bochs-display,id=gpu,bus=socket,xres=640,yres=480', 'pcie-root-port,id=socket'
SIZE = '640x480'


def picture_crc(bench, size=SIZE):
    return program.crc_of(bench, *program.picture(bench, size))


def show(bench, arguments='', **options):
    return program.show(bench, 'vkms', f'--mode {SIZE} {arguments}', **options)


def still(bench):
    """What goes on to show a scene that stands still on vkms."""
    return program.running(bench, 'still', lambda: show(bench, '--stats'))


def plugged(bench):
    """What goes on to show a scene that stands still on virtio-gpu."""
    return program.running(bench, 'plugged', lambda: program.show(bench, 'virtio_gpu'))


def expect_last_words(job, text):
    """That it failed with status 1, and its last line, and no other, has the text."""
    assert job.wait(40) == 1, job.err
    assert job.err.count(text) == 1 and text in job.err.splitlines()[-1], job.err


def another_program(bench):
    """A display that another program has is one line on standard error, and status 1"""
    other = bench.guest.start(f'exec {bench.tool("vm_master")} {bench.card("vkms")}')
    other.says('master', 20)
    job = bench.guest.start(program.command(bench, f'show {program.SCENE} '
                                            f'--device {bench.card("vkms")}'))
    expect_last_words(job, 'in use by another program')
    assert job.err.count('\n') == 1, job.err
    other.stop()


def restores(bench):
    """SIGTERM while a flip is pending ends it with status 0, and what was there before is back"""
    held = program.hold(bench, 'vkms', '800x600')
    job = show(bench, '--set motion.turns=light --set motion.period=9')
    program.wait_for_flips(bench, job, 3)
    assert job.stop() == 0, job.err
    program.expect_crc(bench, program.crc_of(bench, 'pattern:800x600'))
    held.stop()


def master_stolen(bench):
    """A display that is stolen and given back shows the picture again"""
    job = still(bench)
    thief = bench.guest.start(f'exec {bench.tool("vm_master")} {bench.card("vkms")} {job.pid}')
    thief.says('master', 20)
    program.expect_crc(bench, program.crc_of(bench, 'pattern:640x480'))
    time.sleep(6)  # more than it takes to look
    assert job.status is None, job.err
    assert thief.stop() == 0
    program.expect_crc(bench, picture_crc(bench), program.REDRAW_LIMIT)


def master_stolen_in_motion(bench):
    """A moving scene waits while its display is stolen, and goes on when it is given back"""
    job = show(bench, '--set motion.turns=camera --set motion.period=9')
    program.wait_for_flips(bench, job, 3)
    thief = bench.guest.start(f'exec {bench.tool("vm_master")} {bench.card("vkms")} {job.pid}')
    thief.says('master', 20)
    job.says('another program has taken the display', 20)
    shown = len(program.flips(job))
    before = program.processor_time(bench, job)
    time.sleep(3)
    assert program.processor_time(bench, job) - before < 100
    assert len(program.flips(job)) == shown
    assert thief.stop() == 0
    program.wait_for_flips(bench, job, shown + 3)
    assert job.stop() == 0


def connector_off(bench):
    """vkms: a monitor that goes without any event is missed, and its return is seen"""
    job = still(bench)
    status = f'{bench.connector("vkms")}/status'
    bench.guest.check(f'echo off >{status}')
    job.says('the monitor is gone', 20)
    bench.guest.check(f'echo detect >{status}')
    program.expect_crc(bench, picture_crc(bench), program.REDRAW_LIMIT)


def full_disk(bench):
    """Counts that cannot be written: the picture goes on at SIGUSR1, and the end has status 1"""
    bench.guest.check('mkdir -p /full; mount -t tmpfs -o size=8k full /full; '
                      'head -c 8192 /dev/zero >/full/file')
    job = program.start_show(bench, 'vkms', f'--mode {SIZE} --stats >/full/out')
    job.says('flip: frame 1 shows', program.START_LIMIT)
    job.kill('USR1')
    job.says('No space left on device', 20)
    program.expect_crc(bench, picture_crc(bench))
    assert job.stop() == 1
    assert job.err.count('No space left on device') == 2, job.err
    bench.guest.check('umount /full')


def counts_on_request(bench):
    """SIGUSR1 prints the counts so far"""
    job = still(bench)
    job.kill('USR1')
    job.says('processor time: ', 20)
    assert program.fact(job, 'flips') == '1'


def nothing_grows(bench):
    """No descriptor and no memory is lost when a monitor comes and goes many times"""
    job = still(bench)
    assert replug_often(bench, job, 10) == 10
    before = program.size_of(bench, job)
    cycles = replug_often(bench, job, 190, 35)
    after = program.size_of(bench, job)
    print(f'# {cycles} cycles more: {before} then {after} (descriptors, KB)')
    assert cycles >= 10, f'only {cycles} cycles'
    assert after[0] == before[0] and after[1] <= before[1] + 1024
    program.expect_crc(bench, picture_crc(bench))
    assert job.stop() == 0


# In a shell of the guest, because each way from the host costs as much as a frame.
REPLUG = """
says() {{
	for i in $(seq 400); do
		test $(grep -c "$1" {log}) -ge $2 && return
		sleep .05
	done
	exit 1
}}
cd {connector}
end=$(($(date +%s) + {seconds}))
cycle=0
while [ $cycle -lt {cycles} ] && [ $(date +%s) -lt $end ]; do
	cycle=$((cycle + 1))
	echo off >status
	echo change >../uevent
	says "the monitor is gone" $(({gone} + cycle))
	echo detect >status
	echo change >../uevent
	says " flip: frame " $(({shown} + cycle))
done
echo $cycle
"""


def replug_often(bench, job, cycles, seconds=60):
    """Takes the monitor away and gives it back so often, but not longer than so; how often?"""
    script = REPLUG.format(connector=bench.connector('vkms'), log=f'/run/share/{job.name}.err',
                           gone=job.err.count('the monitor is gone'),
                           shown=len(program.flips(job)), cycles=cycles, seconds=seconds)
    return int(bench.guest.check(script, seconds + 30))


def no_rights(bench):
    """Without seatd, such a user is told in one line what to do, with status 1"""
    job = bench.guest.start(program.command(bench, f'show {program.SCENE} '
                                            f'--device {bench.card("vkms")}'), user=services.NOBODY)
    expect_last_words(job, 'seatd')


def seated(bench):
    """What a user without privileges goes on to show on a seat of seatd."""
    services.start_seatd(bench)
    return program.running(bench, 'seated', lambda: show(bench, '--stats', user=services.NOBODY))


def unprivileged(bench):
    """With seatd, a user without privileges shows the picture"""
    job = seated(bench)
    program.expect_crc(bench, picture_crc(bench))
    assert job.status is None and 'seat: seatd, active' in job.err, job.err


def terminals_switched(bench):
    """Another virtual terminal pauses it, and it comes back with the picture drawn again"""
    job = seated(bench)
    bench.guest.check('timeout 15 busybox chvt 2')
    other = program.hold(bench, 'vkms', SIZE)
    program.expect_crc(bench, program.crc_of(bench, f'pattern:{SIZE}'))
    other.stop()
    bench.guest.check('timeout 15 busybox chvt 1')
    program.expect_crc(bench, picture_crc(bench), program.REDRAW_LIMIT)
    assert job.stop() == 0
    services.stop_seatd(bench)


def starts_without_monitor(bench):
    """Without a monitor it waits, and shows the picture on the first one"""
    services.start_udev(bench)
    bench.screen = bench.guest.screen()
    bench.screen.resize(320, 240)  # QEMU ignores 0x0 as long as it was told of no other size
    plug(bench, 0, 0)
    job = program.running(bench, 'plugged', lambda: program.start_show(bench, 'virtio_gpu'))
    job.says('no monitor yet', 60)
    bench.screen.resize(320, 240)
    job.says('flip: frame 1 shows', program.START_LIMIT)
    program.expect_screen(bench, *program.picture(bench, '320x240'))


def plug(bench, width, height):
    """Changes the monitor's size, and waits until the kernel knows."""
    bench.screen.resize(width, height)
    expected = f'{width}x{height}' if width else ''
    connector = bench.connector('virtio_gpu')
    bench.guest.check('for i in $(seq 100); do '
                      f'test "$(echo detect >{connector}/status; head -n 1 {connector}/modes)" = '
                      f'"{expected}" && exit; sleep .2; done; exit 1', 40)


def unplugged(bench):
    """A monitor that is unplugged and plugged in shows the picture again"""
    job = plugged(bench)
    gone, shown = job.err.count('the monitor is gone'), len(program.flips(job))
    bench.screen.resize(0, 0)
    job.says('the monitor is gone', 20, times=gone + 1)
    bench.screen.resize(320, 240)
    program.wait_for_flips(bench, job, shown + 1)
    program.expect_screen(bench, *program.picture(bench, '320x240'))


def mode_changed(bench):
    """A mode that the host changes is followed"""
    job = plugged(bench)
    shown = len(program.flips(job))
    bench.screen.resize(400, 300)
    program.wait_for_flips(bench, job, shown + 1)
    program.expect_screen(bench, *program.picture(bench, '400x300'))
    bench.screen.resize(320, 240)
    program.wait_for_flips(bench, job, shown + 2)
    program.expect_screen(bench, *program.picture(bench, '320x240'))
    assert job.stop() == 0


def gpu_unplugged(bench):
    """bochs: a GPU that is pulled out ends it with one line and status 1"""
    job = program.show(bench, 'bochs-drm')
    bench.guest.monitor.call('device_del', id='gpu')
    expect_last_words(job, 'was removed')


def gpu_removed(bench):
    """virtio-gpu: a driver that is removed while frames flow ends it with one line and status 1"""
    card = bench.card('virtio_gpu').rsplit('/', 1)[1]
    job = program.show(bench, 'virtio_gpu', '--set motion.turns=camera --set motion.period=9')
    program.wait_for_flips(bench, job, 2)
    bench.guest.check(f'echo 1 >/sys/class/drm/{card}/device/remove', 40)
    expect_last_words(job, 'was removed')


def console_comes_back(bench):
    """The kernel's console is back after the end, and after a crash"""
    bench.guest.check(f'modprobe -d {bench.image.folder} drm_kms_helper; '
                      'echo Y >/sys/module/drm_kms_helper/parameters/fbdev_emulation')
    bench.load('virtio-gpu')
    # Without a cursor, which blinks.
    bench.guest.check(r"printf '\033[?25l\033[2J\033[Hthis is the console' >/dev/tty1")
    before = bench.guest.screendump('console.ppm')
    for name, status in (('TERM', 0), ('KILL', 128 + 9)):
        job = program.show(bench, 'virtio_gpu')
        program.expect_screen(bench, *program.picture(bench, '320x240'))
        assert job.stop(name) == status, job.err
        program.expect_screen(bench, before)


GUESTS = [
    Guest(['virtio-gpu-pci,id=screen,xres=320,yres=240', SOCKET, BOCHS],
          ['vkms', 'virtio-gpu', 'bochs'], [
        another_program, restores, counts_on_request, master_stolen, connector_off, nothing_grows,
        master_stolen_in_motion, full_disk, no_rights, unprivileged, terminals_switched,
        starts_without_monitor, unplugged, mode_changed, gpu_unplugged, gpu_removed]),
    Guest(['virtio-gpu-pci,id=screen,xres=320,yres=240'], [], [console_comes_back]),
]
