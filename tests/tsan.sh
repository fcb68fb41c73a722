#!/bin/sh
# What runs in several threads, in a build with -fsanitize=thread: sh tests/tsan.sh UNIT-TESTS RAYTRACER
unit=$PWD/${1#"$PWD/"}
shift
. "$(dirname "$0")/cli/kit.sh"
export TSAN_OPTIONS='halt_on_error=1 exitcode=66'

words='parallel wide_build bvh_is_the_same same_bits sameBits texture_threads film read_threads image_files'
words="$words kernels_on_closed kernels_in_a_shape solids_batches" # as hard for a compiler as code gets
check "unit tests: $words" "$unit" $words
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
