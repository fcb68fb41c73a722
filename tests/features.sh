#!/bin/sh
# FeatureList.txt tells the truth: every row names a scene, a picture and a test that exist.
# sh tests/features.sh UNIT-TESTS
cd "$(dirname "$0")/.." || exit 1
unit=$1
names=$("$unit" --list) || exit 1
passed=0
failed=0
rows=$(grep -v -e '^#' -e '^$' FeatureList.txt)
[ -n "$rows" ] || { echo "FAIL FeatureList.txt has no rows"; failed=1; }
while IFS='|' read -r feature scene picture test; do
    wrong=
    feature=$(echo $feature) scene=$(echo $scene) picture=$(echo $picture) test=$(echo $test)
    [ -f "$scene" ] || wrong="no scene '$scene'"
    [ -f "$picture" ] || wrong="no picture '$picture'"
    [ -f "$test" ] || echo "$names" | grep -q -x -e "$test" || wrong="no test '$test'"
    if [ -z "$wrong" ]; then
        echo "ok $feature"
        passed=$((passed + 1))
    else
        echo "FAIL $feature: $wrong"
        failed=$((failed + 1))
    fi
done <<END
$rows
END
echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
