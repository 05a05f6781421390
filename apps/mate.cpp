// SPDX-License-Identifier: GPL-3.0-or-later
// mortise mate: finds how two mechanical parts fit together.
#include "search_command.hpp"

namespace mortise::app {

void add_mate(CLI::App& program) {
  add_search_command(
      program, mate_kind(),
      {"Find how two parts fit together, write ranked placements",
       "Fixed part: STL, OBJ, PLY, OFF or STEP file; or balls (.xyzr, or what decompose wrote), or "
       "a molecule",
       "Moving part, likewise", "fixed", "moving", "part", "mating", "",
       ". Lengths are fractions of the smaller part's diameter",
       "  mortise mate block.step pin.step -o run.h5\n"
       "  mortise mate seat.obj leg.obj -o run.h5 --preset thorough\n"
       "  mortise mate block.stl pin.stl -o run.h5 --axis 0,0,1:0,0,1 --rotations 360\n"
       "  mortise mate -o run.h5 --resume\n"
       "Score: contact area that holds, less what penetrates, over the smaller part's area.\n"
       "Ctrl-C saves the run with its best placements so far and exits with 130; a second\n"
       "Ctrl-C saves it without placements."});
}

}  // namespace mortise::app
