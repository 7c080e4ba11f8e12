#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Reads a report with the parsers of others, whatever texts are in it: formats.py WRITE_REPORT."""

import csv
import html.parser
import json
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree

# SYNTHETIC_EVIL of synthetic.h, with what no text may have replaced.
EVIL = ']]></x>"\'<script>&#,\\    caf\ufffd \u00e9 '
MARKUP_EVIL = EVIL + '\ufffd'
CASES = 60
STATUSES = {'Pass': 50, 'Fail': 3, 'Skip': 2, 'Crash': 1, 'Timeout': 1, 'Flake': 1,
            'ExpectedFail': 1, 'UnexpectedPass': 1}
VOID = {'meta', 'img', 'br', 'input'}


class Page(html.parser.HTMLParser):
    """Fails on an element that is not closed in order; keeps tags and the text of table cells."""

    def __init__(self):
        super().__init__()
        self.open, self.tags, self.cells = [], [], []

    def handle_starttag(self, tag, attributes):
        self.tags.append((tag, dict(attributes)))
        if tag not in VOID:
            self.open.append(tag)
        if tag == 'td':
            self.cells.append('')

    def handle_endtag(self, tag):
        if not self.open or self.open.pop() != tag:
            raise AssertionError(f'</{tag}> closes another element, line {self.getpos()[0]}')

    def handle_data(self, data):
        if 'td' in self.open:
            self.cells[-1] += data


class Formats(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.scratch.name)
        cls.tap = subprocess.run([WRITE_REPORT, cls.folder], check=True,
                                 stdout=subprocess.PIPE).stdout.decode('utf-8')

    @classmethod
    def tearDownClass(cls):
        cls.scratch.cleanup()

    def read_csv(self, name):
        with open(self.folder / name, newline='', encoding='latin-1') as file:
            return list(csv.reader(file, strict=True))

    def test_csv(self):
        rows = self.read_csv('results.csv')
        self.assertEqual(len(rows), CASES)
        self.assertEqual({len(row) for row in rows}, {3})
        for status, count in STATUSES.items():
            self.assertEqual(sum(row[1] == status for row in rows), count, status)
        self.assertGreaterEqual(min(float(row[2]) for row in rows), 0)
        evil = 'evil.]]></x>"\'<script>&#,\\\n\x01\x7f caf\xe9 \u00c3\u00a9 \u00ef\u00bf\u00bf'
        self.assertEqual([row[1] for row in rows if row[0] == evil], ['Fail'])
        failures = self.read_csv('failures.csv')
        self.assertEqual([row[1] for row in failures],
                         ['Fail', 'Fail', 'Fail', 'Crash', 'Timeout', 'Fail'])
        self.assertEqual(failures[-1][0], evil)

    def test_junit(self):
        root = xml.etree.ElementTree.parse(self.folder / 'junit.xml').getroot()
        suite = root.find('testsuite')
        cases = suite.findall('testcase')
        self.assertEqual(len(cases), CASES)
        for element in root, suite:
            self.assertEqual(
                {name: element.get(name) for name in ('tests', 'failures', 'errors', 'skipped')},
                {'tests': str(CASES), 'failures': '4', 'errors': '2', 'skipped': '3'})
        for name, count in ('failure', 4), ('error', 2), ('skipped', 3):
            self.assertEqual(len(suite.findall(f'testcase/{name}')), count)
        self.assertEqual(suite.get('timestamp'), '2023-11-14T22:13:20')
        facts = {fact.get('name'): fact.get('value') for fact in suite.iter('property')}
        self.assertEqual(facts['renderer'], 'llvmpipe (LLVM 15.0.6, 256 bits)')
        self.assertEqual(facts['evil ' + MARKUP_EVIL], MARKUP_EVIL)
        evil = [case for case in cases if case.get('name') == 'evil.' + MARKUP_EVIL]
        self.assertEqual(evil[0].find('failure').get('message'), 'Fail: ' + MARKUP_EVIL)

    def test_attachments_are_files(self):
        root = xml.etree.ElementTree.parse(self.folder / 'junit.xml').getroot()
        paths = [path for output in root.iter('system-out')
                 for path in re.findall(r'^\[\[ATTACHMENT\|(.+)\]\]$', output.text, re.M)]
        self.assertEqual(len(paths), 9)
        for path in paths:
            self.assertEqual(pathlib.Path(path).read_bytes()[:4], b'\x89PNG')

    def test_tap(self):
        lines = self.tap.splitlines()
        self.assertEqual(lines[:2], ['TAP version 13', f'1..{CASES}'])
        pattern = re.compile(r'(ok|not ok) (\d+) - (?:\\.|[^#\\])+(?: # (SKIP|TODO) .*)?')
        results = [line for line in lines[2:] if not line.startswith('  ')]
        matches = [pattern.fullmatch(line) for line in results]
        self.assertNotIn(None, matches)
        self.assertEqual([int(match[2]) for match in matches], list(range(1, CASES + 1)))
        bad = [match for match in matches if match[1] == 'not ok' and match[3] is None]
        self.assertEqual(len(bad), 6)
        self.assertEqual([match[3] for match in matches if match[3]], ['TODO', 'SKIP', 'SKIP'])
        messages = [json.loads(line.split(': ', 1)[1]) for line in lines
                    if line.startswith('  message: ')]
        self.assertIn(EVIL.replace('    ', '\n\x01\x7f ') + '\uffff', messages)
        self.assertEqual(lines.count('  ---'), 8)
        self.assertEqual(lines.count('  ...'), 8)

    def test_page(self):
        page = Page()
        page.feed((self.folder / 'report.html').read_text(encoding='utf-8'))
        page.close()
        self.assertEqual(page.open, [])
        tags = [tag for tag, _ in page.tags]
        self.assertEqual((tags.count('script'), tags.count('x')), (1, 0))
        self.assertEqual(tags.count('article'), 8)
        rows = [attributes for tag, attributes in page.tags if 'data-status' in attributes
                and tag == 'tr']
        self.assertEqual(len(rows), CASES)
        self.assertIn('evil.' + MARKUP_EVIL, [row['data-name'] for row in rows])
        self.assertIn('evil.' + MARKUP_EVIL + MARKUP_EVIL, page.cells)
        self.assertIn(MARKUP_EVIL, page.cells)

    def test_page_takes_nothing_from_elsewhere(self):
        page = Page()
        page.feed((self.folder / 'report.html').read_text(encoding='utf-8'))
        pictures = [attributes['src'] for _, attributes in page.tags if 'src' in attributes]
        self.assertEqual(len(pictures), 9)
        for source in pictures:
            self.assertRegex(source, r'^data:image/png;base64,[A-Za-z0-9+/]+=*$')
        for tag, attributes in page.tags:
            self.assertNotIn(tag, ('link', 'iframe', 'object', 'base'))
            self.assertRegex(attributes.get('href', '#'),
                             r'^(#[a-z0-9-]*|(results|failures)\.csv|junit\.xml)$')


if __name__ == '__main__':
    WRITE_REPORT = sys.argv.pop(1)
    unittest.main()
