#!/bin/sh
# Runs everything that `make test` needs: sh tests/run.sh UNIT-TESTS RAYTRACER [WORD...]
# The program bench lies beside UNIT-TESTS.
# Every part prints "ok NAME" or "FAIL NAME: why" and ends with "N passed, N failed"; so does this.
# With words, only the scripts whose name contains one of them run.
cd "$(dirname "$0")/.." || exit 1
unit=$1
raytracer=$2
shift 2
passed=0
failed=0

# Adds the counts in the last line of a part; a part that ends in any other way has failed.
add() {
    name=$1
    shift
    printf '== %s\n' "$name"
    "$@" 2>&1 | tee "$log" | grep -v -e '^ok ' -e '^[0-9]* passed, [0-9]* failed$'
    counts=$(tail -n 1 "$log" | grep -x '[0-9]* passed, [0-9]* failed')
    if [ -z "$counts" ]; then
        printf 'FAIL %s: it did not run to its end\n' "$name"
        counts='0 passed, 1 failed'
    fi
    printf '   %s\n' "$counts"
    set -- $counts
    passed=$((passed + $1))
    failed=$((failed + $3))
}

log=$(mktemp) || exit 1
trap 'rm -f "$log"' EXIT
if [ $# -eq 0 ]; then
    add "unit tests" "$unit" --jobs="$(nproc)"
    add "FeatureList.txt" sh tests/features.sh "$unit"
fi
for script in tests/layers.sh tests/leak.sh tests/cli/*.sh; do
    wanted=$#
    for word in "$@"; do
        case $script in *"$word"*) wanted=0 ;; esac
    done
    case $script in */kit.sh) continue ;; esac
    [ "$wanted" -eq 0 ] && add "$script" sh "$script" "$raytracer" "$(dirname "$unit")/bench"
done
printf '%s passed, %s failed\n' "$passed" "$failed"
[ "$failed" -eq 0 ]
