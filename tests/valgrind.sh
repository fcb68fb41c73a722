#!/bin/sh
# One small render per format and one error under valgrind: sh tests/valgrind.sh RAYTRACER
# Reading of what was never written, memory that is used after its end or never given back.
. "$(dirname "$0")/cli/kit.sh"

# clean NAME CODE ARGUMENT...: the exit code, and nothing that memcheck complains about.
clean() {
    name=$1 wanted=$2
    shift 2
    # Memory that is still reachable at the end is the standard library's.
    valgrind --quiet --error-exitcode=99 --leak-check=full --errors-for-leak-kinds=definite,possible \
        "$raytracer" "$@" > out 2> err
    code=$?
    if [ $code -eq "$wanted" ]; then ok "$name"
    else fail "$name" "exit code $code instead of $wanted; $(head -n 20 err)"; fi
}
clean PPM 0 scene.txt a.ppm -t 2
clean PNG 0 scene.txt a.png -t 1 --aov depth,normal,albedo,position,id,samples
clean PFM 0 scene.txt a.pfm -t 2 --no-aa --stats
sed 's/material red$/material gold/' scene.txt > gold.txt
clean 'error in a scene' 2 gold.txt b.ppm
clean 'wrong option' 1 scene.txt b.ppm --spq
clean 'diff' 0 diff a.ppm a.png -o d.png

finish
