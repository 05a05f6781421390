// SPDX-License-Identifier: GPL-3.0-or-later
// Describing poses: one search for near pairs of atoms, from which all else follows.
#include "mortise/metrics/interface.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "core/point_grid.hpp"
#include "metrics/complementarity.hpp"
#include "metrics/hydrogen_bonds.hpp"
#include "metrics/near_pairs.hpp"
#include "metrics/polymer.hpp"
#include "mortise/core/errors.hpp"
#include "mortise/core/threads.hpp"
#include "mortise/molecules/radii.hpp"
#include "mortise/molecules/surface.hpp"

namespace mortise {
namespace {

using detail::NearPairs;
using detail::Neighbours;

// A molecule's heavy atoms and all that does not depend on the pose.
struct Body {
  Molecule heavy;
  std::vector<std::size_t> index;    // of each heavy atom in the molecule
  std::vector<std::size_t> residue;  // of each heavy atom
  Eigen::Matrix3Xd positions;
  std::vector<detail::PolarAtom> polar;
  detail::ProbePlaces water;                  // the accessible surface
  Eigen::VectorXd water_areas;                // what each place of an atom stands for
  std::optional<detail::DottedBody> surface;  // with Sc
};

Body make_body(const Molecule& molecule, const char* which, const InterfaceOptions& options) {
  Body body;
  const std::vector<ResidueRange> ranges = residues(molecule);
  for (std::size_t r = 0; r < ranges.size(); ++r)
    for (std::size_t i = ranges[r].first; i < ranges[r].last; ++i) {
      if (detail::is_hydrogen(molecule.atoms[i])) continue;
      body.heavy.atoms.push_back(molecule.atoms[i]);
      body.index.push_back(i);
      body.residue.push_back(r);
    }
  if (body.heavy.atoms.empty())
    throw InputError(std::string("MolecularInterface: expected heavy atoms in the ") + which +
                     " molecule, found none");
  body.positions = atom_positions(body.heavy);
  body.polar = detail::polar_atoms(body.heavy);
  const Eigen::VectorXd radii = atom_radii(body.heavy);
  AccessiblePoints points = accessible_points(body.positions, radii,
                                              {.probe_radius = options.water_radius,
                                               .points_per_atom = options.points_per_atom,
                                               .threads = options.threads});
  body.water = {std::move(points.positions), std::move(points.first),
                (radii.array() + options.water_radius).matrix()};
  body.water_areas = std::move(points.areas);
  if (options.complementarity) {
    ComplementarityOptions sc = options.sc;
    sc.threads = options.threads;
    body.surface.emplace(body.positions, complementarity_radii(body.heavy), sc);
  }
  return body;
}

double buried_area(const Body& body, const Neighbours& neighbours, const Eigen::Matrix3Xd& partners,
                   const Eigen::VectorXd& partner_grown) {
  // Places rise, so that each one's atom is found by going on from the last one's.
  double sum = 0.0;
  std::size_t atom = 0;
  detail::for_each_covered(body.water, body.positions, neighbours, partners, partner_grown,
                           [&](Eigen::Index place) {
                             while (body.water.first[atom + 1] <= place) ++atom;
                             sum += body.water_areas[static_cast<Eigen::Index>(atom)];
                           });
  return sum;
}

void check(const InterfaceOptions& options) {
  const std::string where = "MolecularInterface: ";
  for (const auto& [name, value] :
       {std::pair("contact_cutoff", options.contact_cutoff),
        std::pair("clash_cutoff", options.clash_cutoff),
        std::pair("hydrogen_bond_length", options.hydrogen_bond_length)})
    if (!(value > 0.0 && std::isfinite(value)))
      throw InputError(where + name + " must be > 0 and finite, got " + std::to_string(value));
  if (!(options.hydrogen_bond_angle >= 0.0 && options.hydrogen_bond_angle <= std::numbers::pi))
    throw InputError(where + "hydrogen_bond_angle must be in [0, pi], got " +
                     std::to_string(options.hydrogen_bond_angle));
  if (options.complementarity) detail::check_complementarity_options(options.sc);
}

}  // namespace

struct MolecularInterface::Impl {
  InterfaceOptions options;
  Body fixed, moving;
  detail::PointGrid grid;  // of the fixed atoms

  Impl(const InterfaceOptions& chosen, Body a, Body b, double reach)
      : options(chosen),
        fixed(std::move(a)),
        moving(std::move(b)),
        grid(fixed.positions, reach, reach) {}

