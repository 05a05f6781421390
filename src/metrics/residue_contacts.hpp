// SPDX-License-Identifier: GPL-3.0-or-later
// Counting the residue contacts of two rigid bodies, pose after pose.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/point_grid.hpp"

namespace mortise::detail {

struct ContactCounts {
  int native = 0;  // contacts of the pose that are native
  int all = 0;     // contacts of the pose
};

// Residue pairs (one of each body) with two atoms closer than the cutoff.
class ResidueContacts {
 public:
  // Atoms per residue, 3 x n each, n >= 1; native: pairs of indices (fixed residue, moving residue)
  ResidueContacts(const std::vector<Eigen::Matrix3Xd>& fixed,
                  const std::vector<Eigen::Matrix3Xd>& moving,
                  const std::vector<std::pair<std::int32_t, std::int32_t>>& native, double cutoff);

  // Contacts when the moving body stands at R x + t.
  [[nodiscard]] ContactCounts count(const Eigen::Matrix3d& R, const Eigen::Vector3d& t) const;

 private:
  struct MovingResidue {
    Eigen::Vector3d centre;
    double reach = 0.0;                              // cutoff + farthest atom from the centre
    std::int32_t first = 0, last = 0;                // its columns of atoms_
    std::int32_t first_native = 0, last_native = 0;  // its part of native_
  };

  std::size_t fixed_count_;
  std::vector<MovingResidue> moving_;
  Eigen::Matrix3Xd atoms_;            // of the moving body
  std::vector<std::int32_t> native_;  // fixed partners of each moving residue, sorted
  std::vector<std::int32_t> owner_;   // fixed residue of each fixed atom
  PointGrid grid_;                    // of the fixed atoms
};

}  // namespace mortise::detail
