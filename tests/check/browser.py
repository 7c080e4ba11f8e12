#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Opens a report in Chromium, uses it, and looks at it: browser.py WRITE_REPORT [FOLDER].
Skipped (77) where there is no Chromium. Screenshots are kept in the FOLDER."""

import functools
import html
import json
import pathlib
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest
import zlib

NAMES = 'chromium', 'chromium-browser', 'google-chrome'
DARK, LIGHT = 0, 1

# What a user does, in a page of its own: it ends by saying what came of it in the title.
USE = '''
const seen = () => [...document.querySelectorAll('.results tbody tr')].filter(row => !row.hidden);
const text = () => document.querySelector('.filter output').textContent;
const names = () => seen().map(row => row.dataset.name);
const search = value => {
	const field = document.querySelector('.filter input');
	field.value = value;
	field.dispatchEvent(new Event('input'));
};
const told = {all: text()};
const chip = document.querySelector('.filter button[data-status=Crash]');
chip.click();
told.crash = [text(), chip.getAttribute('aria-pressed'), names()];
chip.click();
search('VSM bunny');
told.search = [text(), names()];
search('no such case');
told.none = text();
search('');
const headings = [...document.querySelectorAll('.results thead th')];
headings[1].firstElementChild.click();
told.byName = names();
headings[2].firstElementChild.click();
headings[2].firstElementChild.click();
told.slowest = [names()[0], headings[2].getAttribute('aria-sort'),
	headings[1].getAttribute('aria-sort')];
headings[4].firstElementChild.click();
told.withoutMean = names().slice(-7).map(name => name.split('.')[0]).sort();
const slider = document.querySelector('.stage input');
slider.focus();
told.slider = [document.activeElement === slider, slider.tabIndex, slider.type, slider.ariaLabel];
slider.value = SHARE;
slider.dispatchEvent(new Event('input'));
told.text = slider.getAttribute('aria-valuetext');
told.clip = getComputedStyle(document.querySelector('.stage .over')).clipPath;
const place = element => {
	const box = element.getBoundingClientRect();
	return [box.left + scrollX, box.top + scrollY, box.width, box.height];
};
told.stages = [...document.querySelectorAll('.stage')].map(place);
told.heats = [...document.querySelectorAll('.heat')].map(place);
told.loaded = [...document.images].every(image => image.complete && image.naturalWidth > 0);
told.requests = performance.getEntriesByType('resource').map(entry => entry.name)
	.filter(name => !name.startsWith('data:'));
told.width = [document.documentElement.scrollWidth, innerWidth];
document.title = JSON.stringify(told);
'''


def chromium():
    return next(filter(None, map(shutil.which, NAMES)), None)


def browse(page, width, height, scheme, *arguments):
    """Opens a page, with nothing to reach on any network; returns what is printed."""
    with tempfile.TemporaryDirectory() as profile:
        return subprocess.run(
            [chromium(), '--headless=new', '--no-sandbox', '--disable-gpu', '--no-first-run',
             '--disable-background-networking', '--hide-scrollbars', '--disable-dev-shm-usage',
             '--host-resolver-rules=MAP * ~NOTFOUND', f'--user-data-dir={profile}',
             f'--window-size={width},{height}', f'--blink-settings=preferredColorScheme={scheme}',
             *arguments, page.as_uri()],
            check=True, timeout=120, stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL).stdout.decode()


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


class Browser(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.scratch.name)
        subprocess.run([WRITE_REPORT, cls.folder], check=True, stdout=subprocess.DEVNULL)
        cls.page = cls.folder / 'report.html'

    @classmethod
    def tearDownClass(cls):
        cls.scratch.cleanup()

    def used_page(self, share):
        """The report with a user who moves the first wipe to that share."""
        text = self.page.read_text(encoding='utf-8')
        used = self.folder / 'used.html'
        used.write_text(text.replace('</body>', f'<script>{USE.replace("SHARE", str(share))}'
                                     '</script></body>'), encoding='utf-8')
        return used

    @functools.lru_cache
    def use(self, share, width=1280):
        """What the user of used_page() tells, by name."""
        dom = browse(self.used_page(share), width, 900, LIGHT, '--dump-dom')
        return json.loads(html.unescape(re.search('<title>(.*?)</title>', dom, re.S)[1]))

    def shoot(self, page, name, width, height, scheme):
        path = (KEPT or self.folder) / f'{name}.png'
        browse(page, width, height, scheme, f'--screenshot={path}')
        return Picture(path)

    def test_rows_are_there(self):
        dom = browse(self.page, 1280, 900, LIGHT, '--dump-dom')
        self.assertEqual(len(re.findall('<tr data-status=', dom)), 60)
        self.assertIn('<output>60 of 60 cases</output>', dom)
        self.assertEqual(dom.count('<article '), 8)

    def test_results_are_filtered_and_sorted(self):
        told = self.use(25)
        self.assertEqual(told['all'], '60 of 60 cases')
        self.assertEqual(told['crash'], ['1 of 60 cases', 'true', ['format.rg16f.min']])
        self.assertEqual(told['search'], ['2 of 60 cases', [
            'picture.vsm.float.bunny.copy=stored', 'picture.vsm.float.bunny.copy=encode']])
        self.assertEqual(told['none'], '0 of 60 cases')
        self.assertEqual(told['byName'][0], 'context.create-destroy')
        self.assertEqual(len(told['byName']), 60)
        self.assertEqual(told['slowest'], ['context.create-destroy', 'descending', None])
        self.assertEqual(told['withoutMean'], ['context', 'evil', 'evil', 'format', 'format',
                                               'frame', 'picture'])

    def test_the_wipe_moves(self):
        for share in 25, 70:
            told = self.use(share)
            self.assertEqual(told['slider'][:3], [True, 0, 'range'])
            self.assertIn('exact.smoothie.fixed12.fence', told['slider'][3])
            self.assertEqual(told['text'], f'{share} % result')
            self.assertRegex(told['clip'], rf'inset\(-1px (calc\(100% - {share}%\)|{100 - share}%)')

    def test_nothing_is_requested(self):
        told = self.use(25)
        self.assertTrue(told['loaded'])
        self.assertEqual(told['requests'], [])

    def check_wipe(self, picture, told, share):
        """Of the first case the result, at the left, is white, and the reference is black."""
        left, top, width, height = told['stages'][0]
        for x in range(5, 100, 10):
            if abs(x - share) < 4:  # the handle
                continue
            colour = picture.at(left + width * x / 100, top + height / 4)
            self.assertEqual(colour, (255,) * 3 if x < share else (0,) * 3, x)
        left, top, width, height = told['heats'][0]
        red, green, blue = picture.at(left + width / 2, top + height / 2)
        self.assertTrue(red > 150 and green < 60 and blue < 60, (red, green, blue))

    def check_light(self, picture, told):
        """The second case's reference fades into 1; half of that is sRGB 188."""
        left, top, width, height = told['stages'][1]
        # the middle of the ramp is where the shadow's edge would be, at x = .55 + .27
        middle = picture.at(left + width * (.82 + .5 / 128), top + height * (.5 + .5 / 128))
        self.assertTrue(abs(middle[0] - 188) <= 6, middle)

    def test_colours(self):
        for scheme, name, share in (LIGHT, 'light', 25), (DARK, 'dark', 70):
            told = self.use(share)
            picture = self.shoot(self.used_page(share), name, 1280, 1500, scheme)
            self.check_wipe(picture, told, share)
            self.check_light(picture, told)
            back = picture.at(2, 2)
            self.assertEqual(min(back) > 200, scheme == LIGHT, back)

    def test_narrow_screens_need_no_scrolling_to_the_side(self):
        for scheme, name in (LIGHT, 'narrow-light'), (DARK, 'narrow-dark'):
            frame = self.folder / 'frame.html'
            frame.write_text('<body style="margin:0"><iframe src="report.html" style="border:0;'
                             'width:400px;height:2400px"></iframe>')
            picture = self.shoot(frame, name, 500, 2400, scheme)
            back = picture.at(2, 2)
            for y in range(0, 2400, 7):
                self.assertEqual(picture.at(398, y), back, y)
        told = self.use(25, width=500)
        self.assertLessEqual(told['width'][0], told['width'][1])


if __name__ == '__main__':
    if chromium() is None:
        print('skipped: none of', ', '.join(NAMES), 'is installed')
        sys.exit(77)
    WRITE_REPORT = sys.argv.pop(1)
    KEPT = pathlib.Path(sys.argv.pop(1)) if len(sys.argv) > 1 and '/' in sys.argv[1] else None
    unittest.main()
