#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tables A.2 and 1 of the spherical decomposition paper beside ours, and their figure.

Usage: decomposition_table.py [--build DIR] [--csv FILE] [--balls DIR] FIRST_MESH [SECOND_MESH]

FIRST_MESH is the Stanford bunny, SECOND_MESH the other body of Table 1. Runs decompose_bench
--measure (about a quarter of an hour on two cores, nearly all of it measuring) and prints Markdown;
with --csv FILE that exists, it only prints and draws.
"""

import argparse
import csv
import pathlib
import subprocess

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[1]
# [SD, Table A.2]: grid -> (n3 at mu 0.25, 0.5, 1; W&Z), and [SD, Table 1].
PAPER = {16: (36, 53, 67, 334), 32: (161, 251, 324, 1024), 64: (1024, 1048, 1311, 15592), 128: (3686, 4422, 5160, 89030)}
PAPER_N1 = {16: (318, 307, 275), 32: (1552, 1445, 1295), 64: (6842, 6374, 5436), 128: (26217, 23891, 20674)}
PAPER_RATIO = {16: 23.0, 32: 309.1, 64: 764.5, 128: 3785.5}
MUS = ("0.25", "0.50", "1.00")


def read(options):
    if not options.csv.exists():
        options.balls.mkdir(parents=True, exist_ok=True)
        command = [options.build / "bench" / "decompose_bench", "--measure", "--balls", options.balls, *options.meshes]
        options.csv.write_bytes(subprocess.run(command, check=True, stdout=subprocess.PIPE).stdout)
    return list(csv.DictReader(options.csv.open()))


def find(rows, **wanted):
    found = [row for row in rows if all(row[key] == str(value) for key, value in wanted.items())]
    return found[0] if found else None


def table_a2(rows, mesh, grids):
    print(f"### Table A.2: {mesh}, longest side 1\n")
    print("| m | epsilon | mu | n1 (paper) | n3 containment | **n3 cover** | n3 (paper) | Hausdorff containment | cover | seconds |")
    print("|---|---|---|---|---|---|---|---|---|---|")
    for grid in grids:
        for i, mu in enumerate(MUS):
            keys = dict(mesh=mesh, grid=grid, method="skeletal", mu=mu)
            some, few = find(rows, reduction="containment", **keys), find(rows, reduction="cover", **keys)
            paper = PAPER.get(grid), PAPER_N1.get(grid)
            distance = [f"{max(float(r['balls_beyond']), float(r['solid_beyond'])):.4f}" for r in (some, few)]
            print(
                f"| 2^{3 * int(np.log2(grid))} | {float(few['epsilon']):.4f} | {mu} | {few['n1']} ({paper[1][i] if paper[1] else '-'}) "
                f"| {some['n3']} | **{few['n3']}** | {paper[0][i] if paper[0] else '-'} | {distance[0]} | {distance[1]} "
                f"| {float(few['distance_seconds']) + float(few['seconds']):.2f} |"
            )
    print("\n| m | packing n1 | W&Z (paper) | packing n3 containment | cover | octree n1 | n3 containment | cover |")
    print("|---|---|---|---|---|---|---|---|")
    for grid in grids:
        cells = []
        for method in ("packing", "octree"):
            keys = dict(mesh=mesh, grid=grid, method=method)
            some, few = find(rows, reduction="containment", **keys), find(rows, reduction="cover", **keys)
            cells.append((some["n1"], some["n3"], few["n3"]))
        paper = PAPER[grid][3] if grid in PAPER else "-"
        print(
            f"| 2^{3 * int(np.log2(grid))} | {cells[0][0]} | {paper} | {cells[0][1]} | {cells[0][2]} "
            f"| {cells[1][0]} | {cells[1][1]} | {cells[1][2]} |"
        )


def table_1(rows, meshes, grids):
    print(f"\n### Table 1: uniform against spherical samples, {meshes[0]} and {meshes[1]}, mu = 0.25\n")
    print("| m | nodes inside n1', n2' | n1' n2' | balls n1, n2 | n1 n2 | ratio | ratio (paper) |")
    print("|---|---|---|---|---|---|---|")
    for grid in grids:
        both = [find(rows, mesh=mesh, grid=grid, method="skeletal", mu="0.25", reduction="cover") for mesh in meshes]
        nodes, balls = [int(row["inside"]) for row in both], [int(row["n3"]) for row in both]
        uniform, spherical = nodes[0] * nodes[1], balls[0] * balls[1]
        print(
            f"| 2^{3 * int(np.log2(grid))} | {nodes[0]}, {nodes[1]} | {uniform:.3g} | {balls[0]}, {balls[1]} "
            f"| {spherical:.3g} | {uniform / spherical:.1f} | {PAPER_RATIO.get(grid, '-')} |"
        )


def draw_balls(axis, path, pixels=420):
    """Balls seen along z, lit from the upper left, each in the colour of its radius."""
    balls = np.loadtxt(path, delimiter=",", skiprows=1, ndmin=2)
    side = np.linspace(-0.56, 0.56, pixels)
    depth = np.full((pixels, pixels), -np.inf)
    image = np.ones((pixels, pixels, 3))
    light = np.array([-0.4, 0.6, 0.7]) / np.linalg.norm([-0.4, 0.6, 0.7])
    colour = matplotlib.colormaps["viridis"](0.15 + 0.8 * np.clip(balls[:, 3] / balls[:, 3].max(), 0, 1))[:, :3]
    for (x, y, z, r), tint in zip(balls, colour):
        i, j = np.searchsorted(side, (x - r, x + r)), np.searchsorted(side, (y - r, y + r))
        u, v = np.meshgrid(side[slice(*i)] - x, side[slice(*j)] - y, indexing="ij")
        height = r * r - u * u - v * v
        front = z + np.sqrt(np.maximum(height, 0))
        window = (slice(*i), slice(*j))
        seen = (height > 0) & (front > depth[window])
        normal = np.stack([u, v, np.sqrt(np.maximum(height, 0))], axis=-1) / r
        shade = 0.35 + 0.65 * np.clip(normal @ light, 0, 1)
        depth[window] = np.where(seen, front, depth[window])
        image[window] = np.where(seen[..., None], shade[..., None] * tint, image[window])
    axis.imshow(image.transpose(1, 0, 2), origin="lower", interpolation="bilinear")
    axis.set_axis_off()
    return len(balls)


def figure(rows, mesh, grids, folder):
    shape = plt.figure(figsize=(3 * len(grids), 9.2))
    layout = shape.add_gridspec(3, len(grids), height_ratios=[1, 1, 1.1])
    for row, reduction in enumerate(("containment", "cover")):
        for column, grid in enumerate(grids):
            axis = shape.add_subplot(layout[row, column])
            count = draw_balls(axis, folder / f"{mesh}_{grid}_{reduction}.csv")
            axis.set_title(f"{reduction}, m = $2^{{{3 * int(np.log2(grid))}}}$: {count} balls", fontsize=9)
    axis = shape.add_subplot(layout[2, :])
    m = [grid**3 for grid in grids]
    known = [grid for grid in grids if grid in PAPER]

    def line(label, style, **keys):
        axis.loglog(m, [int(find(rows, mesh=mesh, grid=grid, **keys)["n3"]) for grid in grids], style, label=label)

    axis.loglog([g**3 for g in known], [PAPER[g][3] for g in known], "k:s", label="W&Z, paper", markersize=4)
    axis.loglog([g**3 for g in known], [PAPER[g][0] for g in known], "k--o", label="$n_3$, paper", markersize=4)
    line("$n_3$, containment", "-o", method="skeletal", mu="0.25", reduction="containment")
    line("$n_3$, cover", "-o", method="skeletal", mu="0.25", reduction="cover")
    axis.set(xlabel="grid nodes m", ylabel="balls", title="Balls at equal epsilon, mu = 0.25")
    axis.legend(frameon=False, fontsize=8)
    axis.grid(alpha=0.25, which="both")
    path = ROOT / "docs" / "figures" / "decomposition.png"
    shape.tight_layout()
    shape.savefig(path, dpi=90, metadata={"Software": None})
    print(f"\nFigure: {path.relative_to(ROOT)}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build" / "release")
    parser.add_argument("--csv", type=pathlib.Path, default=pathlib.Path("decomposition.csv"))
    parser.add_argument("--balls", type=pathlib.Path, default=pathlib.Path("decomposition_balls"))
    parser.add_argument("meshes", nargs="+", type=pathlib.Path, metavar="MESH")
    options = parser.parse_args()
    rows = read(options)
    names = [path.stem for path in options.meshes]
    grids = sorted({int(row["grid"]) for row in rows})
    table_a2(rows, names[0], grids)
    if len(names) > 1:
        table_1(rows, names, grids)
    figure(rows, names[0], grids, options.balls)


if __name__ == "__main__":
    main()
