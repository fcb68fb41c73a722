#!/bin/sh
# What the machine does to the program: full disks, closed doors and pipes, death, little memory.
# Whatever happens, there is a message and an exit code of the list, and a file that has its final
# name is whole. STRESS=n in the environment: n times as many kills, n times as fine steps of memory.
tests=$(cd "$(dirname "$0")/.." && pwd)
. "$(dirname "$0")/kit.sh"
stress=${STRESS:-1}

run 0 scene.txt whole.ppm
# whole FOLDER NAME CONTENT: nothing but this file is in the folder, with this content.
whole() { holds "$1" "$2" && cmp "$1/$2" "$3"; }

# ---- no room on the disk, three ways

echo old > old
mkdir small
cp old small/a.png
(
    ulimit -f 1 # blocks of 512 bytes or of 1 KiB; the picture below needs 18 KiB
    "$raytracer" scene.txt small/a.png -r 80x60 -q > out 2> err
    echo $? > code
)
check 'limit of file size: 4' [ "$(cat code)" -eq 4 ]
check 'limit of file size: message' has err 'small/a.png: error: cannot write: File too large'
check 'limit of file size: the old file is whole' whole small a.png old
if [ -w /dev/full ]; then
    ln -s /dev/full full.ppm
    expect 'a full device: 4' 4 'full.ppm: error: cannot write: No space left' scene.txt full.ppm
    check 'a full device: the link stays' [ -L full.ppm ]
fi
# A file system of 64 KiB, seen by nobody else.
inSmallDisk() { unshare -rm sh -c 'mount -t tmpfs -o size=64k none disk && "$@"' sh "$@"; }
fillDisk='
    cp old disk/a.pfm
    "$1" scene.txt disk/a.pfm -r 200x200 -q 2> err
    echo $? > code
    "$1" scene.txt disk/b.ppm -q 2> /dev/null
    cp -r disk after'
mkdir disk
if inSmallDisk true 2> /dev/null; then
    inSmallDisk sh -c "$fillDisk" sh "$raytracer"
    check 'full disk: 4' [ "$(cat code)" -eq 4 ]
    check 'full disk: message' has err 'disk/a.pfm: error: cannot write: No space left on device'
    check 'full disk: no more files than before' holds after a.pfm b.ppm
    check 'full disk: the old file is whole' cmp after/a.pfm old
    check 'full disk: a smaller picture fits' cmp after/b.ppm whole.ppm
else
    ok 'a small file system cannot be made here: not tested'
fi

# ---- folders that cannot be written, or are not there any more

mkdir shut
chmod 555 shut
cp "$raytracer" here 2> /dev/null
chmod 755 . here
asNobody=
[ "$(id -u)" -eq 0 ] && asNobody='setpriv --reuid 65534 --regid 65534 --clear-groups'
if $asNobody ./here --version > /dev/null 2>&1 && ! $asNobody test -w shut; then
    $asNobody ./here scene.txt shut/a.ppm > out 2> err
    check 'folder without rights: 4' [ $? -eq 4 ]
    check 'folder without rights: message' has err "the folder 'shut': Permission denied"
    check 'folder without rights: before rendering' sh -c '! grep -q progress err'
else
    ok 'every folder can be written here: not tested'
fi
# One process and no second thread: the render does with what it gets.
if $asNobody prlimit --nproc=1 ./here --version > /dev/null 2>&1 && [ -n "$asNobody" ]; then
    $asNobody prlimit --nproc=1 ./here scene.txt - -t 8 -q > few.ppm 2> err
    check 'no threads to be had: 0' [ $? -eq 0 ]
    check 'no threads to be had: same picture' cmp few.ppm whole.ppm
fi
rm -f here

mkdir leaving
{
    # As soon as it renders, the folder goes.
    while ! has late.err progress; do sleep 0.02; done
    rmdir leaving
} 2> /dev/null &
: > late.err
"$raytracer" scene.txt leaving/a.ppm -r 500x500 --spp 16 --progress plain > out 2> late.err
check 'folder removed while rendering: 4' [ $? -eq 4 ]
check 'folder removed while rendering: message' has late.err "the folder 'leaving' must exist"
wait

# ---- nobody listens

