#!/bin/sh
# A scene with one large mesh on stdout, for measuring memory: sh tests/bench/waves.sh TRIANGLES
# A wavy square of the least even grid with at least that many triangles: 2236 x 2236 cells for 10^7.
awk -v wanted="${1:?usage: waves.sh TRIANGLES}" 'BEGIN {
    n = int(sqrt(wanted / 2)); while (2 * n * n < wanted) n++
    print "raytracer 1\nsettings {\n resolution 480 270\n samples 1\n max_depth 1\n}"
    print "camera c {\n look_at 0 -2 1.5  0 0 0  0 0 1\n lens 50\n}"
    print "light l {\n translate 3 -4 5\n color 100 100 100\n}"
    print "mesh waves {\npoints " (n + 1) * (n + 1)
    for (i = 0; i <= n; i++) {
        y = 2 * i / n - 1
        for (j = 0; j <= n; j++) {
            x = 2 * j / n - 1
            printf "%.7g %.7g %.7g\n", x, y, 0.1 * sin(9 * x) * cos(7 * y)
        }
    }
    print "triangles " 2 * n * n
    for (i = 0; i < n; i++) for (j = 0; j < n; j++) {
        p = i * (n + 1) + j; q = p + n + 1
        print p, p + 1, q; print p + 1, q + 1, q
    }
    print "}\ninstance waves {\n mesh waves\n}"
}'
