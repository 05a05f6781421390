#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes the README's pictures: report.png, the page in a browser, and hero.png, a docked complex beside mated parts.

Usage: report_figures.py MORTISE [DIRECTORY]      DIRECTORY defaults to docs/figures

Needs chromium, node, povray and matplotlib. The program is run on molecules/ and parts/ of this tree.
"""

import pathlib
import subprocess
import sys
import tempfile

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

TREE = pathlib.Path(__file__).resolve().parents[2]
MOLECULES = (TREE / "molecules/1hpv_receptor.pdb", TREE / "molecules/1hpv_ligand.pdb")
PARTS = (TREE / "parts/mortise_post_exact.stl", TREE / "parts/tenon_rail.stl")


def run(*words):
    subprocess.run([str(word) for word in words], check=True, stdout=subprocess.DEVNULL)


def report(mortise, scratch, command, bodies, *options):
    run(mortise, command, *bodies, "-o", scratch / f"{command}.h5", "--quiet", *options)
    if command == "dock":
        run(mortise, "evaluate", scratch / "dock.h5", "--reference-fixed", bodies[0], "--reference-moving", bodies[1], "--quiet")
    run(mortise, "report", scratch / f"{command}.h5", "-o", scratch / command, "--png", 1, "--quiet")
    return scratch / command


def trimmed(path):
    """The picture without its white margin."""
    picture = plt.imread(path)[:, :, :3]
    inked = (picture < 0.99).any(axis=2)
    rows, columns = inked.any(axis=1).nonzero()[0], inked.any(axis=0).nonzero()[0]
    return picture[rows[0] : rows[-1] + 1, columns[0] : columns[-1] + 1]


def hero(pictures, path, height=420, gap=60):
    scaled = [(picture, picture.shape[1] * height / picture.shape[0]) for picture in pictures]
    width = sum(w for _, w in scaled) + gap * (len(scaled) - 1)
    figure = plt.figure(figsize=(width / 100, height / 100), dpi=100)
    left = 0
    for picture, wide in scaled:
        axes = figure.add_axes([left / width, 0, wide / width, 1])
        axes.imshow(picture, interpolation="antialiased", aspect="auto")
        axes.set_axis_off()
        left += wide + gap
    figure.savefig(path, dpi=100, metadata={"Software": None})


def main(mortise, directory=TREE / "docs/figures"):
    directory = pathlib.Path(directory)
    with tempfile.TemporaryDirectory() as name:
        scratch = pathlib.Path(name)
        docked = report(mortise, scratch, "dock", MOLECULES, "--random-start", 1)
        run("node", TREE / "tests/report/browser/screenshot.mjs", docked / "index.html", directory / "report.png", TREE / "build/web")
        mated = report(mortise, scratch, "mate", PARTS)
        hero([trimmed(docked / "poses/pose_0001.png"), trimmed(mated / "poses/pose_0001.png")], directory / "hero.png")


if __name__ == "__main__":
    main(*sys.argv[1:3])
