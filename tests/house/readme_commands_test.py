#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs the commands that README.md shows, in order, in one empty directory, and compares what they print with what is shown.

Commands are the lines "$ ..." of ```console blocks; the lines below one, up to the next, are its standard output. Commands
that start with `mortise` run the program under test and must exit with 0; those that start with `scripts/` must exist and
be executable, their output is not shown; any other command is a fault. What is compared:

- Line by line, without empty lines at the end. White space between words does not count.
- Words must be the same. A number may differ by 1%; one with decimals also by 2 in its last decimal, or in the third
  where it has more: processors round differently, and polishing stops a little elsewhere. Whole numbers below 100
  must hence be the same.
- A number before s, ms, us, MB, thread or threads may be any: it is the machine's.
- Lines that begin with a whole number and follow each other are a table of poses. Rows of the same score (their first
  number with decimals, by the tolerance above) may stand in another order; their ranks still count up. Of rows that
  score like the table's last one the score alone is compared: another such pose may come first.

Every ```cpp block must stand, as it is, in a file of tests/consume, which house.consume compiles.

Usage: readme_commands_test.py README.md PROGRAM [--update]
       readme_commands_test.py --self-test      check that each kind of difference is found

With --update the output shown below each `mortise` command becomes what the command prints now.
"""

import os
import pathlib
import re
import subprocess
import sys
import tempfile

CPP_BLOCK = re.compile(r"^```cpp\n(.*?)^```", re.MULTILINE | re.DOTALL)
BLOCK = re.compile(r"^```console\n(.*?)^```", re.MULTILINE | re.DOTALL)
WORD = re.compile(r"(?P<before>[(\[]*)(?P<number>[-+]?\d+(?:\.\d+)?(?:e[-+]?\d+)?)?(?P<after>.*)")
ROW = re.compile(r"\s*(\d+)\s+(?=(\S+\s+)*[-+]?\d+\.\d+(\s|$))")
SCORE = re.compile(r"(?<!\S)[-+]?\d+\.\d+(?!\S)")
OF_THE_MACHINE = {"s", "ms", "us", "MB", "thread", "threads"}


def transcripts(readme):
    """(command, output shown) of all blocks; a trailing backslash joins lines of a command."""
    for block in BLOCK.findall(readme):
        for part in re.split(r"^\$ ", block.replace("\\\n", " "), flags=re.MULTILINE)[1:]:
            command, _, output = part.partition("\n")
            yield command.strip(), output


def words(line):
    """Each word as (text before and after its number, the number as text or None)."""
    result = []
    for text in line.split():
        match = WORD.fullmatch(text)
        number = match["number"]
        if number is None or re.match(r"[\w/-]|\.\w", match["after"]):  # 1hpv.h5 is a name
            result.append((text, None))
        else:
            result.append((match["before"] + "#" + match["after"], number))
    return result


def near(shown, printed):
    a, b = float(shown), float(printed)
    slack = 0.01 * abs(a)
    if "." in shown:
        slack = max(slack, 2 * 10.0 ** -min(len(re.split(r"[.e]", shown)[1]), 3))
    return abs(a - b) <= slack * (1 + 1e-9)


def same_line(shown, printed):
    a, b = words(shown), words(printed)
    if len(a) != len(b):
        return False
    for i, ((text, number), (other_text, other_number)) in enumerate(zip(a, b)):
        if text != other_text or (number is None) != (other_number is None):
            return False
        following = a[i + 1][0].rstrip(",.;:)") if i + 1 < len(a) else ""
        if number is not None and following not in OF_THE_MACHINE and not near(number, other_number):
            return False
    return True


def tables(lines):
    """(first, past the last) of each run of table rows."""
    first = None
    for i, line in enumerate([*lines, ""]):
        if ROW.match(line) and first is None:
            first = i
        if not ROW.match(line) and first is not None:
            yield first, i
            first = None


def row(line):
    """(rank, the rest, the score)"""
    match = ROW.match(line)
    return match[1], line[match.end():], SCORE.search(line)[0]


def differing_rows(shown, printed):
    """Indices of the rows of a table that differ."""
    if not all(ROW.match(line) for line in printed):
        return range(len(shown))
    left = [row(line) for line in printed]
    last = row(shown[-1])[2]
    differing = []
    for i, line in enumerate(shown):
        rank, rest, score = row(line)
        found = [k for k, (_, other, other_score) in enumerate(left)
                 if near(score, other_score) and (near(last, score) or same_line(rest, other))]
        if rank != row(printed[i])[0] or not near(score, row(printed[i])[2]) or not found:
            differing.append(i)
        else:
            # Its own place first, if that is still free.
            left.pop(next((k for k in found if left[k][0] == rank), found[0]))
    return differing


def differences(shown, printed):
    """What is wrong with a transcript, one text a line."""
    a, b = shown.rstrip().splitlines(), printed.rstrip().splitlines()
    if len(a) != len(b):
        return [f"shows {len(a)} lines, the command prints {len(b)}:\n" + printed.rstrip()]
    wrong = {i for i in range(len(a)) if not same_line(a[i], b[i])}
    for first, end in tables(a):
        wrong -= set(range(first, end))
        wrong |= {first + i for i in differing_rows(a[first:end], b[first:end])}
    return [f"shows  {a[i]}\n  prints {b[i]}" for i in sorted(wrong)]


def updated(text, outputs):
    """The text with outputs (of each command) in place of what its blocks show."""
    def block(match):
        lines = []
        for line in match.group(1).replace("\\\n", "\\\0").splitlines():
            if line.startswith("$ "):
                lines += [line.replace("\0", "\n"), *outputs.get(line[2:].replace("\\\0", " ").strip(), "").splitlines()]
        return "```console\n" + "\n".join(lines) + "\n```"

    return BLOCK.sub(block, text)


def self_test():
    head, first, second, third, last = "rank score w\n", "0.156 1.000 5\n", "0.155 2.000 6\n", "0.123 3.000 7\n", "0.100 4.0 8\n"

    def table(*rows):
        return head + "".join(f"  {rank} {text}" for rank, text in enumerate(rows, 1))

    shown = table(first, second, third, last)
    good = [
        ("found 1973 poses in 0.7 s\n", "found  1973 poses in 2.5 s\n\n"),
        ("found 1973 poses in 0.7 s, 2 threads", "found 1980 poses in 31 s, 8 threads"),
        ("(within 22.3 degrees), 0.053%, -0.000", "(within 22.31 degrees), 0.054%, 0.000"),
        ("q 0.99963 0.00624", "q 0.99960 0.00700"),
        (shown, shown), (shown, table(second, first, third, last)), (shown, table(first, second, third, "0.100 5.0 9\n")),
    ]
    bad = [
        ("found 1973 poses", "found 1900 poses"), ("3 poses", "4 poses"), ("20.25 A", "20.75 A"), ("a b", "a c"),
        ("one\ntwo", "one"), ("wrote out/1hpv.h5", "wrote out/2hpv.h5"), ("1 A", "-1 A"), ("5 x", "x x"),
        ("best 0.05%", "best 0.05"), ("", "more"), ("0.156 0.02", "0.166 0.02"), ("q 0.00624", "q 0.01"),
        (shown, table(first, "0.155 2.100 6\n", third, last)), (shown, table(first, "0.155 2.000 9\n", third, last)),
        (shown, shown.replace("  2 ", "  4 ")), (shown, table(first, third, second, last)),
        (shown, table(first, first, third, last)), (shown, table(first, second, third, "0.5 4.0 8\n")),
        (shown, shown.replace("  3 0", "  x 0")),
    ]
    failures = [f"expected to be alike: {a!r} and {b!r}" for a, b in good if differences(a, b)]
    failures += [f"expected to differ: {a!r} and {b!r}" for a, b in bad if not differences(a, b)]
    text = "x\n```console\n$ mortise a\nold\n$ mortise b \\\n  c\n```\ny\n"
    expected = "x\n```console\n$ mortise a\nnew\n$ mortise b \\\n  c\nlast\n```\ny\n"
    got = updated(text, {"mortise a": "new\n", "mortise b    c": "last\n"})
    if got != expected or [c for c, _ in transcripts(text)] != ["mortise a", "mortise b    c"]:
        failures.append(f"--update gave {got!r}")
    print("\n".join(failures))
    return len(failures)


def main():
    if sys.argv[1:] == ["--self-test"]:
        return 1 if self_test() else 0
    readme = pathlib.Path(sys.argv[1]).resolve()
    program = pathlib.Path(sys.argv[2]).resolve()
    update = "--update" in sys.argv[3:]
    text = readme.read_text(encoding="utf-8")
    shown = list(transcripts(text))
    if not any(command.startswith("scripts/") for command, _ in shown):
        print("README.md: expected a ```console block with `$ scripts/...`, found none")
        return 1
    failures = 0
    examples = [path.read_text(encoding="utf-8") for path in (readme.parent / "tests/consume").glob("*.cpp")]
    for block in CPP_BLOCK.findall(text):
        if not any(block in example for example in examples):
            failures += 1
            print("README.md: expected the ```cpp block in a file of tests/consume, found it in none")
    outputs = {}
    with tempfile.TemporaryDirectory() as directory:
        pathlib.Path(directory, "out").mkdir()
        for name in ("molecules", "parts"):
            if (readme.parent / name).is_dir():
                os.symlink(readme.parent / name, pathlib.Path(directory, name))
        for command, transcript in shown:
            word = command.split()[0]
            if word.startswith("scripts/"):
                if not os.access(readme.parent / word, os.X_OK):
                    failures += 1
                    print(f"README.md: {word}: expected an executable script")
            elif word == "mortise":
                environment = {**os.environ, "PATH": f"{program.parent}{os.pathsep}{os.environ.get('PATH', '')}"}
                done = subprocess.run(command, shell=True, cwd=directory, env=environment, stdin=subprocess.DEVNULL,
                                      capture_output=True, text=True, check=False)
                outputs[command] = done.stdout
                if done.returncode != 0:
                    failures += 1
                    print(f"README.md: $ {command}\n  exit {done.returncode}: {done.stderr.strip()}")
                elif not update:
                    for difference in differences(transcript, done.stdout):
                        failures += 1
                        print(f"README.md: $ {command}\n  {difference}")
            else:
                failures += 1
                print(f"README.md: $ {command}: expected mortise or scripts/...")
    if update and failures == 0:
        readme.write_text(updated(text, outputs), encoding="utf-8")
    print(f"{len(shown)} commands, {failures} faults")
    if failures and not update:
        print("what is shown becomes what is printed by: "
              "tests/house/readme_commands_test.py README.md build/release/apps/mortise --update")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
