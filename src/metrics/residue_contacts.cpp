// SPDX-License-Identifier: GPL-3.0-or-later
// Contact counting: residues far from the fixed body are skipped by their bounding ball, atoms by
// the cell list.
#include "metrics/residue_contacts.hpp"

#include <algorithm>

namespace mortise::detail {
namespace {

Eigen::Matrix3Xd joined(const std::vector<Eigen::Matrix3Xd>& parts) {
  Eigen::Index count = 0;
  for (const auto& part : parts) count += part.cols();
  Eigen::Matrix3Xd out(3, count);
  Eigen::Index k = 0;
  for (const auto& part : parts) {
    out.middleCols(k, part.cols()) = part;
    k += part.cols();
  }
  return out;
}

Eigen::Vector3d middle(const Eigen::Matrix3Xd& points) {
  return 0.5 * (points.rowwise().minCoeff() + points.rowwise().maxCoeff());
}

double longest_reach(const std::vector<Eigen::Matrix3Xd>& residues, double cutoff) {
  double radius = 0.0;
  for (const auto& atoms : residues)
    radius = std::max(radius, (atoms.colwise() - middle(atoms)).colwise().norm().maxCoeff());
  return cutoff + radius;
}

}  // namespace

ResidueContacts::ResidueContacts(const std::vector<Eigen::Matrix3Xd>& fixed,
                                 const std::vector<Eigen::Matrix3Xd>& moving,
                                 const std::vector<std::pair<std::int32_t, std::int32_t>>& native,
                                 double cutoff)
    : fixed_count_(fixed.size()),
      atoms_(joined(moving)),
      grid_(joined(fixed), cutoff, longest_reach(moving, cutoff)) {
  for (std::size_t r = 0; r < fixed.size(); ++r)
    owner_.insert(owner_.end(), static_cast<std::size_t>(fixed[r].cols()),
                  static_cast<std::int32_t>(r));
  std::vector<std::vector<std::int32_t>> partners(moving.size());
  for (const auto& [f, m] : native) partners[m].push_back(f);
  std::int32_t column = 0;
  for (std::size_t r = 0; r < moving.size(); ++r) {
    MovingResidue residue;
    residue.centre = middle(moving[r]);
    residue.reach = longest_reach({moving[r]}, cutoff);
    residue.first = column;
    residue.last = column += static_cast<std::int32_t>(moving[r].cols());
    residue.first_native = static_cast<std::int32_t>(native_.size());
    std::sort(partners[r].begin(), partners[r].end());
    native_.insert(native_.end(), partners[r].begin(), partners[r].end());
    residue.last_native = static_cast<std::int32_t>(native_.size());
    moving_.push_back(residue);
  }
}

ContactCounts ResidueContacts::count(const Eigen::Matrix3d& R, const Eigen::Vector3d& t) const {
  ContactCounts out;
  // stamp[f] = m: fixed residue f is already known to touch moving residue m.
  std::vector<std::int32_t> stamp(fixed_count_, -1);
  for (std::size_t m = 0; m < moving_.size(); ++m) {
    const MovingResidue& residue = moving_[m];
    if (grid_.surely_farther(R * residue.centre + t, residue.reach)) continue;
    for (std::int32_t a = residue.first; a < residue.last; ++a) {
      const Eigen::Vector3d p = R * atoms_.col(a) + t;
      grid_.for_each_near(p, [&](std::int32_t point) {
        const std::int32_t f = owner_[point];
        if (stamp[f] == static_cast<std::int32_t>(m)) return;
        stamp[f] = static_cast<std::int32_t>(m);
        ++out.all;
        if (std::binary_search(native_.begin() + residue.first_native,
                               native_.begin() + residue.last_native, f))
          ++out.native;
      });
    }
  }
  return out;
}

}  // namespace mortise::detail
