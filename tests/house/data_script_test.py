#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs scripts/data on made-up clones: what lies where, and what it says where something is missing.

Usage: data_script_test.py SOURCE_DIR
"""

import gzip
import pathlib
import subprocess
import sys
import tempfile

HEAD = "name,unbound_interface_rmsd,fixed,moving,reference_fixed,reference_moving\n"


def main():
    script = pathlib.Path(sys.argv[1]) / "scripts" / "data"
    failures = []

    def expect(condition, what):
        if not condition:
            failures.append(what)

    with tempfile.TemporaryDirectory() as name:
        scratch = pathlib.Path(name)

        def run(*words):
            command = [sys.executable, script, "--to", scratch / "to", "--clones", scratch / "clones", *words]
            return subprocess.run(list(map(str, command)), capture_output=True, text=True, check=False)

        done = run("bm5")
        expect(done.returncode == 1 and "git clone" in done.stderr and "BM5-clean" in done.stderr, f"no clone: {done.stderr}")
        done = run("other")
        expect(done.returncode == 1 and "expected bm5, dockground, meshes" in done.stderr, f"unknown set: {done.stderr}")

        folder = scratch / "clones" / "BM5-clean" / "structures-matched"
        folder.mkdir(parents=True)
        for part in ("r_u", "l_u", "r_b-matched"):
            (folder / f"1A2K_{part}.pdb").write_text(part)
        done = run("--only", "1A2K", "bm5")
        expect(done.returncode == 1 and "1A2K_l_b-matched.pdb: expected this file" in done.stderr, f"no file: {done.stderr}")
        (folder / "1A2K_l_b-matched.pdb").write_text("l_b-matched")
        done = run("--only", "1A2K", "--program", scratch / "none", "bm5")
        expect(done.returncode == 1 and "expected the program" in done.stderr, f"no program: {done.stderr}")
        table = scratch / "to" / "bm5" / "pairs.csv"
        table.write_text(HEAD + "1A2K,1.196,1A2K_r_u.pdb.gz,1A2K_l_u.pdb.gz,1A2K_r_b-matched.pdb.gz,1A2K_l_b-matched.pdb.gz\n")
        before = table.read_text()
        done = run("--only", "1A2K", "bm5")
        expect(done.returncode == 0 and table.read_text() == before, f"table that is there: {done.stderr}")
        for part in ("r_u", "l_u", "r_b-matched", "l_b-matched"):
            expect(gzip.decompress((scratch / "to" / "bm5" / f"1A2K_{part}.pdb.gz").read_bytes()) == part.encode(), part)

        folder = scratch / "clones" / "FoldDock" / "data" / "dockground" / "PDB"
        folder.mkdir(parents=True)
        for form in "ub":
            (folder / f"1b27_{form}1.pdb").write_text(f"{form} small")
            (folder / f"1b27_{form}2.pdb").write_text(f"{form} larger of the two")
        (scratch / "to" / "dockground").mkdir()
        (scratch / "to" / "dockground" / "pairs.csv").write_text(HEAD + "1b27,0.918,a,b,c,d\n")
        done = run("--only", "1b27", "dockground")
        expect(done.returncode == 0, f"dockground: {done.stderr}")
        receptor = scratch / "to" / "dockground" / "1b27_r_b.pdb.gz"
        expect(receptor.exists() and gzip.decompress(receptor.read_bytes()) == b"b larger of the two", "the larger one is the receptor")

    print("\n".join([*failures, f"{len(failures)} faults"]))
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
