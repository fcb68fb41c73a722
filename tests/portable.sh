#!/bin/sh
# The program that calls the system by nothing but the C++ standard library (Code/base/platform/portable.cpp) does
# what the other one does: sh tests/portable.sh RAYTRACER [MAKE]
# Builds it in build/portable, of the objects of build/release: only those of base/platform are others.
tests=$(cd "$(dirname "$0")" && pwd)
top=$(dirname "$tests")
portable=$top/build/portable/raytracer
${2:-make} -f "$top/Code/Makefile" --no-print-directory all PLATFORM=portable BUILD="$top/build/release" \
    BINARY="$portable" || exit 1
. "$tests/cli/kit.sh"
system=$raytracer

# same NAME ARGUMENT...: both programs print the same and have the same exit code.
same() {
    name=$1
    shift
    "$system" "$@" > expected.out 2> expected.err
    expected=$?
    "$portable" "$@" > out 2> err
    code=$?
    if [ $code -ne $expected ]; then fail "$name" "exit code $code instead of $expected"
    elif ! cmp -s err expected.err; then fail "$name" "'$(head -n 2 err)' instead of '$(head -n 2 expected.err)'"
    else check "$name" cmp out expected.out; fi
}

# The scenes of tests/scenes name textures that are not there.
for scene in "tests/scenes/everything.txt --no-textures" "tests/scenes/obj/room.obj --no-textures" \
    tests/scenes/everything.json tests/scenes/nff/everything.nff tests/scenes/ply/house_little.ply \
    tests/scenes/json/w2024_mesh.json tests/scenes/json/f2024_instances.json ASCII/textures.txt; do
    for threads in 1 3; do
        (cd "$tests/.." && "$system" $scene -o "$work/a.pfm" -r 60x40 -q)
        (cd "$tests/.." && "$portable" $scene -o "$work/b.pfm" -r 60x40 -q -t $threads)
        check "$scene, $threads threads: the same bits" cmp a.pfm b.pfm
        rm -f a.pfm b.pfm
    done
done

same 'help' --help
same 'no file' none.txt
same 'a folder instead of a file' .
same 'a file that may be meant' scen.txt
same 'no folder for the output' scene.txt none/a.ppm
same 'a folder as output' scene.txt "$tests"
same 'a scene on stdout' scene.txt --convert -
mkdir shut
echo old > locked.ppm
chmod 444 locked.ppm
chmod 555 shut
cp "$system" here && cp "$portable" there && chmod 755 . here there && chmod 644 scene.txt
if [ "$(id -u)" -eq 0 ] && setpriv --reuid 65534 --regid 65534 --clear-groups ./here --version > out 2>&1; then
    for program in here there; do
        for output in shut/a.ppm locked.ppm; do
            setpriv --reuid 65534 --regid 65534 --clear-groups "./$program" scene.txt $output -q
            echo "exit code $?"
        done > $program.said 2>&1
    done
    check 'no rights to write: what it says' has there.said 'Permission denied'
    check 'no rights to write: the same' cmp here.said there.said
else
    same 'no rights to write in a folder' scene.txt shut/a.ppm -q
    same 'no rights to write a file' scene.txt locked.ppm -q
fi
check 'the locked file is as it was' [ "$(cat locked.ppm)" = old ]
if [ -w /dev/full ]; then same 'no room on the disk' scene.txt /dev/full -q; fi

# A link to the old file keeps its content: the new one has come by another name.
mkdir one
echo old > one/a.ppm
ln one/a.ppm old.ppm
"$portable" scene.txt one/a.ppm -q
"$system" scene.txt b.ppm -q
check 'a picture is renamed to its name' [ "$(cat old.ppm)" = old ]
check 'it is the same one' cmp one/a.ppm b.ppm
check 'no other file is left' holds one a.ppm

for script in exit_codes formats interrupt output; do
    sh "$tests/cli/$script.sh" "$portable" > "$script.log" 2>&1
    check "cli/$script.sh: $(grep '^FAIL' "$script.log" || tail -n 1 "$script.log")" \
        grep -qx '[0-9]* passed, 0 failed' "$script.log"
done
finish
