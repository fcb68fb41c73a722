#!/bin/sh
# raytracer bench: lines for scripts, and the same hits with every kernel.
. "$(dirname "$0")/kit.sh"

printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n' > tetra.obj
run 0 bench tetra.obj --runs 1
cp out best.csv
check 'a line for the build and one for each set' test "$(wc -l < out)" -eq 5
check 'the build has bytes per triangle' grep -qE '^BUILD,tetra.obj,raytracer-[^,]*,sah,exact,1,[a-z0-9]+(,[0-9]+\.[0-9]{2}){4}$' out
check 'rates of the primary rays' grep -qE '^tetra.obj,.*,primary,1048576,[0-9]+(,[0-9]+\.[0-9]{2}){4}$' out
hitsOf() { grep -v BUILD "$1" | cut -d, -f7-9; }
hitsOf best.csv > expected
check 'sets in order' test "$(cut -d, -f1 expected | tr '\n' ' ')" = 'primary shadow bounce bounceany '
run 0 bench tetra.obj --runs 1 --kernel scalar
hitsOf out > got
check 'the scalar kernel has the same hits' cmp expected got
expect 'no mesh' 1 'bench needs one mesh' bench
expect 'a scene without triangles' 1 'has no triangles' bench scene.txt
expect 'an unknown kernel' 1 "did you mean 'scalar'" bench tetra.obj --kernel scaler
run 0 bench --help
check 'help' grep -q 'bounceany' out
finish
