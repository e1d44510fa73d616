"""Pictures of build/reports/bench.json: plots.py BENCH_JSON FOLDER

bench-totals-KIND.png    from cold to R answers, a panel for each scene, a line for each subject
bench-single.png         ratios of single calls to the best peer, a group of bars for each scene
bench-batch.png          the same of batch calls
"""

import json
import math
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from matplotlib.ticker import FuncFormatter, NullFormatter

OURS = "raywise bvh"
CHOSEN = "raywise"


def as_ratio(value, _position):
    return f"{value:g}"


def in_order(values):
    return list(dict.fromkeys(values))


def curves_of(rows):
    """For one scene: subject -> [(count, ms, extrapolated)], each subject once, ours first."""
    curves = {}
    for row in rows:
        point = (row["count"], row["value"], row.get("extrapolated", False))
        if point not in curves.setdefault(row["subject"], []):
            curves[row["subject"]].append(point)
        if row["peer"] is not None:
            curves.setdefault(row["peer"], []).append(
                (row["count"], row["peer_value"], row.get("peer_extrapolated", False))
            )
    return curves


def plot_totals(rows, kind, path):
    scenes = in_order(row["scene"] for row in rows)
    columns = min(3, len(scenes))
    lines = math.ceil(len(scenes) / columns)
    figure, axes = plt.subplots(lines, columns, figsize=(4.6 * columns, 3.5 * lines), squeeze=False, sharex=True)
    subjects = in_order(name for row in rows for name in (row["subject"], row["peer"]) if name)
    colours = plt.get_cmap("tab10").colors
    style = {name: {"color": colours[i % len(colours)]} for i, name in enumerate(n for n in subjects if n != CHOSEN)}
    style[CHOSEN] = {"color": "black", "linewidth": 2.5, "zorder": 5}
    for place, axis in zip(axes.flat, range(lines * columns)):
        place.set_visible(axis < len(scenes))
    for place, scene in zip(axes.flat, scenes):
        for name, points in curves_of([row for row in rows if row["scene"] == scene]).items():
            counts = [point[0] for point in points]
            times = [point[1] for point in points]
            place.plot(counts, times, label=name, **style[name])
            reckoned = [(count, time) for count, time, extrapolated in points if extrapolated]
            place.plot(*zip(*reckoned), "o", markersize=4, markerfacecolor="white", color=style[name]["color"], zorder=6) if reckoned else None
        triangles = next(row["triangles"] for row in rows if row["scene"] == scene)
        place.set_title(f"{scene} ({triangles:,} triangles)", fontsize=10)
        place.set_xscale("log")
        place.set_yscale("log")
        place.grid(True, which="major", linewidth=0.4, alpha=0.6)
    for place in axes[:, 0]:
        place.set_ylabel("ms, building included")
    # The lowest panel that is there in each column carries the axis.
    for column in range(columns):
        lowest = [axes[line][column] for line in range(lines) if line * columns + column < len(scenes)][-1]
        lowest.set_xlabel(f"{kind} rays")
        lowest.tick_params(labelbottom=True)
    handles, labels = axes[0][0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="lower center", ncol=min(4, len(labels)), frameon=False, fontsize=9)
    figure.suptitle("From cold to R answers, 1 thread; hollow points are reckoned from a measured rate", fontsize=11)
    legend_lines = math.ceil(len(labels) / 4)
    figure.tight_layout(rect=(0, 0.25 * legend_lines / (3.5 * lines) + 0.02, 1, 0.98))
    figure.savefig(path, dpi=110)
    plt.close(figure)


def plot_ratios(rows, title, path):
    """Bars of ours over the best peer; one group for each scene, one bar for each kind of ray and question."""
    best = [row for row in rows if row["subject"] == OURS and row.get("best_peer") and row["threads"] == 1]
    if not best:
        return False
    scenes = in_order(row["scene"] for row in best)
    series = in_order((row["rays"], row["query"]) for row in best)
    figure, axis = plt.subplots(figsize=(max(6.0, 1.1 * len(scenes) + 2.5), 4.2))
    width = 0.8 / len(series)
    for i, (rays, query) in enumerate(series):
        ratios = {row["scene"]: row["ratio"] for row in best if (row["rays"], row["query"]) == (rays, query)}
        places = [k + (i - (len(series) - 1) / 2) * width for k, scene in enumerate(scenes) if scene in ratios]
        axis.bar(places, [ratios[scene] for scene in scenes if scene in ratios], width, label=f"{rays}, {query}")
    axis.axhline(1.0, color="black", linewidth=1)
    axis.set_yscale("log", base=2)
    axis.yaxis.set_major_formatter(FuncFormatter(as_ratio))
    axis.yaxis.set_minor_formatter(NullFormatter())
    axis.set_xticks(range(len(scenes)), scenes, rotation=30, ha="right")
    axis.set_ylabel("Mray/s over the best peer's")
    axis.set_title(title, fontsize=11)
    axis.grid(True, axis="y", linewidth=0.4, alpha=0.6)
    axis.legend(fontsize=8, frameon=False, ncol=3, loc="upper center", bbox_to_anchor=(0.5, -0.22))
    figure.tight_layout()
    figure.savefig(path, dpi=110)
    plt.close(figure)
    return True


def main():
    if len(sys.argv) != 3 or sys.argv[1] in ("-h", "--help"):
        print(__doc__)
        return 0 if "--help" in sys.argv or "-h" in sys.argv else 2
    report = json.loads(Path(sys.argv[1]).read_text())
    folder = Path(sys.argv[2])
    rows = report["rows"]
    written = []
    for kind in in_order(row["rays"] for row in rows if row["section"] == "totals"):
        path = folder / f"bench-totals-{kind}.png"
        plot_totals([row for row in rows if row["section"] == "totals" and row["rays"] == kind], kind, path)
        written.append(path)
    for section, title in (("single", "Single calls of raywise's bvh, 1 thread"), ("batch", "Batch calls of raywise's bvh, 1 thread")):
        path = folder / f"bench-{section}.png"
        if plot_ratios([row for row in rows if row["section"] == section], title, path):
            written.append(path)
    for path in written:
        print(f"    {path.name}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
