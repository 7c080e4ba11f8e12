#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes text files as strings of C: embed.py OUTPUT FILE...; a.css becomes a_css."""
import json
import os
import sys

output, files = sys.argv[1], sys.argv[2:]
with open(output, "w") as out:
    for name in files:
        with open(name) as text:
            lines = "\n".join("\t" + json.dumps(line) for line in text)
        out.write(f"static const char {os.path.basename(name).replace('.', '_')}[] =\n{lines};\n")
