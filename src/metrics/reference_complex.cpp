// SPDX-License-Identifier: GPL-3.0-or-later
// Measuring poses against a complex: all that does not depend on the pose is summed up once.
//
// i-RMSD. The model's interface is {a_i} u {R b_j + t}, the reference's {A_i} u {B_j}. Their
// moments (paired_moments.hpp) are those of the (a, A) pairs merged with those of the (b, B) pairs
// moved by (R, t): a few 3 x 3 operations, then the largest eigenvalue of Horn's 4 x 4 matrix.
// L-RMSD. With S the motion that superposes the model's receptor on the reference's, the ligand
// stands at S (R b + t): moments of all its backbone, moved by S (R, t). If the fixed body is the
// ligand, the same holds with the inverse pose. Neither cost depends on the number of atoms.
#include "mortise/metrics/reference_complex.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <set>
#include <string>
#include <utility>

#include "core/paired_moments.hpp"
#include "core/point_grid.hpp"
#include "metrics/polymer.hpp"
#include "metrics/residue_contacts.hpp"
#include "mortise/core/errors.hpp"
#include "mortise/core/threads.hpp"
#include "mortise/metrics/superpose.hpp"

namespace mortise {
namespace {

using detail::PairedMoments;
using detail::PolymerResidue;

// The residues of one body on both sides; matched ones as positions in these lists.
struct MatchedBody {
  std::vector<PolymerResidue> model;
  std::vector<PolymerResidue> reference;
  std::vector<std::pair<std::int32_t, std::int32_t>> pairs;  // (in model, in reference)
  ResidueMatch match;
};

MatchedBody match_body(const Molecule& model, const Molecule& reference,
                       const MatchResiduesOptions& options) {
  MatchedBody body;
  body.match = match_residues(model, reference, options);
  body.model = detail::polymer_residues(model);
  body.reference = detail::polymer_residues(reference);
  const auto position = [](const std::vector<PolymerResidue>& residues, std::size_t index) {
    const auto found = std::lower_bound(
        residues.begin(), residues.end(), index,
        [](const PolymerResidue& r, std::size_t wanted) { return r.index < wanted; });
    return static_cast<std::int32_t>(found - residues.begin());
  };
  for (const auto& [m, r] : body.match.pairs)
    body.pairs.emplace_back(position(body.model, m), position(body.reference, r));
  return body;
}

Eigen::Matrix3Xd positions(const std::vector<Eigen::Vector3d>& points) {
  Eigen::Matrix3Xd out(3, points.size());
  for (std::size_t i = 0; i < points.size(); ++i) out.col(i) = points[i];
  return out;
}

Eigen::Matrix3Xd positions(const PolymerResidue& residue) {
  Eigen::Matrix3Xd out(3, residue.atoms.size());
  for (std::size_t i = 0; i < residue.atoms.size(); ++i) out.col(i) = residue.atoms[i].position;
  return out;
}

// The backbone atoms that both sides of the body have, in matched reference residues r with
// wanted[r] != 0.
std::pair<Eigen::Matrix3Xd, Eigen::Matrix3Xd> paired_backbone(const MatchedBody& body,
                                                              const std::vector<char>& wanted) {
  std::vector<Eigen::Vector3d> model;
  std::vector<Eigen::Vector3d> reference;
  for (const auto& [m, r] : body.pairs) {
    if (wanted[r] == 0) continue;
    for (const detail::PolymerAtom& a : body.model[m].atoms)
      for (const detail::PolymerAtom& b : body.reference[r].atoms)
        if (a.backbone && b.backbone && a.name == b.name) {
          model.push_back(a.position);
          reference.push_back(b.position);
        }
  }
  return {positions(model), positions(reference)};
}

// Interface residues and contacts of the reference, as positions in the bodies' reference lists.
struct Interface {
  std::vector<char> fixed;
  std::vector<char> moving;
  std::set<std::pair<std::int32_t, std::int32_t>> contacts;
};

Interface find_interface(const MatchedBody& fixed, const MatchedBody& moving,
                         const ReferenceComplexOptions& options) {
  Interface out;
  out.fixed.assign(fixed.reference.size(), 0);
  out.moving.assign(moving.reference.size(), 0);
  std::vector<Eigen::Vector3d> atoms;
  std::vector<std::int32_t> owner;
  for (std::size_t f = 0; f < fixed.reference.size(); ++f)
    for (const detail::PolymerAtom& atom : fixed.reference[f].atoms) {
      atoms.push_back(atom.position);
      owner.push_back(static_cast<std::int32_t>(f));
    }
  const Eigen::Matrix3Xd points = positions(atoms);
  const detail::PointGrid near_interface(points, options.interface_cutoff,
                                         options.interface_cutoff);
  const detail::PointGrid near_contact(points, options.contact_cutoff, options.contact_cutoff);
  for (std::size_t m = 0; m < moving.reference.size(); ++m)
    for (const detail::PolymerAtom& atom : moving.reference[m].atoms) {
      near_interface.for_each_near(atom.position, [&](std::int32_t point) {
        out.fixed[owner[point]] = 1;
        out.moving[m] = 1;
      });
      near_contact.for_each_near(atom.position, [&](std::int32_t point) {
        out.contacts.emplace(owner[point], static_cast<std::int32_t>(m));
      });
    }
  return out;
}

std::vector<Eigen::Matrix3Xd> matched_residue_atoms(const MatchedBody& body) {
  std::vector<Eigen::Matrix3Xd> out;
  for (const auto& pair : body.pairs) out.push_back(positions(body.model[pair.first]));
  return out;
}

// Native contacts as positions in the two bodies' lists of pairs; those of unmatched residues drop
// out.
std::vector<std::pair<std::int32_t, std::int32_t>> matched_contacts(const Interface& interface,
                                                                    const MatchedBody& fixed,
                                                                    const MatchedBody& moving) {
  const auto places = [](const MatchedBody& body) {
    std::vector<std::int32_t> out(body.reference.size(), -1);
    for (std::size_t k = 0; k < body.pairs.size(); ++k)
      out[body.pairs[k].second] = static_cast<std::int32_t>(k);
    return out;
  };
  const std::vector<std::int32_t> fixed_place = places(fixed);
  const std::vector<std::int32_t> moving_place = places(moving);
  std::vector<std::pair<std::int32_t, std::int32_t>> out;
  for (const auto& [f, m] : interface.contacts)
    if (fixed_place[f] >= 0 && moving_place[m] >= 0)
      out.emplace_back(fixed_place[f], moving_place[m]);
  return out;
}

std::string named(const Molecule& molecule) {
  return molecule.path.empty() ? "(unnamed)" : molecule.path;
}

}  // namespace

struct ReferenceComplex::Impl {
  ReferenceSummary summary;
  PairedMoments interface_fixed;
  PairedMoments interface_moving;
  PairedMoments ligand;             // all its backbone
  RigidMotion receptor_superposed;  // model receptor -> reference receptor
  RigidMotion superposed_pose;
  detail::ResidueContacts contacts;
};

ReferenceComplex::ReferenceComplex(const Molecule& fixed, const Molecule& moving,
                                   const Molecule& reference_fixed,
                                   const Molecule& reference_moving,
                                   const ReferenceComplexOptions& options) {
  for (const double cutoff : {options.contact_cutoff, options.interface_cutoff})
    if (!(cutoff > 0.0 && std::isfinite(cutoff)))
      throw InputError("ReferenceComplex: cutoffs must be > 0 and finite, got " +
                       std::to_string(cutoff));
  const MatchedBody fixed_body = match_body(fixed, reference_fixed, options.match);
  const MatchedBody moving_body = match_body(moving, reference_moving, options.match);
  const Interface interface = find_interface(fixed_body, moving_body, options);
  if (interface.contacts.empty())
    throw InputError("ReferenceComplex: expected " + named(reference_fixed) + " and " +
                     named(reference_moving) + " to touch, found no two heavy atoms closer than " +
                     std::to_string(options.contact_cutoff) +
                     " angstrom: are they one complex in one frame?");

  ReferenceSummary summary;
  for (const auto& [body, wanted] :
       {std::pair(&fixed_body, &interface.fixed), std::pair(&moving_body, &interface.moving)}) {
    summary.interface_residues += std::count(wanted->begin(), wanted->end(), 1);
    for (const auto& pair : body->pairs)
      summary.interface_residues_matched += (*wanted)[pair.second] != 0 ? 1 : 0;
  }
  const auto contacts = matched_contacts(interface, fixed_body, moving_body);
  summary.native_contacts = interface.contacts.size();
  summary.native_contacts_matched = contacts.size();

  const auto interface_fixed = paired_backbone(fixed_body, interface.fixed);
  const auto interface_moving = paired_backbone(moving_body, interface.moving);
  for (const auto& [points, molecule] :
       {std::pair(&interface_fixed, &fixed), std::pair(&interface_moving, &moving)})
    if (points->first.cols() == 0)
      throw InputError(
          "ReferenceComplex: expected backbone atoms of the reference's interface in " +
          named(*molecule) + ", found none");

  const auto backbone = [](const MatchedBody& body) {
    return paired_backbone(body, std::vector<char>(body.reference.size(), 1));
  };
  const auto [fixed_model, fixed_reference] = backbone(fixed_body);
  const auto [moving_model, moving_reference] = backbone(moving_body);
  const RigidMotion fixed_superposed = superpose(fixed_model, fixed_reference).motion;
  const RigidMotion moving_superposed = superpose(moving_model, moving_reference).motion;
  summary.ligand_is_moving = options.ligand == LigandChoice::kMoving ||
                             moving_body.reference.size() <= fixed_body.reference.size();
  summary.fixed = fixed_body.match;
  summary.moving = moving_body.match;
  const bool ligand_is_moving = summary.ligand_is_moving;

  impl_ = std::make_shared<const Impl>(Impl{
      std::move(summary), detail::paired_moments(interface_fixed.first, interface_fixed.second),
      detail::paired_moments(interface_moving.first, interface_moving.second),
      ligand_is_moving ? detail::paired_moments(moving_model, moving_reference)
                       : detail::paired_moments(fixed_model, fixed_reference),
      ligand_is_moving ? fixed_superposed : moving_superposed,
      compose(inverse(fixed_superposed), moving_superposed),
      detail::ResidueContacts(matched_residue_atoms(fixed_body), matched_residue_atoms(moving_body),
                              contacts, options.contact_cutoff)});
}

ComplexMetrics ReferenceComplex::evaluate(const RigidMotion& moving_in_fixed) const {
  check_motion(moving_in_fixed, "ReferenceComplex::evaluate");
  const Impl& impl = *impl_;
  const Eigen::Matrix3d R = moving_in_fixed.rotation.toRotationMatrix();
  const Eigen::Vector3d& t = moving_in_fixed.translation;
  ComplexMetrics out;
  out.interface_rmsd = detail::rmsd_superposed(
      detail::merge(impl.interface_fixed, detail::moved(impl.interface_moving, R, t)));

  const RigidMotion ligand =
      compose(impl.receptor_superposed,
              impl.summary.ligand_is_moving ? moving_in_fixed : inverse(moving_in_fixed));
  out.ligand_rmsd = detail::rmsd_in_place(
      detail::moved(impl.ligand, ligand.rotation.toRotationMatrix(), ligand.translation));

  const detail::ContactCounts counts = impl.contacts.count(R, t);
  out.fnat = counts.native / static_cast<double>(impl.summary.native_contacts);
  out.fnonnat =
      counts.all == 0 ? 0.0 : (counts.all - counts.native) / static_cast<double>(counts.all);
  out.dockq = dockq_score(out.fnat, out.ligand_rmsd, out.interface_rmsd);
  out.capri = capri_class(out.fnat, out.ligand_rmsd, out.interface_rmsd);
  return out;
}

RigidMotion ReferenceComplex::superposed_pose() const { return impl_->superposed_pose; }

const ReferenceSummary& ReferenceComplex::summary() const { return impl_->summary; }

std::vector<ComplexMetrics> evaluate_poses(const ReferenceComplex& reference,
                                           const std::vector<RigidMotion>& poses, int threads) {
  constexpr std::size_t kChunk =
      64;  // poses per task: a task costs less than a microsecond, a pose a few
  std::vector<ComplexMetrics> out(poses.size());
  parallel_for((poses.size() + kChunk - 1) / kChunk, threads, [&](std::size_t chunk, int) {
    const std::size_t last = std::min(poses.size(), (chunk + 1) * kChunk);
    for (std::size_t i = chunk * kChunk; i < last; ++i) out[i] = reference.evaluate(poses[i]);
  });
  return out;
}

}  // namespace mortise
