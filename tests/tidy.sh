#!/bin/sh
# clang-tidy of files, silent when there is nothing to say: sh tests/tidy.sh FILE...
# Most of its time goes into the standard headers, once per translation unit. So the files are looked
# at as one unit that includes them all, which takes a third of the time. Files that do not go together
# (each defines the same name in its namespace without a name) are halved, down to one.
flags="-std=c++20 -I$PWD/Code -I$PWD/tests"
folder=build/tidy/$$
# The unit finds the configuration of the files that it includes.
mkdir -p "$folder/Code" "$folder/tests" || exit 1
trap 'rm -r "$folder"' EXIT
cp .clang-tidy "$folder/" && cp tests/.clang-tidy "$folder/tests/" || exit 1

# look FILE...: clang-tidy's own summaries of warnings in other people's headers are left out.
look() {
    if [ $# -eq 1 ]; then
        clang-tidy --quiet "$1" -- $flags 2> /dev/null && return
        echo "FAIL clang-tidy $1"
        return 1
    fi
    for last; do :; done
    unit=$folder/${1%%/*}/unit.cpp
    for file; do
        echo "#include \"$PWD/$file\" // NOLINT(bugprone-suspicious-include)"
    done > "$unit"
    if [ "${1%%/*}" = "${last%%/*}" ] && clang++ -fsyntax-only -w $flags "$unit" 2> /dev/null; then
        clang-tidy --quiet "$unit" -- $flags 2> /dev/null && return
        echo "FAIL clang-tidy $*"
        return 1
    fi
    halves "$@"
}

# halves FILE...
halves() {
    half=$(($# / 2)) first= status=0
    while [ $half -gt 0 ]; do
        first="$first $1"
        half=$((half - 1))
        shift
    done
    rest=$*
    # Names of sources have no spaces. In a subshell each: the variables are all the same ones.
    (look $first) || status=1
    (look $rest) || status=1
    return $status
}

look "$@"
