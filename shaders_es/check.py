#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Validates every shader variant: check.py STAMP DUMP_PROGRAM VALIDATOR"""
import glob
import subprocess
import sys
import tempfile

stamp, dump, validator = sys.argv[1:]
with tempfile.TemporaryDirectory() as folder:
    subprocess.run([dump, folder], check=True)
    files = sorted(glob.glob(folder + "/*"))
    if not files:
        sys.exit("no shader variants were written")
    # One process for all; it prints a file's errors under the file's name.
    result = subprocess.run([validator, *files], capture_output=True, text=True)
    if result.returncode != 0:
        sys.exit("\n".join(line for line in result.stdout.splitlines() if "ERROR" in line))
with open(stamp, "w") as out:
    out.write(f"{len(files)} shader stages are valid\n")
