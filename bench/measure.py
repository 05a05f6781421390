#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Measures the figures of README and docs/ and writes them there: one command, one commit, one machine.

Usage: measure.py [--build DIR] [--shared DIR] [--out FOLDER] [--quick] [--only NAME,...] [--again] [--dry-run]
       measure.py --write [--out FOLDER]     puts the figures measured so far into the documents
       measure.py --places                   which table stands where in the documents
       measure.py --check                    every table that a document asks for is one that can be measured

The measurements are listed in measurements.py. Each runs a program of the build folder (default build/release) or a
script of this folder; where a program or a data set is missing the measurement is skipped with a message. Results go to
FOLDER/figures.json and FOLDER/figures.md (default out/figures) after each measurement, with commit, machine, date and
load; a measurement that the file has already, of the same commit and form, is not made again without --again.

--quick takes a few minutes and shows that everything runs; its figures are not written into documents.

In a document a table stands between `<!-- measure: NAME -->` and `<!-- /measure -->`. --write replaces what lies
between by the table and one line that says commit, machine, date and command.
"""

import argparse
import datetime
import json
import os
import pathlib
import re
import subprocess
import sys
import time

import measurements

ROOT = pathlib.Path(__file__).resolve().parents[1]
MARKED = re.compile(r"<!-- measure: ([a-z0-9_]+) -->\n(.*?)<!-- /measure -->", re.DOTALL)


def note(text):
    print(f"measure: {text}", file=sys.stderr, flush=True)


def output_of(*command, cwd=ROOT):
    """The command's output without blanks at its ends, or "" if it failed."""
    try:
        done = subprocess.run(command, cwd=cwd, capture_output=True, text=True, check=False)
    except OSError:
        return ""
    return done.stdout.strip() if done.returncode == 0 else ""


def commit(build):
    """Of the checkout that holds the build folder; "+" if files differ from it, or the program is older than it."""
    name = output_of("git", "rev-parse", "--short=7", "HEAD", cwd=build)
    changed = output_of("git", "status", "--porcelain", "--untracked-files=no", cwd=build)
    when = output_of("git", "log", "-1", "--format=%ct", cwd=build)
    program = build / "apps" / "mortise"
    old = when and program.is_file() and program.stat().st_mtime < int(when)
    return (name or "unknown") + ("+" if changed or old else "")


def machine():
    try:
        lines = pathlib.Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
    except OSError:
        lines = []
    models = [line.split(":", 1)[1].strip() for line in lines if line.startswith("model name")]
    wide = "AVX-512" if any("avx512f" in line for line in lines) else "AVX2" if any("avx2" in line for line in lines) else ""
    return ", ".join(filter(None, (models[0] if models else "unknown processor", f"{os.cpu_count()} cores", wide)))


def compiler(build):
    cache = build / "CMakeCache.txt"
    for line in cache.read_text(encoding="utf-8").splitlines() if cache.is_file() else ():
        if line.startswith("CMAKE_CXX_COMPILER:"):
            return (output_of(line.split("=", 1)[1], "--version") or "unknown").splitlines()[0]
    return "unknown"


def read_store(folder):
    path = folder / "figures.json"
    return json.loads(path.read_text(encoding="utf-8")) if path.is_file() else {}


def markdown(table):
    lines = ["| " + " | ".join(table["columns"]) + " |", "|" + "---|" * len(table["columns"])]
    lines += ["| " + " | ".join(str(cell) for cell in row) + " |" for row in table["rows"]]
    return "\n".join(lines) + "\n" + "".join(f"\n{line}\n" for line in table.get("notes", ()))


def origin(entry):
    """One line, or a few of at most 100 characters, that say where the figures come from."""
    words = (f"*Commit `{entry['commit']}`, {entry['date'][:10]}, {entry['machine']}, load {entry['load']:.1f}"
             f"{', quick form' if entry['quick'] else ''}: `bench/measure.py --only {entry['name']}`.*").split(" ")
    lines = [words[0]]
    for word in words[1:]:
        if len(lines[-1]) + 1 + len(word) <= 100:
            lines[-1] += " " + word
        else:
            lines.append(word)
    return "\n".join(lines)


def write_store(folder, store):
    folder.mkdir(parents=True, exist_ok=True)
    for name, text in (("figures.json", json.dumps(store, indent=1)),
                       ("figures.md", "# Figures\n" + "".join(
                           f"\n## {entry['name']}: {name}\n\n{markdown(table)}\n{origin(entry)}\n"
                           for entry in store.values() for name, table in entry["tables"].items()))):
        partial = folder / (name + ".partial")
        partial.write_text(text + ("" if text.endswith("\n") else "\n"), encoding="utf-8")
        partial.replace(folder / name)


