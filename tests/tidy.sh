#!/bin/sh
# clang-tidy of one file, silent when there is nothing to say: sh tests/tidy.sh FILE
# (Its own summaries of warnings in other people's headers are left out.)
clang-tidy --quiet "$1" -- -std=c++20 -ICode -Itests 2> /dev/null
status=$?
[ $status -eq 0 ] || echo "FAIL clang-tidy $1"
exit $status
