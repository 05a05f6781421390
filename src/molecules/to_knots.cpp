// SPDX-License-Identifier: GPL-3.0-or-later
// Molecules as knots.
#include "mortise/molecules/to_knots.hpp"

#include <algorithm>
#include <array>
#include <iterator>
#include <string_view>
#include <utility>

#include "mortise/core/errors.hpp"
#include "mortise/molecules/merge_buried.hpp"
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
  return name == "N" || name == "CA" || name == "C" || name == "O" || name == "OXT";
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
  if (!(options.exposed_area >= 0.0))
    throw InputError("to_knots: exposed_area must be >= 0, got " +
                     std::to_string(options.exposed_area));
  if (!(options.merge_buried >= 0.0))
    throw InputError("to_knots: merge_buried must be >= 0, got " +
                     std::to_string(options.merge_buried));
  // Hydrogens go before the surface is made: united radii stand for them.
  Molecule heavy{molecule.path, {}};
  std::copy_if(molecule.atoms.begin(), molecule.atoms.end(), std::back_inserter(heavy.atoms),
               [](const Atom& a) { return a.element != "H" && a.element != "D"; });
  if (heavy.atoms.empty()) throw InputError("to_knots: " + molecule.path + " has no heavy atom");
  // 200 points tell exposed from buried; the area itself is not used.
  const Eigen::VectorXd area =
      accessible_areas(heavy, {.points_per_atom = 200, .threads = options.threads});
  const Eigen::VectorXd radii = atom_radii(heavy);
  const auto count = static_cast<Eigen::Index>(heavy.atoms.size());
  Knots knots{Eigen::Matrix4Xd(4, count), Eigen::VectorXcd(count)};
  for (Eigen::Index i = 0; i < count; ++i) {
    const Atom& atom = heavy.atoms[i];
    knots.points.col(i) << atom.position, options.radius > 0.0 ? options.radius : radii[i];
    const bool weighted = area[i] > options.exposed_area && !is_backbone(atom.name);
    knots.weights[i] =
        weighted ? 1.0 + options.propensity * interface_propensity(atom.residue_name) : 1.0;
  }
  check_knots(knots, "to_knots");
  if (options.merge_buried > 0.0)
    return merge_buried(
        knots,
        {.largest = options.merge_buried, .offset = options.offset, .threads = options.threads});
  return knots;
}

}  // namespace mortise