def measure(arguments):
    """Runs what is asked for; the number of failures."""
    build = arguments.build.resolve()
    store = read_store(arguments.out)
    context = measurements.Context(ROOT, build, arguments.shared, arguments.quick, arguments.out.resolve())
    only = [name for name in arguments.only.split(",") if name]
    unknown = set(only) - {m.name for m in measurements.ALL}
    if unknown:
        sys.exit(f"measure: no measurement {', '.join(sorted(unknown))}; expected some of "
                 + ", ".join(m.name for m in measurements.ALL))
    here = commit(build)
    if here.endswith("+"):
        note(f"commit {here}: files are changed or the program is older than the commit; say so where you use the figures")
    failures = 0
    for m in measurements.ALL:
        if only and m.name not in only or not only and m.on_request:
            continue
        had = store.get(m.name)
        if had and had["commit"] == here and had["quick"] == arguments.quick and not arguments.again:
            note(f"{m.name}: there already (--again measures anew)")
            continue
        missing = m.missing(context)
        if missing:
            note(f"{m.name}: skipped: {missing}")
            continue
        note(f"{m.name}: about {m.quick_minutes if arguments.quick else m.minutes:g} min")
        if arguments.dry_run:
            for command in m.commands(context):
                print("  " + " ".join(str(word) for word in command))
            continue
        start, load = time.monotonic(), os.getloadavg()[0]
        try:
            tables = m.run(context)
        except subprocess.CalledProcessError as error:
            failures += 1
            note(f"{m.name}: failed: {' '.join(map(str, error.cmd))}: exit {error.returncode}: {(error.stderr or '').strip()[-800:]}")
            continue
        except (ValueError, KeyError, IndexError, OSError) as error:
            failures += 1
            note(f"{m.name}: failed: {type(error).__name__}: {error}")
            continue
        store[m.name] = {"name": m.name, "commit": here, "quick": arguments.quick, "machine": machine(),
                         "compiler": compiler(build), "load": max(load, os.getloadavg()[0]),
                         "date": datetime.datetime.now(datetime.timezone.utc).isoformat(timespec="seconds"),
                         "seconds": round(time.monotonic() - start, 1), "tables": tables}
        write_store(arguments.out, store)
    return failures


def documents():
    yield ROOT / "README.md"
    yield from sorted((ROOT / "docs").glob("*.md"))


def places():
    """Name of the table, document and line of each marker."""
    for path in documents():
        text = path.read_text(encoding="utf-8")
        for match in MARKED.finditer(text):
            yield match.group(1), path.relative_to(ROOT), text.count("\n", 0, match.start()) + 1


def check():
    known = {name for m in measurements.ALL for name in m.tables} | set(measurements.SUMMARIES)
    faults = [f"{path}:{line}: no measurement makes the table {name}" for name, path, line in places() if name not in known]
    for path in documents():
        text = path.read_text(encoding="utf-8")
        if not text.count("<!-- measure:") == text.count("<!-- /measure -->") == len(MARKED.findall(text)):
            faults.append(f"{path.relative_to(ROOT)}: markers `<!-- measure: NAME -->` and `<!-- /measure -->` do not pair")
    print("\n".join([*faults, f"{len(list(places()))} tables, {len(faults)} faults"]))
    return 1 if faults else 0


def write(arguments):
    """Tables into documents. Those that were not measured, or with --quick, stay as they are."""
    store = read_store(arguments.out)
    tables = {name: (table, [entry]) for entry in store.values() for name, table in entry["tables"].items()}
    for name, make in measurements.SUMMARIES.items():
        try:
            table, used = make(store)
            tables[name] = (table, [store[m] for m in used])
        except KeyError as error:
            note(f"{name}: stays as it is: {error.args[0]} is not measured")
    written = set()

    def replaced(match):
        name = match.group(1)
        if name not in tables:
            note(f"{name}: stays as it is: not measured")
            return match.group(0)
        table, entries = tables[name]
        if any(entry["quick"] for entry in entries):
            note(f"{name}: stays as it is: measured with --quick only")
            return match.group(0)
        written.update(entry["commit"] for entry in entries)
        # A summary of several: where each was measured stands in its own row.
        source = origin(entries[0]) if len(entries) == 1 else origin({**entries[-1], "name": ",".join(e["name"] for e in entries)})
        return f"<!-- measure: {name} -->\n{markdown(table)}\n{source}\n<!-- /measure -->"

    for path in documents():
        text = path.read_text(encoding="utf-8")
        new = MARKED.sub(replaced, text)
        if new != text:
            path.write_text(new, encoding="utf-8")
            note(f"wrote {path.relative_to(ROOT)}")
    if len(written) > 1:
        note(f"the tables written come from {len(written)} commits ({', '.join(sorted(written))}): measure again from one")
    return 0


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build" / "release")
    parser.add_argument("--shared", type=pathlib.Path, default=(ROOT / ".." / "shared").resolve(),
                        help="data sets as scripts/data lays them out (default: ../shared)")
    parser.add_argument("--out", type=pathlib.Path, default=ROOT / "out" / "figures")
    parser.add_argument("--only", default="", help="names of measurements, by commas")
    for flag in ("quick", "again", "dry-run", "write", "places", "check"):
        parser.add_argument(f"--{flag}", action="store_true")
    arguments = parser.parse_args()
    if arguments.check:
        return check()
    if arguments.places:
        for name, path, line in places():
            print(f"{name}\t{path}:{line}")
        return 0
    if arguments.write:
        return write(arguments)
    return 1 if measure(arguments) else 0


if __name__ == "__main__":
    sys.exit(main())
