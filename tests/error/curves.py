"""Error over time of all renderers in one run that alternates between them: 1, 4, 16, ... samples per pixel, K seeds each."""
from dataclasses import dataclass
import time
import numpy as np
import measures

LADDER = tuple(4 ** k for k in range(9))
REPEATS = 3  # whole processes of a point


@dataclass
class Point:
    spp: int
    first: float  # seconds of the first rendering of so many samples in a process, which may compile
    render: list  # seconds of each seed
    whole: list  # of each repeat
    errors: dict  # by metric
    below: dict  # by metric: whether the error is below the floor of the references

    def spread(self): return (max(self.whole) - min(self.whole)) / np.median(self.whole)


def measure(renderers, references, seeds, limit):
    """Points by the names of renderers. One leaves when its next point would take longer than `limit` for a rendering, or its errors
    are below the floors in every metric."""
    floors = {m: measures.floor(*references, m) for m in measures.METRICS}
    points, active = {r.name: [] for r in renderers}, list(renderers)
    for spp in LADDER:
        if not active: break
        first = {r.name: r.render(spp, 99)[1] for r in active}
        pictures, seconds, whole = ({r.name: [] for r in active} for _ in range(3))
        for seed in range(1, seeds + 1):
            for r in active:
                picture, took = r.render(spp, seed)
                pictures[r.name].append(picture)
                seconds[r.name].append(took)
        for seed in range(1, REPEATS + 1):
            for r in active: whole[r.name].append(r.whole(spp, seed))
        for r in list(active):
            e = {m: measures.errors(np.array(pictures[r.name]), *references, m) for m in measures.METRICS}
            below = {m: e[m].mse.mean() < floors[m] for m in e}
            point = Point(spp, first[r.name], seconds[r.name], whole[r.name], e, below)
            points[r.name].append(point)
            if 4 * np.median(point.render) > limit or all(below.values()): active.remove(r)
    return points, floors


def curve(points, metric, times):
    """Pairs of times and MSEs of the points that are above the floor; `times` is whole or render."""
    return [(np.array(getattr(p, times)), p.errors[metric].mse) for p in points if not p.below[metric]]
