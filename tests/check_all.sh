#!/bin/sh
# What .ci/run leaves out because it is long or rare: sh tests/check_all.sh MAKE. Each step is one
# check; the last line is "N passed, N failed".
make=${1:?usage: sh tests/check_all.sh MAKE}
cd "$(dirname "$0")/.." || exit 1
mkdir -p build
passed=0
failed=0

step() {
    name=$1
    shift
    if "$@" > build/check_all.log 2>&1; then
        printf 'ok %s\n' "$name"
        passed=$((passed + 1))
    else
        printf 'FAIL %s: %s\n' "$name" "$(tail -n 1 build/check_all.log)"
        cp build/check_all.log "build/check_all-$failed.log"
        failed=$((failed + 1))
    fi
}

# MAKE is a command with options: no quotes.
step "each file compiled alone" $make all JUMBO=0 BUILD="$PWD/build/alone" BINARY="$PWD/build/alone/raytracer"
step "each header parsed alone" sh tests/headers.sh
step "the standard library alone" sh tests/portable.sh
step "make valgrind" $make valgrind
step "make bench-unused" $make bench-unused
step "make asan by g++" $make asan CXX=g++
step "make tidy" $make tidy
step "same bits from six builds" $make same-builds
step "make fuzz, a minute a reader" $make fuzz SECONDS=60 JOBS="$(nproc)"
step "make stress" $make stress
printf '%s passed, %s failed\n' "$passed" "$failed"
[ "$failed" -eq 0 ]
