#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Checks that includes point one way, by the table of rooms in docs/architecture.md, and that the table allows
no more than what some file of the room includes.

Usage: include_direction_test.py [SOURCE_DIR]      check the tree
       include_direction_test.py --self-test       check that each kind of fault is found
"""

import pathlib
import re
import sys
import tempfile

INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]', re.MULTILINE)
ROW = re.compile(r"^\|\s*`(\w+)`\s*\|[^|]*\|([^|]*)\|\s*$", re.MULTILINE)
STD_HEADER = re.compile(r"^[a-z_0-9]+$")  # <vector>, <cstdint>: no dot, no slash


def rooms_table(architecture):
    """Room name -> the rooms it may include."""
    section = architecture.split("## Rooms", 1)[-1].split("\n## ", 1)[0]
    return {name: set(allowed.replace(",", " ").split()) for name, allowed in ROW.findall(section)}


def table_faults(table):
    """Names that are no room, and circles."""
    for room, allowed in table.items():
        for other in sorted(allowed - table.keys()):
            yield f"docs/architecture.md: room `{room}` may include `{other}`, which has no row"

    def reaches(room, goal, seen):
        for other in table.get(room, ()):
            if other == goal:
                return True
            if other not in seen and reaches(other, goal, seen | {other}):
                return True
        return False

    for room in table:
        if reaches(room, room, set()):
            yield f"docs/architecture.md: room `{room}` may include itself through others"


def included_room(name, own_room, is_public):
    """The room that an include names; None if it is not of this project."""
    parts = pathlib.PurePosixPath(name).parts
    if parts[0] == "mortise":
        return parts[1] if len(parts) > 2 else parts[-1]
    if is_public:
        return None
    return own_room if len(parts) == 1 else parts[0]


def file_faults(path, shown, room, is_public, table, used):
    """Faults of one file; adds the rooms that it includes to `used`."""
    text = path.read_text(encoding="utf-8")
    for match in INCLUDE.finditer(text):
        bracket, name = match.groups()
        where = f"{shown}:{text.count(chr(10), 0, match.start(1)) + 1}"
        if ".." in pathlib.PurePosixPath(name).parts:
            yield f"{where}: {name}: expected a path from include/ or src/, found .."
            continue
        ours = bracket == '"' or name.startswith("mortise/")
        if ours:
            if is_public and not name.startswith("mortise/"):
                yield f"{where}: {name}: a public header expects public headers, \"mortise/<room>/...\""
                continue
            target = included_room(name, room, is_public)
            used.add((room, target))
            if target != room and target not in table[room]:
                allowed = ", ".join(sorted(table[room])) or "no other room"
                yield f"{where}: {name}: room `{room}` may include {allowed}"
        elif is_public and not (STD_HEADER.match(name) or name.startswith("Eigen/")):
            yield f"{where}: {name}: a public header names only std and Eigen"


def tree_faults(source_dir):
    source_dir = pathlib.Path(source_dir)
    table = rooms_table((source_dir / "docs/architecture.md").read_text(encoding="utf-8"))
    if not table:
        yield "docs/architecture.md: expected a table of rooms under '## Rooms', found none"
        return
    yield from table_faults(table)
    seen, used = set(), set()
    for base, is_public in (("include/mortise", True), ("src", False)):
        for path in sorted((source_dir / base).rglob("*")):
            if not path.name.endswith((".hpp", ".hpp.in", ".cpp", ".h", ".inc")):
                continue
            shown = path.relative_to(source_dir)
            inside = path.relative_to(source_dir / base).parts
            if len(inside) < 2:
                yield f"{shown}: expected in a room, {base}/<room>/"
                continue
            room = inside[0]
            seen.add(room)
            if room not in table:
                yield f"{shown}: room `{room}` has no row in docs/architecture.md"
                continue
            yield from file_faults(path, shown, room, is_public, table, used)
    for path in sorted((source_dir / "apps").glob("*.?pp")):
        for match in INCLUDE.finditer(path.read_text(encoding="utf-8")):
            bracket, name = match.groups()
            if bracket == '"' and "/" in name and not name.startswith("mortise/"):
                yield f"{path.relative_to(source_dir)}: {name}: the program sees public headers only"
    for room in sorted(table.keys() - seen):
        directory = source_dir / "src" / room
        if not directory.is_dir():
            yield f"docs/architecture.md: room `{room}` has a row, but src/{room}/ is not there"
    for room in sorted(seen & table.keys()):
        for other in sorted(table[room] & table.keys()):
            if (room, other) not in used:
                yield f"docs/architecture.md: room `{room}` may include `{other}`, but no file of it does"


def self_test():
    """Builds a small tree, breaks it in each way and expects exactly one fault."""
    architecture = "## Rooms\n| `low` | . | |\n| `high` | . | low |\n| `free` | . | |\n## Next\n"
    good = {
        "docs/architecture.md": architecture,
        "include/mortise/low/a.hpp": "#include <vector>\n#include <Eigen/Core>\n",
        "include/mortise/high/b.hpp": '#include "mortise/low/a.hpp"\n',
        "src/low/a.cpp": '#include "mortise/low/a.hpp"\n#include <fftw3.h>\n#include "helper.hpp"\n',
        "src/low/helper.hpp": "",
        "src/free/c.cpp": "",
        "src/high/b.cpp": '#include "mortise/high/b.hpp"\n#include "low/helper.hpp"\n',
        "apps/main.cpp": '#include "mortise/high/b.hpp"\n#include "commands.hpp"\n',
    }
    broken = {
        "public header upwards": ("include/mortise/low/a.hpp", '#include "mortise/high/b.hpp"\n'),
        "source upwards": ("src/low/a.cpp", '#include "mortise/high/b.hpp"\n'),
        "private header upwards": ("src/low/a.cpp", '#include "high/private.hpp"\n'),
        "brackets do not hide it": ("src/low/a.cpp", "#include <mortise/high/b.hpp>\n"),
        "library in a public header": ("include/mortise/low/a.hpp", "#include <fftw3.h>\n"),
        "C header in a public header": ("include/mortise/low/a.hpp", "#include <math.h>\n"),
        "private header in a public one": ("include/mortise/low/a.hpp", '#include "low/helper.hpp"\n'),
        "parent directory": ("src/high/b.cpp", '#include "../low/helper.hpp"\n'),
        "program sees a private header": ("apps/main.cpp", '#include "low/helper.hpp"\n'),
        "room without a row": ("src/other/c.cpp", ""),
        "file outside all rooms": ("src/c.cpp", ""),
        "row without a room": ("docs/architecture.md", architecture.replace("## Next", "| `ghost` | . | |\n## Next")),
        "allowed, but not included": ("docs/architecture.md",
                                      architecture.replace("| `free` | . | |", "| `free` | . | low |")),
        "unknown name in the table": ("docs/architecture.md", architecture.replace("| low |", "| low, lo |")),
    }
    # Each of the two rooms is named, and that `low` never includes `high`.
    circle = {"docs/architecture.md": architecture.replace("| `low` | . | |", "| `low` | . | high |")}
    failures = 0

    def check(label, files, expected):
        nonlocal failures
        with tempfile.TemporaryDirectory() as directory:
            for name, text in files.items():
                path = pathlib.Path(directory, name)
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text(text, encoding="utf-8")
            faults = list(tree_faults(directory))
        if len(faults) != expected:
            failures += 1
            print(f"{label}: expected {expected} faults, found {faults}")

    check("good tree", good, 0)
    for label, (name, text) in broken.items():
        check(label, {**good, name: text}, 1)
    check("circle", {**good, **circle}, 3)
    return failures


def main():
    if sys.argv[1:] == ["--self-test"]:
        return 1 if self_test() else 0
    default = pathlib.Path(__file__).resolve().parents[2]
    faults = list(tree_faults(sys.argv[1] if len(sys.argv) > 1 else default))
    print("\n".join(faults) if faults else "all includes point one way")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
