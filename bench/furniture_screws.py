#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Screw axes and pitches of furniture parts from their meshes, as the symmetries that mating_table.py --screws reads.

Usage: furniture_screws.py MESHES > bench/data/furniture_screws.json

The threads of these parts are coils of round wire: a tube about a helix r(a) = (h cos a, h sin a, z0 + p a / 2 pi). The
coil's vertices are those off the core cylinder in the thread's stretch of the axis; h, p, z0, the axis' place and the
tube's radius are fitted by least squares of the vertices' distance from the helix. The axis is parallel to the moving part's own
y (z for the table's base) through the fitted place, which is printed to stderr with the misfit.
Motions are reported in the fixed part's frame, one turn either way.
"""

import csv
import json
import math
import pathlib
import sys

import numpy as np
from scipy.optimize import least_squares

# Moving part: axis, stretch of it with the thread, radii around the coil and of the core that it is wound on (metres).
THREADS = {
    "square_table_leg1": (1, (-0.052, -0.030), (0.0070, 0.0130), 0.0100),
    "chair_leg1": (1, (-0.051, -0.030), (0.0070, 0.0130), 0.0100),
    "chair_nut1": (1, (0.000, 0.012), (0.0060, 0.0095), 0.00787),
    "round_table_leg": (1, (0.022, 0.045), (0.0105, 0.0130), 0.0125),
    "round_table_base": (2, (-0.023, -0.003), (0.0070, 0.0130), 0.0100),
}


def vertices(path):
    with open(path, encoding="utf-8") as file:
        return np.array([[float(x) for x in line.split()[1:4]] for line in file if line.startswith("v ")])


def fit(points, core):
    """Pitch (signed, right-handed about +z), offset of the axis, helix radius, rms misfit of a coil about z."""
    def distance(at, u):
        pitch, z0, h, x, y = u
        dx, dy, z = points[:, 0] - x, points[:, 1] - y, points[:, 2]
        slope = 2 * math.pi * h / math.hypot(2 * math.pi * h, pitch)
        along = z - z0 - pitch * np.arctan2(dy, dx) / (2 * math.pi)
        along -= pitch * np.round(along / pitch)
        return np.hypot(np.hypot(dx, dy) - h, along * slope)
    def residual(u):
        d = distance(points, u)
        return d - d.mean()
    # Start where the vertices' angles follow their heights best; every third vertex will do.
    angle, height = np.arctan2(points[::3, 1], points[::3, 0]), points[::3, 2]
    def in_step(pitch):
        return np.exp(1j * (angle - 2 * math.pi * height / pitch)).mean()
    pitch = max((s * p for s in (1, -1) for p in np.arange(0.004, 0.0141, 0.00002)), key=lambda p: abs(in_step(p)))
    place = -np.angle(in_step(pitch)) * pitch / (2 * math.pi)
    best = least_squares(residual, [pitch, place, core, 0, 0], x_scale=[1e-4, 1e-4, 1e-4, 1e-5, 1e-5])
    rms = math.sqrt(2 * best.cost / len(points))
    return best.x[0], best.x[3:5], best.x[2], distance(points, best.x).mean(), rms


def rotation(a, b, c):
    def about(axis, angle):
        i, j = (axis + 1) % 3, (axis + 2) % 3
        m = np.eye(3)
        m[i, i] = m[j, j] = math.cos(angle)
        m[j, i], m[i, j] = math.sin(angle), -math.sin(angle)
        return m
    return about(2, c) @ about(1, b) @ about(0, a)


def main():
    folder = pathlib.Path(sys.argv[1])
    screws = {}
    with open(folder / "mates.csv", encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    for row in rows:
        name = f"{pathlib.Path(row['fixed']).stem} {pathlib.Path(row['moving']).stem}"
        moving = pathlib.Path(row["moving"]).stem
        if moving not in THREADS:
            screws[name] = []
            continue
        axis, (low, high), (inner, outer), core = THREADS[moving]
        order = [(axis + 1) % 3, (axis + 2) % 3, axis]
        points = vertices(folder / row["moving"])[:, order]
        radius = np.hypot(points[:, 0], points[:, 1])
        of_coil = (points[:, 2] > low) & (points[:, 2] < high) & (radius > inner) & (radius < outer) & (
            abs(radius - core) > 5e-5)
        pitch, offset, helix, wire, rms = fit(points[of_coil], core)
        print(f"{name}: {of_coil.sum()} vertices, pitch {1e3 * pitch:.3f} mm, axis off by {1e3 * np.hypot(*offset):.3f} mm, "
              f"helix radius {1e3 * helix:.3f} mm, wire {1e3 * wire:.3f} mm, rms {1e3 * rms:.3f} mm", file=sys.stderr)
        R = rotation(*(float(row[k]) for k in "abc"))
        t = np.array([float(row[k]) for k in ("tx", "ty", "tz")])
        middle = np.zeros(3)
        middle[order[:2]] = offset
        screws[name] = [{"kind": "screw", "pitch": round(float(pitch), 6), "point": [round(float(x), 9) for x in R @ middle + t],
                         "direction": [round(float(x), 9) + 0.0 for x in R[:, axis]], "from": -2 * math.pi, "to": 2 * math.pi}]
    print("{\n" + ",\n".join(f"  {json.dumps(k)}: {json.dumps(v)}" for k, v in screws.items()) + "\n}")


if __name__ == "__main__":
    main()
