#!/usr/bin/env python3
"""Tests of measures.py and equal_error.py with numbers whose errors are known. bench_error.py runs them first and stops if one fails."""
import unittest
import numpy as np
import equal_error, measures


def noisy(random, count, sigma, bias, true):
    return true + bias + sigma * random.normal(size=(count, *true.shape))


class Measures(unittest.TestCase):
    def setUp(self):
        self.random = np.random.default_rng(3)
        self.true = self.random.uniform(0.2, 0.8, (64, 64, 3))
        self.first, self.second = noisy(self.random, 2, 0.05, 0, self.true)

    def test_noise_of_references_drops_out(self):
        e = measures.errors(noisy(self.random, 16, 0.02, 0, self.true), self.first, self.second, "linear")
        self.assertAlmostEqual(e.mse.mean() / 0.02 ** 2, 1, delta=0.2)
        plain = ((noisy(self.random, 16, 0.02, 0, self.true) - self.first) ** 2).mean()
        self.assertGreater(plain, 5 * 0.02 ** 2)

    def test_bias_and_variance_are_told_apart(self):
        e = measures.errors(noisy(self.random, 16, 0.02, 0.03, self.true), self.first, self.second, "linear")
        self.assertAlmostEqual(e.bias2 / 0.03 ** 2, 1, delta=0.1)
        self.assertAlmostEqual(e.variance / 0.02 ** 2, 1, delta=0.1)

    def test_relative_weighs_by_the_reference(self):
        true = np.full((64, 64, 3), 2.0)
        e = measures.errors(noisy(self.random, 8, 0.1, 0, true), true, true, "relative")
        self.assertAlmostEqual(e.mse.mean() * (4 + 0.01) / 0.01, 1, delta=0.05)

    def test_display_does_not_see_what_is_clipped(self):
        true = np.full((8, 8, 3), 5.0)
        self.assertEqual(measures.errors(noisy(self.random, 4, 0.3, 0, true), true, true, "display").mse.max(), 0)
        self.assertAlmostEqual(float(measures.display(0.5)), 0.735357, delta=1e-6)
        self.assertAlmostEqual(float(measures.display(0.002)), 0.02584, delta=1e-6)

    def test_floor_is_the_variance_of_the_mean_of_both(self):
        self.assertAlmostEqual(measures.floor(self.first, self.second, "linear") / (0.05 ** 2 / 2), 1, delta=0.1)

    def test_fireflies_are_in_the_worst_pixels(self):
        pictures = noisy(self.random, 8, 0.001, 0, self.true)
        pictures[:, 3, 3] += 10
        e = measures.errors(pictures, self.true, self.true, "linear")
        self.assertGreater(e.worst, 0.99)


class EqualError(unittest.TestCase):
    times, mse = [0.1, 0.4, 1.6], [1e-2, 2.5e-3, 6.25e-4]  # time times MSE is 1e-3

    def test_a_power_law_is_met_exactly(self):
        for level in (8e-3, 2.5e-3, 1e-3):
            t, sign = equal_error.time_at(level, self.times, self.mse)
            self.assertEqual(sign, "")
            self.assertAlmostEqual(t, 1e-3 / level, delta=1e-12)

    def test_nothing_is_extrapolated(self):
        self.assertEqual(equal_error.time_at(1e-4, self.times, self.mse), (1.6, ">"))
        self.assertEqual(equal_error.time_at(1e-1, self.times, self.mse), (0.1, "<"))
        self.assertEqual(equal_error.time_at(1e-4, self.times, [1e-2, 2e-3, -1e-9]), (0.4, ">"))

    def test_signs_of_ratios(self):
        self.assertEqual(equal_error.ratio((1, ""), (2, "")), (2, ""))
        self.assertEqual(equal_error.ratio((1, ""), (2, ">")), (2, ">"))
        self.assertEqual(equal_error.ratio((1, "<"), (2, "")), (2, ">"))
        self.assertEqual(equal_error.ratio((1, ">"), (2, "")), (2, "<"))
        self.assertEqual(equal_error.ratio((1, "<"), (2, ">")), (2, ">"))
        self.assertEqual(equal_error.ratio((1, "<"), (2, "<"))[1], "?")

    def test_bootstrap_holds_the_truth(self):
        random, inside = np.random.default_rng(5), 0
        for k in range(40):
            curves = [[(t * f * np.ones(3), e * (1 + 0.3 * random.normal(size=16))) for t, e in zip(self.times, self.mse)] for f in (1, 3)]
            low, high = equal_error.bootstrap(*curves, 1.5e-3, 200, k)
            inside += low <= 3 <= high
        self.assertGreater(inside, 28)
        self.assertLess(inside, 40)
        self.assertIsNone(equal_error.bootstrap(*curves, 1e-5, 100))


if __name__ == "__main__":
    unittest.main()
