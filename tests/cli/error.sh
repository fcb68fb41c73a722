#!/bin/sh
# --error: the picture is as good as asked for, and what the program says about it.
. "$(dirname "$0")/kit.sh"

# A ball's edge and its soft shadow, on a floor that fills the rest.
sed -e 's/resolution 24 16/resolution 48 32/' -e 's/color 60 60 60/&\n    radius 0.5/' scene.txt > soft.txt
run 0 soft.txt reference.png --bits 16 --spp 1024 --seed 9 -q
check 'the reference is rendered' test -s reference.png

# number KEY: the value of a key of --stats=json in "out".
number() { tr '{},' '\n\n\n' < out | grep "^\"$1\":" | cut -d : -f 2; }
below() { awk -v a="$1" -v b="$2" 'BEGIN { exit !(a != "" && a < b) }'; }

for goal in 0.03 0.01; do
    run 0 soft.txt a.png --bits 16 --error $goal --stats=json --aov samples,error
    check "--error $goal: the estimate is below it" below "$(number error_estimate)" $goal
    check "--error $goal: the true error is, too" "$raytracer" diff a.png reference.png --tol "$(number error_estimate)"
    check "--error $goal: the picture of samples" hasSize a.samples.pfm '48 32'
    check "--error $goal: the picture of errors" hasSize a.error.pfm '48 32'
    check "--error $goal: nothing to note" differ err /dev/null
done
check 'not all pixels are alike' below "$(number min)" "$(number max)"
run 0 soft.txt a.pfm --error 0.01 -q
run 0 soft.txt b.pfm --error 0.01 -q -t 3
check '3 threads: the same bits' cmp a.pfm b.pfm
run 0 soft.txt b.pfm --error 0.01 -q --no-specialise --kernel scalar --no-bvh
check 'other ways: the same bits' cmp a.pfm b.pfm
run 0 soft.txt b.pfm -q
sed 's/samples 4/samples 64/' soft.txt > more.txt
run 0 more.txt c.pfm --error 0.01 -q
check 'the samples of the scene do not count' cmp a.pfm c.pfm
run 0 soft.txt --convert copy.txt --error 0.01
run 0 copy.txt c.pfm -q
check '--convert: a scene has no goal' cmp b.pfm c.pfm

run 0 soft.txt b.pfm --error 0.0001 --spp 16 --stats=json
check '--spp: no pixel has more' [ "$(number max)" = 16 ]
check '--spp: how many it holds back' below 0 "$(number capped_pixels)"
check '--spp: says that the goal is missed' has err 'note: the estimated error is 0.'
check '--spp: says how many samples it allows' has err 'more than 16 samples; --spp allows more'
expect '--spp: the fewest there may be' 0 '' soft.txt b.pfm --error 0.1 --spp 2 -q
expect '--spp: one fewer' 1 '--error needs --spp 2' soft.txt b.pfm --error 0.1 --spp 1 -q
run 0 soft.txt b.pfm --error 0.0001 --spp 16 -q
check '--quiet: no note' cmp err /dev/null
run 0 soft.txt b.pfm --error 0.01 --progress plain
check 'progress reaches the end' has err 'progress 100 %'
run 0 soft.txt b.pfm --error 0.01 --stats -q
check '--stats: the estimate and the goal' has err '(display; goal 0.01)'

expect '--sampler corners' 1 "whose rays have fixed places" soft.txt b.pfm --error 0.01 --sampler corners
expect '--sampler zsobol' 1 'whose pixels are not independent' soft.txt b.pfm --error 0.01 --sampler zsobol
expect '--no-jitter' 1 'do not know what is between them' soft.txt b.pfm --error 0.01 --sampler grid --no-jitter
expect '--error 0' 1 '--error' soft.txt b.pfm --error 0
expect '--error of a word' 1 '--error' soft.txt b.pfm --error small
expect '--error of a worst' 1 'as 0.01' soft.txt b.pfm --error worst:
expect '--error of another unit' 1 'display' soft.txt b.pfm --error 0.01:square
for unit in display linear relative; do
    expect "--error in units: $unit" 0 '' soft.txt b.pfm --error 0.05:$unit
    expect "--error of the worst block: $unit" 0 '' soft.txt b.pfm --error worst:0.1:$unit
done
expect '--aov error without an estimate' 1 '--aov error needs --error' soft.txt b.pfm --aov error

# The clock decides the number of passes; so many passes are the same picture.
run 0 soft.txt a.pfm --time 0.3 --stats=json
passes=$(number passes)
check '--time: says how to get it again' has err "note: the time was enough for $passes pass"
check '--time: the last line has the error' has err ', error 0.0'
run 0 soft.txt b.pfm --passes "$passes" -q -t 3
check '--passes: the same bits' cmp a.pfm b.pfm
run 0 soft.txt a.pfm --time 0.001 --spp 64 --stats=json
check '--time: one pass at least' [ "$(number passes)" = 1 ]
run 0 soft.txt a.pfm --time 60 --error 0.05 --stats=json
check '--time with --error: the first of both ends it' below "$(number total)" 30
expect '--time with --passes' 1 'give one of them' soft.txt b.pfm --time 1 --passes 2
expect '--time with --sampler corners' 1 '--time has no use' soft.txt b.pfm --time 1 --sampler corners

for sampler in sobol stratified random grid; do
    expect "--sampler $sampler" 0 '' soft.txt b.pfm --error 0.05 --sampler $sampler
done
expect '--no-aa' 0 '' soft.txt b.pfm --error 0.05 --no-aa

finish
