#!/bin/sh
# The picture does not depend on the compiler or its level of optimisation (promise P1):
# sh tests/builds.sh MAKE [COMPILER:LEVEL...] makes each build (g++ and clang++ at -O1, -O2, -O3) in
# build/same and checks the reference pictures of each (cli/hashes.sh), that its kernels agree and that no AVX
# instruction stands outside of them (leak.sh). One
# line a build; the last one is "N passed, N failed".
make=${1:?usage: sh tests/builds.sh MAKE [COMPILER:LEVEL...]}
shift
[ $# -gt 0 ] || set -- g++:-O1 g++:-O2 g++:-O3 clang++:-O1 clang++:-O2 clang++:-O3
cd "$(dirname "$0")/.." || exit 1
mkdir -p build/same || exit 1
passed=0
failed=0

# build COMPILER LEVEL FOLDER
build() {
    # MAKE is a command with options: no quotes. No warnings: g++ 12 has false ones at -O3, of
    # std::string (-Wrestrict, GCC bug 105651).
    $make all WARN= CXX="$1" OPT="$2" BUILD="$PWD/$3" BINARY="$PWD/$3/raytracer" > "$3.log" 2>&1
}

for one; do
    compiler=${one%:*} level=${one##*:}
    folder=build/same/$(basename "$compiler")$level
    status=1
    if ! build "$compiler" "$level" "$folder"; then
        verdict="does not build: $(tail -n 1 "$folder.log")"
    else
        {
            sh tests/leak.sh "$folder/raytracer" && sh tests/cli/hashes.sh "$folder/raytracer" &&
                "$folder/raytracer" verify T10
        } > "$folder.log" 2>&1
        status=$?
        verdict=$(grep '^[0-9]* passed, [0-9]* failed$' "$folder.log" | paste -s -d ';')
    fi
    if [ "$status" -eq 0 ]; then
        printf 'ok %s %s: %s\n' "$compiler" "$level" "$verdict"
        passed=$((passed + 1))
    else
        printf 'FAIL %s %s: %s; see %s.log\n' "$compiler" "$level" "$verdict" "$folder"
        failed=$((failed + 1))
    fi
done
printf '%s passed, %s failed\n' "$passed" "$failed"
[ "$failed" -eq 0 ]
