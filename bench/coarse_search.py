#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Docks every fourth training pair with coarser rotation sets and grids, cross-validated, and prints successes and CPU time.

Usage: coarse_search.py MORTISE PAIRS.csv OUT_FOLDER [--rotations N,...] [--spacings H,...] [-- further options of `mortise benchmark`]

Interrupted runs go on where they stopped. Defaults: 3600,1800,1200,900 rotations (1,200 has no stored set: super-Fibonacci) and
3.0,3.5,4.0 A. A row of the pairs' table belongs to fold row modulo 5 and is ranked by the potential fitted without it.
"""

import argparse
import csv
import pathlib
import statistics
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]
RANKS = (1, 5, 10, 100, 1000, 2000)


def main():
    split = sys.argv.index("--") if "--" in sys.argv else len(sys.argv)
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("mortise")
    parser.add_argument("pairs", type=pathlib.Path)
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--rotations", default="3600,1800,1200,900")
    parser.add_argument("--spacings", default="3.0,3.5,4.0")
    options = parser.parse_args(sys.argv[1:split])
    further = sys.argv[split + 1:]
    options.out.mkdir(parents=True, exist_ok=True)
    with options.pairs.open(encoding="utf-8", newline="") as file:
        names = [row["name"] for row in csv.DictReader(file)]
    print("| rotations | grid, A | hits, top " + " / ".join(f"{k:,}" for k in RANKS)
          + " | acceptable, same | i-RMSD, A | CPU, s |\n|---|---|---|---|---|---|", flush=True)
    for count in options.rotations.split(","):
        for spacing in options.spacings.split(","):
            rows = []
            for fold in range(5):
                some = [name for i, name in enumerate(names) if i % 4 == 0 and i % 5 == fold]
                result = options.out / f"{count}_{spacing}_{fold}.csv"
                subprocess.run([options.mortise, "benchmark", options.pairs, "-o", result, "--subset", ",".join(some), "--threads", "1",
                                "--quiet", "--rotations", count, "--spacing", spacing, "--potential",
                                ROOT / "bench" / "data" / f"contacts_without_fold_{fold}.txt", *further], check=True)
                with result.open(encoding="utf-8", newline="") as file:
                    rows += csv.DictReader(line for line in file if not line.startswith("#"))
            counts = [" / ".join(str(sum(bool(row[column]) and int(row[column]) <= k for row in rows)) for k in RANKS)
                      for column in ("first_irmsd_2_5", "first_acceptable")]
            mean = [f(float(row[column]) for row in rows) for f, column in
                    ((statistics.median, "best_interface_rmsd"), (statistics.mean, "cpu_seconds"))]
            print(f"| {count} | {spacing} | {counts[0]} | {counts[1]} | {mean[0]:.2f} | {mean[1]:.2f} |", flush=True)


if __name__ == "__main__":
    main()
