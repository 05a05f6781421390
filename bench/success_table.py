#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Adds up results of `mortise benchmark`, such as the folds of a cross-validation, to one Markdown table.

Usage: success_table.py RESULTS.csv...

A pair may stand in one file only. Pairs that failed count as pairs without success and are named.
"""

import csv
import statistics
import sys

RANKS = (1, 5, 10, 100, 1000, 2000)
CRITERIA = (("hit, i-RMSD <= 2.5 A", "first_irmsd_2_5"), ("acceptable (CAPRI)", "first_acceptable"),
            ("medium (CAPRI)", "first_medium"))


def read(path):
    with open(path, encoding="utf-8", newline="") as file:
        yield from csv.DictReader(line for line in file if not line.startswith("#"))


def main():
    if len(sys.argv) < 2 or sys.argv[1].startswith("-"):
        sys.exit(__doc__.strip())
    rows = {}
    for path in sys.argv[1:]:
        for row in read(path):
            if row["name"] in rows:
                sys.exit(f"success_table: {path}: {row['name']} stands in two files, or twice in one")
            rows[row["name"]] = row
    failed = [name for name, row in rows.items() if row["error"]]

    print("| pairs | metric | " + " | ".join(f"{k:,}" for k in RANKS) + " |")
    print("| --- | --- |" + " --- |" * len(RANKS))
    for cls in ("all", "easy", "medium", "hard"):
        some = [row for row in rows.values() if cls in ("all", row["difficulty"])]
        for name, column in CRITERIA if some else ():
            first = [int(row[column]) for row in some if row[column] and not row["error"]]
            counts = " | ".join(str(sum(rank <= k for rank in first)) for k in RANKS)
            print(f"| {cls}, {len(some)} | {name} | {counts} |")
    nearest = [float(row["best_interface_rmsd"]) for row in rows.values() if row["best_interface_rmsd"]]
    if nearest:
        print(f"\nbest pose: median i-RMSD {statistics.median(nearest):.2f} A")
    for label, column, unit in (("CPU", "cpu_seconds", "s"), ("wall", "seconds", "s"), ("peak", "peak_memory_mb", "MB")):
        values = sorted(float(row[column]) for row in rows.values() if row[column])
        if values:
            print(f"\n{label}: mean {sum(values) / len(values):.1f} {unit}, {values[0]:.1f} to {values[-1]:.1f}")
    print(f"\nfailed: {', '.join(failed) if failed else 'none'}")


if __name__ == "__main__":
    main()
