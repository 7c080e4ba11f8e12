#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Reports which loops over triangles and blocks the compiler has turned into vector instructions:
vectorised.py OBJDUMP LIBRARY.

Fails where one is left that works on single values, and skips on processors it does not know."""

import collections
import re
import subprocess
import sys

SKIPPED = 77

# Source files and, by processor, the instruction that only a vectorised loop of theirs has.
LOOPS = {
    'facing': ('planes of triangles', {'x86-64': r'v?pmulhw', 'aarch64': r'smull2?\s+v'}),
    'cones': ('cones of blocks', {'x86-64': r'v?mulps', 'aarch64': r'fmul\s+v'}),
}


def instructions_by_file(listing):
    found = collections.defaultdict(list)
    name = None
    for line in listing.splitlines():
        if member := re.match(r'(?:.*/)?(\w+)\.[\w.]*:\s+file format', line):
            name = member[1]
        elif instruction := re.match(r'\s+[0-9a-f]+:\s+(.*)', line):
            found[name].append(instruction[1])
    return found


def main():
    objdump, library = sys.argv[1:]
    listing = subprocess.run([objdump, '-d', '--no-show-raw-insn', library], check=True,
                             capture_output=True, text=True).stdout
    machine = re.search(r'file format elf\d+-(?:little)?(x86-64|aarch64)', listing)
    if not machine:
        print('objdump names no known processor')
        return SKIPPED
    failed = False
    found = instructions_by_file(listing)
    for name, (what, instructions) in LOOPS.items():
        count = sum(bool(re.match(instructions[machine[1]], line)) for line in found[name])
        print(f'{name}.c, {what}: {count} of {len(found[name])} instructions multiply vectors')
        failed |= count == 0
    return 1 if failed else 0


if __name__ == '__main__':
    sys.exit(main())
