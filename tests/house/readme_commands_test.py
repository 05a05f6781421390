#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs the commands that README.md shows, in order, in one empty directory; each must exit with 0.

Commands are the lines "$ ..." of ```console blocks. Those that start with `mortise` run the program under test,
those that start with `scripts/` must exist and be executable; any other command is a fault.

Usage: readme_commands_test.py README.md PROGRAM
"""

import os
import pathlib
import re
import subprocess
import sys
import tempfile

BLOCK = re.compile(r"^```console\n(.*?)^```", re.MULTILINE | re.DOTALL)


def commands(readme):
    """The commands of all blocks; a trailing backslash joins lines."""
    for block in BLOCK.findall(readme):
        for line in block.replace("\\\n", " ").splitlines():
            if line.startswith("$ "):
                yield line[2:].strip()


def main():
    readme = pathlib.Path(sys.argv[1]).resolve()
    program = pathlib.Path(sys.argv[2]).resolve()
    shown = list(commands(readme.read_text(encoding="utf-8")))
    if not any(command.startswith("scripts/") for command in shown):
        print("README.md: expected a ```console block with `$ scripts/...`, found none")
        return 1
    failures = 0
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
                if done.returncode != 0:
                    failures += 1
                    print(f"README.md: $ {command}\n  exit {done.returncode}: {done.stderr.strip()}")
            else:
                failures += 1
                print(f"README.md: $ {command}: expected mortise or scripts/...")
    print(f"{len(shown)} commands, {failures} faults")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
