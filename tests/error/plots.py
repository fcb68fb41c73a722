"""Error over time of a scene, both in logarithms: median over seeds with the band of 10 to 90 %, and what all seeds have in common (bias)."""
import os
import numpy as np

COLORS = {"ours": "#c00000", "mitsuba_llvm": "#1f5fbf", "mitsuba_scalar": "#7fb0e8", "cycles": "#d98a00", "povray": "#3a8a3a"}


def plot(scene, points, levels, floor, folder, metric="display"):
    """Writes FOLDER/SCENE.png: rendering alone on the left, whole processes on the right."""
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot
    figure, sides = pyplot.subplots(1, 2, figsize=(9, 3.8), sharey=True)
    for side, times in zip(sides, ("render", "whole")):
        for name, list_ in points.items():
            shown = [p for p in list_ if not p.below[metric]]
            if not shown: continue
            x = [np.median(getattr(p, times)) for p in shown]
            low, middle, high = np.sqrt(np.maximum(np.percentile([p.errors[metric].mse for p in shown], (10, 50, 90), axis=1), 1e-12))
            side.plot(x, middle, "o-", ms=3, lw=1.2, color=COLORS[name], label=name)
            side.fill_between(x, low, high, color=COLORS[name], alpha=0.2, lw=0)
            biases = np.sqrt(np.maximum([p.errors[metric].bias2 for p in shown], 1e-12))
            side.plot(x, biases, "--", lw=0.7, color=COLORS[name])
        for level in levels: side.axhline(level, color="grey", lw=0.5, ls=":")
        side.axhline(np.sqrt(max(floor, 1e-12)), color="black", lw=0.5)
        side.set(xscale="log", yscale="log", xlabel="seconds, " + {"render": "rendering alone", "whole": "whole process"}[times])
    sides[0].set_ylabel("RMSE as shown")
    bottom = max(np.sqrt(max(floor, 1e-12)) / 2, 1e-5)
    sides[0].set_ylim(bottom=bottom)
    sides[1].legend(fontsize=7)
    figure.suptitle("%s: %s (dashed: bias; black: floor)" % (scene.name, scene.what), fontsize=8)
    figure.tight_layout()
    os.makedirs(folder, exist_ok=True)
    figure.savefig(os.path.join(folder, scene.name + ".png"), dpi=80)
    pyplot.close(figure)
