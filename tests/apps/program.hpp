// SPDX-License-Identifier: GPL-3.0-or-later
// The program beside the sample molecules.
#pragma once

#include <filesystem>
#include <string>

#include "helpers/program.hpp"
#include "mortise/store/run_file.hpp"

namespace mortise::testing {

using tests::Outcome;

class Program : public tests::ProgramTest {
 protected:
  Program() {
    for (const char* file : {"1hpv_receptor.pdb", "1hpv_ligand.pdb", "1hpv_complex.pdb"})
      std::filesystem::copy_file(std::filesystem::path(MORTISE_SOURCE_DIR) / "molecules" / file,
                                 path(file));
  }
};

/// The run's datasets as bytes: all of it but when and how it was made.
inline std::string datasets(Run run) {
  run.provenance = {};
  run.seconds = 0.0;
  run.figures.clear();
  return serialize_run(run);
}

}  // namespace mortise::testing
