#!/bin/sh
# Options that choose what part of which picture is made.
. "$(dirname "$0")/kit.sh"

# rows FILE X0 Y0 X1 Y1: the bytes of a rectangle of an 8-bit PPM.
rows() {
    start=$(head -n 3 "$1" | wc -c)
    width=$(size "$1")
    width=${width% *}
    y=$3
    while [ "$y" -lt "$5" ]; do
        tail -c +$((start + (y * width + $2) * 3 + 1)) "$1" | head -c $((($4 - $2) * 3))
        y=$((y + 1))
    done
}

run 0 scene.txt full.ppm -q
check 'size of the scene' hasSize full.ppm '24 16'
run 0 scene.txt crop.ppm --crop 5,3,21,9 -q
check 'crop: size' hasSize crop.ppm '16 6'
rows full.ppm 5 3 21 9 > expected
rows crop.ppm 0 0 16 6 > got
check 'crop: the same pixels' cmp expected got
run 0 scene.txt pad.ppm --crop 5,3,21,9 --crop-pad -q
check 'crop-pad: size' hasSize pad.ppm '24 16'
rows pad.ppm 5 3 21 9 > got
check 'crop-pad: the same pixels' cmp expected got
rows pad.ppm 0 0 24 3 > got
head -c 216 /dev/zero > expected
check 'crop-pad: black outside' cmp expected got
run 0 scene.txt all.ppm --crop 0,0,24,16 -q
check 'crop of everything' "$raytracer" diff all.ppm full.ppm --tol 0

run 0 scene.txt half.ppm --scale 50 -q
check '--scale' hasSize half.ppm '12 8'
run 0 scene.txt small.ppm --resolution 12x8 -q
check '--scale and --resolution agree' cmp half.ppm small.ppm
run 0 scene.txt third.ppm --scale 33 -q
check '--scale rounds down' hasSize third.ppm '7 5'
run 0 scene.txt big.ppm -r 5x7 --scale=200 -q
check '--scale of --resolution' hasSize big.ppm '10 14'

cp scene.txt walk_0012.txt
mkdir frames
run 0 walk_####.txt frames/f##.ppm --frame 12 -q
check '--frame' holds frames f12.ppm
check '--frame: the picture' cmp frames/f12.ppm full.ppm
run 0 walk_####.txt --frame 12 -q
check '--frame: default output' "$raytracer" diff walk_0012.png full.ppm --tol 0
expect '--frame without #' 1 'needs a run of #' scene.txt a.ppm --frame 3
expect '--frame of a missing scene' 2 "did you mean 'walk_0012.txt'?" walk_####.txt a.ppm --frame 13

run 0 scene.txt top.ppm --camera top -q
check '--camera' differ top.ppm full.ppm
run 0 scene.txt front.ppm --camera front -q
check '--camera: the first one' cmp front.ppm full.ppm

run 0 scene.txt a.pfm -q
run 0 scene.txt b.pfm --exposure 1 -q
sed 's/resolution/exposure 1\n    resolution/' scene.txt > bright.txt
run 0 bright.txt c.pfm -q
check '--exposure as in the scene' cmp b.pfm c.pfm
run 0 bright.txt c.pfm -q --exposure 0
check '--exposure wins over the scene' cmp a.pfm c.pfm
run 0 scene.txt linear.ppm --transfer linear -q
check '--transfer' differ linear.ppm full.ppm
run 0 scene.txt linear.png --transfer linear --bits 16 -q
run 0 scene.txt full16.png --bits 16 -q
check '--bits 16 is nearer' "$raytracer" diff a.pfm full16.png --tol 0.00002
check '--bits 8 is not' sh -c "! '$raytracer' diff a.pfm full.ppm --tol 0.00002 > /dev/null"
run 0 scene.txt deep.ppm --bits 16 -q
check '--bits 16: PPM' [ "$(head -n 3 deep.ppm | tail -n 1)" = 65535 ]

run 0 scene.txt grey.ppm --background 0.5,0.5,0.5 -q
sed 's/background .*/background 0.5 0.5 0.5/' scene.txt > grey.txt
run 0 grey.txt grey2.ppm -q
check '--background' cmp grey.ppm grey2.ppm

for integrator in whitted path ao normal depth albedo id uv; do
    expect "--integrator $integrator" 0 '' scene.txt $integrator.pfm --integrator $integrator
done
check '--integrator: whitted is the default' cmp whitted.pfm a.pfm
for integrator in path ao normal depth albedo id uv; do
    check "--integrator $integrator is another picture" differ $integrator.pfm a.pfm
    sed "s/settings {/&\n    integrator $integrator/" scene.txt > said.txt
    run 0 said.txt said.pfm -q
    check "integrator $integrator of the scene" cmp said.pfm $integrator.pfm
done
run 0 said.txt said.pfm -q --integrator whitted
check '--integrator wins over the scene' cmp said.pfm a.pfm

finish
