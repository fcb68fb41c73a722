#!/bin/sh
# Builds the fuzzer and lets it loose on readers, for `make fuzz`:
# sh tests/fuzz/fuzz.sh MAKE ENGINE SECONDS JOBS [READER...]
make=$1 engine=$2 seconds=$3 jobs=$4
shift 4
cd "$(dirname "$0")/../.." || exit 1

hasLibFuzzer() {
    probe=$(mktemp) || exit 1
    echo 'extern "C" int LLVMFuzzerTestOneInput(const char*, unsigned long) { return 0; }' |
        clang++ -fsanitize=fuzzer -x c++ - -o "$probe" 2> /dev/null
    found=$?
    rm -f "$probe"
    return $found
}
[ -n "$engine" ] || { hasLibFuzzer && engine=libfuzzer || engine=plain; }

work=build/fuzz/$engine
checks='-fsanitize=address,undefined,float-cast-overflow -fno-sanitize-recover=all'
build() {
    $make --no-print-directory "$PWD/$work/fuzz" BUILD="$PWD/$work" ENGINE="$engine" \
        OPT='-O1 -g1 -D_GLIBCXX_ASSERTIONS' "$@"
}
case $engine in
libfuzzer) build CXX=clang++ SANITIZE="$checks -fsanitize=fuzzer-no-link" LDLIBS=-fsanitize=fuzzer ;;
plain) build SANITIZE="$checks -fsanitize-coverage=trace-pc" ;;
*) echo "unknown ENGINE '$engine'; libfuzzer or plain" >&2 && false ;;
esac || exit 1

[ $# -gt 0 ] || set -- $("$work/fuzz" --list)
lines=$(mktemp) || exit 1
trap 'rm -f "$lines"' EXIT
printf '%s\n' "$@" | xargs -P "$jobs" -n 1 sh tests/fuzz/one.sh "$work" "$seconds" | tee "$lines"
failed=$(grep -c '^FAIL ' "$lines")
printf '%s passed, %s failed\n' $(($# - failed)) "$failed"
[ "$failed" -eq 0 ]
