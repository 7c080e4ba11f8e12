#!/bin/sh
# SPDX-License-Identifier: MIT
#
# What a user of the library does, from an installed copy: compiles the example by pkg-config and
# runs it. Its picture must show lit ground, the shadow, and the penumbra between them. Before that,
# what a kiosk needs: the program, its scene, and a unit (yes or no) that systemd understands.
#
# usage: check.sh MESON BUILD PREFIX LIBDIR DATADIR UNIT EXAMPLE COMPILER...
set -eu
meson=$1 build=$2 prefix=$3 libdir=$4 datadir=$5 unit=$6 example=$7
shift 7

copy=$(mktemp -d)
trap 'rm -rf "$copy"' EXIT
"$meson" install -C "$build" --no-rebuild --destdir "$copy" >"$copy/log" ||
	{ cat "$copy/log"; exit 1; }
installed=$copy$prefix/$libdir
LD_LIBRARY_PATH=$installed${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}
export LD_LIBRARY_PATH

"$copy$prefix/bin/smoothie" --version
test -s "$copy$prefix/$datadir/smoothie/kiosk.ini"
if [ "$unit" = yes ] && command -v systemd-analyze >/dev/null; then
	# as it reads once the program is where systemd looks for programs
	sed "s|^ExecStart=|&$copy$prefix/bin/|" "$copy$prefix/lib/systemd/system/smoothie.service" \
		>"$copy/smoothie.service"
	systemd-analyze verify "$copy/smoothie.service" >"$copy/log" 2>&1 || :
	if grep smoothie "$copy/log"; then exit 1; fi
fi

PKG_CONFIG_PATH=$installed/pkgconfig
export PKG_CONFIG_PATH
ours=$(pkg-config --define-variable=prefix="$copy$prefix" --cflags --libs smoothie)
system=$(pkg-config --cflags --libs egl glesv2)
# shellcheck disable=SC2086 # flags are words
"$@" -std=c11 -Wall -Wextra -Wpedantic -Werror "$example" -o "$copy/example" $ours $system

"$copy/example" >"$copy/picture.ppm"

# After 15 bytes of header, R,G,B. The ground is grey and lit all over, the blocker is not grey.
tail -c +16 "$copy/picture.ppm" | od -An -v -tu1 -w3 | awk '
	$1 - $3 > 30 { blocker++; next }
	$1 < 104 { shadow++; next }
	$1 < 160 { penumbra++; next }
	{ lit++ }
	END {
		printf "pixels: blocker %d, shadow %d, penumbra %d, lit %d\n",
			blocker, shadow, penumbra, lit
		exit !(blocker > 5000 && shadow > 2000 && penumbra > 1000 && lit > 50000)
	}'
