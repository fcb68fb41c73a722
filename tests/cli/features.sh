#!/bin/sh
# Each switch takes away what its feature adds, to the bit, and nothing else.
. "$(dirname "$0")/kit.sh"

printf 'P3 2 2 255  255 0 0  0 255 0  0 0 255  255 255 0\n' > tiles.ppm

# scene FILE SED...: the scene with changes; BALL and LIGHT mark where properties go.
base() {
    sed -e 's/diffuse 0.8 0.1 0.1/&\n    BALL/' -e 's/color 60 60 60/&\n    LIGHT/' \
        -e 's/camera front {/&\n    CAMERA/' -e 's/translate 0 0 1/KEYS/' scene.txt
}
scene() {
    file=$1
    shift
    base | sed "$@" | sed -e '/^ *\(BALL\|LIGHT\|CAMERA\)$/d' -e 's/KEYS/translate 0 0 1/' > "$file"
}
# feature SWITCH: with.txt uses the feature, without.txt says the same without it. by: more options.
by=
feature() {
    run 0 with.txt with.pfm -q $by
    run 0 with.txt off.pfm -q $by "--no-$1" --stats=json
    cp out stats
    run 0 without.txt without.pfm -q $by
    check "$1: the scene shows it" differ with.pfm without.pfm
    check "--no-$1 is the scene without it" cmp off.pfm without.pfm
    check "--no-$1 is told by --stats" grep -q "\"$1: [^\"]*\"" stats
    run 0 without.txt off.pfm -q $by "--no-$1"
    check "--no-$1 changes nothing else" cmp off.pfm without.pfm
    run 0 with.txt on.pfm -q $by "--no-$1" "--$1"
    check "--$1 is the last word" cmp on.pfm with.pfm
}

scene with.txt -e ''
scene without.txt -e 's/LIGHT/shadows false/'
feature shadows

scene with.txt -e 's/LIGHT/radius 0.7/'
scene without.txt -e ''
feature soft-shadows

scene with.txt -e 's/BALL/mirror 0.5 0.5 0.5/'
scene without.txt -e ''
feature reflection

scene with.txt -e 's/BALL/transmission 0.5 0.5 0.5/'
scene without.txt -e ''
feature refraction

scene with.txt -e 's/BALL/mirror 0.5 0.5 0.5\n    roughness 0.4/'
scene without.txt -e 's/BALL/mirror 0.5 0.5 0.5/'
feature glossy

scene with.txt -e 's/BALL/mirror 0.5 0.5 0.5\n    fresnel schlick/'
scene without.txt -e 's/BALL/mirror 0.5 0.5 0.5/'
feature fresnel

# Lobes that are written as such, by both integrators.
lobes() {
    scene with.txt -e "s/BALL/${2:+lobe $2}/"
    scene without.txt -e "s/BALL/${3:+lobe $3}/"
    for integrator in whitted path; do
        by="-i $integrator"
        feature "$1"
    done
    by=
}
part='weight 0.3 0.3 0.3'
lobes reflection "mirror $part" ''
lobes reflection "conductor $part roughness 0.3" ''
lobes reflection 'coat covers' ''
lobes reflection "dielectric $part roughness 0.2" "dielectric $part roughness 0.2 reflect_tint 0 0 0"
lobes refraction "refraction $part" ''
lobes refraction "dielectric $part roughness 0.2" "dielectric $part roughness 0.2 transmit_tint 0 0 0"
lobes glossy "conductor $part roughness 0.4" "conductor $part roughness 0"
lobes glossy "dielectric $part roughness 0.4" "dielectric $part roughness 0"
lobes glossy "ashikhmin $part exponent 20" "mirror $part"

scene with.txt -e 's/CAMERA/aperture_radius 0.4\n    focus_distance 4/'
scene without.txt -e ''
feature dof

scene with.txt -e 's/KEYS/translate -0.5 0 1\n    key\n    translate 0.5 0 1/'
scene without.txt -e ''
feature motion-blur

scene with.txt -e 's/BALL/diffuse_texture tiles/'
printf 'texture tiles {\n    file "tiles.ppm"\n}\n' >> with.txt
scene without.txt -e ''
feature textures
mkdir folder
mv tiles.ppm folder
expect 'a missing texture: 2' 2 "no file 'tiles.ppm'" with.txt a.ppm
check 'at its line' grep -q '^with.txt:[0-9]*:[0-9]*: error: ' err
expect 'a missing texture: --check finds it' 2 "no file 'tiles.ppm'" with.txt --check
expect '--no-textures does not read it' 0 '' with.txt a.ppm --no-textures
expect '--textures FOLDER finds it' 0 '' with.txt --textures folder b.pfm
check '--textures FOLDER: the same picture' cmp b.pfm with.pfm
expect '--textures=FOLDER' 0 '' with.txt --textures=folder b.pfm
run 0 with.txt --info --textures folder
check '--info: size of a texture' has out '2x2, 3 x 8 bit, srgb'

# Without a lens and soft lights all samples in the centre of a pixel are alike.
scene with.txt -e ''
run 0 with.txt with.pfm -q
run 0 with.txt off.pfm -q --no-aa --stats=json
check '--no-aa: one sample' has out '"samples":{"min":1,"mean":1,"max":1}'
check 'aa: the scene shows it' differ with.pfm off.pfm
run 0 with.txt four.pfm -q --no-aa --spp 4 --seed 5
check '--no-aa: all samples in the centre' cmp off.pfm four.pfm

# Features that a scene does not have make no difference.
run 0 with.txt a.pfm -q
for name in soft-shadows reflection refraction glossy textures dof motion-blur fresnel; do
    run 0 with.txt b.pfm -q --no-$name
    check "--no-$name without $name" cmp a.pfm b.pfm
done

finish
