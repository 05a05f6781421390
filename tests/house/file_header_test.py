#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Checks that each source file opens with the licence and one sentence on what it holds, and names no one machine's paths.

Usage: file_header_test.py [SOURCE_DIR]      check the tree
       file_header_test.py --self-test       check that each kind of fault is found
"""

import pathlib
import re
import sys
import tempfile

FOLDERS = ("apps", "bench", "cmake", "examples", "include", "scripts", "src", "tests")
LICENCE = "SPDX-License-Identifier: GPL-3.0-or-later"
SENTENCE = {  # a comment of at least two words, after "@file" if there is one
    ".cpp": re.compile(r"// \w+\W+\w"),
    ".hpp": re.compile(r"(/// @file\n)?//+ \w+\W+\w"),
    ".py": re.compile(r'(# |""")\w+\W+\w'),
    ".sh": re.compile(r"# \w+\W+\w"),
    ".cmake": re.compile(r"# \w+\W+\w"),
}
MACHINE_PATH = re.compile(r"(?<![\w.$}/])/(?:root|home|work)/\w")


def faults(shown, text, sentence):
    lines = text.splitlines()
    first = 1 if lines and lines[0].startswith("#!") else 0
    if len(lines) <= first or LICENCE not in lines[first]:
        yield f"{shown}:{first + 1}: expected '{LICENCE}'"
    elif sentence and not sentence.match("\n".join(lines[first + 1 : first + 3])):
        yield f"{shown}:{first + 2}: expected one sentence on what the file holds"
    for number, line in enumerate(lines, 1):
        if MACHINE_PATH.search(line):
            yield f"{shown}:{number}: a path of one machine"


def tree_faults(source_dir):
    source_dir = pathlib.Path(source_dir)
    for folder in FOLDERS:
        for path in sorted((source_dir / folder).rglob("*")):
            if not path.is_file() or "__pycache__" in path.parts or "data" in path.parts or "golden" in path.parts:
                continue
            sentence = SENTENCE.get(path.suffix)
            if sentence or path.name == "CMakeLists.txt" or path.read_bytes()[:2] == b"#!":
                shown = path.relative_to(source_dir)
                yield from faults(shown, path.read_text(encoding="utf-8"), sentence)


def self_test():
    """One good file of each kind, and each fault once."""
    cases = [
        ("good.cpp", f"// {LICENCE}\n// Sums of waves.\n", 0),
        ("good.hpp", f"// {LICENCE}\n/// @file\n/// Sums of waves.\n#pragma once\n", 0),
        ("good.py", f'#!/usr/bin/env python3\n# {LICENCE}\n"""Sums of waves."""\n', 0),
        ("CMakeLists.txt", f"# {LICENCE}\nadd_subdirectory(core)\n", 0),
        ("no_licence.cpp", "// Sums of waves.\n", 1),
        ("no_sentence.cpp", f"// {LICENCE}\n#include <vector>\n", 1),
        ("empty.cpp", "", 1),
        ("machine.cpp", f"// {LICENCE}\n// Sums of waves.\nauto p = \"/ho" + "me/me/x\";\n", 1),
    ]
    failures = 0
    for name, text, expected in cases:
        with tempfile.TemporaryDirectory() as directory:
            path = pathlib.Path(directory, "src", "room", name)
            path.parent.mkdir(parents=True)
            path.write_text(text, encoding="utf-8")
            found = list(tree_faults(directory))
        if len(found) != expected:
            failures += 1
            print(f"{name}: expected {expected} faults, found {found}")
    return failures


def main():
    if sys.argv[1:] == ["--self-test"]:
        return 1 if self_test() else 0
    default = pathlib.Path(__file__).resolve().parents[2]
    found = list(tree_faults(sys.argv[1] if len(sys.argv) > 1 else default))
    print("\n".join(found) if found else "all files open with the licence and a sentence")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
