// SPDX-License-Identifier: GPL-3.0-or-later
// Closure of a few generators to a finite rotation group.
#include "rotations/groups.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "mortise/core/errors.hpp"
#include "mortise/core/rigid_motion.hpp"

namespace mortise {

std::vector<Eigen::Quaterniond> generate_group(const std::vector<Eigen::Quaterniond>& generators) {
  std::vector<Eigen::Quaterniond> group{Eigen::Quaterniond::Identity()};
  for (std::size_t i = 0; i < group.size(); ++i)
    for (const Eigen::Quaterniond& g : generators) {
      const Eigen::Quaterniond product = canonical(group[i] * g);
      const bool known = std::any_of(group.begin(), group.end(), [&](const auto& member) {
        return rotation_angle(member, product) < 1e-6;
      });
      if (!known) group.push_back(product);
      assert(group.size() <= 1000);
    }
  return group;
}

std::vector<Eigen::Quaterniond> rotation_group(const std::string& name) {
  const Eigen::Quaterniond third(0.5, 0.5, 0.5, 0.5);  // about (1, 1, 1)
  const Eigen::Quaterniond half_x(0.0, 1.0, 0.0, 0.0);
  if (name == "T") return generate_group({third, half_x});
  if (name == "O")
    return generate_group({third, Eigen::Quaterniond(1.0, 1.0, 0.0, 0.0).normalized()});
  constexpr double kGolden = std::numbers::phi;
  if (name == "I") return generate_group({third, {kGolden / 2.0, 0.5 / kGolden, 0.5, 0.0}});
  const bool digits =
      name.size() > 1 && name.size() < 4 &&
      std::all_of(name.begin() + 1, name.end(), [](char c) { return c >= '0' && c <= '9'; });
  const int fold = digits ? std::stoi(name.substr(1)) : 0;
  if (fold < 1 || (name[0] != 'C' && name[0] != 'D'))
    throw InputError("rotation_group: expected Cn, Dn, T, O or I, got " + name);
  const double half_turn = std::numbers::pi / fold;
  std::vector<Eigen::Quaterniond> generators{{std::cos(half_turn), 0.0, 0.0, std::sin(half_turn)}};
  if (name[0] == 'D') generators.push_back(half_x);
  return generate_group(generators);
}

}  // namespace mortise
