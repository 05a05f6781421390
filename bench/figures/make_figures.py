#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws the figures of docs/figures from data that the benchmark programs print.

Usage: make_figures.py [--build DIR] [--data DIR] [--mesh FILE] [--keep-data] [FIGURE...]

Without FIGURE: all. --keep-data draws from the CSV of an earlier run where it is there. --mesh is the body of the
spectra's figure, by default the Stanford bunny of ../shared/meshes; where it is not, that figure is left out.
"""

import argparse
import csv
import pathlib
import subprocess

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
INK = "#1f3b4d"
ACCENT = "#d1495b"
LIGHT = "#66a182"

plt.rcParams.update(
    {
        "figure.dpi": 110,
        "font.size": 9,
        "axes.spines.top": False,
        "axes.spines.right": False,
        "axes.grid": True,
        "grid.alpha": 0.25,
        "svg.hashsalt": "mortise",
    }
)


class Maker:
    def __init__(self, options):
        self.build = options.build
        self.data = options.data
        self.keep = options.keep_data
        self.mesh = options.mesh
        self.data.mkdir(parents=True, exist_ok=True)

    def rows(self, name, *command):
        """The CSV that a benchmark program prints, as a list of dicts; comments are dropped."""
        path = self.data / f"{name}.csv"
        if not (self.keep and path.exists()):
            print(" ".join(command), "->", path, flush=True)
            program = self.build / "bench" / command[0]
            path.write_bytes(subprocess.run([program, *command[1:]], check=True, stdout=subprocess.PIPE).stdout)
        lines = path.read_text().splitlines()
        self.comments = [line for line in lines if line.startswith("#")]
        return list(csv.DictReader(line for line in lines if not line.startswith("#")))

    @staticmethod
    def save(figure, name):
        path = ROOT / "docs" / "figures" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        figure.savefig(path, bbox_inches="tight", metadata={"Software": None} if name.endswith("png") else {"Date": None})
        plt.close(figure)
        print("wrote", path.relative_to(ROOT))


def plane(maker):
    """All rows of gap_data plane as grids, by modes."""
    rows = maker.rows("gap_plane", "gap_data", "plane")
    threshold = float(maker.comments[0].split()[2])
    xs = sorted({float(r["x"]) for r in rows})
    at = {x: i for i, x in enumerate(xs)}
    grids = {}
    for r in rows:
        grid = grids.setdefault(int(r["modes"]), {k: np.zeros((len(xs), len(xs))) for k in r if k not in ("modes", "x", "y")})
        for name, values in grid.items():
            values[at[float(r["x"])], at[float(r["y"])]] = float(r[name])
    return np.array(xs), grids, threshold


def convergence(maker):
    """Gap function, terms to reject and gradient field for growing numbers of modes [FC, Fig. 5]."""
    xs, grids, threshold = plane(maker)
    grid_x, grid_y = np.meshgrid(xs, xs, indexing="ij")
    figure, axes = plt.subplots(3, len(grids), figsize=(10, 7.6), sharex=True, sharey=True)
    top = max(np.abs(g["reference"]).max() for g in grids.values())
    for column, (modes, g) in enumerate(sorted(grids.items())):
        axes[0, column].pcolormesh(grid_x, grid_y, g["value"], cmap="viridis", vmin=0, vmax=top, rasterized=True)
        axes[0, column].contour(grid_x, grid_y, g["reference"], levels=[threshold], colors="w", linewidths=0.8)
        axes[0, column].set_title(f"m' = {modes:,}")
        share = np.where(g["rejected"] > 0, g["terms"] / modes, np.nan)
        image = axes[1, column].pcolormesh(grid_x, grid_y, share, cmap="magma_r", vmin=0, vmax=1, rasterized=True)
        step = 7
        axes[2, column].contour(grid_x, grid_y, g["value"], levels=[threshold], colors=[ACCENT], linewidths=1)
        length = np.hypot(g["gx"], g["gy"]) + 1e-9
        shown = np.where(g["value"] > threshold, 1.0 / length, 0.0)[::step, ::step]
        axes[2, column].quiver(grid_x[::step, ::step], grid_y[::step, ::step], -g["gx"][::step, ::step] * shown,
                               -g["gy"][::step, ::step] * shown, color=INK, scale=22, width=0.006)
        for row in range(3):
            axes[row, column].set_aspect("equal")
            axes[row, column].grid(False)
    for axis, label in zip(axes[:, 0], ("gap function\n(white: exact outline)", "part of the modes\nneeded to reject", "way out and\nlevel set")):
        axis.set_ylabel(label)
    figure.colorbar(image, ax=axes[1, :], fraction=0.02)
    maker.save(figure, "gap_convergence.png")


def residual(maker):
    """A section through the gap function and what is missing of it, by modes [SD, Fig. 7]."""
    xs, grids, _ = plane(maker)
    grid_x, grid_y = np.meshgrid(xs, xs, indexing="ij")
    figure, axes = plt.subplots(2, len(grids) + 1, figsize=(11, 4.6), sharex=True, sharey=True)
    reference = next(iter(grids.values()))["reference"]
    top = np.abs(reference).max()
    axes[0, 0].pcolormesh(grid_x, grid_y, reference, cmap="viridis", vmin=0, vmax=top, rasterized=True)
    axes[0, 0].set_title("reference")
    axes[1, 0].set_axis_off()
    for column, (modes, g) in enumerate(sorted(grids.items()), start=1):
        axes[0, column].pcolormesh(grid_x, grid_y, g["value"], cmap="viridis", vmin=0, vmax=top, rasterized=True)
        error = g["value"] - reference
        axes[1, column].pcolormesh(grid_x, grid_y, error / top, cmap="RdBu", vmin=-0.1, vmax=0.1, rasterized=True)
        axes[0, column].set_title(f"m' = {modes:,}")
        axes[1, column].set_title(f"rms {100 * np.sqrt((error**2).mean()) / top:.2g}% of the top", fontsize=8)
    for axis in axes.flat:
        axis.set_aspect("equal")
        axis.grid(False)
    maker.save(figure, "gap_residual.png")


def query_time(maker):
    """Time of one query against the retained modes [SD, Fig. 9]."""
    rows = maker.rows("gap_time", "gap_data", "time")
    modes = [int(r["modes"]) for r in rows]
    figure, axis = plt.subplots(figsize=(5, 3.4))
    axis.loglog(modes, [float(r["microseconds"]) for r in rows], color=INK, marker="o", ms=3, label="value and 6D gradient")
    axis.loglog(modes, [float(r["value_only_microseconds"]) for r in rows], color=LIGHT, marker="s", ms=3, label="value and remainder")
    axis.axhline(1000, color=ACCENT, lw=1, ls="--")
    axis.text(modes[0], 1100, "1 ms: haptic rate", color=ACCENT, fontsize=8)
    axis.plot(4096, 1000, color=ACCENT, marker="*", ms=9, ls="none", label="paper: value alone, one CPU core")
    axis.set_xlabel("retained modes m'")
    axis.set_ylabel("microseconds, one core")
    axis.legend(frameon=False, fontsize=8)
    maker.save(figure, "gap_query_time.png")


def spectrum(maker):
    """Rasterise + FFT against 4D NDFT and NFFT, by the modes that are wanted [SD, Fig. 8]."""
    if not maker.mesh.exists():
        print("left out: the spectra's figure needs", maker.mesh)
        return
    items = []
    for grid in (16, 32, 64, 128):
        knots = maker.data / f"{maker.mesh.stem}_{grid}.h5"
        if not (maker.keep and knots.exists()):
            subprocess.run([maker.build / "apps" / "mortise", "decompose", maker.mesh, "-o", knots, "--grid", str(grid),
                            "--mu", "0.25", "--no-hausdorff", "--quiet"], check=True)
        items.append(f"{grid}={knots}")
    rows = maker.rows("spectrum", "spectrum_data", *items)
    grids = sorted({int(r["grid"]) for r in rows})
    figure, axes = plt.subplots(1, len(grids), figsize=(11, 3.3), sharey=True)
    for axis, grid in zip(axes, grids):
        some = [r for r in rows if int(r["grid"]) == grid]
        axis.axhline(float(some[0]["raster"]) + float(some[0]["fft"]), color=INK, lw=2, label="rasterise + 3D FFT")
        axis.axhline(float(some[0]["raster"]), color=INK, lw=1, ls=":", label="rasterise alone")
        for column, color, marker, label in (("ndft4d", ACCENT, "o", "4D NDFT"), ("nfft4d", LIGHT, "s", "4D NFFT"),
                                             ("compressed", "#e09f3e", "^", "compressed radii, 3D NFFTs")):
            points = [(int(r["modes"]) ** 3, float(r[column])) for r in some if float(r[column]) > 0]
            axis.loglog(*zip(*points), color=color, marker=marker, ms=4, label=label, base=2)
        axis.set_yscale("log", base=10)
        axis.set_xlim(2**5.5, 2**21.5)
        axis.set_title(f"m = $2^{{{3 * int(np.log2(grid))}}}$ nodes, {int(some[0]['knots'])} balls")
        axis.set_xlabel("modes wanted m'")
    axes[0].set_ylabel("CPU seconds, one core")
    axes[0].legend(frameon=False, fontsize=7)
    maker.save(figure, "spectrum_time.png")


FIGURES = {"convergence": convergence, "residual": residual, "query_time": query_time, "spectrum": spectrum}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build" / "release")
    parser.add_argument("--data", type=pathlib.Path, default=ROOT / "out" / "figures")
    parser.add_argument("--mesh", type=pathlib.Path, default=ROOT.parent / "shared" / "meshes" / "stanford-bunny.obj")
    parser.add_argument("--keep-data", action="store_true")
    parser.add_argument("figures", nargs="*", choices=[*FIGURES, []], metavar="FIGURE")
    options = parser.parse_args()
    maker = Maker(options)
    for name in options.figures or FIGURES:
        FIGURES[name](maker)


if __name__ == "__main__":
    main()
