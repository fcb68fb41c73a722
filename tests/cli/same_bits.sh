#!/bin/sh
# The picture depends on the scene, the settings and the seed only.
. "$(dirname "$0")/kit.sh"

# Many small shapes, so that there is a tree, and everything that uses random numbers.
{
    sed -e 's/samples 4/samples 8/' -e 's/diffuse 0.8 0.1 0.1/&\n    mirror 0.2 0.2 0.2\n    roughness 0.3/' \
        -e 's/color 60 60 60/&\n    radius 0.5/' -e 's/camera front {/&\n    aperture_radius 0.1\n    focus_distance 6/' scene.txt
    i=0
    while [ $i -lt 60 ]; do
        printf 'sphere s%s {\n    translate %s %s %s\n    scale 0.2 0.2 0.1\n    material red\n}\n' \
            $i $((i % 5 - 2)) $((i / 5 % 4 - 2)).5 $((i / 20)).3
        i=$((i + 1))
    done
} > many.txt

run 0 many.txt a.pfm --threads 1 -q
check 'it renders' hasSize a.pfm '24 16'
# same NAME OPTION...: no bit changes.
same() {
    name=$1
    shift
    run 0 many.txt b.pfm -q "$@"
    check "$name" cmp a.pfm b.pfm
}
same 'again' --threads 1
same '2 threads' --threads 2
same '3 threads' -t3
same 'all threads' --threads 0
same '--no-bvh' --no-bvh
same '--accel none' --accel none
same '--accel bvh' --accel bvh
same '--kernel scalar' --kernel scalar
same '--kernel auto' --kernel auto
for kernel in sse avx2 avx512; do
    if "$raytracer" many.txt b.pfm -q --kernel $kernel 2> err; then
        check "--kernel $kernel" cmp a.pfm b.pfm
    else # not on this CPU, which the message has to say
        check "--kernel $kernel" grep -q "this CPU can't run the kernel '$kernel'" err
    fi
done
same 'every step for every scene' --no-specialise
same 'AOVs beside it' --aov depth,id
same 'statistics' --stats
same 'the scene'\''s own settings' --spp 8 --seed 0 --sampler sobol --filter blackman-harris,1.5 --jitter \
    --max-depth 8 --light-samples 1 --camera front --scale 100 --resolution 24x16

run 0 many.txt --convert copy.txt
run 0 copy.txt b.pfm -q
check '--convert: the copy renders the same bits' cmp a.pfm b.pfm
run 0 copy.txt --convert copy2.txt
check '--convert: a copy of the copy is equal' cmp copy.txt copy2.txt
run 0 many.txt --convert -
check '--convert -' cmp copy.txt out
run 0 many.txt --convert less.txt --spp 2 --camera top --background 1,1,1
run 0 less.txt b.pfm -q
run 0 many.txt c.pfm -q --spp 2 --camera top --background 1,1,1
check '--convert takes options along' cmp b.pfm c.pfm

# other NAME OPTION...: the picture changes.
other() {
    name=$1
    shift
    run 0 many.txt b.pfm -q "$@"
    check "$name" differ a.pfm b.pfm
}
other 'another seed' --seed 1
other 'another number of samples' --spp 4
other 'another sampler' --sampler random
other 'another filter' --filter box
other 'another width' --filter blackman-harris,3
other 'more light samples' --light-samples 2
other 'another depth' --max-depth 0
other 'no jitter' --no-jitter --sampler stratified

# One sequence through all pixels, of which a crop has its part.
run 0 many.txt a.pfm -q --sampler zsobol --threads 1
same 'zsobol: 3 threads' --sampler zsobol -t3
same 'zsobol: one lane' --sampler zsobol --kernel scalar
run 0 many.txt c.pfm -q --sampler zsobol --crop 5,3,20,14
run 0 many.txt a.pfm -q --sampler zsobol --crop 5,3,20,14 --kernel scalar
check 'zsobol: a crop in one lane' cmp a.pfm c.pfm
expect 'zsobol: too many samples' 1 '5000x300 pixels can have at most 64 samples per pixel, not 128' \
    many.txt b.pfm --sampler zsobol --resolution 5000x300 --spp 128
expect 'zsobol: too many pixels' 1 '65535x1 pixels can have at most 1 samples' \
    many.txt b.pfm --sampler zsobol --resolution 65535x1 --spp 2

# The filter, too, and the picture of a scene that asks for it.
run 0 many.txt a.pfm -q --denoise --threads 1
same 'denoised: 3 threads' --denoise -t3
same 'denoised: one lane' --denoise --kernel scalar
same 'denoised: AOVs beside it' --denoise --aov depth,albedo
run 0 many.txt --convert copy.txt --denoise
run 0 copy.txt b.pfm -q
check 'denoised: as the scene says' cmp a.pfm b.pfm
run 0 many.txt b.pfm --denoise --stats=json
check 'denoised: its error in the last line' has err 'denoised, estimated error'
check 'denoised: its error in the statistics' has out '"error_estimate_denoised":0.'
expect 'denoised: too few samples' 1 'needs 4 or more samples per pixel, not 2' many.txt b.pfm --denoise --spp 2
run 0 many.txt a.pfm --denoise --error 0.02 --threads 1 --stats=json
check 'denoised: an error goal has its own error' has out '"error_estimate":0.'
check 'denoised: and that of what is left' has out '"error_estimate_denoised":0.'
run 0 many.txt b.pfm -q --denoise --error 0.02 --threads 3 --kernel scalar
check 'denoised: an error goal, other threads and lanes' cmp a.pfm b.pfm
run 0 many.txt a.pfm --denoise --passes 1
check 'denoised: one pass shows no noise' has err 'is not denoised'
run 0 many.txt b.pfm -q --no-denoise --passes 1
check 'denoised: one pass is left as it is' cmp a.pfm b.pfm
expect 'denoised: normals' 1 'no use with the integrator normal' many.txt b.pfm --denoise --integrator normal
run 0 copy.txt b.pfm -q --integrator normal
run 0 copy.txt c.pfm -q --integrator normal --no-denoise
check 'denoised: other integrators stay' cmp b.pfm c.pfm

# An advice is no warning.
expect 'advice about samples' 0 'a power of two (8)' many.txt b.pfm --spp 7 --strict

finish
