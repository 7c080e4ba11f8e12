# SPDX-License-Identifier: MIT
"""ANGLE on SwiftShader: an OpenGL ES driver that shares no code with Mesa.

It comes prebuilt in an npm package, is fetched when first needed, and kept in a folder of the
user's cache. Later releases of the package hold stubs in its place."""

import fcntl
import hashlib
import io
import os
import platform
import shutil
import subprocess
import tarfile
import tempfile

PACKAGE = '@sparticuz/chromium'
VERSION = '143.0.4'
MEMBER = 'package/bin/swiftshader.tar.br'
SHA256 = '1b4c63ac0f24bfedd469675c33b09c84f7d6d26acb30bed2ab8e875e084cf3a2'
SECONDS = 300

# What a program looks for, and what the archive calls it.
LINKS = {'libEGL.so.1': 'libEGL.so', 'libGLESv2.so.2': 'libGLESv2.so'}
ICD = 'vk_swiftshader_icd.json'

UNPACK = "process.stdout.write(require('zlib').brotliDecompressSync(require('fs').readFileSync(0)))"


class Missing(Exception):
    """What a machine lacks, in one line."""


def call(*command, **options):
    """Runs it and returns the bytes that it prints."""
    try:
        return subprocess.run(command, check=True, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                              timeout=SECONDS, **options).stdout
    except FileNotFoundError:
        raise Missing(f'there is no {command[0]}') from None
    except subprocess.TimeoutExpired:
        raise Missing(f'{command[0]} takes more than {SECONDS} s') from None
    except subprocess.CalledProcessError as error:
        lines = error.stderr.decode(errors='replace').strip().splitlines()
        raise Missing(f'{command[0]}: {lines[0] if lines else error}') from None


def cache_folder():
    user = os.environ.get('XDG_CACHE_HOME') or os.path.join(os.path.expanduser('~'), '.cache')
    return os.path.join(user, 'smoothie', 'drivers')


def download(work):
    """The archive of the package, which is known by its hash."""
    call('npm', 'pack', '--fetch-retries=0', f'--pack-destination={work}', f'{PACKAGE}@{VERSION}',
         cwd=work, stdin=subprocess.DEVNULL)
    tarball = next(name for name in os.listdir(work) if name.endswith('.tgz'))
    with tarfile.open(os.path.join(work, tarball)) as package:
        archive = package.extractfile(MEMBER).read()
    if hashlib.sha256(archive).hexdigest() != SHA256:
        raise Missing(f'{PACKAGE} {VERSION} is not what it was: {MEMBER} has another SHA-256')
    return archive


def make(work, target):
    archive = call('node', '-e', UNPACK, input=download(work))
    os.mkdir(target)
    with tarfile.open(fileobj=io.BytesIO(archive)) as files:
        for file in files:
            with open(os.path.join(target, os.path.basename(file.name)), 'wb') as copy:
                shutil.copyfileobj(files.extractfile(file), copy)
    for link, name in LINKS.items():
        os.symlink(name, os.path.join(target, link))


def find():
    """Returns the folder with the libraries, which is filled if it is not there; raises Missing."""
    if platform.machine() != 'x86_64':
        raise Missing(f'it is built for x86_64, this machine is {platform.machine()}')
    cache = cache_folder()
    os.makedirs(cache, exist_ok=True)
    path = os.path.join(cache, f'swiftshader-{VERSION}')
    with open(os.path.join(cache, 'lock'), 'w', encoding='utf-8') as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        if not os.path.isdir(path):
            with tempfile.TemporaryDirectory(prefix='new-', dir=cache) as work:
                make(work, os.path.join(work, 'driver'))
                os.rename(os.path.join(work, 'driver'), path)
    return path
