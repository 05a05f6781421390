// SPDX-License-Identifier: GPL-3.0-or-later
// Molecules as knots.
#include "mortise/molecules/to_knots.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>
#include <vector>

#include "mortise/core/errors.hpp"
#include "mortise/molecules/radii.hpp"
#include "mortise/molecules/surface.hpp"

namespace mortise {
namespace {

constexpr std::array<std::pair<std::string_view, double>, 21> kPropensities = {{
    {"ALA", -0.17}, {"ARG", 0.27},  {"ASN", 0.12}, {"ASP", -0.38}, {"CYS", 0.43},  {"GLN", -0.11},
    {"GLU", -0.13}, {"GLY", -0.07}, {"HIS", 0.41}, {"ILE", 0.44},  {"LEU", 0.40},  {"LYS", -0.36},
    {"MET", 0.66},  {"MSE", 0.66},  {"PHE", 0.82}, {"PRO", -0.25}, {"SER", -0.33}, {"THR", -0.18},
    {"TRP", 0.83},  {"TYR", 0.66},  {"VAL", 0.27},
}};

bool is_backbone(const std::string& name) {
  return name == "N" || name == "CA" || name == "C" || name == "O";
}

}  // namespace

double interface_propensity(const std::string& residue_name) {
  const auto* found = std::find_if(kPropensities.begin(), kPropensities.end(),
                                   [&](const auto& entry) { return entry.first == residue_name; });
  return found == kPropensities.end() ? 0.0 : found->second;
}

Knots to_knots(const Molecule& molecule, const ToKnotsOptions& options) {
  if (!(options.radius >= 0.0))
    throw InputError("to_knots: radius must be >= 0, got " + std::to_string(options.radius));
  if (!(options.propensity >= 0.0))
    throw InputError("to_knots: propensity must be >= 0, got " +
                     std::to_string(options.propensity));
  // 200 points tell exposed from buried; the area itself is not used.
  const Eigen::VectorXd area =
      accessible_areas(molecule, {.points_per_atom = 200, .threads = options.threads});
  const Eigen::VectorXd radii = atom_radii(molecule);
  std::vector<Eigen::Index> heavy;
  for (std::size_t i = 0; i < molecule.atoms.size(); ++i)
    if (molecule.atoms[i].element != "H" && molecule.atoms[i].element != "D")
      heavy.push_back(static_cast<Eigen::Index>(i));
  if (heavy.empty()) throw InputError("to_knots: " + molecule.path + " has no heavy atom");
  Knots knots{Eigen::Matrix4Xd(4, heavy.size()), Eigen::VectorXcd(heavy.size())};
  for (std::size_t k = 0; k < heavy.size(); ++k) {
    const Atom& atom = molecule.atoms[heavy[k]];
    knots.points.col(k) << atom.position, options.radius > 0.0 ? options.radius : radii[heavy[k]];
    const bool weighted = area[heavy[k]] > options.exposed_area && !is_backbone(atom.name);
    knots.weights[k] =
        weighted ? 1.0 + options.propensity * interface_propensity(atom.residue_name) : 1.0;
  }
  check_knots(knots, "to_knots");
  return knots;
}

}  // namespace mortise
