#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Lets each sample part go from random starts near its mate and prints, as Markdown, how many end in it.

Usage: assembly_table.py MORTISE [--mates FILE.json] [--only NAME,...] [-- further options of `mortise assemble`]

The parts lie beside the truth file, by default parts/mates.json. Default further options: --free 50 --grid 64.
"""

import argparse
import json
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]


def main():
    split = sys.argv.index("--") if "--" in sys.argv else len(sys.argv)
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("mortise")
    parser.add_argument("--mates", type=pathlib.Path, default=ROOT / "parts" / "mates.json")
    parser.add_argument("--only", default="")
    options = parser.parse_args(sys.argv[1:split])
    further = sys.argv[split + 1:] or ["--free", "50", "--grid", "64"]
    print("| pair | symmetries | starts | end in the mate | without symmetries | mate rests off a true placement, % of the radius |")
    print("|---|---|---|---|---|---|", flush=True)
    sums = [0, 0, 0]
    for pair in json.loads(options.mates.read_text())["pairs"]:
        if options.only and pair["name"] not in options.only.split(","):
            continue
        files = [options.mates.parent / f"{pair[body]}.stl" for body in ("fixed", "moving")]
        command = [options.mortise, "assemble", *files, "--mates", options.mates, "--pair", pair["name"], "--json", *further]
        found = json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)
        counts = [found[key] for key in ("starts", "home", "home_without_symmetries")]
        sums = [a + b for a, b in zip(sums, counts)]
        kinds = ", ".join(s["kind"] for s in pair.get("symmetries", [])) or "-"
        print(f"| {pair['name']} | {kinds} | {counts[0]} | {counts[1]} | {counts[2]} | {100 * found['mate_drift']:.1f} |",
              flush=True)
    print(f"| all | | {sums[0]} | {sums[1]} | {sums[2]} | |")


if __name__ == "__main__":
    main()
