"""Errors of pictures of K seeds against two references R1, R2 whose noise is independent of them and of each other. The product
(I - R1)(I - R2) has the mean Var(I) + bias(I)^2: the noise of the references drops out, but may leave it below 0.
As shown, noise is also a bias: the mean of what a curve makes of it is not what the curve makes of its mean."""
from dataclasses import dataclass
import numpy as np

METRICS = ("display", "linear", "relative")


def display(values):
    """As shown: clipped to what a screen has, in sRGB."""
    x = np.clip(values, 0, 1)
    return np.where(x <= 0.0031308, 12.92 * x, 1.055 * np.maximum(x, 1e-9) ** (1 / 2.4) - 0.055)


def differences(pictures, reference, other, metric):
    """Pictures minus the reference, so that the product of those of both references has the metric as its mean."""
    if metric == "display": return display(pictures) - display(reference)
    if metric == "linear": return pictures - reference
    return (pictures - reference) / np.sqrt(((reference + other) / 2) ** 2 + 0.01)


@dataclass
class Errors:
    mse: np.ndarray  # of each seed
    bias2: float  # square of what all seeds have in common, estimated from pairs of unlike seeds
    worst: float  # share of the MSE in the worst 0.1 % of the pixels, median over seeds

    @property
    def variance(self): return float(self.mse.mean()) - self.bias2


def errors(pictures, first, second, metric):
    """Of pictures [seed, row, column, channel]."""
    a, b = differences(pictures, first, second, metric), differences(pictures, second, first, metric)
    maps = (a * b).mean(-1).reshape(len(pictures), -1)
    mse, count = maps.mean(1), len(pictures)
    pairs = (a.sum(0) * b.sum(0)).mean() - mse.sum()
    few = max(1, round(maps.shape[1] / 1000))
    worst = np.median(np.sort(maps, 1)[:, -few:].sum(1) / np.maximum(maps.sum(1), 1e-300))
    return Errors(mse, float(pairs / (count * (count - 1))), float(worst))


def floor(first, second, metric):
    """The variance of the mean of both references."""
    return float((differences(first, second, first, metric) * differences(first, second, second, metric)).mean() / 4)
