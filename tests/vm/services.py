# SPDX-License-Identifier: MIT
"""Services that a session on a seat has, in the guest."""

from bench import Skip

NOBODY = 65534
UDEVD = '/lib/systemd/systemd-udevd'


def start_udev(bench):
    """Starts udevd, if it does not run yet, and lets it learn of the cards."""
    if bench.guest.run(f'test -x {UDEVD}')[0] != 0:
        raise Skip(f'there is no {UDEVD} (package udev)')
    bench.guest.check(f'test -e /run/udev/control || {UDEVD} --daemon; '
                      'udevadm trigger --subsystem-match=drm; udevadm settle', 40)


def start_seatd(bench, user='nobody'):
    """Starts seatd, if it does not run yet; its socket is the user's."""
    if bench.guest.run('command -v seatd')[0] != 0:
        raise Skip('there is no seatd (package seatd)')
    if 'seatd' not in bench.running:
        seatd = bench.running['seatd'] = bench.guest.start(f'exec seatd -u {user}', 'seatd')
        seatd.lasting = True
        seatd.says('seatd started', 20)


def stop_seatd(bench):
    bench.running.pop('seatd').stop()
