# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws a run's scores, its funnel and the best of its first poses, or the success curves of a benchmark.

Usage: plots.py run DATA.json DIRECTORY, plots.py success DATA.json FILE.png
"""

import json
import pathlib
import sys

import matplotlib.pyplot as plt
import numpy as np

FIXED, MOVING = "#4f7196", "#d9762b"
# Classes differ in shape as well as in colour.
CLASSES = [("incorrect", "#9aa4b1", 6, "o"), ("acceptable", "#c98a12", 16, "^"), ("medium", "#1f64b4", 15, "s"), ("high", "#1b7a43", 22, "D")]
# What poses are measured by where the truth is known: column, its name, its scale, and below what a pose counts as found.
MEASURES = [("interface_rmsd", "interface RMSD (\u00c5)", 1, 2.5, "2.5 \u00c5, a hit"),
            ("placement_largest", "largest error (% of the part's diameter)", 100, 2.0, "2%, in place")]
plt.rcParams.update({
    "figure.figsize": (4.2, 3.2), "figure.dpi": 100, "savefig.dpi": 300, "font.size": 9, "axes.spines.top": False,
    "axes.spines.right": False, "axes.edgecolor": "#4d5967", "axes.linewidth": 0.8, "savefig.bbox": "tight",
    "axes.titlesize": 9, "legend.frameon": False, "legend.fontsize": 8,
})


def column(values):
    return np.array([np.nan if value is None else value for value in values], dtype=float)


def save(figure, path):
    figure.savefig(path, metadata={"Software": None})  # equal runs give equal files
    plt.close(figure)


def scores(data, path):
    figure, axes = plt.subplots()
    score = column(data["score"])
    axes.hist(score[np.isfinite(score)], bins=min(60, max(8, int(len(score) ** 0.5))), color=FIXED, log=len(score) > 50)
    axes.axvline(score[0], color=MOVING, lw=1.5)
    axes.annotate("rank 1", (score[0], 0.98), xycoords=("data", "axes fraction"), color=MOVING, fontsize=8,
                  ha="right", va="top", xytext=(-4, 0), textcoords="offset points")
    axes.set(xlabel="score", ylabel="poses", title=data["title"])
    axes.yaxis.set_major_formatter("{x:,.0f}")
    axes.yaxis.set_minor_formatter("")
    save(figure, path)


def funnel(data, measure, path):
    figure, axes = plt.subplots()
    key, label, scale, _, _ = measure
    score = column(data["score"])
    rmsd = scale * column(data["metrics"][key])
    capri = column(data["metrics"].get("capri", [0] * len(score)))
    for level, (name, colour, size, shape) in enumerate(CLASSES):
        of_class = capri == level
        if of_class.any():
            axes.scatter(rmsd[of_class], score[of_class], s=size, c=colour, marker=shape, lw=0, alpha=0.8, label=name, rasterized=True)
    axes.set(xlabel=label, ylabel="score", title=data["title"], xlim=(0, None))
    if "capri" in data["metrics"]:
        axes.legend(loc="upper right", handletextpad=0.1)
    save(figure, path)


def best_of_top(data, measure, path):
    figure, axes = plt.subplots()
    key, label, scale, found, note = measure
    rmsd = scale * column(data["metrics"][key])
    rank = np.arange(1, len(rmsd) + 1)
    axes.step(rank, np.fmin.accumulate(rmsd), where="post", color=FIXED)
    axes.axhline(found, color="#9aa4b1", lw=0.8, ls="--")
    axes.annotate(note, (1.0, found), xycoords=("axes fraction", "data"), ha="right", va="top", fontsize=8,
                  color="#667282", xytext=(-4, -2), textcoords="offset points")
    axes.set(xlabel="poses looked at", ylabel=f"best {label}", xscale="log", title=data["title"],
             ylim=(0, 1.1 * np.nanmax([found, *rmsd[:1]])))
    axes.xaxis.set_major_formatter("{x:,.0f}")
    if "dockq" in data["metrics"]:
        right = axes.twinx()
        right.spines["right"].set_visible(True)
        right.step(rank, np.fmax.accumulate(column(data["metrics"]["dockq"])), where="post", color=MOVING)
        right.set(ylim=(0, 1))
        right.set_ylabel("best DockQ", color=MOVING)
    save(figure, path)


def success(data, path):
    figure, axes = plt.subplots()
    most = data["most"]
    for curve, colour in zip(data["curves"], [FIXED, MOVING, "#1b7a43", "#7a4fa3"] * len(data["curves"])):
        ranks = column(curve["first_ranks"])
        met = np.sort(ranks[np.isfinite(ranks) & (ranks <= most)])
        x = np.concatenate([[1], met, [most]])
        y = np.concatenate([[np.sum(met <= 1)], np.arange(1, len(met) + 1), [len(met)]]) / len(ranks)
        axes.step(x, 100 * y, where="post", color=colour, label=f"{curve['name']} ({len(met)} of {len(ranks)})")
    axes.set(xlabel="poses looked at", ylabel="pairs with such a pose (%)", xscale="log", xlim=(1, most), ylim=(0, 100))
    axes.xaxis.set_major_formatter("{x:,.0f}")
    axes.legend(loc="upper left")
    save(figure, path)


def run(data, directory):
    data.setdefault("metrics", {})
    directory = pathlib.Path(directory)
    scores(data, directory / "scores.png")
    measure = next((m for m in MEASURES if m[0] in data["metrics"]), None)
    if measure:
        funnel(data, measure, directory / "funnel.png")
        best_of_top(data, measure, directory / "best_of_top.png")


if __name__ == "__main__":
    what, source, target = sys.argv[1:]
    {"run": run, "success": success}[what](json.loads(pathlib.Path(source).read_text(encoding="utf-8")), target)
