#!/bin/sh
# Small files that promise gigabytes are refused at once: in a second of processor time and with half
# a gigabyte of addresses, with exit code 2 and words about the promise.
. "$(dirname "$0")/kit.sh"

# A sanitizer wants address space without end, and time.
addresses=500000 seconds=1
if ! (ulimit -v $addresses && exec "$raytracer" --version) > out 2> err; then
    echo 'the program does not start with half a gigabyte (a sanitizer): no limit of addresses'
    addresses=unlimited seconds=20
fi

# promise NAME WORDS ARGUMENT...
promise() {
    promised=$1 words=$2
    shift 2
    (
        ulimit -t $seconds
        ulimit -v $addresses
        exec "$raytracer" "$@"
    ) > out 2> err
    code=$?
    if [ "$code" -ne 2 ]; then fail "$promised" "exit code $code; $(head -n 2 err)"
    elif ! has err "$words"; then fail "$promised" "no '$words' in: $(head -n 2 err)"
    else ok "$promised"; fi
}

printf 'raytracer 1\nmesh m {\n    points 300000000\n    0 0 0\n}\n' > points.txt
promise 'native: points' "points.txt:3:12: error: 'points 300000000' is more than" points.txt --check
printf 'raytracer 1\nsettings {\n    resolution 65535 65535\n}\ncamera c {\n}\n' > size.txt
promise 'native: resolution' "size.txt:2:1: error: settings: 'resolution'" size.txt --check

view='v from 1 -3 2 at 0 0 0 up 0 0 1 angle 45 hither 1 resolution'
printf '%s 9 9\np 2000000000\n0 0 0\n' "$view" > corners.nff
promise 'NFF: corners' "corners.nff:2:3: error: 'p 2000000000' is more than" corners.nff --check
printf '%s 9 9\npp 9999999999999999999\n0 0 0\n' "$view" > overflow.nff
promise 'NFF: more corners than a number holds' 'overflow.nff:2:4: error: expected the number of corners' overflow.nff --check
printf '%s 65535 65535\n' "$view" > size.nff
promise 'NFF: resolution' "size.nff:1:1: error: settings: 'resolution'" size.nff --check

awk 'BEGIN { while (i++ < 1000000) printf "[" }' > deep.json
promise 'JSON: a million arrays in each other' 'deep.json:1:257: error: ' deep.json --check
printf '{"resolution": [65535, 65535], "camera": {"position": [0, 0, 9]}}' > size.json
promise 'JSON: resolution' "'resolution' 65535 65535 has more than" size.json --check
printf '{"AA": {"jitter": true, "samples": 2000000000}, "camera": {"position": [0, 0, 9]}}' > samples.json
promise 'JSON: samples' 'samples.json:1:36: error: expected a whole number' samples.json --check
# Each node holds the one before twice.
{
    printf '{"camera": {"position": [0, 0, 9]}, "objects": [{"name": "n0", "type": "sphere"}'
    awk 'BEGIN { while (++i <= 40)
        printf ", {\"name\": \"n%d\", \"type\": \"node\", \"children\": [" \
            "{\"type\": \"instance\", \"ref\": \"n%d\"}, {\"type\": \"instance\", \"ref\": \"n%d\"}]}\n", i, i - 1, i - 1 }'
    printf ']}'
} > double.json
promise 'JSON: 2^40 copies' 'error: with this the scene has more than 1048576 objects' double.json --check

printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 2000000000\n' > index.obj
promise 'OBJ: index' 'index.obj:4:7: error: there is no vertex 2000000000' index.obj --check
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf -2000000000 2 3\n' > relative.obj
promise 'OBJ: index from the end' "relative.obj:4:3: error: there is no vertex" relative.obj --check

for format in ascii binary_little_endian binary_big_endian; do
    printf 'ply\nformat %s 1.0\nelement vertex 4000000000\nproperty float x\nproperty float y\nproperty float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n' \
        $format > $format.ply
    promise "PLY: vertices, $format" "$format.ply:3:1: error: 'element vertex 4000000000' is more than" $format.ply --check
    printf 'ply\nformat %s 1.0\nelement vertex 0\nproperty float x\nproperty float y\nproperty float z\nelement face 4000000000\nproperty list uint int vertex_indices\nend_header\n9999' \
        $format > faces_$format.ply
    promise "PLY: faces, $format" "'element face 4000000000' is more than" faces_$format.ply --check
done

# 16000 x 16000 is a size that a picture may have.
for size in '60000 60000' '16000 16000'; do
    [ "$size" = '60000 60000' ] && words='is too large' || words='the header promises'
    for kind in P3 P6; do
        printf '%s %s 255 0 0 0' $kind "$size" > a.ppm
        promise "PPM $kind: $size" "$words" diff a.ppm a.ppm
    done
    printf 'PF %s -1 0000' "$size" > a.pfm
    promise "PFM: $size" "$words" diff a.pfm a.pfm
done
# Header and a few rows of 65535 x 65535 pixels, then of 16000 x 16000; all checksums are right.
start='\211PNG\r\n\032\n\000\000\000\015IHDR'
rows='\000\000\000\014IDAT\170\234\143\140\240\075\000\000\000\144\000\001\206\144\074\065'
end='\000\000\000\000IEND\256\102\140\202'
printf "$start"'\000\000\377\377\000\000\377\377\010\002\000\000\000\071\147\116\007'"$rows$end" > wide.png
promise 'PNG: 65535 x 65535' 'the size 65535x65535 is too large' diff wide.png wide.png
printf "$start"'\000\000\076\200\000\000\076\200\010\002\000\000\000\316\034\110\211'"$rows$end" > large.png
promise 'PNG: 16000 x 16000' 'the file is too short for 16000x16000 pixels' diff large.png large.png

finish
