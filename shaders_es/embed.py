#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes shader files as one C table: embed.py OUTPUT FILE..."""
import json
import os
import sys

output, files = sys.argv[1], sys.argv[2:]
with open(output, "w") as out:
    out.write('#include "gles/shader_source.h"\n\n')
    out.write("const struct shader_file shader_files[] = {\n")
    for name in files:
        with open(name) as shader:
            lines = "\n".join("\t\t" + json.dumps(line) for line in shader)
        out.write(f'\t{{"{os.path.basename(name)}",\n{lines}}},\n')
    out.write("\t{0},\n};\n")
