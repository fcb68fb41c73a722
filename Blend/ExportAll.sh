#!/bin/sh
# Exports every .blend of this folder to ASCII/NAME.txt. BLENDER=... chooses another Blender.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
for blend in "$here"/*.blend; do
    name=$(basename "$blend" .blend)
    echo "$name"
    "${BLENDER:-blender}" -b "$blend" --python-exit-code 3 -P "$here/Export.py" -- \
        -o "$here/../ASCII/$name.txt" --ppm "$@" > /dev/null
done
