#!/bin/sh
# Remakes our .blend files and their textures and exports every .blend of this folder to ASCII/NAME.txt.
# BLENDER=... chooses another Blender; arguments go to Export.py. Running it twice gives the same files.
set -eu
blender=${BLENDER:-blender}
cd "$(dirname "$0")/.."
"$blender" -b --factory-startup --python-exit-code 3 -P Blend/MakeScenes.py > /dev/null
for blend in Blend/*.blend; do
    name=$(basename "$blend" .blend)
    echo "$name"
    # One thread: with more, Blender sums up smooth normals in another order each time.
    "$blender" -t 1 -b --factory-startup "$blend" --python-exit-code 3 -P Blend/Export.py -- \
        -o "ASCII/$name.txt" "$@" > /dev/null
done
