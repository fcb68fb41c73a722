#!/bin/sh
# What goes where: files, stdout, stderr; names, formats and sizes of what is written.
scenes=$(cd "$(dirname "$0")/../scenes" && pwd)
. "$(dirname "$0")/kit.sh"

mkdir one
run 0 scene.txt one/a.ppm
check 'only the picture is written' holds one a.ppm
check 'nothing on stdout' [ ! -s out ]
check 'a picture of less than a second: one line on stderr, of file, size, samples and time' \
    grep -qx 'wrote one/a.ppm (24x16, 4 samples per pixel, 0[.][0-9]* s)' err
check 'nothing else' [ "$(wc -l < err)" -eq 1 ]
run 0 scene.txt one/a.ppm --progress plain
check 'progress on stderr' has err 'progress 100 %'
run 0 scene.txt one/a.png --quiet
check 'quiet' [ ! -s err ]
run 0 scene.txt one/a.pfm --progress none
check 'no progress' sh -c '! grep -q progress err'
check 'PNG' sh -c "head -c 8 one/a.png | cmp - - < /dev/null; head -c 4 one/a.png | grep -q PNG"
check 'PFM' sh -c 'head -n 1 one/a.pfm | grep -qx PF'
check 'PPM and PNG say the same' "$raytracer" diff one/a.ppm one/a.png --tol 0
check 'PFM is near' "$raytracer" diff one/a.ppm one/a.pfm --tol 0.01

run 0 scene.txt - -q
check 'stdout: the same PPM' cmp out one/a.ppm
run 0 scene.txt - --stats
check 'stdout: only the picture beside --stats' cmp out one/a.ppm
check 'the table is on stderr' has err 'Mray/s'
run 0 scene.txt -o - -q < /dev/null
check '-o -' cmp out one/a.ppm
"$raytracer" - - -q < scene.txt > out
check 'scene from stdin' cmp out one/a.ppm

run 0 scene.txt one/b.ppm --stats=json
check 'JSON: one line' [ "$(wc -l < out)" -eq 1 ]
check 'JSON: only an object' grep -qx '{.*}' out
for key in scene output width height arguments version seconds parse build render write total rays camera shadow reflect refract indirect hits \
    rays_per_second accel kind nodes leaves bytes sah triangles bytes_per_triangle \
    peak_bytes threads kernel features needed \
    skipped skipped_work empty_tile_rays count of samples min mean max numeric nan_samples degenerate_primitives; do
    has out "\"$key\":" || fail 'JSON: all keys' "no $key"
done
check 'JSON: samples are counted' has out '"camera":1536'
expect 'JSON and picture do not share stdout' 1 'cannot both go to stdout' scene.txt - --stats=json

run 0 scene.txt
check 'default output: in the working folder' cmp scene.png one/a.png
mkdir elsewhere Output
run 0 elsewhere/../scene.txt -s 1
check 'default output: never beside the scene, nor in a folder' [ -f scene.png ] && holds Output
run 0 scene.txt /dev/null -q
check '/dev/null: a picture that nobody keeps' [ ! -s err ]
run 0 scene.txt /dev/null
check '/dev/null: it is named' has err 'wrote /dev/null (24x16'
expect '/dev/null has no neighbours' 1 'name an OUTPUT file instead of /dev/null' scene.txt /dev/null --aov id
expect 'an empty OUTPUT' 1 'OUTPUT is empty; name a file, or leave it out for scene.png' scene.txt ''
expect 'an empty SCENE' 1 'SCENE is empty' ''
expect 'an empty --output' 1 '--output expects the name of a file' scene.txt --output ''
expect 'a run of # without --frame' 1 "OUTPUT 'out_####.png' has a run of #" scene.txt out_####.png
expect 'a run of # in SCENE without --frame' 1 "SCENE 'scene_##.txt' has a run of #" scene_##.txt
expect 'a percentage below 1' 1 'is 50 meant?' scene.txt a.ppm --scale 0.5
expect '--textures of no folder' 1 "there is no folder 'nothere' for --textures" scene.txt --textures nothere
run 0 help
cp out help.txt
run 0 --help
check 'help is --help' cmp out help.txt
run 0 help diff
check 'help COMMAND' has out 'Compares two pictures'
cp one/a.ppm one/old.ppm
chmod 400 one/old.ppm
run 0 scene.txt one/a.ppm --seed 9
check 'a picture is replaced' differ one/a.ppm one/old.ppm

mkdir aov
run 0 scene.txt aov/a.png --aov depth,normal,albedo,position,id,samples
check 'all AOVs' holds aov a.albedo.pfm a.depth.pfm a.id.pfm a.normal.pfm a.png a.position.pfm a.samples.pfm
for name in albedo depth id normal position samples; do
    check "AOV $name: size" hasSize aov/a.$name.pfm '24 16'
    check "AOV $name: bytes" [ "$(wc -c < aov/a.$name.pfm)" -eq $((24 * 16 * 12 + $(head -n 3 aov/a.$name.pfm | wc -c))) ]
