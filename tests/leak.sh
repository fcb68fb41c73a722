#!/bin/sh
# The binary runs on any x86-64: no instruction of AVX or later outside the kernels that are chosen
# at start (functions whose names contain avx2:: or avx512::), and no AVX-512 (registers zmm and k) in
# those of AVX2. Functions of C, whose names have no arguments, are those of the system's library, which
# chooses at start as we do. Binaries of the sanitizers are passed over: clang puts words of data before the
# code of their functions, which objdump takes for instructions. sh tests/leak.sh RAYTRACER
raytracer=${1:?usage: sh tests/leak.sh RAYTRACER}
case $(uname -m) in
x86_64) ;;
*)
    echo "ok no x86-64, nothing to look for"
    echo "1 passed, 0 failed"
    exit 0
    ;;
esac
if nm "$raytracer" | grep -qE ' __(asan|tsan|ubsan)_'; then
    echo "ok a build of the sanitizers, whose functions hold data"
    echo "1 passed, 0 failed"
    exit 0
fi
listing=$(mktemp) || exit 1
trap 'rm -f "$listing"' EXIT
objdump -d -C --no-show-raw-insn "$raytracer" > "$listing"
functions=$(grep -c '^[0-9a-f]* <.*>:$' "$listing")
# Of what objdump shows, VEX and EVEX instructions begin with v; verr, verw and vm* do not count.
leaks=$(awk '
    /^[0-9a-f]+ <.*>:$/ {
        name = $0
        kernel = name ~ /avx2::|avx512::/ || name !~ /\(|<_Z|<main|<_GLOBAL_/
        next
    }
    name ~ /avx2::/ && name !~ /avx512::/ && /%zmm|%k[0-7]/ && !(name in seen) { seen[name]; print name ": " $0 }
    !kernel && $2 ~ /^v[a-z]/ && $2 !~ /^(verr|verw|vm)/ && !(name in seen) { seen[name]; print name ": " $2 }
' "$listing")
if [ "$functions" -lt 100 ]; then
    echo "FAIL leak check: objdump shows only $functions functions of $raytracer"
    echo "0 passed, 1 failed"
    exit 1
fi
if [ -n "$leaks" ]; then
    printf '%s\n' "$leaks" | head -n 10
    echo "FAIL leak check: AVX outside the kernels"
    echo "0 passed, 1 failed"
    exit 1
fi
echo "ok no AVX in $functions functions outside the kernels"
echo "1 passed, 0 failed"
