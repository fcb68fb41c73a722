#!/bin/sh
# --help and the completion scripts have every option; the scripts work where their shell is there.
. "$(dirname "$0")/kit.sh"

run 0 --help
cp out help
check 'help: 100 columns' sh -c "! grep -q '.\{101\}' help"
for words in 'usage:' 'features:' 'exit codes:' 'examples:' '130 ' 'raytracer diff'; do
    check "help: $words" has help "$words"
done
run 0 diff --help
cp out help.of.diff
check 'diff: help' has help.of.diff '--metric'
run 0 verify --help
cp out help.of.verify
check 'verify: help' has help.of.verify '--effort'
run 0 -h
check '-h' cmp out help

# --[no-]x stands for two.
options() {
    sed -n 's/^  \(-., \|    \)\(--\(\[no-\]\)\{0,1\}[^ =[]*\).*/\2/p' "$1" |
        sed 's/^--\[no-\]\(.*\)/--\1 --no-\1/' | tr ' ' '\n'
}
for file in help help.of.diff help.of.verify; do options $file; done | sort -u > names
check 'help: many options' [ "$(wc -l < names)" -gt 50 ]
for shell in bash zsh fish; do
    run 0 --completion $shell
    cp out script.$shell
    missing=
    for name in $(cat names); do
        word=$name
        [ $shell = fish ] && word="-l ${name#--}"
        grep -q -e "$word[^a-z-]" script.$shell || missing="$missing $name"
    done
    check "$shell: every option of --help ($missing)" [ -z "$missing" ]
done

if command -v bash > /dev/null; then
    # complete WORD...: what bash offers for the last word.
    cat > complete.bash << 'END'
source script.bash
COMP_WORDS=("$@")
COMP_CWORD=$(($# - 1))
_raytracer 2> /dev/null
echo "${COMPREPLY[@]}"
END
    offers() {
        name=$1
        expected=$2
        shift 2
        got=$(bash complete.bash "$@")
        check "bash: $name ($got)" [ "$got" = "$expected" ]
    }
    offers 'an option' '--spp' raytracer scene.txt --spp
    offers 'both forms' '--no-dof' raytracer --no-do
    offers 'values' 'sobol stratified' raytracer --sampler s
    offers 'values after =' 'json' raytracer --stats = j
    offers 'an empty value after =' 'json' raytracer --stats =
    offers 'a list with commas' 'depth,normal' raytracer --aov depth,n
    offers 'files' 'scene.txt' raytracer sce
    offers 'diff' 'diff' raytracer dif
    offers 'options of diff' '--metric' raytracer diff a b --me
    offers 'values of diff' 'psnr' raytracer diff a b --metric p
    offers 'verify' 'verify' raytracer ver
    offers 'options of verify' '--effort' raytracer verify --ef
    offers 'tests of verify' 'T21a T21b' raytracer verify T25 T21
    offers 'nothing for numbers' '' raytracer --spp 1
else
    ok 'bash is not here'
fi
for shell in zsh fish; do
    if command -v $shell > /dev/null; then check "$shell: the script is sound" $shell -n script.$shell; fi
done

finish
