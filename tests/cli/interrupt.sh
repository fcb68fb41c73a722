#!/bin/sh
# A render that is stopped leaves nothing behind: no picture, no temporary file.
. "$(dirname "$0")/kit.sh"

# In the foreground, since shells make jobs in the background ignore SIGINT. One that does not stop
# within ten seconds is killed. $code is the exit code.
runAndSignal() {
    signal=$1
    shift
    rm -f pid
    {
        sleep 0.3
        kill "-$signal" "$(cat pid)"
        for tenth in 1 2 3 4 5 6 7 8 9 10; do
            sleep 1
            kill -0 "$(cat pid)" || exit
        done
        kill -KILL "$(cat pid)"
    } 2> /dev/null &
    sh -c 'echo $$ > pid; exec "$@"' sh "$raytracer" "$@" > out 2> err
    code=$?
}

# interrupted NAME: stops a render that would take minutes.
interrupted() {
    mkdir "$1"
    echo old > "$1/a.png"
    runAndSignal "$1" scene.txt "$1/a.png" --aov depth -r 2000x2000 --spp 256 --progress plain
    check "$1: exit code 130" [ $code -eq 130 ]
    check "$1: a message" has err 'raytracer: interrupted; nothing is written'
    # Not by the handler itself, which begins a new line.
    check "$1: the render ends by itself" [ "$(grep -c '^$' err)" -eq 0 ]
    check "$1: nothing on stdout" [ ! -s out ]
    check "$1: no file is left" holds "$1" a.png
    check "$1: the old picture is kept" [ "$(cat "$1/a.png")" = old ]
}
interrupted TERM

# A tile of so many samples takes minutes; it is left in the middle of them.
runAndSignal TERM scene.txt whole_tile.png -r 16x16 --spp 60000 --light-samples 16 -t 1
check 'within a tile: exit code 130' [ $code -eq 130 ]
check 'within a tile: the render ends by itself' [ "$(grep -c '^$' err)" -eq 0 ]

# What is done is kept where that was asked for.
runAndSignal TERM scene.txt partial.ppm --aov depth -r 2000x2000 --spp 256 --partial --progress none
check '--partial: exit code 130' [ $code -eq 130 ]
check '--partial: a message' has err 'raytracer: interrupted; what is done is written'
check '--partial: the picture' hasSize partial.ppm '2000 2000'
check '--partial: the AOV' hasSize partial.depth.pfm '2000 2000'
"$raytracer" scene.txt black.ppm -r 2000x2000 --spp 1 -d 0 -q
check '--partial: not all of it is black' differ partial.ppm black.ppm
if [ "$(sh -c 'kill -INT $$; echo ignored' 2> /dev/null)" = ignored ]; then
    ok 'INT is ignored where this test runs: not tested'
else
    interrupted INT
fi

# Ignored from outside, as nohup and shells do it for jobs in the background: the render goes on.
trap '' INT
runAndSignal INT scene.txt ignored.ppm -r 400x300 --spp 16
trap - INT
check 'an ignored signal stays ignored' [ $code -eq 0 ]

finish
