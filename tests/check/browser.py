#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Opens a report in Chromium, uses it, and looks at it: browser.py WRITE_REPORT [FOLDER/].
Skipped (77) where there is no Chromium. Screenshots are kept in the FOLDER."""

import pathlib
import subprocess
import sys
import tempfile
import unittest

import chromium

CASES = 60

SEEN = '''[...document.querySelectorAll('.results tbody tr')].filter(row => !row.hidden)
	.map(row => row.dataset.name)'''
PLACES = '''[...document.querySelectorAll('%s')].map(element => {
	const box = element.getBoundingClientRect();
	return [box.left, box.top, box.width, box.height];
})'''


class Browser(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.scratch.name)
        subprocess.run([WRITE_REPORT, cls.folder], check=True, stdout=subprocess.DEVNULL)
        cls.page = chromium.Page()

    @classmethod
    def tearDownClass(cls):
        cls.page.close()
        cls.scratch.cleanup()

    def open(self, width=1280, height=1500, scheme='light'):
        self.page.open(self.folder / 'report.html', width, height, scheme)

    def shoot(self, name):
        return self.page.shoot((KEPT or self.folder) / f'{name}.png')

    def seen(self):
        """The names in the table, and what is said of their number."""
        return self.page.evaluate(SEEN), self.page.evaluate(
            "document.querySelector('.filter output').textContent")

    def click(self, selector):
        self.page.evaluate(f"document.querySelector('{selector}').click()")

    def search(self, text):
        self.page.evaluate("document.querySelector('.filter input').select()")
        self.page.call('Input.insertText', text=text)

    def share(self):
        """Of the first picture, how much shows the result: as drawn, and as told."""
        return self.page.evaluate(
            "getComputedStyle(document.querySelector('.stage')).getPropertyValue('--at')"), \
            self.page.evaluate("document.querySelector('.stage input').ariaValueText")

    def focus_slider(self):
        self.page.evaluate("document.querySelector('.stage input').focus()")

    def test_results_are_filtered(self):
        self.open()
        names, told = self.seen()
        self.assertEqual((len(names), told), (CASES, f'{CASES} of {CASES} cases'))
        self.click('.filter [data-status=Crash]')
        self.assertEqual(self.seen(), (['format.rg16f.min'], f'1 of {CASES} cases'))
        self.click('.filter [data-status=Flake]')
        self.assertEqual(self.seen()[0], ['format.rg16f.min', 'frame.repeat'])
        self.click('.filter [data-status=Crash]')
        self.click('.filter [data-status=Flake]')
        self.search('VSM bunny')
        self.assertEqual(self.seen()[0], ['picture.vsm.float.bunny.copy=stored',
                                          'picture.vsm.float.bunny.copy=encode'])
        self.search('no such case')
        self.assertEqual(self.seen(), ([], f'0 of {CASES} cases'))

    def test_results_are_sorted(self):
        self.open()
        for column, times, first, order in ((2, 1, 'context.create-destroy', 'ascending'),
                                            (3, 2, 'context.create-destroy', 'descending'),
                                            (4, 2, 'exact.smoothie.fixed12.fence', 'descending')):
            for _ in range(times):
                self.click(f'.results th:nth-child({column}) button')
            names, _ = self.seen()
            self.assertEqual((len(names), names[0]), (CASES, first))
            self.assertEqual(self.page.evaluate(
                "[...document.querySelectorAll('.results [aria-sort]')].map(heading =>"
                "[heading.cellIndex + 1, heading.ariaSort])"), [[column, order]])
        # those without pixels are last in either order
        last = {name.split('.')[0] for name in names[-7:]}
        self.assertEqual(last, {'context', 'evil', 'format', 'frame', 'picture'})

    def test_the_wipe_follows_keys(self):
        self.open()
        self.assertEqual(self.share(), ('50%', '50 % result'))
        self.focus_slider()
        for key, code, times, share in (('ArrowRight', 39, 3, 53), ('ArrowLeft', 37, 5, 48),
                                        ('Home', 36, 1, 0), ('End', 35, 1, 100)):
            for _ in range(times):
                self.page.press(key, code)
            self.assertEqual(self.share(), (f'{share}%', f'{share} % result'))

    def test_the_wipe_follows_the_mouse(self):
        self.open()
        left, top, width, height = self.page.evaluate(PLACES % '.stage')[0]
        middle = top + height / 2
        for start, end in (50, 20), (20, 80), (5, 65):
            self.page.drag((left + width * start / 100, middle), (left + width * end / 100, middle))
            share = int(self.share()[0].rstrip('%'))
            self.assertTrue(abs(share - end) <= 1, (share, end))

    def test_wipes_are_told_to_who_cannot_see_them(self):
        self.open(height=8000)  # of what is far below, Chromium tells later
        sliders = self.page.accessible('slider', 3)
        self.assertEqual(len(sliders), 3)
        self.assertEqual(sliders[0][0], 'Wipe: share of the picture that shows the result of '
                                        'exact.smoothie.fixed12.fence')
        pictures = [name for name, _ in self.page.accessible('image', 9)]
        self.assertIn('Difference of exact.smoothie.fixed12.fence', pictures)

    def test_nothing_is_requested(self):
        self.open()
        self.assertTrue(self.page.evaluate(
            '[...document.images].every(image => image.complete && image.naturalWidth > 0)'))
        other = [url for url in self.page.requests if not url.startswith('data:')]
        self.assertEqual(other, [(self.folder / 'report.html').as_uri()])

    def check_wipe(self, picture, share):
        """Of the first case the result, at the left, is white, and the reference is black."""
        left, top, width, height = self.page.evaluate(PLACES % '.stage')[0]
        for x in range(5, 100, 10):
            if abs(x - share) < 4:  # the handle
                continue
            colour = picture.at(left + width * x / 100, top + height / 4)
            self.assertEqual(colour, (255,) * 3 if x < share else (0,) * 3, x)
        left, top, width, height = self.page.evaluate(PLACES % '.heat')[0]
        red, green, blue = picture.at(left + width / 2, top + height / 2)
        self.assertTrue(red > 150 and green < 60 and blue < 60, (red, green, blue))

    def check_light(self, picture):
        """The second case's reference fades into 1; half of that is sRGB 188."""
        left, top, width, height = self.page.evaluate(PLACES % '.stage')[1]
        # the middle of the ramp is where the shadow's edge would be, at x = .55 + .27
        middle = picture.at(left + width * (.82 + .5 / 128), top + height * (.5 + .5 / 128))
        self.assertTrue(abs(middle[0] - 188) <= 6, middle)

    def test_colours(self):
        for scheme in 'light', 'dark':
            self.open(scheme=scheme)
            self.focus_slider()
            for _ in range(22):
                self.page.press('ArrowRight', 39)
            picture = self.shoot(scheme)
            self.check_wipe(picture, 72)
            self.check_light(picture)
            back = picture.at(2, 2)
            self.assertEqual(min(back) > 200, scheme == 'light', back)

    def test_narrow_screens_need_no_scrolling_to_the_side(self):
        for scheme in 'light', 'dark':
            self.open(400, 1500, scheme)
            self.shoot(f'narrow-{scheme}')
            self.assertEqual(self.page.evaluate('document.documentElement.scrollWidth'), 400)
            self.page.evaluate("document.querySelector('#results').scrollIntoView()")
            self.shoot(f'narrow-results-{scheme}')


if __name__ == '__main__':
    if chromium.find() is None:
        print('skipped: none of', ', '.join(chromium.NAMES), 'is installed')
        sys.exit(77)
    WRITE_REPORT = sys.argv.pop(1)
    KEPT = pathlib.Path(sys.argv.pop(1)) if len(sys.argv) > 1 and '/' in sys.argv[1] else None
    unittest.main()
