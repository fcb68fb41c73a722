#!/bin/sh
# Scenes of every format render, and so does what --convert makes of them: to the same bits, from any
# folder, and the text of a second conversion is that of the first.
. "$(dirname "$0")/kit.sh"

mkdir models pictures
cat > models/roof.mtl <<'END'
newmtl tiles
Kd 0.8 0.3 0.2
Ks 0.2 0.2 0.2
Ns 30
map_Kd ../pictures/tiles.ppm
END
printf 'P3 2 2 255  255 0 0  0 255 0  0 0 255  255 255 0\n' > pictures/tiles.ppm
cat > models/roof.obj <<'END'
mtllib roof.mtl
o roof
v -1 0 -1
v 1 0 -1
v 1 0 1
v -1 0 1
v 0 1.5 0
vt 0 0
vt 1 0
vt 0.5 1
usemtl tiles
f 4/1 3/2 5/3
f 3/1 2/2 5/3
f 2/1 1/2 5/3
f 1/1 4/2 5/3
o floor
f 1 2 3 4
END
cat > roof.ply <<'END'
ply
format ascii 1.0
element vertex 5
property float x
property float y
property float z
element face 5
property list uchar int vertex_indices
end_header
-1 0 -1
1 0 -1
1 0 1
-1 0 1
0 1.5 0
3 3 2 4
3 2 1 4
3 1 0 4
3 0 3 4
4 0 1 2 3
END
cat > roof.json <<'END'
{
    "resolution": [40, 30], "AA_jitter": true, "AA_samples": 4, "ambient": [0.1, 0.1, 0.1],
    "camera": {"position": [3, 3, 4], "lookAt": [0, 0.5, 0], "up": [0, 1, 0], "fov": 45},
    "materials": [{"name": "red", "diffuse": [1, 0.2, 0.1], "specular": [0.5, 0.5, 0.5], "shininess": 20},
                  {"name": "white", "diffuse": [1, 1, 1], "specular": [0, 0, 0], "shininess": 0}],
    "objects": [{"name": "ground", "type": "plane", "normal": [0, 1, 0], "materials": ["white", "red"]},
                {"name": "roof", "type": "mesh", "filepath": "models/roof.obj", "materials": ["red"]},
                {"name": "ball", "type": "sphere", "radius": 0.5, "position": [1.5, 0.5, 1],
                 "materials": ["white"]}],
    "lights": [{"name": "l", "type": "point", "position": [2, 5, 3], "colour": [1, 1, 1], "power": 0.8,
                "attenuation": [0, 0, 1]}]
}
END
cat > roof.nff <<'END'
b 0.1 0.2 0.4
v
from 3 -4 3
at 0 0 0.5
up 0 0 1
angle 45
hither 0.1
resolution 40 30
l 2 -3 5
f 1 0.2 0.1 0.7 0.2 20 0 0
p 3
-1 -1 0  1 -1 0  0 0 1.5
p 3
1 -1 0  1 1 0  0 0 1.5
f 1 1 1 0.6 0.4 100000 0 0
s 1.5 -1 0.5 0.5
c -1.5 -1 0 0.4  -1.5 -1 1 0.1
p 4
-4 -4 0  4 -4 0  4 4 0  -4 4 0
END

for scene in roof.json roof.nff models/roof.obj roof.ply; do
    run 0 "$scene" a.pfm -q --spp 4 --scale 20
    check "$scene renders" [ -s a.pfm ]
    check "$scene shows something" differ a.pfm /dev/null
    rm -rf else.where
    mkdir else.where
    run 0 "$scene" -q --convert else.where/copy.txt
    run 0 else.where/copy.txt b.pfm -q --spp 4 --scale 20
    check "$scene converted has the same bits" cmp a.pfm b.pfm
    run 0 else.where/copy.txt -q --convert else.where/again.txt
    check "$scene converted twice is the same text" cmp else.where/copy.txt else.where/again.txt
    run 0 "$scene" --check
    check "$scene can be checked" has out ': ok ('
done

# Files that a scene names are looked for beside it, here, and one folder up.
mkdir -p up/scenes up/models
cp models/roof.obj up/models
sed 's|models/roof|./models/roof|' roof.json > up/scenes/roof.json
rm models/roof.obj
run 0 roof.json a.pfm -q 2> /dev/null || true
check "a missing mesh is named" has err "roof.json:7:"
run 0 up/scenes/roof.json b.pfm -q
check "a mesh in the folder above the scene is found" [ -s b.pfm ]
printf 'mtllib no.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl x\nf 1 2 3\n' > lone.obj
run 0 lone.obj c.pfm -q --scale 10 --spp 1
check "an OBJ without its library renders with a warning" has err "lone.obj:1:8: warning: no file 'no.mtl'"
run 3 lone.obj c.pfm -q --strict
check "and not under --strict" has err "--strict"

# The corner rays of the Standard Procedural Databases.
run 0 roof.nff c.png -q --sampler corners --stats=json
check "corner rays are shared: 41 x 31" has out '"camera":1271'
run 0 roof.nff centers.pfm -q
run 0 roof.nff edges.pfm -q --nff-angle edges
check "--nff-angle changes the view" differ centers.pfm edges.pfm

sed 's/"resolution"/"unheard_of": 1, "resolution"/' up/scenes/roof.json > up/scenes/odd.json
run 2 up/scenes/odd.json d.pfm -q
check "an unknown key is an error" has err "unheard_of"
run 0 up/scenes/odd.json d.pfm -q --lenient
check "--lenient makes it a warning" has err "warning:"
check "and the picture is the same" cmp b.pfm d.pfm

finish
