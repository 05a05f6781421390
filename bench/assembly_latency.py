#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Time per step of `mortise assemble` on a sample pair whose triangles are cut finer, as Markdown.

Usage: assembly_latency.py MORTISE [--pair NAME] [--triangles N] [-- further options of `mortise assemble`]

Every triangle is cut into four at its edges' middles until a part has at least N (default 300,000). Default further
options: --grid 128 --seconds 10. The path is the program's recorded hand, at 1 kHz, to the pair's true placement.
"""

import argparse
import array
import json
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[1]


def read_stl(path):
    """Corners (9 floats) of each triangle of a binary STL."""
    data = path.read_bytes()
    count = int.from_bytes(data[80:84], "little")
    triangles = []
    for i in range(count):
        triangles.append(array.array("f", data[84 + 50 * i + 12:84 + 50 * i + 48]).tolist())
    return triangles


def cut(triangles):
    finer = []
    for t in triangles:
        a, b, c = t[0:3], t[3:6], t[6:9]
        ab, bc, ca = ([(x + y) / 2 for x, y in zip(p, q)] for p, q in ((a, b), (b, c), (c, a)))
        finer += [a + ab + ca, ab + b + bc, ca + bc + c, ab + bc + ca]
    return finer


def write_stl(path, triangles):
    out = bytearray(80) + len(triangles).to_bytes(4, "little")
    for t in triangles:
        out += bytes(12) + array.array("f", t).tobytes() + bytes(2)
    path.write_bytes(out)


def main():
    split = sys.argv.index("--") if "--" in sys.argv else len(sys.argv)
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("mortise")
    parser.add_argument("--pair", default="broken_sphere_exact")
    parser.add_argument("--triangles", type=int, default=300000)
    options = parser.parse_args(sys.argv[1:split])
    further = sys.argv[split + 1:] or ["--grid", "128", "--seconds", "10"]
    mates = ROOT / "parts" / "mates.json"
    pair = next(p for p in json.loads(mates.read_text())["pairs"] if p["name"] == options.pair)
    with tempfile.TemporaryDirectory() as folder:
        files = []
        for body in ("fixed", "moving"):
            triangles = read_stl(mates.parent / f"{pair[body]}.stl")
            while len(triangles) < options.triangles:
                triangles = cut(triangles)
            files.append(pathlib.Path(folder) / f"{pair[body]}.stl")
            write_stl(files[-1], triangles)
        command = [options.mortise, "assemble", *files, "--mates", mates, "--pair", pair["name"], "--json", "--quiet", *further]
        found = json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)
    print(f"{pair['name']}, {found['fixed_triangles']} and {found['moving_triangles']} triangles, m' = {found['modes']}, "
          f"{found['steps']} steps at {found['rate']:g} Hz, prepared in {found['preparation_seconds']:.1f} s, "
          f"{found['misses']} misses\n")
    print("| microseconds | median | 99% | 99.9% | largest |\n|---|---|---|---|---|")
    for name, key in (("wrench", "compute_microseconds"), ("whole step, from when it was due", "step_microseconds")):
        q = found[key]
        print(f"| {name} | {q['median']:.1f} | {q['percentile_99']:.1f} | {q['percentile_99_9']:.1f} | {q['largest']:.1f} |")


if __name__ == "__main__":
    main()