{
    "$raytracer" scene.txt - -r 300x300 -q 2> err
    echo $? > code
} | :
check 'closed pipe: 4' [ "$(cat code)" -eq 4 ]
check 'closed pipe: message' has err 'stdout: error: cannot write: Broken pipe'
{ "$raytracer" scene.txt piped.ppm --progress plain --stats 2>&1; echo $? > code; } | :
check 'progress into a closed pipe: 0' [ "$(cat code)" -eq 0 ]
check 'progress into a closed pipe: the picture is whole' cmp piped.ppm whole.ppm
"$raytracer" scene.txt closed.ppm > out 2>&-
check 'stderr is closed: 0' [ $? -eq 0 ]
check 'stderr is closed: the picture is whole' cmp closed.ppm whole.ppm
"$raytracer" scene.txt - -q 2> err >&-
check 'stdout is closed: 4' [ $? -eq 4 ]
"$raytracer" - stdin.ppm 2> err <&-
check 'stdin is closed: 2' [ $? -eq 2 ]
check 'stdin is closed: no picture' absent stdin.ppm

# ---- killed, at any moment

# Nearly all the time goes into writing: 9 MB around a few pixels.
wide='-r 1600x1200 --crop 0,0,16,16 --crop-pad -q'
run 0 scene.txt full.pfm $wide --stats=json
seconds=$(sed 's/.*"total":\([0-9.e-]*\).*/\1/' out)
kills=$((20 * stress)) seed=$$
awk -v n=$kills -v seed=$seed -v seconds="$seconds" 'BEGIN {
    srand(seed); for (i = 0; i < n; i++) printf "%.4f\n", rand() * 1.5 * seconds
}' > delays
mkdir killed
broken=0 early=0 during=0 after=0 number=0
for delay in $(cat delays); do
    number=$((number + 1))
    rm -f killed/*
    [ $((number % 2)) -eq 0 ] && cp old killed/a.pfm
    "$raytracer" scene.txt killed/a.pfm $wide 2> /dev/null &
    sleep "$delay"
    kill -KILL $! 2> /dev/null
    wait $! 2> /dev/null
    if cmp -s killed/a.pfm full.pfm; then
        after=$((after + 1))
        continue
    fi
    set -- killed/*.tmp
    if [ -e "$1" ]; then during=$((during + 1)); else early=$((early + 1)); fi
    [ $((number % 2)) -eq 1 ] && [ ! -e killed/a.pfm ] && continue
    [ $((number % 2)) -eq 0 ] && cmp -s killed/a.pfm old && continue
    broken=$((broken + 1))
    echo "seed $seed, kill $number after $delay s: killed/a.pfm is neither old nor whole"
done
echo "$kills kills, seed $seed: $early before, $during while and $after after writing"
check 'killed: no half-written picture under its final name' [ $broken -eq 0 ]
check 'killed: some kills were before the end' [ $((early + during)) -gt 0 ]
if [ "$stress" -ge 10 ]; then
    check 'killed: some kills hit the writing' [ $during -gt 0 ]
fi
rm -rf killed full.pfm

# ---- memory

# limited KIB ARGUMENT...: the program with that much address space; "err", $code as run() has them.
limited() {
    kib=$1
    shift
    (ulimit -v "$kib" && exec "$raytracer" "$@") > out 2> err
    code=$?
}
# sweep NAME WORDS CODE MOST ARGUMENT...: with each limit from what --version needs up to MOST MiB
# more, the program succeeds or fails with a message; somewhere memory runs out "while WORDS" (not
# asked for when CODE is 0).
sweep() {
    name=$1 words=$2 wantedCode=$3 limit=$least most=$(($4 * 1024)) seen=0 wrong= enough=
    shift 4
    step=$((most / (16 * stress) + 1))
    while [ $limit -le $((least + most)) ]; do
        rm -f tight.ppm
        limited $limit "$@"
        case $code in
        0) enough=$limit ;;
        2 | 4)
            has err 'raytracer: error: out of memory while ' || wrong="$limit KiB: $(head -n 2 err)"
            has err "out of memory while $words" && [ $code -eq "$wantedCode" ] && seen=$((seen + 1))
            [ -e tight.ppm ] && wrong="$limit KiB: a picture, and exit code $code"
            ;;
        *) wrong="$limit KiB: exit code $code, $(head -n 2 err)" ;;
        esac
        limit=$((limit + step))
    done
    check "memory: $name: success or a message" [ -z "$wrong" ]
    [ -z "$wrong" ] || echo "$name: $wrong"
    [ "$wantedCode" -eq 0 ] || check "memory: $name: runs out while $words" [ $seen -gt 0 ]
    check "memory: $name: enough in the end" [ -n "$enough" ]
}
least=4096
while limited $least --version 2> /dev/null && [ $code -ne 0 ] && [ $least -lt 65536 ]; do
    least=$((least + 512))
done
if [ $code -ne 0 ]; then
    ok 'the program needs address space without end (a sanitizer): not tested'
else
    sh "$tests/bench/waves.sh" 40000 > waves.txt
    sweep 'a large mesh' 'reading the scene' 2 24 waves.txt tight.ppm -q -t 1 -r 16x16
    # 300,000 vertices of 3 bytes in the file, of 24 in memory.
    {
        printf 'ply\nformat binary_little_endian 1.0\nelement vertex 300000\nproperty char x\n'
        printf 'property char y\nproperty char z\nelement face 1\n'
        printf 'property list uchar int vertex_indices\nend_header\n'
        head -c 899991 /dev/zero
        printf '\001\000\000\000\001\000\000\000\001'
        printf '\003\337\223\004\000\336\223\004\000\335\223\004\000'
    } > swarm.ply
    sweep 'a large PLY file' 'reading the scene' 2 24 swarm.ply tight.ppm -q -t 1 -r 16x16
    sweep 'a tree' 'building the scene' 2 24 waves.txt tight.ppm -q -t 1 -r 16x16
    sweep 'a large film' 'rendering' 2 48 scene.txt tight.ppm -q -t 1 -r 1600x1600 --spp 1 -i normal
    sweep 'a large picture' 'writing the picture' 4 96 scene.txt tight.ppm -q -t 1 \
        -r 1600x1600 --crop 0,0,16,16 --crop-pad
    sweep 'many samples' 'rendering' 2 24 scene.txt tight.ppm -q -t 1 --spp 64
    # Where the system does not give all threads, fewer do the work.
    sweep 'many threads' '' 0 400 scene.txt tight.ppm -q -t 32

    # Points, indices and tree of a closed or wavy mesh: 6 + 12 + 4 + 36 bytes per triangle. The
    # most is while the tree is built: also 64 for two lists of boxes, 24 for the scene as it was
    # read and 40 for the text; and each of these arrays ends somewhere in a page of 2 MB.
    triangles=200000
    [ "$stress" -ge 10 ] && triangles=10000000
    field() { sed 's/.*"'"$1"'":\([0-9]*\).*/\1/' out; }
    run 0 scene.txt few.ppm -q --stats=json
    base=$(field peak_bytes)
    sh "$tests/bench/waves.sh" $triangles > waves.txt
    run 0 waves.txt waves.ppm -q --stats=json
    check "memory: $triangles triangles are drawn" [ "$(field triangles)" -ge $triangles ]
    check 'memory: at most 64 bytes per triangle' [ "$(field bytes_per_triangle)" -le 64 ]
    most=$(($(field peak_bytes) - base - 4 * 2097152))
    echo "$triangles triangles: $(field bytes_per_triangle) bytes each, $((most / triangles)) at most"
    check 'memory: at most 190 bytes per triangle at any time' [ $((most / triangles)) -le 190 ]

    # Text and description of an object, 85 + 200 bytes here, are gone before its tree is built: the
    # shape has 272, boxes and tree 24 + 140 and, while it is built, 240. Half as much again for
    # what several threads have at once.
    spheres=100000
    [ "$stress" -ge 10 ] && spheres=1000000
    awk -v n=$spheres 'BEGIN {
        print "raytracer 1\ncamera c {\n  translate 0 0 30\n}\nlight l {\n  translate 9 9 30\n}"
        for (i = 0; i < n; ++i) {
            seed = (seed * 1103 + 12345) % 65536; x = seed / 3277 - 10
            seed = (seed * 1103 + 12345) % 65536; y = seed / 3277 - 10
            printf "sphere s%d {\n  translate %.4f %.4f %.5f\n  radius 0.05\n}\n", i, x, y, i / n
        }
    }' > spheres.txt
    run 0 spheres.txt few.ppm -q --stats=json -r 64x64 --spp 1
    most=$(($(field peak_bytes) - base - 4 * 2097152))
    echo "$spheres spheres: $((most / spheres)) bytes each at most"
    check "memory: $spheres spheres are in the tree" [ "$(field leaves)" -eq $spheres ]
    check 'memory: at most 700 bytes per sphere at any time' [ $((most / spheres)) -le 700 ]
fi

finish
