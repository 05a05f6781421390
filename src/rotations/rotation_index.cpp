// SPDX-License-Identifier: GPL-3.0-or-later
// The k-d tree behind RotationIndex.
#include "mortise/rotations/rotation_index.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "rotations/checks.hpp"

namespace mortise {
namespace {

Eigen::Vector4d unit_coordinates(const Eigen::Quaterniond& q, const char* who) {
  if (!(std::abs(q.norm() - 1.0) < 1e-6))
    throw InputError(std::string(who) + ": expected a unit quaternion, got norm " +
                     std::to_string(q.norm()));
  return Eigen::Vector4d(q.w(), q.x(), q.y(), q.z()).normalized();
}

}  // namespace

RotationIndex::RotationIndex(const Eigen::Matrix4Xd& quaternions)
    : points_(quaternions), member_(quaternions.cols()), axis_(quaternions.cols()) {
  check_quaternions(quaternions, "RotationIndex");
  std::iota(member_.begin(), member_.end(), Eigen::Index{0});
  build(0, size());
  for (Eigen::Index i = 0; i < size(); ++i) points_.col(i) = quaternions.col(member_[i]);
}

void RotationIndex::build(Eigen::Index begin, Eigen::Index end) {
  if (begin >= end) return;
  Eigen::Vector4d low = points_.col(member_[begin]);
  Eigen::Vector4d high = low;
  for (Eigen::Index i = begin; i < end; ++i) {
    low = low.cwiseMin(points_.col(member_[i]));
    high = high.cwiseMax(points_.col(member_[i]));
  }
  Eigen::Index axis = 0;
  (high - low).maxCoeff(&axis);
  const Eigen::Index middle = begin + (end - begin) / 2;
  std::nth_element(member_.begin() + begin, member_.begin() + middle, member_.begin() + end,
                   [&](Eigen::Index a, Eigen::Index b) {
                     const double pa = points_(axis, a);
                     const double pb = points_(axis, b);
                     return pa < pb || (pa == pb && a < b);
                   });
  axis_[middle] = static_cast<std::uint8_t>(axis);
  build(begin, middle);
  build(middle + 1, end);
}

std::vector<Eigen::Index> RotationIndex::within(const Eigen::Quaterniond& centre,
                                                double angle) const {
  const Eigen::Vector4d q = unit_coordinates(centre, "RotationIndex::within");
  if (!(angle >= 0.0))
    throw InputError("RotationIndex::within: angle must be >= 0, got " + std::to_string(angle));
  std::vector<Eigen::Index> found;
  if (angle >= std::numbers::pi) {
    found.resize(size());
    std::iota(found.begin(), found.end(), Eigen::Index{0});
    return found;
  }
  // Chords on the 3-sphere, where the angle between quaternions is half the rotation's.
  const double chord = 2.0 * std::sin(0.25 * angle);
  const double chord_sq = chord * chord;
  const auto visit = [&](const auto& self, const Eigen::Vector4d& x, Eigen::Index begin,
                         Eigen::Index end) -> void {
    while (begin < end) {
      const Eigen::Index middle = begin + (end - begin) / 2;
      if ((points_.col(middle) - x).squaredNorm() <= chord_sq) found.push_back(member_[middle]);
      const double offset = x(axis_[middle]) - points_(axis_[middle], middle);
      if (offset >= -chord && offset <= chord) self(self, x, begin, middle);
      if (offset >= -chord)
        begin = middle + 1;
      else
        end = middle;
    }
  };
  visit(visit, q, 0, size());
  visit(visit, -q, 0, size());
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

}  // namespace mortise
