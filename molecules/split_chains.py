#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes the sample inputs of this folder from the two PDB entries in Debian's package pymol-data.

  molecules/split_chains.py [SOURCE] [TARGET]

SOURCE holds tut/1hpv.pdb and demo/1tii.pdb (default /usr/share/pymol/data), TARGET is where the
files go (default: this folder). Atom records are copied as they stand (blanks at line ends go); waters and the inhibitor of
1HPV are left out of the receptor and ligand files.
"""
import gzip
import pathlib
import sys

HEAD = ("HEADER", "TITLE ", "COMPND", "SOURCE", "AUTHOR", "REVDAT", "JRNL  ")
# output file -> (entry, chains); .gz is packed
FILES = {
    "1hpv_receptor.pdb": ("tut/1hpv.pdb", "A"),
    "1hpv_ligand.pdb": ("tut/1hpv.pdb", "B"),
    "1hpv_complex.pdb": ("tut/1hpv.pdb", "AB"),
    "1tii_receptor.pdb.gz": ("demo/1tii.pdb", "DEFGH"),
    "1tii_ligand.pdb.gz": ("demo/1tii.pdb", "AC"),
    "1tii_complex.pdb.gz": ("demo/1tii.pdb", "DEFGHAC"),
}


def split(lines, chains):
    """Title lines, then the polymer atoms of `chains` with a TER record after each."""
    out = [line for line in lines if line[:6] in HEAD]
    for chain in chains:
        atoms = [line for line in lines if line.startswith("ATOM  ") and line[21] == chain]
        if not atoms:
            sys.exit(f"split_chains.py: expected chain {chain}, found no atoms of it")
        out += atoms + ["TER"]
    return "".join(line.rstrip() + "\n" for line in out + ["END"])


def main():
    here = pathlib.Path(__file__).resolve().parent
    source = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else "/usr/share/pymol/data")
    target = pathlib.Path(sys.argv[2]) if len(sys.argv) > 2 else here
    for name, (entry, chains) in FILES.items():
        text = split((source / entry).read_text(encoding="ascii").splitlines(), chains)
        data = text.encode("ascii")
        # mtime 0 and no name: the same bytes each time
        (target / name).write_bytes(gzip.compress(data, 9, mtime=0) if name.endswith(".gz") else data)
        print(f"{name}: chains {','.join(chains)}, {text.count(chr(10) + 'ATOM  ')} atoms")


main()
