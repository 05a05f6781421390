#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs the commands that README.md shows, in order, in one empty directory; each must exit with 0.

Commands are the lines "$ ..." of ```console blocks. Those that start with `mortise` run the program under test,
those that start with `scripts/` must exist and be executable; any other command is a fault.
Every ```cpp block must stand, as it is, in a file of tests/consume, which house.consume compiles.

Usage: readme_commands_test.py README.md PROGRAM [--update]

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


def commands(readme):
    """The commands of all blocks; a trailing backslash joins lines."""
    for block in BLOCK.findall(readme):
        for line in block.replace("\\\n", " ").splitlines():
            if line.startswith("$ "):
                yield line[2:].strip()


def updated(text, outputs):
    """The text with outputs (of each command) in place of what its blocks show."""
    def block(match):
        lines = []
        for line in match.group(1).replace("\\\n", "\\\0").splitlines():
            if line.startswith("$ "):
                lines += [line.replace("\0", "\n"), *outputs.get(line[2:].replace("\\\0", " ").strip(), "").splitlines()]
        return "```console\n" + "\n".join(lines) + "\n```"

    return BLOCK.sub(block, text)


def main():
    readme = pathlib.Path(sys.argv[1]).resolve()
    program = pathlib.Path(sys.argv[2]).resolve()
    shown = list(commands(readme.read_text(encoding="utf-8")))
    if not any(command.startswith("scripts/") for command in shown):
        print("README.md: expected a ```console block with `$ scripts/...`, found none")
        return 1
    failures = 0
    examples = [path.read_text(encoding="utf-8") for path in (readme.parent / "tests/consume").glob("*.cpp")]
    for block in CPP_BLOCK.findall(readme.read_text(encoding="utf-8")):
        if not any(block in example for example in examples):
            failures += 1
            print("README.md: expected the ```cpp block in a file of tests/consume, found it in none")
    outputs = {}
    with tempfile.TemporaryDirectory() as directory:
        pathlib.Path(directory, "out").mkdir()
        for name in ("molecules", "parts"):
            if (readme.parent / name).is_dir():
                os.symlink(readme.parent / name, pathlib.Path(directory, name))
        for command in shown:
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
            else:
                failures += 1
                print(f"README.md: $ {command}: expected mortise or scripts/...")
    if "--update" in sys.argv[3:] and failures == 0:
        readme.write_text(updated(readme.read_text(encoding="utf-8"), outputs), encoding="utf-8")
    print(f"{len(shown)} commands, {failures} faults")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