done
check 'an AOV is no copy of the picture' differ aov/a.depth.pfm aov/a.normal.pfm
run 0 scene.txt aov/c.pfm --aov depth --crop 2,3,7,5
check 'AOV of a crop' hasSize aov/c.depth.pfm '5 2'
run 0 scene.txt aov/c.pfm --aov depth --crop 2,3,7,5 --crop-pad
check 'AOV of a padded crop' hasSize aov/c.depth.pfm '24 16'

mkdir exr
run 0 scene.txt exr/a.exr -q --aov depth,normal,albedo,position,id,samples
check 'OpenEXR: AOVs are layers of the one file' holds exr a.exr
check 'OpenEXR: the picture is the PFM' "$raytracer" diff exr/a.exr one/a.pfm --tol 0
for channel in depth.Z normal.X normal.Y normal.Z albedo.R position.Z id.V samples.V; do
    check "OpenEXR: channel $channel" grep -aq "$channel" exr/a.exr
done
run 0 scene.txt exr/b.exr -q --bits 16
check 'OpenEXR of 16 bits: near' "$raytracer" diff exr/b.exr one/a.pfm --tol 0.001
check 'OpenEXR of 16 bits: smaller' [ "$(wc -c < exr/b.exr)" -lt "$(wc -c < exr/a.exr)" ]
run 0 scene.txt exr/c.exr -q --aov depth --crop 2,3,7,5 --crop-pad -t 3
run 0 scene.txt exr/d.pfm -q --crop 2,3,7,5 --crop-pad
check 'OpenEXR: padded' "$raytracer" diff exr/c.exr exr/d.pfm --tol 0
run 0 scene.txt exr/ev.exr -q --exposure 1
run 0 scene.txt exr/ev.pfm -q --exposure 1
check 'OpenEXR: exposed' "$raytracer" diff exr/ev.exr exr/ev.pfm --tol 0
expect 'OpenEXR has no 8 bits' 1 '16 or 32 bits, not 8' scene.txt a.exr --bits 8
expect 'only OpenEXR has 32 bits' 1 'is for .exr' scene.txt a.png --bits 32
check 'JPEG is read' "$raytracer" diff "$scenes/jpeg/420_baseline.jpg" "$scenes/jpeg/420_baseline.ppm" --tol 0.02
cp "$scenes/jpeg/420_baseline.jpg" skin.jpg
printf 'texture skin {\n    file "skin.jpg"\n}\n' > skin
sed 's/material red {/&\n    diffuse_texture skin/' scene.txt | cat - skin > skin.txt
expect 'a JPEG as a texture' 0 '' skin.txt skin.ppm -q
check 'a JPEG as a texture: it is seen' differ skin.ppm one/a.ppm
rm skin*

run 0 scene.txt p.ppm --preview -q
check 'preview: half blocks on stderr' has err '▀'
check 'preview: 8 rows' [ "$(wc -l < err)" -eq 8 ]
run 0 scene.txt --check
check '--check: one line' [ "$(cat out)" = 'scene.txt: ok (2 objects, 1 light, 1 material, 0 textures, 0 triangles)' ]
run 0 scene.txt --info
for words in '24x16 pixels' "'front' perspective 50 mm" '1 sphere, 1 infinite_plane' '-1 -1 0  to  1 1 2' \
    "point 'key' 60 60 60 W/sr at 3 -3 5" 'peak'; do
    check "--info: $words" has out "$words"
done
check '--info: nothing on stderr' [ ! -s err ]
sed -e 's/material red {/&\n    lobe coat covers\n    lobe mirror weight 0.1 0.1 0.1\n    lobe mirror weight 0 0 0.1\n    emission_lights true/' \
    -e 's/world {/&\n    environment_lights true/' -e 's/settings {/&\n    integrator albedo/' scene.txt > lobes.txt
run 0 lobes.txt --info
for words in '1, 2 mirror lobes, 1 coat lobe, 1 lighting others' 'lights surfaces' ', albedo, depth '; do
    check "--info: $words" has out "$words"
done
rm lobes.txt
run 0 --version
check '--version' grep -qx 'raytracer [0-9.]*' out
run 0 --list-features
check '--list-features' has out 'motion-blur'
check '--list-features: texts in one column' [ "$(cut -c 16-17 out | grep -c '^ [^ ]')" -eq "$(wc -l < out)" ]
run 0 scene.txt --convert told.txt
check '--convert says what it wrote' [ "$(cat err)" = 'wrote told.txt' ]
run 0 scene.txt told.pfm --aov depth,id --progress none
check 'all files are told that were written' grep -q '^wrote told.pfm, told.depth.pfm, told.id.pfm (24x16, ' err
rm told.*
check 'nothing else was written' [ "$(find . -name '*.tmp' | wc -l)" -eq 0 ]

finish
