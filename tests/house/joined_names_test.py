#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Checks that no two sources of one folder give one name to two things: joined builds (MORTISE_JOINED) compile them as one.

It looks at definitions that begin a line: types, aliases, constants, and functions with the same parameters. Left out are
sources compiled once per instruction set and those with SKIP_UNITY_BUILD_INCLUSION; tests/consume and tests/reference are
no folders of one target.

Usage: joined_names_test.py [SOURCE_DIR]      check the tree
       joined_names_test.py --self-test       check that each kind of fault is found
"""

import collections
import pathlib
import re
import sys
import tempfile

FOLDERS = ("apps", "src/*", "src/parts/step", "tests/*")
TYPE = re.compile(r"^(?:struct|class|enum class|enum) (\w+)(?! *;)\b(?=[^;]*$)", re.MULTILINE)
ALIAS = re.compile(r"^using (\w+) = ([^;]*);", re.MULTILINE)
CONSTANT = re.compile(r"^(?:constexpr|const|static const|inline constexpr) [\w:<>,*& ]+ (\w+)(?:\[\w*\])* ?[={]", re.MULTILINE)
FUNCTION = re.compile(r"^(?!return|else|typedef|using|TEST|BENCHMARK)(?:[\w\[\]]+ )*[\w:<>,&*]+[ &*]+(\w+)(\([^;{}]*\))[^;{}()]*\{",
                      re.MULTILINE)
ALONE = re.compile(r"set_source_files_properties\(\s*([^)]*?)\s+(?:TARGET_DIRECTORY \w+ )?PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON")


def names(text):
    """(name, what must be unlike in another file) of each definition; None: any other definition is a fault."""
    for match in TYPE.finditer(text):
        yield match[1], None
    for match in CONSTANT.finditer(text):
        yield match[1], None
    for match in ALIAS.finditer(text):
        yield match[1], "= " + match[2]
    for match in FUNCTION.finditer(text):
        parameters = [re.sub(r"( \w+)?( = .*)?$", "", " ".join(p.split())) for p in match[2][1:-1].split(", ")]
        yield match[1], "(" + ", ".join(parameters) + ")"


def faults(source_dir):
    source_dir = pathlib.Path(source_dir)
    for folder in sorted(f for pattern in FOLDERS for f in source_dir.glob(pattern) if f.is_dir() and f.name not in ("consume", "reference")):
        lists = folder / "CMakeLists.txt"
        alone = set()
        if lists.is_file():
            for match in ALONE.finditer(lists.read_text(encoding="utf-8")):
                alone.update(match[1].split())
        seen = collections.defaultdict(dict)
        for path in sorted(folder.glob("*.cpp")):
            if path.name in alone or path.name.endswith("_isa.cpp"):
                continue
            for name, kind in names(path.read_text(encoding="utf-8")):
                for other, other_kind in seen[name].items():
                    alias = kind is not None and kind == other_kind and kind.startswith("=")
                    overload = kind is not None and other_kind is not None and kind != other_kind and kind[0] == "("
                    if other != path.name and not alias and not overload:
                        yield f"{path.relative_to(source_dir)}: `{name}` is defined in {other} too"
                seen[name].setdefault(path.name, kind)


def self_test():
    one = ("namespace {\nusing Json = a::b;\nconstexpr int kOne = 1;\nstruct Row {\n};\nclass Later;\n"
           "int twice(int x) {\n  return 2 * x;\n}\n}\nvoid Other::member() {\n}\n")
    two = {
        "constant": "constexpr double kOne{2};\n", "type": "struct Row {\n  int a;\n};\n", "alias": "using Json = c;\n",
        "function": "double twice(int other) {\n}\n", "": "using Json = a::b;\nint twice(double x) {\n}\nclass Later;\n"
        "void Other::member() {\n}\nvoid kTwo(int kOne) {\n}\n",
    }
    failures = 0
    for label, text in two.items():
        with tempfile.TemporaryDirectory() as directory:
            folder = pathlib.Path(directory, "src/room")
            folder.mkdir(parents=True)
            (folder / "one.cpp").write_text(one, encoding="utf-8")
            (folder / "two.cpp").write_text(text, encoding="utf-8")
            found = list(faults(directory))
            if len(found) != (1 if label else 0):
                failures += 1
                print(f"{label or 'good'}: found {found}")
            (folder / "CMakeLists.txt").write_text(
                "set_source_files_properties(two.cpp TARGET_DIRECTORY x PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)\n", encoding="utf-8")
            if list(faults(directory)):
                failures += 1
                print(f"{label}: a source that stays alone was looked at")
    return failures


def main():
    if sys.argv[1:] == ["--self-test"]:
        return 1 if self_test() else 0
    default = pathlib.Path(__file__).resolve().parents[2]
    found = list(faults(sys.argv[1] if len(sys.argv) > 1 else default))
    print("\n".join(found) if found else "all names are unlike within their folders")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
