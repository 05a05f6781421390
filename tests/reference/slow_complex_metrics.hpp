// SPDX-License-Identifier: GPL-3.0-or-later
// Complex metrics the slow, plain way: move the atoms, look at every pair, superpose with an SVD.
// Proteins whose chains, numbers and atom names agree; every residue is taken as amino acid.
#pragma once

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "mortise/metrics/quality.hpp"
#include "mortise/molecules/molecule.hpp"

namespace mortise::reference {

using Points = std::vector<Eigen::Vector3d>;
using ResidueKey = std::tuple<std::string, int, std::string>;
using ResidueAtoms = std::map<std::string, Eigen::Vector3d>;
using BodyAtoms = std::map<ResidueKey, ResidueAtoms>;

inline BodyAtoms body_atoms(const Molecule& molecule) {
  BodyAtoms out;
  for (const Atom& a : molecule.atoms)
    out[{a.chain, a.residue_number, a.insertion_code}][a.name] = a.position;
  return out;
}

// Kabsch, Acta Cryst. A 32 (1976) 922: rotation and translation from `from` to `to`.
inline std::pair<Eigen::Matrix3d, Eigen::Vector3d> kabsch(const Points& from, const Points& to) {
  Eigen::Vector3d a = Eigen::Vector3d::Zero();
  Eigen::Vector3d b = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < from.size(); ++i) {
    a += from[i] / static_cast<double>(from.size());
    b += to[i] / static_cast<double>(from.size());
  }
  Eigen::Matrix3d h = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < from.size(); ++i) h += (from[i] - a) * (to[i] - b).transpose();
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(h, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix3d flip = Eigen::Matrix3d::Identity();
  if ((svd.matrixV() * svd.matrixU().transpose()).determinant() < 0.0) flip(2, 2) = -1.0;
  const Eigen::Matrix3d R = svd.matrixV() * flip * svd.matrixU().transpose();
  return {R, b - R * a};
}

inline double rmsd(const Points& a, const Points& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]).squaredNorm();
  return std::sqrt(sum / static_cast<double>(a.size()));
}

inline double closest(const ResidueAtoms& a, const ResidueAtoms& b) {
  double best = 1e300;
  for (const auto& p : a)
    for (const auto& q : b) best = std::min(best, (p.second - q.second).norm());
  return best;
}

inline void add_backbone(const BodyAtoms& model, const BodyAtoms& reference, const ResidueKey& key,
                         Points& from, Points& to) {
  if (model.count(key) == 0) return;
  for (const char* name : {"N", "CA", "C", "O"})
    if (model.at(key).count(name) != 0 && reference.at(key).count(name) != 0) {
      from.push_back(model.at(key).at(name));
      to.push_back(reference.at(key).at(name));
    }
}

// ligand_is_moving: as in ReferenceSummary. `moving` stands in its input frame, `pose` carries it
// to the fixed body's.
inline ComplexMetrics complex_metrics(const Molecule& fixed_model, const Molecule& moving_model,
                                      const Molecule& fixed_reference,
                                      const Molecule& moving_reference, const RigidMotion& pose,
                                      bool ligand_is_moving) {
  const BodyAtoms f = body_atoms(fixed_model);
  BodyAtoms m = body_atoms(moving_model);
  for (auto& residue : m)
    for (auto& atom : residue.second) atom.second = pose * atom.second;
  const BodyAtoms rf = body_atoms(fixed_reference);
  const BodyAtoms rm = body_atoms(moving_reference);

  std::set<ResidueKey> interface_f;
  std::set<ResidueKey> interface_m;
  int native = 0;
  int kept = 0;
  int all = 0;
  for (const auto& a : rf)
    for (const auto& b : rm) {
      const double d = closest(a.second, b.second);
      if (d < 10.0) {
        interface_f.insert(a.first);
        interface_m.insert(b.first);
      }
      if (d < 5.0) ++native;
      if (f.count(a.first) == 0 || m.count(b.first) == 0) continue;
      const bool touches = closest(f.at(a.first), m.at(b.first)) < 5.0;
      if (touches) ++all;
      if (touches && d < 5.0) ++kept;
    }

  ComplexMetrics out;
  out.fnat = static_cast<double>(kept) / native;
  out.fnonnat = all == 0 ? 0.0 : static_cast<double>(all - kept) / all;
  Points from;
  Points to;
  for (const ResidueKey& key : interface_f) add_backbone(f, rf, key, from, to);
  for (const ResidueKey& key : interface_m) add_backbone(m, rm, key, from, to);
  const auto [R, t] = kabsch(from, to);
  for (auto& p : from) p = (R * p + t).eval();
  out.interface_rmsd = rmsd(from, to);

  const BodyAtoms& receptor = ligand_is_moving ? f : m;
  const BodyAtoms& receptor_reference = ligand_is_moving ? rf : rm;
  const BodyAtoms& ligand = ligand_is_moving ? m : f;
  const BodyAtoms& ligand_reference = ligand_is_moving ? rm : rf;
  from.clear();
  to.clear();
  for (const auto& r : receptor_reference)
    add_backbone(receptor, receptor_reference, r.first, from, to);
  const auto [S, s] = kabsch(from, to);
  from.clear();
  to.clear();
  for (const auto& r : ligand_reference) add_backbone(ligand, ligand_reference, r.first, from, to);
  for (auto& p : from) p = (S * p + s).eval();
  out.ligand_rmsd = rmsd(from, to);
  out.dockq = dockq_score(out.fnat, out.ligand_rmsd, out.interface_rmsd);
  out.capri = capri_class(out.fnat, out.ligand_rmsd, out.interface_rmsd);
  return out;
}

}  // namespace mortise::reference
