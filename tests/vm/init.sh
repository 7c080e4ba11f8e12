#!/bin/sh
# SPDX-License-Identifier: MIT
# The first program of a guest, in its initramfs: puts a layer that can be written over the
# host's root, and hands over to the runner in the folder that is shared with the host.
export PATH=/bin
mount -t proc proc /proc
mount -t sysfs sys /sys
mount -t devtmpfs dev /dev
for module in $(cat /modules); do
	modprobe "$module"
done
mount -t tmpfs tmpfs /layer
mkdir /layer/upper /layer/work
plan9=trans=virtio,version=9p2000.L,msize=1048576
mount -t 9p -o $plan9,ro,cache=loose root /host
mount -t overlay -o lowerdir=/host,upperdir=/layer/upper,workdir=/layer/work overlay /root
mount -t tmpfs tmpfs /root/run
mkdir /root/run/share
mount -t 9p -o $plan9,cache=none share /root/run/share
for folder in proc sys dev; do
	mkdir -p /root/$folder
	mount --move /$folder /root/$folder
done
exec switch_root /root /bin/sh /run/share/runner.sh
