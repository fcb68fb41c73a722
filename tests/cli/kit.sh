# What the scripts in tests/cli share; they begin with: . "$(dirname "$0")/kit.sh"
# Gives $raytracer, an empty folder that the script works in, and a tiny scene in it.
raytracer=${1:?usage: sh SCRIPT RAYTRACER}
case $raytracer in /*) ;; *) raytracer=$PWD/$raytracer ;; esac
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1
passed=0
failed=0

ok() {
    printf 'ok %s\n' "$1"
    passed=$((passed + 1))
}
fail() {
    printf 'FAIL %s: %s\n' "$1" "$2"
    failed=$((failed + 1))
}

# check NAME COMMAND...: the command succeeds.
check() {
    checked=$1
    shift
    if "$@" > check.out 2>&1; then ok "$checked"
    else fail "$checked" "$* gave $(head -n 3 check.out)"; fi
}
differ() { ! cmp -s "$1" "$2"; }
absent() { [ ! -e "$1" ]; }
# The folder has exactly these files, in the order of the alphabet (C locale).
holds() {
    found=$(cd "$1" && LC_ALL=C ls -A | tr '\n' ' ')
    shift
    [ "$found" = "$*${*:+ }" ]
}
has() { grep -q -F -e "$2" "$1"; }

# run CODE ARGUMENT...: runs the program; "out" and "err" hold what it printed, $code is its exit
# code. False when that is not CODE.
run() {
    codeOfRun=$1
    shift
    "$raytracer" "$@" > out 2> err
    code=$?
    [ "$code" -eq "$codeOfRun" ]
}
# expect NAME CODE WORDS ARGUMENT...: the exit code, and the words on stderr ('' for any).
expect() {
    expectation=$1 wanted=$2 message=$3
    shift 3
    if ! run "$wanted" "$@"; then
        fail "$expectation" "exit code $code instead of $wanted; $(head -n 2 err)"
    elif [ -n "$message" ] && ! has err "$message"; then
        fail "$expectation" "no '$message' in: $(head -n 3 err)"
    else ok "$expectation"; fi
}

# size FILE: "WIDTH HEIGHT" of a PPM or PFM.
size() { head -n 2 "$1" | tail -n 1; }
hasSize() { [ "$(size "$1")" = "$2" ]; }

finish() {
    printf '%s passed, %s failed\n' "$passed" "$failed"
    [ "$failed" -eq 0 ]
}

cat > scene.txt << 'END'
raytracer 1
settings {
    resolution 24 16
    samples 4
}
world {
    background 0.2 0.3 0.5
}
camera front {
    look_at 0 -6 2  0 0 0.5  0 0 1
}
camera top {
    look_at 0 0 8  0 0 0  0 1 0
}
light key {
    color 60 60 60
    translate 3 -3 5
}
material red {
    diffuse 0.8 0.1 0.1
}
infinite_plane floor {
}
sphere ball {
    translate 0 0 1
    material red
}
END
