// SPDX-License-Identifier: GPL-3.0-or-later
// Writes the reports that the browser test opens: mortise_report_pages DIRECTORY
// [hundred-thousand].
#include <cstdio>
#include <cstring>
#include <exception>
#include <filesystem>

#include "mortise/parts/ball_mesh.hpp"
#include "mortise/report/write_report.hpp"
#include "sample_report.hpp"

namespace {

using namespace mortise;           // NOLINT(google-build-using-namespace)
using namespace mortise::testing;  // NOLINT(google-build-using-namespace)

const char* const kMarkup = "</script><img src=x onerror=\"window.broken = 1\"><b>&amp;";

// Selenomethionine, a base, a sugar, hydrogens, chains of two letters, numbers beyond 9,999.
Molecule unusual(Molecule molecule) {
  const std::vector<ResidueRange> all = residues(molecule);
  for (std::size_t k = 0; k < all.size(); ++k)
    for (std::size_t i = all[k].first; i < all[k].last; ++i) {
      Atom& atom = molecule.atoms[i];
      atom.chain = "XY";
      atom.residue_number += 12'000;
      if (k % 10 == 3) atom.residue_name = "MSE";
      if (k % 17 == 5) {
        atom.residue_name = "NAG";
        atom.hetero = true;
      }
    }
  return molecule;
}

void write_all(const std::string& directory, bool many) {
  const auto write = [&](const char* name, const Run& run, const ReportBodies& bodies,
                         int triangles = 40'000) {
    const ReportFiles files = write_report(run, bodies, directory + "/" + name,
                                           {.structures = 3, .part_triangles = triangles});
    std::printf("%s: %zu files\n", name, files.files.size());
  };
  const ReportBodies molecules = protease();
  if (many) {
    write("many", report_run(molecules, 100'000), molecules);
    return;
  }
  write("molecules", report_run(molecules, 1000), molecules);
  write("one", report_run(molecules, 1), molecules);
  write("zero", report_run(molecules, 0), molecules);
  const ReportBodies parts = plate_and_pin();
  write("parts", report_run(parts, 40), parts);

  ReportBodies large = parts;
  large.fixed.mesh = ball_mesh(Eigen::Vector4d(0.0, 0.0, 0.0, 10.0), 32);
  large.moving.mesh = ball_mesh(Eigen::Vector4d(0.0, 0.0, 0.0, 3.0), 32);
  write("large", report_run(large, 10), large, 4'000);

  ReportBodies missing = molecules;
  missing.moving = {};
  missing.moving.stand_in = report_points(molecules.moving);
  missing.notices.emplace_back("x.pdb: the run's moving input is not there.");
  write("missing", report_run(molecules, 30), missing);

  Run bare = report_run(molecules, 30);
  bare.metrics.clear();
  bare.provenance.mortise_version = "0.0.9";
  write("no_reference", bare, molecules);

  Run unfinished = report_run(molecules, 0);
  unfinished.complete = false;
  unfinished.candidates = sample_candidates(60);
  write("unfinished", unfinished, molecules);

  Run hostile = report_run(molecules, 20);
  hostile.provenance.command_line = hostile.provenance.host = kMarkup;
  hostile.fixed.path = hostile.fixed.spec = hostile.moving.path = hostile.moving.spec =
      std::string("a") + kMarkup + ".pdb";
  hostile.provenance.options_json = R"({"</script>": "<img src=x onerror='window.broken = 1'>"})";
  hostile.poses.channel_names[0] = "<img src=x onerror='window.broken = 1'>";
  ReportBodies named = molecules;
  named.notices.emplace_back(kMarkup);
  for (Atom& atom : named.fixed.molecule.atoms) atom.chain = "<";
  write("hostile", hostile, named);

  ReportBodies odd = molecules;
  odd.fixed.molecule = unusual(odd.fixed.molecule);
  write("unusual", report_run(odd, 20), odd);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    if (argc < 2) return 1;
    std::filesystem::remove_all(argv[1]);
    write_all(argv[1], argc > 2 && std::strcmp(argv[2], "hundred-thousand") == 0);
    return 0;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 1;
  }
}
