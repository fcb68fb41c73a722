#!/bin/sh
# Includes point down only (Code/README.md, "The folders"):
#   base <- image, desc <- read          base, simd <- image <- the folders of one thing each
#   all of them <- scene <- film <- integrate <- render <- verify <- cli <- main
# The units of isa/ hold the kernels of accel/, texture/, camera/ and integrate/; isa/isa.h, which includes nothing of the
# project, says what they do, and everything above base/ may include it.
# A folder includes itself and what is below it, never its neighbours in a row but for three: a mesh is
# a shape with a tree of its own, a sky that is a light shows a picture, and lights, lenses, materials
# and skies spread their samples.
cd "$(dirname "$0")/../Code" || exit 1
passed=0
failed=0

siblings='shape material light camera texture accel sample'
allowedFor() {
    case $1 in
    base) echo base ;;
    simd) echo base simd ;;
    isa) echo base simd isa image denoise $siblings scene film integrate ;;
    image) echo base image ;;
    denoise) echo base simd isa image denoise ;;
    desc) echo base desc material ;;
    read) echo base desc image read ;;
    accel | sample) echo base simd isa image "$1" ;;
    shape) echo base isa image shape accel ;;
    light) echo base simd image texture light sample ;;
    material | camera | texture) echo base simd image "$1" sample ;;
    scene) echo base isa image desc $siblings scene ;;
    film) echo base image scene film ;;
    integrate) echo base simd isa image desc $siblings scene film integrate ;;
    render) echo base simd isa image denoise desc $siblings scene film integrate render ;;
    verify) echo base isa image desc $siblings scene film integrate render verify ;;
    cli) echo base isa image desc read $siblings scene film integrate render verify cli ;;
    main) echo base cli ;;
    esac
}

check() {
    folder=$1
    shift
    allowed=$(allowedFor "$folder")
    if [ -z "$allowed" ]; then
        printf 'FAIL layer %s: a folder that tests/layers.sh does not know\n' "$folder"
        failed=$((failed + 1))
        return
    fi
    wrong=$(grep -n '^ *# *include *"' "$@" /dev/null | while IFS= read -r line; do
        header=${line#*\"}
        header=${header%%\"*}
        target=${header%%/*}
        [ "$target" = "$header" ] && target='(no folder)'
        [ -f "$header" ] || printf '%s (there is no such file)\n' "$line"
        case " $allowed " in *" $target "*) ;; *) printf '%s\n' "$line" ;; esac
    done)
    if [ -z "$wrong" ]; then
        printf 'ok layer %s\n' "$folder"
        passed=$((passed + 1))
    else
        printf 'FAIL layer %s: may include %s only\n%s\n' "$folder" "$allowed" "$wrong"
        failed=$((failed + 1))
    fi
}

for folder in */; do
    folder=${folder%/}
    files=$(find "$folder" -name '*.h' -o -name '*.cpp' -o -name '*.inl')
    [ -n "$files" ] && check "$folder" $files
done
check main main.cpp
if grep -q '^#include "' isa/isa.h; then
    printf 'FAIL isa/isa.h includes nothing of the project\n'
    failed=$((failed + 1))
else
    printf 'ok isa/isa.h includes nothing of the project\n'
    passed=$((passed + 1))
fi

# The system is called in base/platform alone: headers of the C++ standard library have no dot or slash in their
# names, and those of instruction sets call nothing. Some functions of the system are in standard headers.
wrong=$(find . -path ./base/platform -prune -o \( -name '*.h' -o -name '*.cpp' -o -name '*.inl' \) -exec grep -nE \
    -e '^ *# *include *<(csignal|[^>]*[./][^>]*)>' -e '\b(fileno|fseeko|ftello|popen|setenv|localtime_r|strerror_r)\(' {} + |
    grep -vE '<(immintrin|emmintrin|arm_neon)\.h>')
if [ -z "$wrong" ]; then
    printf 'ok only base/platform calls the system\n'
    passed=$((passed + 1))
else
    printf 'FAIL only base/platform calls the system:\n%s\n' "$wrong"
    failed=$((failed + 1))
fi

# Only what turns a description into a scene names the concrete shapes and lights.
wrong=$(grep -ln '#include "\(shape\|light\)/\(sphere\|cube\|plane\|disk\|cylinder\|cone\|infinite_plane\|point_light\|sun_light\|area_light\)\.h"' \
    scene/* film/* integrate/* render/* cli/* | grep -v -e '^scene/scene\.cpp$' -e '^scene/make_[a-z]*\.cpp$')
if [ -z "$wrong" ]; then
    printf 'ok only scene/scene.cpp and make_*.cpp name concrete shapes and lights\n'
    passed=$((passed + 1))
else
    printf 'FAIL only scene/scene.cpp and make_*.cpp name concrete shapes and lights: %s\n' "$wrong"
    failed=$((failed + 1))
fi

# Two types of one name are one for the linker, which keeps the functions of either (headers with
# namespaces are on their own).
wrong=$(grep -ho '^\(struct\|class\|enum class\) [A-Za-z0-9]* .*[{:]' $(find . -name '*.h' -exec grep -LE '^(namespace|LANES_BEGIN)' {} +) |
    sed 's/^enum //' | cut -d' ' -f2 | sort | uniq -d | tr '\n' ' ')
if [ -z "$wrong" ]; then
    printf 'ok every type of a header has its own name\n'
    passed=$((passed + 1))
else
    printf 'FAIL every type of a header has its own name: %s\n' "$wrong"
    failed=$((failed + 1))
fi

printf '%s passed, %s failed\n' "$passed" "$failed"
[ "$failed" -eq 0 ]
