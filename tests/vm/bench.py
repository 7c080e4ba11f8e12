# SPDX-License-Identifier: MIT
"""What cases are made of."""

import collections
import os

# What a guest has beside QEMU's defaults, the drivers that it loads, what is run in it.
Guest = collections.namedtuple('Guest', 'devices modules cases')


class Skip(Exception):
    """Why a case cannot be run here."""


class Bench:
    """What a case works with: the guest, the folders of the build, the cards."""

    def __init__(self, build, guest, image):
        self.build, self.guest, self.image = build, guest, image
        self._cards, self.pictures, self.running = {}, {}, {}

    def tool(self, name):
        return os.path.join(self.build, 'tests', 'vm', name)

    def load(self, *modules):
        """Loads drivers, and learns which cards are theirs."""
        for module in modules:
            if module == 'vkms' and self.image.no_vkms:
                continue
            self.guest.check(f'modprobe -d {self.image.folder} {module}')
        lines = self.guest.check('grep -Hs . /sys/kernel/debug/dri/?/name || true')
        self._cards = {line.split(':', 1)[1].split()[0]: f'/dev/dri/card{line.split("/")[-2]}'
                       for line in lines.splitlines()}

    def start_over(self):
        """Ends whatever runs, so that the next case finds nothing of this one."""
        self.running = {}
        if not self.guest.failed:
            self.guest.stop_jobs(lasting=True)

    def card(self, driver):
        """The device of a driver."""
        if driver == 'vkms' and driver not in self._cards:
            raise Skip(self.image.no_vkms)
        return self._cards[driver]

    def debug(self, driver):
        """The card's folder in debugfs."""
        return '/sys/kernel/debug/dri/' + self.card(driver)[-1]

    def connector(self, driver):
        """The folder of its first connector in sysfs."""
        card = os.path.basename(self.card(driver))
        return self.guest.check(f'ls -d /sys/class/drm/{card}-*-1 /sys/class/drm/{card}-*-[2-9] '
                                '2>/dev/null | grep -v Writeback | head -n 1')
