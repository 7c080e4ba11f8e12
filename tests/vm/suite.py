#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Runs one suite of cases in guests and prints TAP: suite.py NAME BUILD_FOLDER.

A suite is a module cases_NAME with a list GUESTS. A guest is booted once for all its cases; a
case is a function of a Bench whose docstring says what is so. SMOOTHIE_VM=required makes a
failure of what this machine lacks, SMOOTHIE_VM=no runs nothing."""

import importlib
import os
import shutil
import signal
import sys
import time
import traceback

import image as images
import machine
import program
from bench import Bench, Skip


def required():
    return os.environ.get('SMOOTHIE_VM') == 'required'


def tell(result, case, note=''):
    """Prints the line of a case; its docstring says what is so."""
    print(f'{result} - {" ".join(case.__doc__.split()).rstrip(".")}{note}', flush=True)


def explain():
    """Prints what went wrong as comments."""
    for line in traceback.format_exc().splitlines():
        print(f'# {line}', flush=True)


def run_case(number, case, bench):
    """Runs it, prints its line, and returns whether it passed; a Hang is the caller's."""
    start = time.monotonic()
    try:
        try:
            case(bench)
        except Exception:
            bench.start_over()
            raise
        bench.guest.stop_jobs(lasting=False)
    except machine.Hang:
        raise
    except Skip as skip:
        if required():
            tell(f'not ok {number}', case, f': {skip}')
            return False
        tell(f'ok {number}', case, f' # SKIP {skip}')
        return True
    except Exception as error:  # a case may fail in any way
        tell(f'not ok {number}', case)
        explain()
        if not isinstance(error, machine.Late):
            bench.guest.show_console()
        return False
    tell(f'ok {number}', case, f' ({time.monotonic() - start:.1f} s)')
    return True


def run_cases(guest, build, image, numbered, results):
    """Boots a guest and runs cases, which it takes from the front of the list of numbers and
    cases once they have a result."""
    with machine.Machine(image, guest.devices) as booted:
        print(f'# up after {booted.boot_time:.1f} s', flush=True)
        bench = Bench(build, booted, image)
        bench.load(*guest.modules)
        program.load_shaders(bench)
        while numbered:
            results.append(run_case(*numbered[0], bench))
            numbered.pop(0)
        program.keep_shaders(bench)


def run_guest(guest, build, image, number):
    """Runs its cases, numbered from here; returns how many failed. One emulated kernel in some
    dozens hangs, whatever is run in it: the case that meets this has a second guest, once."""
    numbered, results = list(enumerate(guest.cases, number)), []
    try:
        run_cases(guest, build, image, numbered, results)
    except machine.Hang:
        explain()
        print('# the guest hangs: going on in another one', flush=True)
        run_cases(guest, build, image, numbered, results)
    return results.count(False)


def skip_all(why):
    if required():
        print(f'Bail out! {why}')
        return 1
    print(f'1..0 # SKIP {why}')
    return 0


def stop(*_):
    """Ends the guests too, undisturbed by a second signal."""
    signal.signal(signal.SIGTERM, signal.SIG_IGN)
    sys.exit(1)


def main(name, build):
    signal.signal(signal.SIGTERM, stop)
    if os.environ.get('SMOOTHIE_VM') == 'no':
        return skip_all('SMOOTHIE_VM=no')
    if not shutil.which(machine.QEMU):
        return skip_all(f'there is no {machine.QEMU} (package qemu-system-x86)')
    try:
        image = images.find(lambda text: print(f'# {text}', flush=True))
    except (images.Missing, OSError) as error:
        return skip_all(error)
    guests = importlib.import_module(f'cases_{name}').GUESTS
    failed, number = 0, 1
    print(f'1..{sum(len(guest.cases) for guest in guests)}', flush=True)
    for guest in guests:
        try:
            failed += run_guest(guest, build, image, number)
        except (machine.Late, AssertionError, OSError) as error:
            print(f'Bail out! a guest could not be set up: {error}')
            return 1
        number += len(guest.cases)
    return 1 if failed else 0


if __name__ == '__main__':
    sys.exit(main(sys.argv[1], os.path.abspath(sys.argv[2])))
