#!/bin/sh
# The program of tests/bench: lines for scripts, and the same hits with every kernel.
# sh tests/cli/bench.sh RAYTRACER BENCH
bench=${2:?usage: sh tests/cli/bench.sh RAYTRACER BENCH}
case $bench in /*) ;; *) bench=$PWD/$bench ;; esac
. "$(dirname "$0")/kit.sh"
raytracer=$bench # what run and expect call
mkdir temporary
export TMPDIR="$work/temporary"

printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n' > tetra.obj
run 0 tetra.obj --runs 1 --uv
cp out best.csv
numbers() { printf '(,[0-9]+\\.[0-9]{2}){%s}$' "$1"; }
check 'a line for build and picture, for each set, and for u and v' test "$(wc -l < out)" -eq 8
check 'the build has bytes per triangle' \
    grep -qE "^BUILD,tetra.obj,raytracer-[^,]*,sah,exact,1,[a-z0-9]+$(numbers 4)" out
check 'rates, nodes and leaves of the primary rays' \
    grep -qE "^tetra.obj,.*,primary,1048576,[0-9]+$(numbers 6)" out
check 'a picture, step by step' grep -qE "^PICTURE,tetra.obj,.*,1,[a-z0-9]+,1024x1024$(numbers 5)" out
hitsOf() { grep -v -e BUILD -e PICTURE "$1" | cut -d, -f7-9; }
hitsOf best.csv > withUv
check 'sets in order' test "$(cut -d, -f1 withUv | tr '\n' ' ')" = 'primary primary shadow bounce bounce bounceany '
check 'u and v change no hit' test "$(sort -u withUv | wc -l)" -eq 4
uniq withUv > expected
run 0 tetra.obj --runs 1 --kernel scalar --threads 3 --no-picture
check 'no picture' test "$(grep -c PICTURE out)" -eq 0
check 'threads' test "$(cut -d, -f5 out | tail -n 1)" -eq 3
hitsOf out > got
check 'the scalar kernel with three threads has the same hits' cmp expected got
check 'no file is left where temporary files go' holds temporary

# 8 bytes of mark, 3 numbers, 4 points, 4 triangles, 4 headings of 24 bytes, 32 bytes for every ray.
run 0 tetra.obj --write-rays tetra.rays
rays=$(cut -d, -f2 expected | tr '\n' '+')0
check 'rays in a file' test "$(wc -c < tetra.rays)" -eq $((8 + 12 + 48 + 48 + 4 * 24 + 32 * ($rays)))
check 'its mark' test "$(head -c 8 tetra.rays)" = RTRAYS01
check 'nothing is measured then' test ! -s out

expect 'no mesh' 1 'bench needs one mesh'
expect 'a scene without triangles' 1 'has no triangles' scene.txt
expect 'an unknown kernel' 1 "did you mean 'scalar'" tetra.obj --kernel scaler
expect 'no threads' 1 '--threads expects a whole number from 1 to 1024' tetra.obj --threads 0
expect 'rays into no folder' 4 'no folder' tetra.obj --write-rays none/tetra.rays
run 0 --help
check 'help' grep -q 'bounceany' out
finish
