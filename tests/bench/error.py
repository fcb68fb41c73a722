#!/usr/bin/env python3
"""How honest --error is, and what it saves: python3 tests/bench/error.py RAYTRACER > tests/bench/error.tsv

The truth is a picture of many samples and another seed. Errors are those of `raytracer diff` between
PNGs of 16 bits. What the same true error costs with the same number of samples everywhere is read off
a line through the errors of powers of two, in logarithms."""
import json
import math
import subprocess
import sys
import tempfile

SCENES = 'soft_shadows glossy dof motion_blur textures glass antialiasing transparent'.split()
GOALS = (0.02, 0.01, 0.005)
SEEDS = range(3)
COMMON = ['--scale', '20', '--bits', '16', '-q']


def main(raytracer):
    folder = tempfile.mkdtemp()

    def render(scene, name, *options):
        out = f'{folder}/{name}.png'
        done = subprocess.run([raytracer, f'ASCII/{scene}.txt', out, '--stats=json', *COMMON, *options],
                              check=True, capture_output=True, text=True)
        return out, json.loads(done.stdout)

    def error(a, b):
        done = subprocess.run([raytracer, 'diff', a, b], check=True, capture_output=True, text=True)
        return float(done.stdout.split()[1])

    print('scene', 'goal', 'estimate', 'true', 'worst_true_of_estimate', 'min', 'mean', 'max',
          'even_samples', 'rays_saved', sep='\t')
    for scene in SCENES:
        truth, _ = render(scene, 'truth', '--spp', '8192', '--seed', '99')
        even = []  # log error, log samples, log rays
        for power in range(2, 10):
            picture, stats = render(scene, 'even', '--spp', str(1 << power))
            even.append([math.log(x) for x in (error(picture, truth), 1 << power, rays(stats))])
        for goal in GOALS:
            runs = []
            for seed in SEEDS:
                picture, stats = render(scene, 'goal', '--error', str(goal), '--seed', str(seed))
                runs.append((stats['error_estimate'], error(picture, truth), stats['samples']['min'],
                             stats['samples']['mean'], stats['samples']['max'], rays(stats)))
            estimate, true, least, mean, most, cost = (sum(r[i] for r in runs) / len(runs)
                                                       for i in range(6))
            worst = max(r[1] / r[0] for r in runs)
            samples, even_cost = (math.exp(along(even, math.log(true), i)) for i in (1, 2))
            print(scene, goal, f'{estimate:.5f}', f'{true:.5f}', f'{worst:.2f}', f'{least:.0f}',
                  f'{mean:.1f}', f'{most:.0f}', f'{samples:.1f}', f'{even_cost / cost:.2f}',
                  sep='\t', flush=True)


def rays(stats):
    return sum(stats['rays'].values())


def along(rows, x, column):
    """The column where the first one is x; the errors fall from row to row."""
    last = len(rows) - 2
    i = next((i for i in range(last) if rows[i + 1][0] <= x), last)
    part = (x - rows[i][0]) / (rows[i + 1][0] - rows[i][0])
    return rows[i][column] + part * (rows[i + 1][column] - rows[i][column])


if __name__ == '__main__':
    main(sys.argv[1])
