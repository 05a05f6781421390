#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Checks that lines of the documents are at most 100 characters long and that no table has a row twice; in decisions.md
no table decides the same thing twice.

Tables, code blocks, headings, pictures and lines without a blank to break at (links) may be longer.

Usage: document_lines_test.py [SOURCE_DIR]      check README.md, CHANGELOG.md, CONTRIBUTING.md and docs/*.md
       document_lines_test.py --self-test       check that each kind of fault is found
"""

import pathlib
import re
import sys

MOST = 100


def faults(shown, text):
    code, table = False, {}
    for number, line in enumerate(text.splitlines(), 1):
        if line.lstrip().startswith("```"):
            code = not code
        if not line.startswith("|"):
            table = {}
        elif not code and re.search(r"\w", line):
            row = line.split("|")[1].strip() if str(shown).endswith("decisions.md") else line
            if row in table:
                yield f"{shown}:{number}: the row of line {table[row]} again"
            table.setdefault(row, number)
        if code or line.startswith(("|", "#", "    ", "![")) or len(line) <= MOST:
            continue
        if " " in line[:MOST].strip().removeprefix("- "):
            yield f"{shown}:{number}: {len(line)} characters; break the line at {MOST}"


def self_test():
    long = "word " * 25
    cases = [("short\n", 0), (long + "\n", 1), (f"| {long} |\n", 0), (f"```\n{long}\n```\n{long}\n", 1),
             (f"# {long}\n", 0), ("- https://" + "x" * 120 + "\n", 0), ("| a | b |\n|---|---|\n| 1 | 2 |\n| 1 | 2 |\n", 1),
             ("| a |\n|---|\n| 1 |\n\n| a |\n|---|\n| 1 |\n", 0)]
    wrong = [text for text, expected in cases if len(list(faults("case", text))) != expected]
    if len(list(faults("docs/decisions.md", "| a | 1 |\n| a | 2 |\n"))) != 1:
        wrong.append("one decision twice")
    for text in wrong:
        print(f"self-test: {text[:60]!r}: found {list(faults('case', text))}")
    return 1 if wrong else 0


def main():
    if "--self-test" in sys.argv:
        return self_test()
    root = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).parents[2])
    documents = [root / name for name in ("README.md", "CHANGELOG.md", "CONTRIBUTING.md")] + sorted((root / "docs").glob("*.md"))
    found = [fault for path in documents for fault in faults(path.relative_to(root), path.read_text(encoding="utf-8"))]
    print("\n".join([*found, f"{len(documents)} documents, {len(found)} faults"]))
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
