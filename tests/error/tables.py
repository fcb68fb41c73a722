"""Two tables of tests/error: error.tsv has times to equal error, ours against each peer; points.tsv what was measured."""
import os
import numpy as np
import equal_error, measures
from curves import curve

HERE = os.path.dirname(os.path.abspath(__file__))
COLUMNS = ("scene", "peer", "display_rmse", "ours_s", "peer_s", "times_faster", "range_5_95", "ours_render_s", "peer_render_s", "render_times_faster",
           "render_range_5_95", "same_picture", "note")
POINT_COLUMNS = ("scene", "renderer", "spp", "whole_s", "whole_spread_%", "render_s", "first_render_s",
                 *("%s_%s" % (m, what) for m in measures.METRICS for what in ("mse", "bias2", "variance", "worst_share", "floor")))


def put_rows(table, columns, scene, rows):
    """Replaces the rows of a scene, and keeps those of the others."""
    path, kept = os.path.join(HERE, table), []
    if os.path.exists(path):
        with open(path) as file: kept = [line for line in list(file)[1:] if line.split("\t")[0] != scene]
    kept += ["\t".join(map(str, row)) + "\n" for row in rows]
    with open(path, "w") as file:
        file.write("\t".join(columns) + "\n")
        file.writelines(sorted(kept, key=lambda line: line.split("\t")[0]))


def bias(points, metric):
    """RMSE of what all seeds have in common, at the most samples."""
    return float(np.sqrt(max(points[-1].errors[metric].bias2, 0)))


def compared(ours, theirs, level, metric, times):
    """Cells: ours, theirs, how many times faster ours is, and the range of that."""
    a, b = curve(ours, metric, times), curve(theirs, metric, times)
    cut = [equal_error.time_at(level ** 2, [np.median(t) for t, _ in c], [e.mean() for _, e in c]) for c in (a, b)]
    value, sign = equal_error.ratio(*cut)
    span = equal_error.bootstrap(a, b, level ** 2)
    return ["%s%.3g" % (s, t) for t, s in cut] + ["?" if sign == "?" else "%s%.3g" % (sign, value), "%.3g-%.3g" % span if span else "-"]


def error_rows(scene, renderers, points, gates, levels, metric="display"):
    for r in renderers:
        if r.name == "ours": continue
        if r.why:
            yield (scene.name, r.name, *("-",) * 9, "-", "cannot: " + r.why)
            continue
        gate, most = gates[r.name], bias(points[r.name], metric)
        for level in levels:
            note = [n for n in (scene.note, r.note) if n]
            if gate != "agrees" and level < 5 * most:
                yield (scene.name, r.name, "%g" % level, *("-",) * 8, gate, "; ".join(note + ["below five times its bias of %.2g" % most]))
                continue
            cells = [c for times in ("whole", "render") for c in compared(points["ours"], points[r.name], level, metric, times)]
            if gate != "agrees": note.append("bias %.2g" % most)
            yield (scene.name, r.name, "%g" % level, *cells, gate, "; ".join(note))


def point_rows(scene, points, floors):
    for name, list_ in points.items():
        for p in list_:
            cells = []
            for m in measures.METRICS:
                e = p.errors[m]
                cells += ["below floor" if p.below[m] else "%.4g" % e.mse.mean(), "%.3g" % e.bias2, "%.3g" % e.variance, "%.2f" % e.worst, "%.3g" % floors[m]]
            yield (scene.name, name, p.spp, "%.4g" % np.median(p.whole), "%.0f" % (100 * p.spread()), "%.4g" % np.median(p.render), "%.4g" % p.first, *cells)
