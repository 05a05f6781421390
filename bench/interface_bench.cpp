// SPDX-License-Identifier: GPL-3.0-or-later
// Describes the interfaces of known complexes, one CSV line each, and times one pose (one thread).
//
//   interface_bench PAIRS.csv > interfaces.csv      PAIRS.csv:
//   name,...,reference_fixed,reference_moving
#include <algorithm>
#include <cstdio>
#include <ctime>
#include <exception>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "mortise/metrics/interface.hpp"
#include "mortise/molecules/read_molecule.hpp"
#include "mortise/store/csv.hpp"

namespace mortise {
namespace {

// Processor time since the start, so that a busy machine changes little.
double milliseconds() { return 1e3 * static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

void describe(const std::string& name, const std::string& fixed_path,
              const std::string& moving_path) {
  const Molecule fixed = read_molecule({fixed_path, 0, {}}).molecule;
  const Molecule moving = read_molecule({moving_path, 0, {}}).molecule;
  const double start = milliseconds();
  const MolecularInterface interface(fixed, moving, {.threads = 1});
  const double made = milliseconds() - start;
  InterfaceDescription d;
  double best = 1e30;
  for (int repeat = 0; repeat < 5; ++repeat) {
    const double begin = milliseconds();
    d = interface.describe({});
    best = std::min(best, milliseconds() - begin);
  }
  std::printf("%s,%.3f,%.3f,%.3f,%.2f,%.0f,%.0f,%zu,%zu,%zu,%zu,%zu,%.0f,%.1f\n", name.c_str(),
              d.shape.sc, d.shape.fixed_to_moving, d.shape.moving_to_fixed, d.shape.gap,
              d.shape.area, d.buried_area, d.residue_contacts.size(), d.atom_contacts,
              d.hydrogen_bonds.size(), d.clashes, fixed.atoms.size() + moving.atoms.size(), made,
              best);
  std::fflush(stdout);
}

int run(const std::string& table) {
  std::ifstream in(table);
  std::string line;
  if (!std::getline(in, line)) {
    std::fprintf(stderr, "interface_bench: cannot read %s\n", table.c_str());
    return 1;
  }
  std::printf(
      "name,sc,fixed_to_moving,moving_to_fixed,gap,sc_area,buried_area,residue_contacts,"
      "atom_contacts,hydrogen_bonds,clashes,atoms,build_ms,pose_ms\n");
  const std::string folder = std::filesystem::path(table).parent_path().string() + "/";
  while (std::getline(in, line)) {
    const std::vector<std::string> row = csv_cells(line);
    if (row.size() >= 6) describe(row[0], folder + row[4], folder + row[5]);
  }
  return 0;
}

}  // namespace
}  // namespace mortise

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: interface_bench PAIRS.csv\n");
    return 1;
  }
  try {
    return mortise::run(argv[1]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "interface_bench: %s\n", error.what());
    return 1;
  }
}
