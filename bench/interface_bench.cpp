// SPDX-License-Identifier: GPL-3.0-or-later
// Describes the interfaces of known complexes, one CSV line each, and times one pose (one thread).
//
//   interface_bench PAIRS.csv > interfaces.csv      PAIRS.csv: as `mortise benchmark` takes it
#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

#include "bench.hpp"
#include "mortise/core/errors.hpp"
#include "mortise/metrics/interface.hpp"
#include "mortise/molecules/read_molecule.hpp"
#include "mortise/runs/benchmark.hpp"

namespace mortise {
namespace {

double milliseconds() { return 1e3 * bench::cpu_seconds(); }

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

void run(const std::vector<std::string>& words) {
  if (words.size() != 1) throw InputError("usage: interface_bench PAIRS.csv");
  std::printf(
      "name,sc,fixed_to_moving,moving_to_fixed,gap,sc_area,buried_area,residue_contacts,"
      "atom_contacts,hydrogen_bonds,clashes,atoms,build_ms,pose_ms\n");
  for (const BenchmarkPair& pair : read_benchmark_pairs(words[0]))
    describe(pair.name, pair.reference_fixed, pair.reference_moving);
}

}  // namespace
}  // namespace mortise

int main(int argc, char** argv) {
  return mortise::bench::bench_main("interface_bench", argc, argv, mortise::run);
}
