// SPDX-License-Identifier: GPL-3.0-or-later
// Real pairs of Docking Benchmark 5: the superposed unbound structures against the interface RMSD
// of the pairs' table. Four pairs by default; MORTISE_BM5_PAIRS=all measures every pair and prints
// one line each.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <set>
#include <string>
#include <vector>

#include "mortise/metrics/reference_complex.hpp"
#include "mortise/molecules/read_molecule.hpp"
#include "mortise/store/csv.hpp"

namespace mortise {
namespace {

std::string shared_folder() {
  const char* folder = std::getenv("MORTISE_SHARED");
  return folder != nullptr ? folder : MORTISE_SOURCE_DIR "/../shared";
}

struct Row {
  std::string name;
  double unbound_interface_rmsd = 0.0;
  std::string files[4];  // fixed, moving, reference fixed, reference moving
};

std::vector<Row> read_table(const std::string& path) {
  std::ifstream in(path);
  std::vector<Row> out;
  std::string line;
  std::getline(in, line);  // header
  while (std::getline(in, line)) {
    const std::vector<std::string> cells = csv_cells(line);
    Row row;
    row.name = cells.at(0);
    row.unbound_interface_rmsd = std::stod(cells.at(1));
    for (std::size_t f = 0; f < 4; ++f) row.files[f] = cells.at(2 + f);
    out.push_back(row);
  }
  return out;
}

TEST(Bm5, SuperposedUnboundPairsHaveTheirTabledInterfaceRmsd) {
  const std::string folder = shared_folder() + "/bm5/";
  if (!std::filesystem::exists(folder + "pairs.csv"))
    GTEST_SKIP() << "no " << folder << "pairs.csv: set MORTISE_SHARED to the folder with bm5/";
  const char* wanted = std::getenv("MORTISE_BM5_PAIRS");
  const bool all = wanted != nullptr && std::string(wanted) == "all";
  const std::set<std::string> few{"1AK4", "1A2K", "1PPE", "1ACB"};
  int measured = 0;
  int within_02 = 0;
  int within_1 = 0;
  for (const Row& row : read_table(folder + "pairs.csv")) {
    if (!all && few.count(row.name) == 0) continue;
    std::vector<Molecule> bodies;
    for (const std::string& file : row.files)
      bodies.push_back(read_molecule({folder + file, 0, {}}).molecule);
    const ReferenceComplex complex(bodies[0], bodies[1], bodies[2], bodies[3]);
    const ComplexMetrics m = complex.evaluate({});
    const ComplexMetrics best = complex.evaluate(complex.superposed_pose());
    const double off = m.interface_rmsd - row.unbound_interface_rmsd;
    ++measured;
    within_02 += std::abs(off) <= 0.02 ? 1 : 0;
    within_1 += std::abs(off) <= 0.1 ? 1 : 0;
    if (all) {
      const ReferenceSummary& s = complex.summary();
      std::cout << std::fixed << std::setprecision(3) << row.name << " table "
                << row.unbound_interface_rmsd << " i " << m.interface_rmsd << " off " << off
                << " L " << m.ligand_rmsd << " fnat " << m.fnat << " fnonnat " << m.fnonnat
                << " dockq " << m.dockq << ' ' << to_string(m.capri) << " superposed i "
                << best.interface_rmsd << ' ' << to_string(best.capri) << " matched "
                << s.fixed.pairs.size() << '/' << s.fixed.reference_residues << ' '
                << s.moving.pairs.size() << '/' << s.moving.reference_residues << " interface "
                << s.interface_residues_matched << '/' << s.interface_residues << " contacts "
                << s.native_contacts_matched << '/' << s.native_contacts;
      for (const ResidueMatch* match : {&s.fixed, &s.moving})
        for (const ChainMatch& c : match->chains)
          std::cout << ' ' << c.model_chain << c.reference_chain
                    << (c.method == MatchMethod::kNumbering ? "#" : "~") << c.identical << '/'
                    << c.matched;
      std::cout << '\n';
    } else {
      EXPECT_NEAR(m.interface_rmsd, row.unbound_interface_rmsd, 0.02) << row.name;
      EXPECT_GT(m.fnat, 0.3) << row.name;
    }
  }
  if (all)
    std::cout << measured << " pairs, within 0.02 A " << within_02 << ", within 0.1 A " << within_1
              << '\n';
  ASSERT_GE(measured, 4);
}

}  // namespace
}  // namespace mortise
