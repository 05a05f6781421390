#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Times `mortise dock` on seven pairs and prints the README's speed table as Markdown.

The pairs are the two samples of molecules/ and five of a table as `mortise benchmark` takes it; those that are not
there are left out with a message. Every run starts from the same random orientation of the ligand (seed 1).
Wall times and the ratio to bare FFTW mean something only on an otherwise idle machine; CPU time less so.
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
ROTATIONS = (3600, 54000)
THREADS = (1, 2)
COLUMNS = ("pair", "atoms", "grid", "rotations", "threads", "wall, s", "CPU, s", "search, s",
           "ratio (a) to bare FFTW", "peak MB")


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


def output_of(*command):
    """The command's output without blanks at its ends, or None if it failed."""
    try:
        done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    except OSError:
        return None
    return done.stdout.strip() if done.returncode == 0 else None


def processor():
    try:
        lines = pathlib.Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
    except OSError:
        return "unknown"
    models = [line.split(":", 1)[1].strip() for line in lines if line.startswith("model name")]
    return f"{models[0] if models else 'unknown'}, {os.cpu_count()} cores"


def compiler(program):
    """First line of --version of the compiler that the program's build folder is set up for."""
    for folder in program.parents:
        cache = folder / "CMakeCache.txt"
        if cache.is_file():
            for line in cache.read_text(encoding="utf-8").splitlines():
                if line.startswith("CMAKE_CXX_COMPILER:"):
                    return (output_of(line.split("=", 1)[1], "--version") or "unknown").splitlines()[0]
    return "unknown (the program is not in a build folder)"


def commit(program):
    name = output_of("git", "rev-parse", "--short", "HEAD")
    if not name:
        return "unknown"
    if output_of("git", "status", "--porcelain", "--untracked-files=no"):
        name += " with changes"
    when = output_of("git", "log", "-1", "--format=%ct")
    if when and program.stat().st_mtime < int(when):
        name += "; the program is older than that, build it again"
    return name


def dock(program, fixed, moving, rotations, threads, run_file):
    """One run: its figures as `--json` gives them, with atoms and CPU seconds added."""
    command = [str(program), "dock", fixed, moving, "-o", run_file, "--force", "--random-start", "1",
               "--rotations", str(rotations), "--threads", str(threads), "--json", "--quiet"]
    with tempfile.TemporaryFile("w+") as out, tempfile.TemporaryFile("w+") as err:
        process = subprocess.Popen(command, stdout=out, stderr=err)
        _, status, usage = os.wait4(process.pid, 0)  # the usage of this child alone
        process.returncode = os.waitstatus_to_exitcode(status)
        out.seek(0)
        err.seek(0)
        if process.returncode != 0:
            raise RuntimeError(f"{' '.join(command)}: exit {process.returncode}: {err.read().strip()}")
        figures = json.load(out)
    info = json.loads(output_of(str(program), "info", run_file, "--json"))
    figures["atoms"] = [info[body]["knots"]["count"] for body in ("fixed", "moving")]
    figures["cpu_seconds"] = usage.ru_utime + usage.ru_stime
    return figures


def table_row(name, rotations, threads, f):
    return (name, " + ".join(f"{n:,}" for n in f["atoms"]), " x ".join(str(n) for n in f["grid"]), f"{rotations:,}",
            str(threads), f"{f['seconds']:.1f}", f"{f['cpu_seconds']:.1f}", f"{f['seconds_search']:.1f}",
            f"{f['fft_ratio']:.2f}", f"{f['peak_memory_mb']:.0f}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", type=pathlib.Path, default=ROOT / "build/release/apps/mortise",
                        help="the mortise to time (default: the release build)")
    parser.add_argument("--table", type=pathlib.Path, default=ROOT / "../shared/bm5/pairs.csv",
                        help="table of known complexes (default: ../shared/bm5/pairs.csv)")
    parser.add_argument("--quick", action="store_true", help="only 3,600 rotations")
    arguments = parser.parse_args()
    program = arguments.program.resolve()
    if not os.access(program, os.X_OK):
        sys.exit(f"docking_speed: {program}: expected the program; "
                 "cmake --preset release && cmake --build --preset release")

    def line(cells):
        print("| " + " | ".join(cells) + " |", flush=True)

    print(f"Processor: {processor()}  \nCompiler: {compiler(program)}  \nCommit: {commit(program)}  \n"
          f"Command: `bench/docking_speed.py{' --quick' if arguments.quick else ''}`\n")
    line(COLUMNS)
    line(["---"] * len(COLUMNS))
    failures = 0
    with tempfile.TemporaryDirectory() as folder:
        for name, fixed, moving in [*sample_pairs(), *benchmark_pairs(arguments.table)]:
            for rotations in ROTATIONS[:1] if arguments.quick else ROTATIONS:
                for threads in THREADS:
                    try:
                        figures = dock(program, fixed, moving, rotations, threads, os.path.join(folder, "run.h5"))
                        line(table_row(name, rotations, threads, figures))
                    except (RuntimeError, ValueError, KeyError, TypeError) as error:
                        failures += 1
                        note(f"{name}: {error}")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
