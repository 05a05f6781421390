// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Finding the members of a rotation set that lie near a given rotation.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

namespace mortise {

/// A k-d tree over the unit quaternions of a rotation set; q and -q are the same rotation.
/// Immutable once built, so any number of threads may ask at once.
class RotationIndex {
 public:
  /// @param quaternions  4 x N: rows w, x, y, z, unit length; copied
  /// @throws InputError if there is no column or one is not of unit length (to 1e-6)
  /// Time O(N log^2 N), memory 44 N bytes.
  explicit RotationIndex(const Eigen::Matrix4Xd& quaternions);

  [[nodiscard]] Eigen::Index size() const noexcept { return points_.cols(); }

  /// Members no more than `angle` (radians) of rotation away from `centre`, by ascending index.
  /// @throws InputError unless angle >= 0 and `centre` is of unit length. Time O(log N + hits) when
  /// few are near.
  [[nodiscard]] std::vector<Eigen::Index> within(const Eigen::Quaterniond& centre,
                                                 double angle) const;

 private:
  void build(Eigen::Index begin, Eigen::Index end);

  // The tree is implicit: the root of a range of columns is its middle one.
  Eigen::Matrix4Xd points_;           // columns in tree order
  std::vector<Eigen::Index> member_;  // tree position -> column of the set
  std::vector<std::uint8_t> axis_;    // tree position -> coordinate it splits by
};

}  // namespace mortise
