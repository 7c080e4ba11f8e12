#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Debian's own kernel for the guests: vmlinuz, the modules they need, an initramfs.

Made once and kept in a folder of the user's cache. Nothing is installed: the packages come by
`apt-get download` and are only unpacked. vkms is in no kernel of Debian and is built here."""

import fcntl
import os
import platform
import re
import shutil
import subprocess
import sys
import tempfile

# Part of the name of what is kept: raise it when the recipe changes.
RECIPE = 2
# Packages and what is unpacked from them, while it is made; what is kept has about 15 MB.
ROOM = 1200 << 20

# In the initramfs, in this order.
EARLY = ['virtio_pci', '9pnet_virtio', '9p', 'overlay', 'virtio_console']
# For "modprobe -d FOLDER" in a guest.
LATER = ['virtio-gpu', 'bochs', 'vgem']

HERE = os.path.dirname(os.path.abspath(__file__))


class Missing(Exception):
    """What a machine lacks, in one line."""


def call(*command, **options):
    """Runs it and returns what it prints; what it says is in the error."""
    try:
        return subprocess.run(command, check=True, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                              stdin=options.pop('stdin', subprocess.DEVNULL), text=True,
                              **options).stdout
    except FileNotFoundError:
        raise Missing(f'there is no {command[0]}') from None
    except subprocess.CalledProcessError as error:
        lines = error.stderr.strip().splitlines() or [f'status {error.returncode}']
        said = next((line for line in lines if 'error' in line.lower()), lines[-1])
        raise Missing(f'{command[0]}: {said}') from None


def cache_folder():
    user = os.environ.get('XDG_CACHE_HOME') or os.path.join(os.path.expanduser('~'), '.cache')
    return os.environ.get('SMOOTHIE_VM_CACHE') or os.path.join(user, 'smoothie', 'vm')


def depends(package):
    """The packages that it depends on, as the package lists have it."""
    lines = call('apt-cache', 'depends', package).splitlines()
    return [line.split(':', 1)[1].strip() for line in lines if line.strip().startswith('Depends:')]


def kernel_package():
    if platform.machine() != 'x86_64':
        raise Missing(f'the guests are x86_64, this machine is {platform.machine()}')
    for package in depends('linux-image-amd64'):
        if re.fullmatch(r'linux-image-\d.*-amd64', package):
            return package
    raise Missing('the package lists know no linux-image-amd64; apt-get update fetches them')


def download(folder, *packages):
    try:
        call('apt-get', 'download', *packages, cwd=folder)
    except Missing as missing:
        raise Missing(f'{missing} (are the package lists old? apt-get update)') from None
    return [os.path.join(folder, name) for package in packages
            for name in os.listdir(folder) if name.startswith(package.split('=')[0] + '_')]


def unpack(folder, *packages):
    for package in download(os.path.dirname(folder), *packages):
        call('dpkg', '-x', package, folder)
        os.remove(package)


def copy_modules(tree, abi, names, to):
    """Copies modules and what they depend on from one tree to another, for modprobe -d."""
    source = os.path.join(tree, 'lib', 'modules', abi)
    target = os.path.join(to, 'lib', 'modules', abi)
    needs = {}
    with open(os.path.join(source, 'modules.dep'), encoding='utf-8') as lines:
        for line in lines:
            module, _, others = line.partition(':')
            name = os.path.basename(module).split('.')[0].replace('-', '_')
            needs[name] = [module, *others.split()]
    for name in names:
        for path in needs[name.replace('-', '_')]:
            os.makedirs(os.path.dirname(os.path.join(target, path)), exist_ok=True)
            shutil.copy(os.path.join(source, path), os.path.join(target, path))
    for name in ('modules.builtin', 'modules.order'):
        shutil.copy(os.path.join(source, name), target)
    call('depmod', '-b', to, abi)


def needs_loader(program):
    with open(program, 'rb') as file:
        return b'/ld-linux' in file.read(4096)


def make_initramfs(tree, abi, work, target):
    root = os.path.join(work, 'initramfs')
    for folder in ('bin', 'proc', 'sys', 'dev', 'layer', 'host', 'root'):
        os.makedirs(os.path.join(root, folder))
    busybox = shutil.which('busybox')
    if not busybox or needs_loader(busybox):
        raise Missing('there is no static busybox (package busybox-static)')
    shutil.copy(busybox, os.path.join(root, 'bin', 'busybox'))
    for applet in ('sh', 'cat', 'mount', 'mkdir', 'modprobe', 'switch_root'):
        os.symlink('busybox', os.path.join(root, 'bin', applet))
    shutil.copy(os.path.join(HERE, 'init.sh'), os.path.join(root, 'init'))
    os.chmod(os.path.join(root, 'init'), 0o755)
    with open(os.path.join(root, 'modules'), 'w', encoding='utf-8') as modules:
        modules.write('\n'.join(EARLY) + '\n')
    copy_modules(tree, abi, EARLY, root)
    names = call('find', '.', cwd=root)
    with open(target, 'wb') as archive:
        subprocess.run(['cpio', '--quiet', '-o', '-H', 'newc'], input=names.encode(),
                       stdout=archive, cwd=root, check=True)


def build_vkms(abi, version, work, tree):
    """Builds vkms from the kernel's source into the tree of modules."""
    headers = f'linux-headers-{abi}'
    others = depends(headers)
    common = [name for name in others if name.startswith('linux-headers-')]
    kbuild = [name for name in others if name.startswith('linux-kbuild-')]
    release = kbuild[0][len('linux-kbuild-'):] if kbuild else ''
    built = os.path.join(work, 'headers')
    unpack(built, headers, *common, *kbuild)
    folder = os.path.join(built, 'usr', 'src', headers)
    makefile = os.path.join(folder, 'Makefile')
    with open(makefile, encoding='utf-8') as lines:
        text = lines.read().replace(' /usr/src/', f' {built}/usr/src/')
    with open(makefile, 'w', encoding='utf-8') as lines:
        lines.write(text)

    major = re.match(r'\d+\.\d+', release or version)[0]
    archive = download(work, f'linux-source-{major}={version}')[0]
    source = f'usr/src/linux-source-{major}.tar.xz'
    # the source is large; only one folder of it reaches the disk
    call('sh', '-c', f'dpkg --fsys-tarfile "$1" | tar -xO ./{source} |'
         ' tar -xJ -C "$2" --wildcards --strip-components=5 "*/drivers/gpu/drm/vkms/*"',
         'sh', archive, new_folder(work, 'vkms'))
    os.remove(archive)
    call('make', '-C', folder, f'M={work}/vkms', 'CONFIG_DRM_VKMS=m',
         'CONFIG_DEBUG_INFO_BTF_MODULES=', 'modules')
    call('strip', '--strip-debug', f'{work}/vkms/vkms.ko')
    shutil.copy(f'{work}/vkms/vkms.ko', os.path.join(tree, 'lib', 'modules', abi, 'kernel'))


