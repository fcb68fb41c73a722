#!/bin/sh
# Pictures that a scene names and that cannot be read: of a mesh, and of JSON under --lenient, they
# are warnings, and what they colour has its plain colour; with --strict the warnings end the program.
. "$(dirname "$0")/kit.sh"

cat > mesh.obj <<'END'
mtllib mesh.mtl
v -1 -1 0
v 1 -1 0
v 1 1 0
v -1 1 0
vt 0 0
vt 1 0
vt 1 1
usemtl skin
f 1/1 2/2 3/3
f 1/1 3/3 4/1
END
# library FILE: the skin has this picture.
library() { printf 'newmtl skin\nKd 0.8 0.5 0.3\n%s\n' "$1" > mesh.mtl; }
library ''
run 0 mesh.obj plain.ppm -q -r 40x30
printf 'P6\n8 8\n255\nshort' > cut.ppm
printf '\211PNG\r\n\032\n\0\0\0\rIHDR\0\0\0\010' > cut.png
printf 'RIFF\044\0\0\0WEBPVP8 ' > photo.webp
printf 'GIF89a' > photo.gif
: > empty.jpg
for file in none.png none.jpg sub/none.tga cut.ppm cut.png photo.webp photo.gif empty.jpg; do
    library "map_Kd $file"
    expect "mesh: $file is a warning" 0 "warning: texture '" mesh.obj picture.ppm -q -r 40x30
    check "mesh: $file: one warning that says what follows" \
        [ "$(grep -c 'warning: .*; it is left out$' err)" -eq 1 ]
    check "mesh: $file: the colour alone" cmp picture.ppm plain.ppm
    expect "mesh: $file under --strict" 3 'error: 1 warning under --strict' mesh.obj strict.ppm --strict -q
    check "mesh: $file under --strict: no picture" absent strict.ppm
    expect "mesh: $file, --check" 0 "warning: texture '" mesh.obj --check
    expect "mesh: $file, --info" 0 "warning: texture '" mesh.obj --info
    check "mesh: $file, --info says so" has out ', missing'
done
# Each map of a material may miss; what the others say stays.
for map in map_Ks map_Ke map_d map_Bump norm; do
    library "$map none.png"
    expect "mesh: $map" 0 "no file 'none.png'" mesh.obj picture.ppm -q -r 40x30
    check "mesh: $map: one warning" [ "$(grep -c warning: err)" -eq 1 ]
done
printf 'P6\n1 1\n255\n\0\377\0' > green.ppm
library 'map_Kd green.ppm
map_d none.png'
expect 'mesh: one of two pictures' 0 "no file 'none.png'" mesh.obj green2.ppm -q -r 40x30
library 'map_Kd green.ppm'
run 0 mesh.obj green1.ppm -q -r 40x30
check 'mesh: the other picture is shown' cmp green1.ppm green2.ppm
check 'mesh: and makes a difference' differ green1.ppm plain.ppm

# scene TEXTURE WORLD
scene() {
    printf '{"camera": {"position": [0, 0, 5]}, "resolution": [20, 15],
 "materials": [{"name": "m", "diffuse": [0.8, 0.5, 0.3]%s}],
 "textures": [{"name": "t", "file": "cut.png"}],
 "objects": [{"type": "sphere", "materials": ["m"]}],
 "lights": [{"type": "point", "position": [3, 3, 5]}]%s}' "$1" "$2" > scene.json
}
scene '' ''
run 0 scene.json plain.ppm -q
scene ', "diffuse_texture": "t"' ''
expect 'JSON: an error' 2 "error: texture 't' can't be read" scene.json picture.ppm -q
expect 'JSON under --lenient: a warning' 0 "warning: texture 't' can't be read" \
    scene.json picture.ppm -q --lenient
check 'JSON under --lenient: the colour alone' cmp picture.ppm plain.ppm
expect 'JSON under --lenient --strict' 3 'error: ' scene.json strict.ppm -q --lenient --strict
scene '' ', "world": {"environment": "t"}'
expect 'JSON under --lenient: surroundings' 0 "warning: texture 't' can't be read" \
    scene.json picture.ppm -q --lenient
finish