  void count_pairs(const NearPairs& pairs, const RigidMotion& motion, const Eigen::Matrix3Xd& moved,
                   InterfaceDescription& out) const;
  [[nodiscard]] bool bonded(std::int32_t f, std::int32_t m, const Eigen::Vector3d& to_moving,
                            const RigidMotion& motion, bool& fixed_donates) const;
};

// `to_moving`: from the fixed atom to the moving one, fixed frame.
bool MolecularInterface::Impl::bonded(std::int32_t f, std::int32_t m,
                                      const Eigen::Vector3d& to_moving, const RigidMotion& motion,
                                      bool& fixed_donates) const {
  const detail::PolarAtom& a = fixed.polar[f];
  const detail::PolarAtom& b = moving.polar[m];
  fixed_donates = a.donor && b.acceptor;
  if (!fixed_donates && !(a.acceptor && b.donor)) return false;
  const double most = std::cos(options.hydrogen_bond_angle) + 1e-12;
  return detail::faces(a, to_moving, most) &&
         detail::faces(b, motion.rotation.conjugate() * -to_moving, most);
}

void MolecularInterface::Impl::count_pairs(const NearPairs& pairs, const RigidMotion& motion,
                                           const Eigen::Matrix3Xd& moved,
                                           InterfaceDescription& out) const {
  const double contact_sq = options.contact_cutoff * options.contact_cutoff;
  const double clash_sq = options.clash_cutoff * options.clash_cutoff;
  const double bond_sq = options.hydrogen_bond_length * options.hydrogen_bond_length;
  std::map<std::pair<std::size_t, std::size_t>, double> closest;  // square distance
  const Neighbours& near = pairs.moving;
  for (std::size_t a = 0; a < near.atoms.size(); ++a)
    for (std::int32_t k = near.first[a]; k < near.first[a + 1]; ++k) {
      const std::int32_t m = near.atoms[a], f = near.partners[k];
      const Eigen::Vector3d step = moved.col(m) - fixed.positions.col(f);
      const double distance_sq = step.squaredNorm();
      if (distance_sq < contact_sq) {
        ++out.atom_contacts;
        const auto [place, first] =
            closest.try_emplace({fixed.residue[f], moving.residue[m]}, distance_sq);
        if (!first) place->second = std::min(place->second, distance_sq);
      }
      bool bond = false, fixed_donates = false;
      if (distance_sq <= bond_sq && distance_sq > 0.0 &&
          (bond = bonded(f, m, step, motion, fixed_donates)))
        out.hydrogen_bonds.push_back(
            {fixed.index[f], moving.index[m], fixed_donates, std::sqrt(distance_sq)});
      if (distance_sq < clash_sq && !bond) ++out.clashes;
    }
  for (const auto& [residue_pair, distance_sq] : closest)
    out.residue_contacts.push_back(
        {residue_pair.first, residue_pair.second, std::sqrt(distance_sq)});
}

MolecularInterface::MolecularInterface(const Molecule& fixed, const Molecule& moving,
                                       const InterfaceOptions& options) {
  check(options);
  Body a = make_body(fixed, "fixed", options), b = make_body(moving, "moving", options);
  double reach = std::max({options.contact_cutoff, options.clash_cutoff,
                           options.hydrogen_bond_length * (1.0 + 1e-9),
                           a.water.grown.maxCoeff() + b.water.grown.maxCoeff()});
  if (options.complementarity)
    reach = std::max(reach, a.surface->grown().maxCoeff() + b.surface->grown().maxCoeff());
  impl_ = std::make_shared<const Impl>(options, std::move(a), std::move(b), reach);
}

InterfaceDescription MolecularInterface::describe(const RigidMotion& moving_in_fixed) const {
  check_motion(moving_in_fixed, "MolecularInterface::describe");
  const Impl& impl = *impl_;
  const Body &fixed = impl.fixed, &moving = impl.moving;
  const Eigen::Matrix3Xd moved = moving_in_fixed * moving.positions;
  const Eigen::Matrix3Xd fixed_in_moving = inverse(moving_in_fixed) * fixed.positions;
  const NearPairs pairs = detail::near_pairs(impl.grid, fixed.positions.cols(), moved);
  InterfaceDescription out;
  impl.count_pairs(pairs, moving_in_fixed, moved, out);
  out.fixed_buried_area = buried_area(fixed, pairs.fixed, moved, moving.water.grown);
  out.moving_buried_area = buried_area(moving, pairs.moving, fixed_in_moving, fixed.water.grown);
  out.buried_area = out.fixed_buried_area + out.moving_buried_area;
  if (impl.options.complementarity)
    out.shape = detail::complementarity(*fixed.surface, *moving.surface, moving_in_fixed, pairs,
                                        fixed_in_moving, moved, impl.options.sc.weight);
  return out;
}

std::vector<InterfaceDescription> describe_poses(const MolecularInterface& interface,
                                                 const std::vector<RigidMotion>& poses,
                                                 int threads) {
  std::vector<InterfaceDescription> out(poses.size());
  parallel_for(poses.size(), threads,
               [&](std::size_t i, int) { out[i] = interface.describe(poses[i]); });
  return out;
}

}  // namespace mortise
