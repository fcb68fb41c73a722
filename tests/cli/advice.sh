#!/bin/sh
# What the program says of light: before rendering, of materials and lamps; after it, of the picture.
. "$(dirname "$0")/kit.sh"

silent() { [ ! -s err ]; }
# quiet NAME ARGUMENT...: exit code 0, and not a word.
quiet() {
    quietName=$1
    shift
    if run 0 -q "$@" && silent; then ok "$quietName"
    else fail "$quietName" "exit code $code; $(head -n 2 err)"; fi
}
lines() { [ "$(grep -c -F -e "$2" "$1")" = "$3" ]; }

quiet 'nothing to say of a sound scene' scene.txt a.png

# Materials that give back more than they get: one warning with the place, and how many others.
sed -e 's/diffuse 0.8 0.1 0.1/&\n    mirror 0.3 0.3 0.3/' scene.txt > bright.txt
expect 'a material above 1' 0 \
    "bright.txt:19:1: warning: material 'red': diffuse + mirror + transmission is 1.1;" \
    bright.txt a.png
check '... is told once' lines err warning: 1
expect '... counts under --strict' 3 '1 warning under --strict' bright.txt b.png --strict
check '... before anything is written' absent b.png
expect '... and under --check' 0 'transmission is 1.1;' bright.txt --check
{
    cat bright.txt
    for name in blue green; do
        printf 'material %s {\n transmission 0.5 0.5 0.5\n}\nsphere %s {\n material %s\n}\n' \
            $name $name $name
    done
} > three.txt
expect 'three of them' 0 "material 'red' and 2 others: diffuse" three.txt a.png
check '... are told once' lines err warning: 1
sed -e 's/diffuse 0.8 0.1 0.1/diffuse 0 0 0\n    mirror 1 1 1\n    transmission 1 1 1\n    fresnel dielectric/' \
    scene.txt > glass.txt
quiet 'glass is sound' glass.txt a.png

# Lobes whose weights are more than there is.
sed -e 's/diffuse 0.8 0.1 0.1/lobe diffuse weight 0.8 0.5 0.5\n    lobe mirror weight 0.45 0.3 0.3/' \
    scene.txt > more.txt
expect 'weights above 1' 0 \
    "more.txt:19:1: warning: material 'red': the weights of its lobes sum up to 1.25; they are scaled to 1" \
    more.txt a.png
check '... are told once' lines err warning: 1
sed -e 's/weight 0.8 0.5 0.5/weight 0.64 0.4 0.4/' -e 's/weight 0.45 0.3 0.3/weight 0.36 0.24 0.24/' \
    more.txt > scaled.txt
run 0 scaled.txt s.png -q
check "... and scaled" cmp a.png s.png

# Lights without area.
for light in 'rectangle\n    size 0 1' 'disk\n    size 1 0' 'sphere'; do
    printf 'light flat {\n    visible true\n    type %b\n}\n' "$light" | cat scene.txt - > flat.txt
    expect "a light without area: $light" 0 "flat.txt:28:1: warning: light 'flat': it has no area, and is left out" \
        flat.txt a.pfm
    check '... is told once' lines err warning: 1
    run 0 scene.txt b.pfm -q
    check '... and left out' cmp a.pfm b.pfm
done

# Pixels around the scene that are no light.
pixels() { printf 'PF\n2 1\n-1.0\n' && printf '\0\0\200\077%.0s' 1 2 3 4 && printf "$1" && printf '\0\0\200\077'; }
sed -e 's/^world {/texture sky {\n    file "sky.pfm"\n}\n&\n    environment sky\n    environment_lights true/' \
    scene.txt > sky.txt
pixels '\0\0\200\277' > sky.pfm
expect 'a negative pixel of the environment' 2 'sky.txt:7:10: error: sky.pfm: pixel 1 from the left, 0 from the top is negative' sky.txt s.png
pixels '\0\0\300\177' > sky.pfm
expect 'a pixel of it that is no number' 2 "sky.pfm: error: the pixel 1,0 is not a finite number" sky.txt s.png

# No light at all: told before, and the picture is black.
sed -e '/^light/,/^}/d' -e '/background/d' scene.txt > dark.txt
expect 'no light' 0 'no light, no emission and no ambient: the picture will be black; add a light' \
    dark.txt a.png
