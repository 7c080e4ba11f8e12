#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Shows that a conformance run finds faults of drivers, and prints TAP:
check_faults.py PROGRAM LIBRARY.

The library seeds the fault. Cases that are named after what is wrong must fail, and none that
have nothing to do with it."""

import csv
import fnmatch
import os
import subprocess
import sys
import tempfile

CASES = ['format.rgba8.*', 'format.rg16f.*', 'format.r32f.*', 'depth.test.*', 'texture.*']

# The fault, the cases that name it, and all that may fail of it: the texels that are looked at
# after drawing are looked up as well.
FAULTS = [
    ('none', [], []),
    ('min-is-add', ['format.rgba8.min', 'format.rg16f.min', 'format.r32f.min'],
     ['format.*.min', 'format.*.min-mask']),
    ('depth-func-ignored', ['depth.test.never', 'depth.test.equal', 'depth.test.greater'],
     ['depth.test.*']),
    ('r16f-truncated', ['format.rg16f.rounding'], ['format.rg16f.*', 'texture.linear-*']),
    ('texel-off-by-one', ['texture.fetch', 'texture.nearest', 'texture.level', 'texture.gather'],
     ['*']),
    ('float-target-8-bit', ['format.rg16f.rounding', 'format.r32f.rounding'],
     ['format.rg16f.*', 'format.r32f.*', 'texture.*']),
    ('float-target-refused', ['format.rg16f.rounding', 'format.r32f.rounding'],
     ['format.rg16f.*', 'format.r32f.*']),
]


def run(program, library, fault):
    """Returns the exit status and the status of each case."""
    with tempfile.TemporaryDirectory() as folder:
        environment = {**os.environ, 'GL_FAULT': fault, 'LD_PRELOAD': library}
        choice = [word for case in CASES for word in ('--test', case)]
        status = subprocess.run([program, 'check', '--quiet', '--output', folder, *choice],
                                env=environment, stdout=subprocess.DEVNULL, check=False).returncode
        with open(os.path.join(folder, 'results.csv'), encoding='utf-8') as results:
            return status, {row[0]: row[1] for row in csv.reader(results) if len(row) > 1}


def problems(status, found, named, allowed):
    """What is not as it must be, a line each."""
    failed = [name for name, outcome in found.items() if outcome == 'Fail']
    if status != (1 if named else 0):
        yield f'the exit status is {status}'
    for name in named:
        if name not in failed:
            yield f'{name} does not fail: {found.get(name, "it was not run")}'
    for name, outcome in found.items():
        if outcome not in ('Pass', 'Fail', 'Skip'):
            yield f'{name} ends with {outcome}'
        if outcome == 'Fail' and not any(fnmatch.fnmatch(name, glob) for glob in allowed):
            yield f'{name} fails, which has nothing to do with it'


def main(program, library):
    print(f'1..{len(FAULTS)}', flush=True)
    good = True
    for number, (fault, named, allowed) in enumerate(FAULTS, 1):
        wrong = list(problems(*run(program, library, fault), named, allowed))
        what = f'{", ".join(named)} fail' if named else 'all cases pass'
        print(f'{"not " if wrong else ""}ok {number} - {fault}: {what}', flush=True)
        for line in wrong:
            print(f'# {line}', flush=True)
        good = good and not wrong
    return 0 if good else 1


if __name__ == '__main__':
    sys.exit(main(*sys.argv[1:]))
