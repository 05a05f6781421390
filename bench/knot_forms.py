#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Prints the tables of docs/ranking.md from rows of knot_forms, as Markdown.

Usage: knot_forms.py ROWS.csv... [--base FORM:PENALTY]

Per form and penalty: pairs with an acceptable pose and with a hit among the first N, for both rankings, and the mean over
the pairs of log10 of the rank of the first acceptable pose (none in the top 2,000 counts as 4,000). Its difference to the
base form has a 95% interval from 10,000 bootstrap samples of the pairs.
"""

import argparse
import csv
import math
import random

TOPS = (1, 10, 100, 1000, 2000)
NONE = 4000


def log_rank(rank):
    return math.log10(rank if rank else NONE)


def interval(differences, rng, samples=10000):
    """The 95% bootstrap interval of the mean."""
    n = len(differences)
    means = sorted(sum(rng.choices(differences, k=n)) / n for _ in range(samples))
    return means[int(0.025 * samples)], means[int(0.975 * samples) - 1]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("rows", nargs="+")
    parser.add_argument("--base", default="")
    args = parser.parse_args()
    forms = {}
    for path in args.rows:
        with open(path, encoding="utf-8", newline="") as file:
            for row in csv.DictReader(file):
                if row["pair"] != "pair":
                    forms.setdefault(f"{row['form']}:{row['penalty']}", {})[row["pair"]] = row
    base = args.base or next(iter(forms))
    common = set.intersection(*(set(rows) for rows in forms.values()))
    pairs = sorted(common)
    print(f"{len(pairs)} pairs, base {base}\n")
    print("| form | lambda | knots | CPU, s | ranked by | acceptable, top 1 / 10 / 100 / 1,000 / 2,000 | hits, same "
          "| mean log10 rank | minus base (95%) |")
    print("|---|---|---|---|---|---|---|---|---|")
    for name, rows in forms.items():
        form, penalty = name.rsplit(":", 1)
        knots = sum(int(rows[p]["moving_knots"]) for p in pairs) / len(pairs)
        cpu = sum(float(rows[p]["search_cpu"]) for p in pairs) / len(pairs)
        for ranked in ("shape", "both"):
            rng = random.Random(1)
            counts = {}
            for kind in ("acceptable", "hit"):
                ranks = [int(rows[p][f"{ranked}_{kind}"]) for p in pairs]
                counts[kind] = " / ".join(str(sum(0 < r <= top for r in ranks)) for top in TOPS)
            logs = [log_rank(int(rows[p][f"{ranked}_acceptable"])) for p in pairs]
            differences = [a - log_rank(int(forms[base][p][f"{ranked}_acceptable"])) for a, p in zip(logs, pairs)]
            low, high = interval(differences, rng)
            change = "" if name == base else f"{sum(differences) / len(pairs):+.3f} ({low:+.3f}, {high:+.3f})"
            print(f"| {form} | {penalty} | {knots:.0f} | {cpu:.2f} | {ranked} | {counts['acceptable']} | {counts['hit']} | "
                  f"{sum(logs) / len(pairs):.3f} | {change} |")


if __name__ == "__main__":
    main()
