#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Mates pairs of parts from random starts and prints the table of ranks, errors and costs as Markdown.

Usage: mating_table.py MORTISE [--mates FILE.json | --table mates.csv] [--format stl|step] [--only NAME,...] [--seed N]
                       [-- further options of `mortise mate`]

--mates takes a truth file (default: parts/mates.json, whose parts lie beside it); --table a CSV of furniture parts:
fixed, moving, tx, ty, tz, a, b, c with R = Rz(c) Ry(b) Rx(a), whose screws are taken from --screws (a JSON object:
name of the pair to its list of symmetries), if given. Failed pairs are listed.
"""

import argparse
import csv
import json
import math
import pathlib
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[1]
COLUMNS = ("pair", "clearance", "rank within 2%", "largest error, %", "rms, %", "contact / penetration", "wall, s",
           "CPU, s", "MB")


def quaternion(a, b, c):
    """w, x, y, z of Rz(c) Ry(b) Rx(a)."""
    def product(p, q):
        return (p[0] * q[0] - p[1] * q[1] - p[2] * q[2] - p[3] * q[3], p[0] * q[1] + p[1] * q[0] + p[2] * q[3] - p[3] * q[2],
                p[0] * q[2] - p[1] * q[3] + p[2] * q[0] + p[3] * q[1], p[0] * q[3] + p[1] * q[2] - p[2] * q[1] + p[3] * q[0])
    x = (math.cos(a / 2), math.sin(a / 2), 0, 0)
    y = (math.cos(b / 2), 0, math.sin(b / 2), 0)
    z = (math.cos(c / 2), 0, 0, math.sin(c / 2))
    return product(z, product(y, x))


def pairs_of_table(path, screws):
    """The rows of a furniture table as entries of a truth file."""
    with open(path, encoding="utf-8", newline="") as file:
        for row in csv.DictReader(line for line in file if not line.startswith("#")):
            fixed, moving = pathlib.Path(row["fixed"]), pathlib.Path(row["moving"])
            name = f"{fixed.stem} {moving.stem}"
            q = quaternion(*(float(row[k]) for k in "abc"))
            yield {"name": name, "fixed": fixed.stem, "moving": moving.stem, "clearance": "",
                   "files": (path.parent / fixed, path.parent / moving),
                   "pose": {"rotation": q, "translation": [float(row[k]) for k in ("tx", "ty", "tz")]},
                   "symmetries": screws.get(name, [])}


def run(command):
    """JSON of a command, its wall and CPU seconds; raises CalledProcessError."""
    # /usr/bin/time is not everywhere: ask the kernel for what the child used.
    import resource
    before, start = resource.getrusage(resource.RUSAGE_CHILDREN), time.monotonic()
    out = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    cpu = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return json.loads(out), time.monotonic() - start, cpu


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("mortise")
    parser.add_argument("--mates", type=pathlib.Path, default=ROOT / "parts" / "mates.json")
    parser.add_argument("--table", type=pathlib.Path)
    parser.add_argument("--screws", type=pathlib.Path)
    parser.add_argument("--format", default="stl")
    parser.add_argument("--only", default="")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--keep", type=pathlib.Path, help="folder for the run files")
    split = sys.argv.index("--") if "--" in sys.argv else len(sys.argv)
    args = parser.parse_args(sys.argv[1:split])
    further = sys.argv[split + 1:]

    if args.table:
        screws = json.loads(args.screws.read_text()) if args.screws else {}
        pairs = list(pairs_of_table(args.table, screws))
    else:
        pairs = json.loads(args.mates.read_text())["pairs"]
        for pair in pairs:
            pair["files"] = [args.mates.parent / f"{pair[k]}.{args.format}" for k in ("fixed", "moving")]
    only = [name for name in args.only.split(",") if name]
    pairs = [pair for pair in pairs if not only or pair["name"] in only]

    print("| " + " | ".join(COLUMNS) + " |")
    print("|" + " --- |" * len(COLUMNS))
    ranks, errors, failed = [], [], []
    with tempfile.TemporaryDirectory() as scratch:
        folder = args.keep or pathlib.Path(scratch)
        folder.mkdir(exist_ok=True)
        for pair in pairs:
            name = pair["name"]
            output = folder / (name.replace(" ", "_") + ".h5")
            truth = pathlib.Path(scratch) / "truth.json"
            truth.write_text(json.dumps({k: v for k, v in pair.items() if k not in ("files", "clearance")}))
            try:
                mate, wall, cpu = run([args.mortise, "mate", *map(str, pair["files"]), "-o", str(output), "--force",
                                       "--random-start", str(args.seed), "--json", *further])
                found, _, _ = run([args.mortise, "evaluate", str(output), "--reference-pose", str(truth), "--json"])
            except subprocess.CalledProcessError as error:
                failed.append(f"{name}: {error.stderr.strip()}")
                continue
            exported = json.loads(subprocess.run([args.mortise, "export", str(output), "--format", "json", "--top", "1", "-o",
                                                  "-"], check=True, capture_output=True, text=True).stdout)
            channels = exported["poses"][0]["channels"]
            rank, error = found["first_within_2_percent"], found["error_of_first"]
            if rank is None:
                failed.append(f"{name}: no pose within 2%, nearest {100 * found['best_placement_largest']:.2f}%")
            else:
                ranks.append(rank)
                errors.append(error)
            print(f"| {name} | {pair['clearance']} | {rank if rank else '-'} | "
                  f"{f'{100 * error:.3f}' if rank else '-'} | {100 * found['rms_of_first']:.3f} | " if rank else
                  f"| {name} | {pair['clearance']} | - | - | - | ", end="")
            print(f"{channels['contact']:.3f} / {channels['penetration']:.3f} | {wall:.1f} | {cpu:.1f} | "
                  f"{mate.get('peak_memory_mb', 0):.0f} |", flush=True)
    count = len(pairs)
    print(f"\n{count} pairs: {sum(r == 1 for r in ranks)} at rank 1, {sum(r <= 10 for r in ranks)} within the top 10, "
          f"{len(ranks)} found; {sum(e <= 0.002 for e in errors)} within 0.2% of the diameter")
    for line in failed:
        print(f"- {line}")


if __name__ == "__main__":
    main()
