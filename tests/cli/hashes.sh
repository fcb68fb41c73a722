#!/bin/sh
# The reference pictures have the bits that tests/golden/hashes.tsv says, whatever compiler, level of
# optimisation and machine. A line there: the first 64 bits of the PFM's SHA-256, scene, options.
# sh tests/cli/hashes.sh RAYTRACER [renew]: "renew" writes the hashes of this program into the table.
tests=$(cd "$(dirname "$0")/.." && pwd)
. "$(dirname "$0")/kit.sh"
table=$tests/golden/hashes.tsv
tab=$(printf '\t')

# Scenes name their textures as seen from the top folder.
picture() { (cd "$tests/.." && "$raytracer" "$@" -o "$work/picture.pfm" -q); }

changed=0
while IFS=$tab read -r wanted scene options; do
    rm -f picture.pfm
    found=none
    # Options are words: no quotes.
    picture "$scene" $options > err 2>&1 && found=$(sha256sum < picture.pfm | cut -c 1-16)
    printf '%s\t%s\t%s\n' "$found" "$scene" "$options" >> found.tsv
    if [ "$found" = none ]; then
        fail "$scene $options" "no picture: $(head -n 2 err)"
    elif [ "$found" = "$wanted" ]; then
        ok "$scene $options"
    else
        fail "$scene $options" "its hash is $found instead of $wanted"
        changed=$((changed + 1))
    fi
done < "$table"

if [ "${2:-}" = renew ]; then
    cp found.tsv "$table"
    echo "$table is written anew; the commit has to say why $changed pictures changed"
elif [ "$changed" -gt 0 ]; then
    echo "$changed pictures have other bits. If only some builds or machines say so, promise P1 is"
    echo "broken. If this change is meant to change pictures: sh tests/cli/hashes.sh ./raytracer renew,"
    echo "and say in the commit why they changed."
fi
finish
