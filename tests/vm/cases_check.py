# SPDX-License-Identifier: MIT
"""smoothie check finds the same with a DRM node and without."""

import csv
import os
import xml.etree.ElementTree as xml

import program
from bench import Guest
from services import NOBODY

# MIN on a target, what a target keeps, and a picture whose every bit is pinned.
CHECKS = ['format.rgba8.min', 'format.rgba8.rounding', 'exact.smoothie.fixed12.cylinder']
LIMIT = 180


def check(bench, device, tests, output):
    """A shell command that runs these, two at a time; slow machines want more than a minute."""
    chosen = ' '.join(f'--test {test}' for test in tests)
    return program.command(bench, f'check --device {device} {chosen} --jobs 2 --timeout 120 '
                                  f'--output /run/share/{output}')


def all_pass(bench, device):
    """Runs CHECKS there, and looks at what that prints and leaves."""
    output = f'check-{os.path.basename(device)}'
    said = bench.guest.check(check(bench, device, CHECKS, output), LIMIT)
    assert f'device {device}\n' in said, said
    assert [line.split()[:2] for line in said.splitlines()[-2:]] == \
        [['Pass', str(len(CHECKS))], ['All', str(len(CHECKS))]], said
    with open(bench.guest.share(f'{output}/results.csv'), encoding='utf-8') as file:
        results = [(name, status) for name, status, _ in csv.reader(file)]
    assert sorted(results) == [(name, 'Pass') for name in sorted(CHECKS)], results
    facts = {fact.get('name'): fact.get('value') for fact in
             xml.parse(bench.guest.share(f'{output}/junit.xml')).iter('property')}
    assert facts['device'] == device, facts


def check_without_a_node(bench):
    """check --device surfaceless: cases pass, two at a time"""
    all_pass(bench, 'surfaceless')


def check_beside_a_display(bench):
    """check on virtio-gpu, through GBM: they pass there while another program's picture stays"""
    held = program.hold(bench, 'virtio_gpu', '320x240')
    all_pass(bench, bench.card('virtio_gpu'))
    program.expect_screen(bench, 'pattern:320x240')
    assert held.stop() == 0


def check_on_vkms(bench):
    """check on vkms, which has no render node: they pass there"""
    all_pass(bench, bench.card('vkms'))


def check_refuses(bench):
    """check on a node that may not be opened is an error: nothing is checked in its place"""
    node = bench.card('virtio_gpu')
    job = bench.guest.start(check(bench, node, CHECKS[:1], 'refused'), 'check', NOBODY)
    assert job.wait(LIMIT) == 1, job.out
    assert job.err == f'smoothie: device {node} does not work: Permission denied\n', job.err
    assert job.out == '', job.out


GUESTS = [
    Guest(['virtio-gpu-pci,id=screen,xres=320,yres=240'], ['vkms', 'virtio-gpu'], [
        check_without_a_node, check_beside_a_display, check_on_vkms, check_refuses]),
]
