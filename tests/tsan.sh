#!/bin/sh
# What runs in several threads, in a build with -fsanitize=thread: sh tests/tsan.sh UNIT-TESTS RAYTRACER WORD...
# WORDs: names of unit tests, or parts of them.
unit=$PWD/${1#"$PWD/"}
shift
. "$(dirname "$0")/cli/kit.sh"
export TSAN_OPTIONS='halt_on_error=1 exitcode=66'

shift
for word; do # a word that names no test would check nothing
    [ -n "$("$unit" --list "$word")" ] || fail "unit tests: $word" 'no test has this in its name'
done
check "unit tests: $*" "$unit" --jobs="$(nproc)" "$@"
for threads in 1 4; do
    for option in '-i whitted' '-i ao' '--aov depth,id -i normal'; do
        expect "$option, $threads threads" 0 '' scene.txt $threads.ppm -t $threads $option --progress plain
    done
    expect "whitted, $threads threads" 0 '' scene.txt $threads.ppm -t $threads -r 120x80
done
check 'one thread and four draw the same' cmp 1.ppm 4.ppm

# An interrupt comes in the middle of it.
"$raytracer" scene.txt stopped.ppm -t 4 -r 2000x2000 --spp 64 -q 2> err &
sleep 1
kill -TERM $!
wait $!
check 'interrupted: 130' [ $? -eq 130 ]

finish
