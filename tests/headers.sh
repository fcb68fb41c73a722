#!/bin/sh
# Every header of Code/ is read alone: each includes what it uses. Headers of lanes are read for AVX2,
# or for FORMS="SSE AVX512 ONE", some of them; those of one set of instructions for that one.
# CXX=clang++ takes another compiler. Words choose the headers whose paths contain one of them.
# The last line is "N passed, N failed".
cd "$(dirname "$0")/.." || exit 1
export CXX="${CXX:-g++}"

# Lines "header LANES_..." to read; plain headers know nothing of LANES_ONE.
readings() {
    for header in $(find Code -name '*.h' | sort); do
        [ $# -eq 0 ] || printf '%s\n' "$header" | grep -qF "$(printf '%s\n' "$@")" || continue
        case $header in
        */sse*.h | */box_sse.h) forms=SSE ;;
        */avx2*.h | */box_avx2.h) forms=AVX2 ;;
        */avx512*.h) forms=AVX512 ;;
        */one*.h) forms=ONE ;;
        *) if grep -q '^LANES_BEGIN' "$header"; then forms=${FORMS:-AVX2}; else forms=ONE; fi ;;
        esac
        for form in $forms; do printf '%s LANES_%s\n' "$header" "$form"; done
    done
}

result=$(readings "$@" | xargs -P 2 -L 1 sh -c '
    if errors=$($CXX -std=c++20 -fsyntax-only -w -ICode -D"$1" -x c++ "$0" 2>&1); then
        echo ok
    else
        printf "FAIL header %s with %s\n%s\n" "$0" "$1" \
            "$(printf "%s\n" "$errors" | grep "error:" | head -n 3)"
    fi')
printf '%s\n' "$result" | grep -v '^ok$'
passed=$(printf '%s\n' "$result" | grep -c '^ok$')
failed=$(printf '%s\n' "$result" | grep -c '^FAIL ')
printf '%s passed, %s failed\n' "$passed" "$failed"
[ "$failed" -eq 0 ]
