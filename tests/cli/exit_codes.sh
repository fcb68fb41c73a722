#!/bin/sh
# Every exit code, and the message that comes with it.
. "$(dirname "$0")/kit.sh"

expect 'a picture: 0' 0 'wrote a.ppm' scene.txt a.ppm
expect 'no arguments: usage, 1' 1 'usage: raytracer SCENE'
expect 'unknown option: nearest, 1' 1 \
    "raytracer: error: unknown option '--spq'; did you mean '--spp'?" scene.txt --spq 4
expect 'where help is' 1 "'raytracer --help' lists all options" scene.txt --spq 4
expect 'where help of a sub-command is' 1 "'raytracer diff --help' lists all options" diff a.ppm
expect 'nearly a sub-command: 1' 1 "no sub-command 'dif'; did you mean 'raytracer diff'?" dif a.ppm a.ppm
expect 'wrong value: 1' 1 "--spp expects a whole number from 1 to 16777216, got 'x'" scene.txt --spp x
expect 'missing value: 1' 1 '--threads expects a whole number from 0 to 1024, got nothing' scene.txt -q --threads
expect 'two outputs: 1' 1 "two outputs: 'a.ppm' and --output 'b.ppm'" scene.txt a.ppm -o b.ppm
expect 'unknown extension: 1' 1 'must end in .ppm, .png, .pfm or .exr' scene.txt a.jpg
expect 'unknown camera: 1' 1 "did you mean 'top'?" scene.txt a.ppm --camera tpo
expect 'crop outside: 1' 1 'but the picture has 24x16 pixels' scene.txt a.ppm --crop 0,0,25,16
expect 'too large a picture: 1' 1 'is too large' scene.txt a.ppm --resolution 65535x65535
expect 'missing scene: 2' 2 'nothere.txt: error: cannot read' nothere.txt a.ppm
for kind in blend=Export.py stl=.obj glb=Blender fbx=Blender usd=Blender abc=Blender off=.obj gltf=Blender \
    pov=native png='name the scene first' mtl=.obj zip=unpack; do
    echo x > "foreign.${kind%%=*}"
    expect "a .${kind%%=*} as SCENE: 2" 2 "${kind#*=}" "foreign.${kind%%=*}" a.ppm
    rm "foreign.${kind%%=*}"
done
printf 'texture wood {\n    channel rgb\n    file "not there.png"\n}\n' | sed '/channel/d' > wood
sed 's/material red {/&\n    diffuse_texture wood/' scene.txt | cat - wood > wood.txt
expect 'a missing texture: where its file is named' 2 \
    "wood.txt:$(grep -n 'not there' wood.txt | cut -d: -f1):10: error: texture 'wood': no file 'not there.png'" wood.txt a.ppm
check 'with the line and a caret' grep -q '\^' err
sed -i 's/not there.png/wood.ppm/' wood.txt
"$raytracer" scene.txt wood.ppm -q
cp wood.ppm kept.ppm
expect 'OUTPUT is a texture of the scene: 1' 1 "OUTPUT 'wood.ppm' is a file that the scene is made of" wood.txt wood.ppm
ln -s wood.ppm link.ppm
expect 'OUTPUT is a link to a texture: 1' 1 "OUTPUT 'link.ppm' is a file that the scene is made of ('wood.ppm')" wood.txt link.ppm
check 'the texture is as it was' cmp wood.ppm kept.ppm
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' > tri.obj
ln tri.obj tri.ppm
printf 'mesh tri {\n    file "tri.obj"\n}\ninstance tri {\n    mesh tri\n}\n' | cat scene.txt - > tri.txt
expect 'OUTPUT is a mesh of the scene, by another name: 1' 1 "('tri.obj')" tri.txt tri.ppm
expect '--convert onto the scene itself: 1' 1 "OUTPUT 'tri.txt' is a file" tri.txt --convert tri.txt
rm wood wood.txt wood.ppm kept.ppm link.ppm tri.*
expect 'nearest scene' 2 "did you mean 'scene.txt'?" scenee.txt a.ppm
expect 'a folder is no scene: 2' 2 'it is a folder' / a.ppm

cp scene.txt bare
expect 'no extension: 2' 2 'bare: error: the name has no extension' bare a.ppm
rm bare

sed 's/material red$/material gold/' scene.txt > gold.txt
expect 'error in a scene: 2' 2 'error: unknown material' gold.txt gold.ppm
check 'with line and column' grep -q '^gold.txt:[0-9]*:[0-9]*: error: ' err
check 'no picture after an error' absent gold.ppm
printf 'not a scene' | "$raytracer" - b.ppm 2> err
check 'error in stdin: 2' [ $? -eq 2 ]

printf 'material unused {\n}\n' | cat scene.txt - > warned.txt
expect 'a warning alone: 0' 0 'warning: ' warned.txt w.ppm
rm w.ppm
expect 'a warning under --strict: 3' 3 '1 warning under --strict' warned.txt w.ppm --strict
check 'no picture under --strict' absent w.ppm
expect 'check under --strict: 3' 3 'warning: ' warned.txt --check --strict
expect 'no warning under --strict: 0' 0 '' scene.txt --check --strict

expect 'missing folder: 4' 4 "there is no folder 'no'" scene.txt no/a.ppm
check 'before rendering' sh -c '! grep -q progress err'
mkdir folder.ppm
expect 'output is a folder: 4' 4 'it is a folder' scene.txt folder.ppm
expect 'missing folder for --convert: 4' 4 "there is no folder 'no'" scene.txt --convert no/a.txt
mkdir a.depth.pfm
expect 'an AOV that cannot be written: 4' 4 'a.depth.pfm: error: cannot write' scene.txt a.ppm --aov depth
if [ -w /dev/full ]; then
    "$raytracer" scene.txt - -q > /dev/full 2> err
    check 'full disk: 4' [ $? -eq 4 ]
    check 'full disk: message' has err 'stdout: error: cannot write'
    "$raytracer" --help > /dev/full 2> err
    check 'full disk for --help: 4' [ $? -eq 4 ]
fi

expect 'diff, equal: 0' 0 '' diff a.ppm a.ppm --tol 0
run 0 scene.txt b.ppm --exposure 1
expect 'diff above tolerance: 5' 5 '' diff a.ppm b.ppm --tol 0.0001
expect 'diff below tolerance: 0' 0 '' diff a.ppm b.ppm --tol 2
expect 'diff, psnr below: 5' 5 '' diff a.ppm b.ppm --metric psnr --tol 90
expect 'diff, missing file: 2' 2 'nothere.ppm: error: cannot read' diff a.ppm nothere.ppm
run 0 scene.txt small.ppm --scale 50
expect 'diff, sizes: both names, 2' 2 'a.ppm has 24x16 pixels, small.ppm has 12x8' diff a.ppm small.ppm
expect 'diff, one name: 1' 1 'diff expects two pictures' diff a.ppm
expect 'diff, unknown option: 1' 1 "did you mean '--tol'?" diff a.ppm b.ppm --tool 3

finish