check '... and after it' has err 'warning: the picture is black; no light reaches what the camera sees'
expect '... ends the program under --strict' 3 'under --strict' dark.txt b.png --strict
check '... before anything is written' absent b.png
sed -e 's/^world {/&\n    ambient 0.5 0.5 0.5/' dark.txt > ambient.txt
quiet '... is none with ambient light' ambient.txt a.png
run 0 dark.txt a.png -q --integrator normal
check '... nothing of the picture where it is none of light' lines err 'picture is black' 0

# Lamps that reach nothing: the floor hides them.
sed -e 's/translate 3 -3 5/translate 3 -3 -5/' -e '/background/d' scene.txt > hidden.txt
expect 'lamps below the floor' 0 'warning: the picture is black;' hidden.txt a.png
# The picture is written all the same, also under --strict: it is no warning about the scene.
expect '... no error under --strict' 0 'warning: the picture is black;' hidden.txt b.png --strict -q
check '... the picture is there' cmp a.png b.png

# Too dark, and what is proposed brings it into sight.
sed -e 's/60 60 60/0.3 0.3 0.3/' -e '/background/d' scene.txt > dim.txt
expect 'a dim lamp' 0 'warning: the brightest value of the picture is 0.0' dim.txt a.png
ev=$(sed -n 's/.*--exposure //p' err)
check '... an exposure is proposed' [ "$ev" -ge 5 ]
quiet '... which is enough' dim.txt a.png --exposure "$ev"
for format in ppm pfm exr; do
    expect "... told of .$format too" 0 "or --exposure $ev" dim.txt "a.$format"
done
expect '... of 16 bits' 0 "or --exposure $ev" dim.txt a.png --bits 16
expect '... of stdout' 0 "or --exposure $ev" dim.txt -

# Clipped, and what is proposed.
sed -e 's/60 60 60/20000 20000 20000/' scene.txt > glaring.txt
expect 'a glaring lamp' 0 'of the pixels are as bright as can be; less light shows more, or --exposure -2' \
    glaring.txt a.png
expect '... adds to an exposure' 0 'or --exposure -3.5' glaring.txt a.png --exposure -1.5
quiet '... is not told of files that keep it' glaring.txt a.exr
quiet '... nor of the other one' glaring.txt a.pfm
# White backgrounds are wanted, those beyond white are not.
sed -e 's/background 0.2 0.3 0.5/background 1 1 1/' -e '/infinite_plane/,/}/d' \
    -e 's/0 0 1$/0 0 1\n    scale 0.2 0.2 0.2/' scene.txt > white.txt
quiet 'a white background' white.txt a.png
quiet '... of floats' white.txt a.png --bits 16
expect 'one beyond white' 0 'are as bright as can be' white.txt a.png --background 1,1,4

# Whitted pictures take samples of each lamp.
lamps() {
    cat scene.txt
    i=0
    while [ "$i" -lt "$1" ]; do
        i=$((i + 1))
        echo "light l$i {
    type point
    translate $i 0 9
    color 0.1 0.1 0.1
}"
    done
}
lamps 100 > some.txt
quiet 'a hundred lamps' some.txt a.png
lamps 300 > many.txt
expect 'three hundred' 0 'warning: this picture takes samples of each of 301 lights at every point' many.txt a.png
quiet '... are one choice of a path' many.txt a.png --integrator path

# Surfaces that are to light others, and whose light Whitted pictures take no samples of.
cat > shines.txt << 'END'
raytracer 1
camera c {
    look_at 0 -6 3  0 0 0  0 0 1
}
material e {
    emission 5 5 5
    emission_lights true
}
plane floor {
    scale 5 5 1
}
cylinder lamp {
    translate 0 0 3
    scale 0.5 0.5 0.5
    material e
}
END
expect 'a cylinder that shines' 0 'shines.txt: warning: object lamp shines, but lights nothing here' shines.txt a.png
quiet '... is found by paths' shines.txt a.png --integrator path

# Covers let through what they do not reflect: no more than all.
cat > cover.txt << 'END'
raytracer 1
camera c {
    look_at 0 -6 3  0 0 0  0 0 1
}
world {
    background 1 1 1
}
material m {
    lobe mirror weight 5 5 5 covers
    lobe diffuse
}
sphere s {
    material m
}
END
expect 'a cover above 1' 0 "cover.txt:8:1: warning: material 'm': the weights of its lobes sum up to 5; they are scaled to 1" cover.txt a.png

finish
