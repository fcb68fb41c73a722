#!/bin/sh
# The source files that .ci/run has analysed: up to 40 of those that the last day's commits changed,
# and a fixed tenth of all others. `make tidy` analyses all of them.
cd "$(dirname "$0")/.." || exit 1
day=$(git log -1 --format=%ct 2> /dev/null) && since=$(git rev-list -1 --before="$((day - 86400))" HEAD)
all=$(git ls-files 'Code/*.cpp' 'tests/*.cpp' | grep -v -e '^tests/bench/' -e '^tests/fuzz/.*/')
changed=$(git diff --name-only "${since:-HEAD}" HEAD 2> /dev/null)
printf '%s\n' "$all" | grep -Fx "$changed" | head -n 40
printf '%s\n' "$all" | grep -Fxv "${changed:- }" | awk 'NR % 10 == 1'
