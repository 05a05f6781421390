// SPDX-License-Identifier: GPL-3.0-or-later
// The stored sets: unions of left cosets of the icosahedral rotation group with optimised
// representatives.
#include <numbers>

#include "mortise/core/rigid_motion.hpp"
#include "rotations/checks.hpp"
#include "rotations/groups.hpp"
#include "rotations/stored_sets.hpp"

namespace mortise {
namespace {

struct CosetTable {
  Eigen::Index cosets;
  const double* numbers;  // covering radius in degrees, then w, x, y, z of each representative
};

#include "coset_tables.inc"

constexpr Eigen::Index kGroupOrder = 60;

}  // namespace

std::vector<Eigen::Index> stored_rotation_counts() {
  std::vector<Eigen::Index> counts;
  for (const CosetTable& table : kCosetTables) counts.push_back(kGroupOrder * table.cosets);
  return counts;
}

std::optional<RotationSet> stored_rotation_set(Eigen::Index count) {
  for (const CosetTable& table : kCosetTables) {
    if (kGroupOrder * table.cosets != count) continue;
    RotationSet set;
    set.method = RotationMethod::kIcosahedral;
    set.covering_radius = table.numbers[0] * std::numbers::pi / 180.0;
    set.quaternions.resize(4, count);
    const std::vector<Eigen::Quaterniond> group = rotation_group("I");
    const double* next = table.numbers + 1;
    for (Eigen::Index i = 0; i < table.cosets; ++i, next += 4)
      for (Eigen::Index g = 0; g < kGroupOrder; ++g) {
        const Eigen::Quaterniond representative(next[0], next[1], next[2], next[3]);
        const Eigen::Quaterniond q = canonical(group[g] * representative);
        set.quaternions.col(kGroupOrder * i + g) << q.w(), q.x(), q.y(), q.z();
      }
    return set;
  }
  return std::nullopt;
}

}  // namespace mortise