def new_folder(*parts):
    path = os.path.join(*parts)
    os.mkdir(path)
    return path


def version_of(package):
    match = re.search(r'^Version: (.+)$', call('apt-cache', 'show', '--no-all-versions', package),
                      re.MULTILINE)
    return match[1]


def make(package, work, target):
    """Makes the image of a kernel in an empty folder."""
    abi = package[len('linux-image-'):]
    tree = os.path.join(work, 'tree')
    unpack(tree, package)
    modules = list(LATER)
    try:
        build_vkms(abi, version_of(package), work, tree)
        modules.append('vkms')
    except Missing as missing:
        with open(os.path.join(target, 'no-vkms'), 'w', encoding='utf-8') as why:
            why.write(f'vkms could not be built: {missing}\n')
    call('depmod', '-b', tree, abi)
    shutil.copy(os.path.join(tree, 'boot', f'vmlinuz-{abi}'), os.path.join(target, 'vmlinuz'))
    copy_modules(tree, abi, modules, target)
    make_initramfs(tree, abi, work, os.path.join(target, 'initramfs'))


def check_room(folder):
    disk = os.statvfs(folder)
    free = disk.f_bavail * disk.f_frsize
    if free < ROOM:
        raise Missing(f'{folder} has {free >> 20} MB free; making the kernel of the guests takes '
                      f'{ROOM >> 20} MB for a minute')


class Image:
    """Files of a guest's kernel, in `folder`; `no_vkms` says why there is no vkms, or is empty."""

    def __init__(self, folder):
        self.folder = folder
        self.kernel = os.path.join(folder, 'vmlinuz')
        self.initramfs = os.path.join(folder, 'initramfs')
        self.no_vkms = ''
        if os.path.exists(os.path.join(folder, 'no-vkms')):
            with open(os.path.join(folder, 'no-vkms'), encoding='utf-8') as why:
                self.no_vkms = why.read().strip()


def find(say=lambda text: None):
    """Returns the Image, which is made if it is not there yet; raises Missing."""
    cache = cache_folder()
    os.makedirs(cache, exist_ok=True)
    package = kernel_package()
    name = f'{package}-{RECIPE}'
    path = os.path.join(cache, name)
    with open(os.path.join(cache, 'lock'), 'w', encoding='utf-8') as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        if not os.path.isdir(path):
            check_room(cache)
            say(f'making the kernel of the guests in {path}')
            with tempfile.TemporaryDirectory(prefix='new-', dir=cache) as work:
                os.chmod(work, 0o755)
                target = new_folder(work, 'image')
                make(package, work, target)
                os.rename(target, path)
            for other in set(os.listdir(cache)) - {name, 'lock'}:
                shutil.rmtree(os.path.join(cache, other))
    return Image(path)


def main():
    try:
        image = find(lambda text: print(f'image: {text}', file=sys.stderr))
    except (Missing, OSError) as error:
        print(f'image: {error}', file=sys.stderr)
        return 1
    if image.no_vkms:
        print(f'image: {image.no_vkms}', file=sys.stderr)
    print(image.folder)
    return 0


if __name__ == '__main__':
    sys.exit(main())
