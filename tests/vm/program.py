# SPDX-License-Identifier: MIT
"""The program in the guest, and what stands on the guest's displays.

Everything is small and has one sample a pixel, because the GPU is emulated by an emulated
processor."""

import os
import shutil
import subprocess
import time

SCENE = 'builtin:cylinder --map 256 --samples 1'
# The first frame in a fresh guest compiles all shaders.
START_LIMIT, REDRAW_LIMIT = 90, 40


def load_shaders(bench):
    """Gives the guest what the last one has compiled."""
    kept = os.path.join(bench.image.folder, 'shaders.tar')
    bench.guest.check(f'mkdir -m 1777 /shaders && ! test -e {kept} || tar -xf {kept} -C /shaders')


def keep_shaders(bench):
    """Keeps what the guest has compiled for the next one; the drivers limit their caches."""
    bench.guest.check('tar -cf /run/share/shaders.tar -C /shaders .')
    target = os.path.join(bench.image.folder, 'shaders.tar')
    shutil.copyfile(bench.guest.share('shaders.tar'), f'{target}.new')
    os.replace(f'{target}.new', target)


def command(bench, arguments, programs='/shaders/programs', buffers=''):
    """A shell command that becomes the program; programs: its own cache; buffers: that kind
    alone."""
    return ('export MESA_SHADER_CACHE_DIR=/shaders MESA_SHADER_CACHE_MAX_SIZE=32M '
            f'SMOOTHIE_CACHE_DIR={programs} SMOOTHIE_BUFFERS={buffers}; '
            f'exec {bench.build}/src/app/smoothie {arguments}')


def start_show(bench, driver, arguments='', user=None, scene=SCENE, **options):
    """Starts "smoothie show" on the card of a driver, with all its messages."""
    return bench.guest.start(command(bench, f'show {scene} --device {bench.card(driver)} -vv '
                                     f'{arguments}', **options), 'show', user)


def show(bench, driver, arguments='', **options):
    """The same, and waits for its first frame."""
    job = start_show(bench, driver, arguments, **options)
    job.says('flip: frame 1 shows tick 0', START_LIMIT)
    return job


def running(bench, key, start):
    """The program that case after case goes on with: the one of before, or else what start()
    returns."""
    job = bench.running.get(key)
    if job is None or job.status is not None:
        job = bench.running[key] = start()
        job.lasting = True
    return job


def flips(job):
    """The ticks of the frames that were shown so far."""
    return [int(line.rsplit(' ', 1)[1]) for line in job.err.splitlines() if ' flip: frame ' in line]


def wait_for_flips(bench, job, count):
    bench.guest.wait_until(lambda: len(flips(job)) >= count or job.status is not None, REDRAW_LIMIT,
                           f'{count} frames')
    assert len(flips(job)) >= count, f'ended: {job.status}\n{job.err}'


def fact(job, name):
    """A line "name: value" of what it printed last."""
    values = [line.split(': ', 1)[1] for line in job.out.splitlines()
              if line.startswith(name + ': ')]
    assert values, f'no "{name}" in:\n{job.out}{job.err}'
    return values[-1]


def picture(bench, size, arguments=''):
    """What the program draws without a display, made once: PNG files of the host, one unless
    arguments say more."""
    key = f'{size} {arguments}'
    if key not in bench.pictures:
        name = f'picture-{len(bench.pictures)}'
        bench.guest.check(command(bench, f'render {SCENE} --device surfaceless --size {size} '
                                  f'-o /run/share/{name}.png {arguments}'), 2 * START_LIMIT)
        bench.pictures[key] = sorted(bench.guest.share(file) for file in
                                     os.listdir(bench.guest.share()) if file.startswith(name))
    return bench.pictures[key]


def vm_picture(bench, *arguments):
    """Runs the tool on the host; returns whether pictures are equal, and what it says."""
    done = subprocess.run([bench.tool('vm_picture'), *arguments], stdout=subprocess.PIPE, text=True,
                          check=False)
    return done.returncode == 0, done.stdout.strip()


def crc_of(bench, *arguments):
    """What vkms will say of a picture."""
    made, crc = vm_picture(bench, *arguments)
    assert made, arguments
    return f'0x{crc}'


def crc_shown(bench):
    """What vkms says of its display now, or "" while that is off."""
    crc = f'{bench.debug("vkms")}/crtc-0/crc'
    line = bench.guest.run(f'echo auto >{crc}/control; timeout 5 head -n 2 {crc}/data')[1]
    return line.split()[-1] if line else ''


def expect_crc(bench, expected, limit=10):
    """Waits until the display of vkms shows this."""
    end = time.monotonic() + limit
    while (shown := crc_shown(bench)) != expected:
        assert time.monotonic() < end, f'the display shows {shown}, not {expected}'


def expect_screen(bench, expected, *arguments, limit=10):
    """Waits until the screen of virtio-gpu shows this picture, changed as arguments tell."""
    end = time.monotonic() + limit
    while True:
        equal, difference = vm_picture(bench, *arguments, expected,
                                       bench.guest.screendump('screen.ppm'))
        if equal:
            return
        assert time.monotonic() < end, difference
        time.sleep(0.3)


def hold(bench, driver, size):
    """Puts the test pattern on the display, as one that was there before; returns its Job."""
    job = bench.guest.start(f'exec {bench.tool("vm_hold")} {bench.card(driver)} {size}', 'hold')
    job.says(f'shown: {size}', 20)
    return job


def processor_time(bench, job):
    """ms that the process has used so far."""
    stat = bench.guest.check(f'cat /proc/{job.pid}/stat').rsplit(')', 1)[1].split()
    return 10 * (int(stat[11]) + int(stat[12]))  # utime and stime, in ticks of 10 ms


def size_of(bench, job):
    """Open descriptors and KB of the process's own memory, without the files that it maps."""
    files = bench.guest.check(f'ls /proc/{job.pid}/fd | wc -l')
    memory = bench.guest.check(f'grep RssAnon /proc/{job.pid}/status')
    return int(files), int(memory.split()[1])
