// SPDX-License-Identifier: GPL-3.0-or-later
// Random motions by seed.
#include "runs/random_start.hpp"

#include <cmath>
#include <numbers>
#include <random>

namespace mortise {

RigidMotion random_start(std::uint64_t seed, double reach) {
  std::mt19937_64 generator(seed);  // its numbers are fixed by the standard, unlike distributions'
  const auto uniform = [&] { return static_cast<double>(generator() >> 11) * 0x1p-53; };
  // K. Shoemake, Uniform random rotations, Graphics Gems III (1992) 124-132.
  const double u = uniform();
  const double a = 2.0 * std::numbers::pi * uniform();
  const double b = 2.0 * std::numbers::pi * uniform();
  RigidMotion start;
  start.rotation = canonical({std::sqrt(u) * std::cos(b), std::sqrt(1.0 - u) * std::sin(a),
                              std::sqrt(1.0 - u) * std::cos(a), std::sqrt(u) * std::sin(b)});
  for (int d = 0; d < 3; ++d) start.translation[d] = reach * (2.0 * uniform() - 1.0);
  return start;
}

}  // namespace mortise
