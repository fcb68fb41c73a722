#!/bin/sh
# Fuzzes one reader: sh tests/fuzz/one.sh FOLDER-OF-THE-FUZZER SECONDS READER; 0 seconds: what is
# there is read again, nothing new. One line: files read, places of code reached, seconds, crashes.
# A file that crashed lies in build/fuzz/READER-*; mended, it goes to tests/fuzz/regressions/READER.
work=$1 seconds=$2 reader=$3
corpus=$work/corpus/$reader log=$work/$reader.log
mkdir -p "$corpus"
limit=-max_total_time=$seconds
[ "$seconds" -gt 0 ] || limit=-runs=0
set -- "$corpus" "tests/fuzz/seeds/$reader"
[ -d "tests/fuzz/regressions/$reader" ] && set -- "$@" "tests/fuzz/regressions/$reader"
start=$(date +%s)
"$work/fuzz" "$reader" "$limit" -max_len=4096 -timeout=5 -rss_limit_mb=1024 -malloc_limit_mb=128 \
    "-dict=tests/fuzz/dict/$reader.dict" "-artifact_prefix=build/fuzz/$reader-" "$@" > "$log" 2>&1
status=$?
end=$(date +%s)
progress=$(grep -a '^#[0-9]' "$log" | tail -n 1 | tr '\t' ' ')
runs=$(expr "$progress" : '#\([0-9]*\)')
places=$(expr "$progress" : '.*cov: \([0-9]*\)')
crashes=0
[ "$status" -eq 0 ] || crashes=1
printf '%-9s %10s files %6s places %5s s %2s crashes\n' \
    "$reader" "${runs:-0}" "${places:-0}" $((end - start)) "$crashes"
[ "$status" -eq 0 ] && exit 0
grep -a -e 'ERROR' -e 'runtime error' -e 'what()' -e 'written to' "$log" | cut -c 1-300 | head -n 6
printf 'FAIL %s: exit %s, see %s\n' "$reader" "$status" "$log"
