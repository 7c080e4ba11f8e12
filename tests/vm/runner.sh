# SPDX-License-Identifier: MIT
# The guest's side of machine.py. The host writes jobs into the shared folder and their names to
# a serial port, one a line; each runs in a session of its own, and its name and status go back.
# Outputs are files of the shared folder, so that the host sees them grow.
export PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LC_ALL=C.UTF-8
mkdir -p /dev/pts /dev/shm /run/lock
mount -t devpts devpts /dev/pts
mount -t tmpfs tmpfs /dev/shm
mount -t debugfs debugfs /sys/kernel/debug
chmod 1777 /tmp /dev/shm
ln -sf /proc/self/fd /dev/fd

job() {
	(
		cd /tmp || exit
		setsid sh -c "echo \$\$ >/run/share/$1.pid; exec sh /run/share/$1.sh" \
			</dev/null >"/run/share/$1.out" 2>"/run/share/$1.err"
		echo "$1 $?" >&3
	) &
}

exec 3<>/dev/vport0p1
echo ready >&3
while read -r name <&3; do
	job "$name"
done
