#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Checks how bench/measure.py reads tables, puts them into documents and finds wrong markers.

Usage: measure_test.py SOURCE_DIR
"""

import argparse
import contextlib
import io
import json
import pathlib
import sys
import tempfile


def entry(name, quick, rows):
    return {"name": name, "commit": "abcdef0", "quick": quick, "machine": "one machine of many words, 2 cores, AVX-512",
            "compiler": "gcc", "load": 0.5, "date": "2026-01-31T12:00:00+00:00", "seconds": 1.0,
            "tables": {name: {"columns": ["a", "b"], "rows": rows, "notes": []}}}


def main():
    sys.path.insert(0, str(pathlib.Path(sys.argv[1]) / "bench"))
    sys.dont_write_bytecode = True
    import measure
    import measurements

    failures = []

    def expect(found, wanted, what):
        if found != wanted:
            failures.append(f"{what}: expected {wanted!r}, found {found!r}")

    tables = measurements.markdown_tables("text\n| a | b |\n|---|---|\n| 1 | 2 |\n\n3 pairs\n\n| c |\n|---|\n| 4 |\n")
    expect(tables, [{"columns": ["a", "b"], "rows": [["1", "2"]], "notes": ["3 pairs"]},
                    {"columns": ["c"], "rows": [["4"]], "notes": []}], "tables of a text")
    expect(measurements.numbers_of_mating("36 pairs: 35 at rank 1, 36 within the top 10, 36 found; 30 within 0.2% of the diameter"),
           (36, 35, 36, 30), "last line of mating_table.py")

    with tempfile.TemporaryDirectory() as name:
        measure.ROOT = pathlib.Path(name)
        readme = measure.ROOT / "README.md"
        (measure.ROOT / "docs").mkdir()
        block = "<!-- measure: {} -->\nold\n<!-- /measure -->\n"
        readme.write_text("before\n" + block.format("speed") + block.format("gap") + block.format("fcl") + "after\n")
        store = {e["name"]: e for e in (entry("speed", False, [["1", "2"]]), entry("gap", True, [["3", "4"]]))}
        (measure.ROOT / "figures.json").write_text(json.dumps(store))
        with contextlib.redirect_stderr(io.StringIO()):
            measure.write(argparse.Namespace(out=measure.ROOT))
        text = readme.read_text()
        expect("| 1 | 2 |" in text and "`abcdef0`" in text and "before\n<!-- measure: speed -->\n" in text, True, "table written")
        expect(text.count("old"), 2, "tables that are quick or not measured stay")
        expect(max(map(len, text.splitlines())) <= 100, True, "lines wrap")
        once = text
        with contextlib.redirect_stderr(io.StringIO()):
            measure.write(argparse.Namespace(out=measure.ROOT))
        expect(readme.read_text(), once, "written twice")
        with contextlib.redirect_stdout(io.StringIO()):
            expect(measure.check(), 0, "good markers")
            readme.write_text(text + block.format("nonsense"))
            expect(measure.check(), 1, "a table that nothing measures")
            readme.write_text(text + "<!-- measure: speed -->\n")
            expect(measure.check(), 1, "a marker without its end")

    print("\n".join([*failures, f"{len(failures)} faults"]))
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
