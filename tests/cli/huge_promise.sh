#!/bin/sh
# Small files that promise gigabytes are refused at once: in a second of processor time and half a
# gigabyte of addresses, with exit code 2 and not for want of memory.
. "$(dirname "$0")/kit.sh"

# promise NAME WORDS ARGUMENT...: the program refuses its file, and says so with the words.
promise() {
    promised=$1 words=$2
    shift 2
    (
        ulimit -t 1 -v 500000
        "$raytracer" "$@"
    ) > out 2> err
    code=$?
    if [ "$code" -ne 2 ]; then fail "$promised" "exit code $code; $(head -n 2 err)"
    elif has err 'out of memory' || ! has err "$words"; then
        fail "$promised" "no '$words' in: $(head -n 2 err)"
    else ok "$promised"; fi
}
# write FILE: from stdin; most are about 100 bytes.
write() { cat > "$1"; }

printf 'raytracer 1\nmesh m {\n    points 300000000\n    0 0 0\n}\n' > points.txt
promise 'native: points' 'points.txt:3:12: error: ' points.txt --check
printf 'raytracer 1\nsettings {\n    resolution 65535 65535\n}\ncamera c {\n}\n' > size.txt
promise 'native: resolution' "'resolution' 65535 65535 has more than 2^28 pixels" size.txt --check
