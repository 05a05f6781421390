// SPDX-License-Identifier: GPL-3.0-or-later
// mortise dock: searches all placements of one molecule against another.
#include "search_command.hpp"

namespace mortise::app {

void add_dock(CLI::App& program) {
  add_search_command(
      program, dock_kind(),
      {"Find how two molecules bind: search all placements, write ranked poses",
       "Receptor: PDB or mmCIF file, .gz too, FILE#MODEL:CHAIN,CHAIN for some chains; or a mesh, a "
       "STEP file, balls (.xyzr, or what decompose wrote)",
       "Ligand, likewise", "receptor", "ligand", "ligand", "docking", " A", "",
       "  mortise dock receptor.pdb ligand.pdb -o run.h5\n"
       "  mortise dock complex.cif.gz:A,B complex.cif.gz:C -o run.h5 --preset thorough\n"
       "  mortise dock pore.stl protein.pdb -o run.h5\n"
       "  mortise dock receptor.pdb ligand.pdb -o run.h5 --rotations 54000 --json\n"
       "  mortise dock -o run.h5 --resume\n"
       "Ctrl-C saves the run with its best poses so far and exits with 130; a second Ctrl-C\n"
       "saves it without poses."});
}

}  // namespace mortise::app
