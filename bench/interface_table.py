#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Medians and quartiles of interface_bench's figures by class of complex.

Usage: interface_table.py interfaces.csv [CLASSES.csv]      default: data/complex_classes.csv beside this file
"""

import csv
import pathlib
import statistics
import sys

COLUMNS = ["sc", "gap", "buried_area", "residue_contacts", "hydrogen_bonds", "clashes", "build_ms", "pose_ms"]


def summary(rows, column):
    values = [float(row[column]) for row in rows]
    low, middle, high = statistics.quantiles(values, n=4, method="inclusive")
    digits = {"sc": 3, "gap": 2}.get(column, 0)
    return f"{middle:.{digits}f} ({low:.{digits}f} - {high:.{digits}f})"


def main():
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    classes_path = sys.argv[2] if len(sys.argv) == 3 else pathlib.Path(__file__).parent / "data/complex_classes.csv"
    with open(classes_path, encoding="utf-8") as file:
        class_of = {row["name"]: row["class"] for row in csv.DictReader(file)}
    with open(sys.argv[1], encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    groups = {}
    for row in rows:
        name = class_of.get(row["name"], "other")
        groups.setdefault(name, []).append(row)
        if name.endswith("with inhibitor"):
            groups.setdefault("all enzymes with inhibitor", []).append(row)
    groups["all"] = rows
    print("| class | n | " + " | ".join(COLUMNS) + " |")
    print("|---|---|" + "---|" * len(COLUMNS))
    for name, members in groups.items():
        if len(members) > 1:
            print(f"| {name} | {len(members)} | " + " | ".join(summary(members, c) for c in COLUMNS) + " |")


if __name__ == "__main__":
    main()
