#!/bin/sh
# SPDX-License-Identifier: MIT
#
# What a user of the library does, from an installed copy: compiles the example by pkg-config and
# runs it. Its picture must show lit ground, the shadow, and the penumbra between them.
#
# usage: check.sh MESON BUILD PREFIX LIBDIR EXAMPLE COMPILER...
set -eu
meson=$1 build=$2 prefix=$3 libdir=$4 example=$5
shift 5

copy=$(mktemp -d)
trap 'rm -rf "$copy"' EXIT
"$meson" install -C "$build" --no-rebuild --destdir "$copy" >"$copy/log" ||
	{ cat "$copy/log"; exit 1; }
installed=$copy$prefix/$libdir

PKG_CONFIG_PATH=$installed/pkgconfig
export PKG_CONFIG_PATH
ours=$(pkg-config --define-variable=prefix="$copy$prefix" --cflags --libs smoothie)
system=$(pkg-config --cflags --libs egl glesv2)
# shellcheck disable=SC2086 # flags are words
"$@" -std=c11 -Wall -Wextra -Wpedantic -Werror "$example" -o "$copy/example" $ours $system

LD_LIBRARY_PATH=$installed${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH} "$copy/example" >"$copy/picture.ppm"

# After 15 bytes of header, R,G,B. The ground is grey and lit all over, the blocker is not grey.
tail -c +16 "$copy/picture.ppm" | od -An -v -tu1 -w3 | awk '
	$1 - $3 > 30 { blocker++; next }
	$1 < 104 { shadow++; next }
	$1 < 160 { penumbra++; next }
	{ lit++ }
	END {
		printf "pixels: blocker %d, shadow %d, penumbra %d, lit %d\n",
			blocker, shadow, penumbra, lit
		exit !(blocker > 5000 && shadow > 4000 && penumbra > 300 && lit > 50000)
	}'
