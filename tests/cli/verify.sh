#!/bin/sh
# raytracer verify: which tests run, what is printed and written. That a test which does not keep its
# mark fails is checked with a made-up one (tests/unit/test_battery.cpp).
. "$(dirname "$0")/kit.sh"

expect 'list' 0 '' verify --list
cp out list
check 'list: a line per test' grep -q '^T25  [a-z]' list
check 'list: no test is run' sh -c '! grep -q passed list'
check 'list: every id once' [ -z "$(cut -d' ' -f1 list | sort | uniq -d)" ]

expect 'one test: 0' 0 '' verify T25 --effort 0.1
check 'one test: its line' grep -q '^T25 .* ok (' out
check 'one test: the sum' [ "$(tail -n 1 out)" = '1 passed, 0 failed' ]
check 'one test: nothing on stderr' [ ! -s err ]
lines() { sed 's/ ([0-9.]* s)$//' "$1"; }
lines out > first
for threads in 1 3; do
    run 0 verify T25 --effort 0.1 --threads $threads
    lines out > again
    check "the same with $threads threads" cmp first again
done
expect 'all of a subject' 0 '' verify T21 --effort 0.1
check 'all of a subject: two' [ "$(tail -n 1 out)" = '2 passed, 0 failed' ]
expect 'all of another' 0 '' verify T22 --effort 0.2
check 'all of another: five' [ "$(tail -n 1 out)" = '5 passed, 0 failed' ]
check 'all of another: their unit' grep -q '^T22a .* deviations ' out
expect 'a batch alone: 0' 0 '' verify T25 --batch 3
check 'a batch alone: one case' grep -q '^T25 .* 1  0 failed' out
# Rays along triangles, a few of 100 million: one whose plane goes through the origin, and one whose
# points on the ray are all behind it.
expect 'a plane through the origin: 0' 0 '' verify T10c --batch 831
expect 'in a plane, behind the origin: 0' 0 '' verify T10c --batch 2418
# From 0 and from -0: differences have other signs, and so have u and v of 0.
expect 'origins of zeros of both signs: 0' 0 '' verify T10d --batch 478

expect 'a page: 0' 0 '' verify T25 -e 0.1 --markdown page.md
check 'a page: its table' grep -q '^| T25 | .* | ok | ' page.md
check 'a page: its worst case' grep -q '^| T25 | seed 25 batch ' page.md
expect 'a page that cannot be written: 4' 4 "there is no folder 'no'" verify T25 --markdown no/page.md
check 'before anything runs' [ ! -s out ]

expect 'unknown test: nearest, 1' 1 "unknown test 'T255'; did you mean 'T25'?" verify T255
expect 'unknown option: nearest, 1' 1 "did you mean '--effort'?" verify --efort 3
expect 'wrong effort: 1' 1 "--effort expects a number from 0.01 to 1e+06, got 'x'" verify --effort x
expect 'a batch of nothing: 1' 1 '--batch is for a TEST' verify --batch 3
expect 'help: 0' 0 '' verify --help
check 'help: its options' has out '--markdown'

finish
