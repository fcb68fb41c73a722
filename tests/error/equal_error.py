"""Time to equal error: between measured points of a curve, a line in logarithms; beyond them nothing."""
import numpy as np


def time_at(level, seconds, mse):
    """Seconds at which a curve of ever more samples falls to an MSE of `level`: (seconds, "") between two points, (first, "<") where
    its first point is below, (last, ">") where no point is. Points without a positive MSE are left out."""
    points = [(t, e) for t, e in zip(seconds, mse) if e > 0]
    if not points: return float("inf"), ">"
    if points[0][1] <= level: return points[0][0], "<"
    for (t0, e0), (t1, e1) in zip(points, points[1:]):
        if e0 > level >= e1:
            part = (np.log(e0) - np.log(level)) / (np.log(e0) - np.log(e1))
            return float(np.exp(np.log(t0) + part * (np.log(t1) - np.log(t0)))), ""
    return points[-1][0], ">"


def ratio(ours, theirs):
    """Their time over ours with the sign of what is known of it: "", "<", ">", or "?" where nothing is."""
    (a, sign_a), (b, sign_b) = ours, theirs
    flipped = {"": "", "<": ">", ">": "<"}[sign_a]
    signs = {sign_b, flipped} - {""}
    return b / a, signs.pop() if len(signs) == 1 else "?" if signs else ""


def resampled(curve, random):
    """Seconds and MSE of each point, as means of seeds and medians of times drawn again. A curve is a list of (times, MSEs)."""
    return ([float(np.median(random.choice(t, len(t)))) for t, _ in curve], [float(np.mean(random.choice(e, len(e)))) for _, e in curve])


def bootstrap(ours, theirs, level, count=1000, seed=1):
    """The ratio's range from 5 to 95 %, of those resamples in which both curves cross the level; None where fewer than half do."""
    random, found = np.random.default_rng(seed), []
    for _ in range(count):
        value, sign = ratio(*(time_at(level, *resampled(curve, random)) for curve in (ours, theirs)))
        if not sign: found.append(value)
    return tuple(np.percentile(found, (5, 95))) if 2 * len(found) >= count else None
