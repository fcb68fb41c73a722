#!/bin/sh
# Times of the program in parts, as tab-separated lines: sh tests/bench/bench.sh RAYTRACER [THREADS]
# Each figure is the median of five runs. The mesh is made here: a wavy ball of 69,432 triangles.
# Absolute times say little on a shared machine; compare two builds in one interleaved run.
cd "$(dirname "$0")/../.." || exit 1
raytracer=${1:-./raytracer}
threads=${2:-1}
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT

ball() {
    awk 'BEGIN {
        rows = 132; columns = 263; pi = atan2(0, -1)
        print "raytracer 1\nsettings {\n resolution 1024 1024\n samples 1\n max_depth 4\n}"
        print "camera c {\n look_at 0 -4 1  0 0 0  0 0 1\n lens 50\n}"
        print "light l {\n type point\n translate 3 -4 5\n color 100 100 100\n}"
        print "mesh ball {\npoints " (rows + 1) * columns
        for (i = 0; i <= rows; i++) for (j = 0; j < columns; j++) {
            a = pi * i / rows; b = 2 * pi * j / columns; r = 1 + 0.05 * sin(9 * a) * cos(11 * b)
            printf "%.9g %.9g %.9g\n", r * sin(a) * cos(b), r * sin(a) * sin(b), r * cos(a)
        }
        print "triangles " 2 * rows * columns
        for (i = 0; i < rows; i++) for (j = 0; j < columns; j++) {
            p = i * columns + j; q = i * columns + (j + 1) % columns
            print p, p + columns, q; print q, p + columns, q + columns
        }
        print "}\ninstance ball {\n mesh ball\n}"
    }'
}

# field NAME FILE: the number behind "NAME": in a line of JSON.
field() { sed 's/.*"'"$1"'": *\([-+.0-9e]*\).*/\1/' "$2"; }
median() { sort -g | sed -n 3p; }

# row NAME SCENE OPTION...: five runs, one line.
row() {
    name=$1 scene=$2
    shift 2
    for run in 1 2 3 4 5; do
        "$raytracer" "$scene" "$work/out.png" -t "$threads" -q --stats=json "$@" |
            tr -d '\n' > "$work/$run.json" || exit 1
    done
    printf '%s' "$name"
    for key in parse build render write rays_per_second peak_bytes; do
        printf '\t%s' "$(for run in 1 2 3 4 5; do field $key "$work/$run.json"; echo; done | grep . | median)"
    done
    printf '\n'
}

ball > "$work/ball.txt"
printf 'what\tparse_s\tbuild_s\trender_s\twrite_s\trays_per_s\tpeak_bytes\n'
row ball-primary "$work/ball.txt" -i normal
row ball-whitted "$work/ball.txt"
row ball-ao "$work/ball.txt" -i ao
row showcase ASCII/showcase.txt --scale 50 --spp 4 -i whitted
row shapes ASCII/shapes.txt --spp 4 -i whitted
row glass ASCII/glass.txt --spp 4 -i whitted
