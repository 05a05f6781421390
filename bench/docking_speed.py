#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Times `mortise dock` on seven pairs, by stage, and prints the README's speed table as Markdown.

Usage: docking_speed.py [--program MORTISE] [--table pairs.csv] [--only NAME,...] [--repeat N] [--quick]
                        [-- further options of `mortise dock`]

The pairs are the two samples of molecules/ and five of a table as `mortise benchmark` takes it; those that are not
there are left out with a message. Every run starts from the same random orientation of the ligand (seed 1). A row is
the run of median CPU time among N (default 3), on one thread, with the CPU seconds divided among the stages by their
shares of the wall time, so that other work on the machine does not count. The wall time is that of a further run on all
cores; it means something on an otherwise idle machine only.
"""

import argparse
import csv
import json
import os
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[1]
BENCHMARK_PAIRS = ("1JTG", "1A2K", "1ML0", "2G77", "4G6M")
# Column and the figures of the run file that it sums up.
STAGES = (("read", ("seconds_read",)), ("set up", ("seconds_plan", "seconds_prepare")), ("search", ("seconds_search",)),
          ("contacts", ("seconds_rank_contact",)), ("polish", ("seconds_rank_polish",)))
COLUMNS = ("pair", "atoms", "grid", "CPU, s", *(name for name, _ in STAGES), "other",
           f"wall on {os.cpu_count()} cores, s", "peak MB")


def note(text):
    print(f"docking_speed: {text}", file=sys.stderr)


def sample_pairs():
    """Name, fixed and moving file of the pairs in molecules/."""
    for name, suffix in (("1HPV", ".pdb"), ("1TII", ".pdb.gz")):
        stem = ROOT / "molecules" / name.lower()
        yield name, f"{stem}_receptor{suffix}", f"{stem}_ligand{suffix}"


def benchmark_pairs(table):
    """The same of BENCHMARK_PAIRS, from the table's folder."""
    if not table.is_file():
        note(f"skipped {', '.join(BENCHMARK_PAIRS)}: no {table} (--table names another)")
        return
    with open(table, encoding="utf-8", newline="") as file:
        rows = {row["name"]: row for row in csv.DictReader(file)}
    for name in BENCHMARK_PAIRS:
        if name in rows:
            yield name, str(table.parent / rows[name]["fixed"]), str(table.parent / rows[name]["moving"])
        else:
            note(f"skipped {name}: not in {table}")


def dock(program, fixed, moving, threads, run_file, further):
    """One run: the figures of its file, with grid, atoms and CPU seconds added."""
    command = [str(program), "dock", fixed, moving, "-o", run_file, "--force", "--random-start", "1",
               "--threads", str(threads), "--json", "--quiet", *further]
    with tempfile.TemporaryFile("w+") as out, tempfile.TemporaryFile("w+") as err:
        process = subprocess.Popen(command, stdout=out, stderr=err)
        _, status, usage = os.wait4(process.pid, 0)  # the usage of this child alone
        process.returncode = os.waitstatus_to_exitcode(status)
        out.seek(0)
        err.seek(0)
        if process.returncode != 0:
            raise RuntimeError(f"{' '.join(command)}: exit {process.returncode}: {err.read().strip()}")
        figures = json.load(out)
    info = json.loads(subprocess.run([str(program), "info", run_file, "--json"], check=True, capture_output=True,
                                     text=True).stdout)
    figures["atoms"] = [info[body]["knots"]["count"] for body in ("fixed", "moving")]
    figures["cpu_seconds"] = usage.ru_utime + usage.ru_stime
    return figures


def table_row(name, runs, many):
    """Cells for COLUMNS. @param runs on one thread; many: the run on all cores"""
    f = sorted(runs, key=lambda run: run["cpu_seconds"])[(len(runs) - 1) // 2]
    share = f["cpu_seconds"] / f["seconds"]
    stages = [share * sum(f.get(key, 0.0) for key in keys) for _, keys in STAGES]
    stages.append(max(0.0, f["cpu_seconds"] - sum(stages)))
    return (name, " + ".join(f"{n:,}" for n in f["atoms"]), " x ".join(f"{n:.0f}" for n in f["grid"]),
            f"{f['cpu_seconds']:.1f}", *(f"{s:.2f}" for s in stages), f"{many['seconds']:.1f}",
            f"{f['peak_memory_mb']:.0f}")


def main():
    split = sys.argv.index("--") if "--" in sys.argv else len(sys.argv)
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", type=pathlib.Path, default=ROOT / "build/release/apps/mortise",
                        help="the mortise to time (default: the release build)")
    parser.add_argument("--table", type=pathlib.Path, default=ROOT / "../shared/bm5/pairs.csv",
                        help="table of known complexes (default: ../shared/bm5/pairs.csv)")
    parser.add_argument("--only", default="", help="names of pairs, by commas")
    parser.add_argument("--repeat", type=int, default=3, help="runs of which the median counts (default: 3)")
    parser.add_argument("--quick", action="store_true", help="the sample pairs, one run each")
    arguments = parser.parse_args(sys.argv[1:split])
    further = sys.argv[split + 1:]
    program = arguments.program.resolve()
    if not os.access(program, os.X_OK):
        sys.exit(f"docking_speed: {program}: expected the program; "
                 "cmake --preset release && cmake --build --preset release")

    pairs = [*sample_pairs(), *(() if arguments.quick else benchmark_pairs(arguments.table))]
    only = [name for name in arguments.only.split(",") if name]
    print("| " + " | ".join(COLUMNS) + " |\n" + "|" + "---|" * len(COLUMNS), flush=True)
    failures = 0
    with tempfile.TemporaryDirectory() as folder:
        run_file = os.path.join(folder, "run.h5")
        for name, fixed, moving in pairs:
            if only and name not in only:
                continue
            try:
                runs = [dock(program, fixed, moving, 1, run_file, further)
                        for _ in range(1 if arguments.quick else max(1, arguments.repeat))]
                many = dock(program, fixed, moving, 0, run_file, further)
                print("| " + " | ".join(table_row(name, runs, many)) + " |", flush=True)
            except (RuntimeError, ValueError, KeyError, TypeError, subprocess.CalledProcessError) as error:
                failures += 1
                note(f"{name}: {error}")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
