"""Whether two sets of pictures have the same means. Each renderer gives K pictures of independent seeds. Per block of
pixels Welch's t-test gives a probability p; where the means are the same the p of all blocks are spread evenly over
[0,1], which the test of Kolmogorov and Smirnov examines (Jung, Hanika and Dachsbacher 2020, JCGT 9/2). The means of the
whole picture are compared apart, since a small difference everywhere hardly shows in a single block."""
from dataclasses import dataclass
from math import lgamma
import numpy as np


def beta_part(a, b, x):
    """The regularised incomplete beta function, elementwise, by Lentz's continued fraction."""
    a, b, x = np.broadcast_arrays(*(np.asarray(v, float) for v in (a, b, x)))
    swap = x > (a + 1) / (a + b + 2)
    p, q, y = np.where(swap, b, a), np.where(swap, a, b), np.where(swap, 1 - x, x)
    logs = np.vectorize(lambda s, t: lgamma(s + t) - lgamma(s) - lgamma(t))(p, q)
    front = np.exp(logs + p * np.log(np.maximum(y, 1e-300)) + q * np.log1p(-np.minimum(y, 1 - 1e-16))) / p
    tiny = 1e-300
    c, d = np.ones_like(y), 1 / np.where(np.abs(1 - (p + q) * y / (p + 1)) < tiny, tiny, 1 - (p + q) * y / (p + 1))
    h = d.copy()
    for m in range(1, 300):
        for step in (m * (q - m) * y / ((p + 2 * m - 1) * (p + 2 * m)),
                     -(p + m) * (p + q + m) * y / ((p + 2 * m) * (p + 2 * m + 1))):
            d, c = 1 + step * d, 1 + step / c
            d, c = 1 / np.where(np.abs(d) < tiny, tiny, d), np.where(np.abs(c) < tiny, tiny, c)
            h = h * d * c
    return np.where(swap, 1 - front * h, front * h)


def t_probability(t, freedom):
    """Of a |t| at least as large."""
    return beta_part(freedom / 2, 0.5, freedom / (freedom + np.square(t)))


def kolmogorov(p):
    """The probability that numbers spread evenly over [0,1] are at least as uneven as these."""
    p, n = np.sort(p), len(p)
    i = np.arange(n)
    most = max(np.max((i + 1) / n - p), np.max(p - i / n))
    x = (np.sqrt(n) + 0.12 + 0.11 / np.sqrt(n)) * most
    k = np.arange(1, 101)
    return float(np.clip(2 * np.sum((-1.0) ** (k - 1) * np.exp(-2 * k * k * x * x)), 0, 1)) if x > 0.2 else 1.0


def blocks(pictures, size):
    """Means of blocks: [seed, row, column, channel]."""
    k, h, w, c = pictures.shape
    return pictures.reshape(k, h // size, size, w // size, size, c).mean((2, 4))


def welch(a, b):
    """t, and degrees of freedom, of the difference of means over axis 0."""
    va, vb = a.var(0, ddof=1) / len(a), b.var(0, ddof=1) / len(b)
    both = np.maximum(va + vb, 1e-300)
    freedom = both ** 2 / np.maximum(va ** 2 / (len(a) - 1) + vb ** 2 / (len(b) - 1), 1e-300)
    return (a.mean(0) - b.mean(0)) / np.sqrt(both), np.clip(freedom, 1, 1e6)


@dataclass
class Verdict:
    blocks: int  # with noise, which are tested
    still: int  # without noise, in which both are alike to 1e-5 and a step
    ks: float
    noise: float  # standard error of the difference of a block, median, relative
    ratio: float  # of the means of the pictures, ours over theirs
    error: float  # standard error of the ratio
    channel_z: float  # of the three channels' means, the z farthest from 0
    worst: tuple  # row and column of the worst block, and its t
    p: np.ndarray
    t: np.ndarray  # of all blocks
    why: str  # empty: they agree

    @property
    def agrees(self): return not self.why


def compare(ours, theirs, size, hide=(), step=0.0):
    """`step`: what a file of theirs can tell apart, by which still blocks may differ."""
    shown = np.ones(ours.shape[1:3])
    for x0, y0, x1, y1 in hide: shown[y0:y1, x0:x1] = 0
    keep = blocks(shown[None, ..., None], size)[0, ..., 0] == 1
    a, b = blocks(ours, size), blocks(theirs, size)
    grey_a, grey_b = a.mean(-1), b.mean(-1)
    t, freedom = welch(grey_a, grey_b)
    mean = (grey_a.mean(0) + grey_b.mean(0)) / 2
    spread = np.sqrt(grey_a.var(0, ddof=1) / len(a) + grey_b.var(0, ddof=1) / len(b))
    still = keep & (spread <= 1e-6 * mean)
    noisy = keep & ~still
    p = t_probability(t[noisy], freedom[noisy])
    means_a, means_b = a[:, keep].mean(1), b[:, keep].mean(1)
    channel = welch(means_a, means_b)[0]
    whole_a, whole_b = means_a.mean(1), means_b.mean(1)
    ratio = whole_a.mean() / whole_b.mean()
    error = np.sqrt(whole_a.var(ddof=1) / len(a) + whole_b.var(ddof=1) / len(b)) / whole_b.mean()
    ks = kolmogorov(p) if len(p) else 1.0
    at = np.unravel_index(np.argmax(np.where(noisy, np.abs(t), 0)), t.shape)
    unlike = still & (np.abs(grey_a.mean(0) - grey_b.mean(0)) > 1e-5 * mean + step)
    why = []
    if not np.isfinite(ours).all() or not np.isfinite(theirs).all(): why.append("not finite")
    if ks <= 0.001: why.append("p not flat")
    if error > 0.0005: why.append("too much noise")
    if abs(ratio - 1) > max(0.001, 3 * error): why.append("means differ")
    if np.abs(channel).max() > 4: why.append("a channel differs")
    if unlike.any(): why.append("%d still blocks differ" % unlike.sum())
    return Verdict(int(noisy.sum()), int(still.sum()), ks, float(np.median((spread / np.maximum(mean, 1e-30))[noisy])) if noisy.any() else 0.0,
                   float(ratio), float(error), float(channel[np.argmax(np.abs(channel))]), (*map(int, at), float(t[at])), p, t, ", ".join(why))
