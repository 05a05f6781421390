// SPDX-License-Identifier: GPL-3.0-or-later
// Rotations as a grid on the sphere times a circle: the Hopf fibration over HEALPix.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "mortise/core/rigid_motion.hpp"
#include "rotations/checks.hpp"

namespace mortise {
namespace {

struct Direction {
  double z, longitude;
};

// The 12 n^2 pixel centres of HEALPix, ring by ring from the north (Gorski et al. 2005, Eq. 4-9).
std::vector<Direction> healpix_centres(Eigen::Index n) {
  std::vector<Direction> centres;
  const double side = static_cast<double>(n);
  for (Eigen::Index ring = 1; ring < 4 * n; ++ring) {
    const Eigen::Index from_pole = std::min(ring, 4 * n - ring);
    const double i = static_cast<double>(from_pole);
    const bool cap = from_pole < n;
    double z = cap ? 1.0 - i * i / (3.0 * side * side) : 4.0 / 3.0 - 2.0 * i / (3.0 * side);
    if (ring > 2 * n) z = -z;
    const Eigen::Index pixels = cap ? 4 * from_pole : 4 * n;
    const double shift = cap || (from_pole - n) % 2 == 0 ? 0.5 : 0.0;  // of every second ring
    for (Eigen::Index j = 0; j < pixels; ++j)
      centres.push_back({z, 2.0 * std::numbers::pi * (static_cast<double>(j) + shift) /
                                static_cast<double>(pixels)});
  }
  return centres;
}

// The n whose grid of 12 n^2 directions and count / (12 n^2) turns is most nearly as fine in both:
// turns = 6 n. 0 if the count allows none finer in one than twice the other.
Eigen::Index directions_side(Eigen::Index count) {
  Eigen::Index best = 0;
  double least = std::log(2.0) + 1e-9;
  for (Eigen::Index n = 1; 36 * n * n * n <= count; ++n) {
    if (count % (12 * n * n) != 0) continue;
    const double turns = static_cast<double>(count / (12 * n * n));
    const double misfit = std::abs(std::log(turns / (6.0 * static_cast<double>(n))));
    if (misfit < least) {
      least = misfit;
      best = n;
    }
  }
  return best;
}

std::string nearest_counts(Eigen::Index count) {
  constexpr Eigen::Index kLeast = 36;
  Eigen::Index below = count - 1;
  while (below >= kLeast && directions_side(below) == 0) --below;
  Eigen::Index above = std::max(count + 1, kLeast);
  while (directions_side(above) == 0) ++above;
  return (below >= kLeast ? std::to_string(below) + " and " : "") + std::to_string(above);
}

}  // namespace

Eigen::Matrix4Xd hopf_rotations(Eigen::Index count) {
  check_rotation_count(count, "hopf_rotations");
  const Eigen::Index n = directions_side(count);
  if (n == 0)
    throw InputError("hopf_rotations: count must be 12 n^2 m with 3 n <= m <= 12 n, got " +
                     std::to_string(count) + "; the nearest that is: " + nearest_counts(count));
  const Eigen::Index turns = count / (12 * n * n);
  Eigen::Matrix4Xd quaternions(4, count);
  Eigen::Index column = 0;
  for (const Direction& direction : healpix_centres(n)) {
    const double c = std::sqrt(0.5 * (1.0 + direction.z));  // cos and sin of half the colatitude
    const double s = std::sqrt(0.5 * (1.0 - direction.z));
    const Eigen::Quaterniond tilt(c, -s * std::sin(direction.longitude),
                                  s * std::cos(direction.longitude), 0.0);
    for (Eigen::Index k = 0; k < turns; ++k) {
      const double half = std::numbers::pi * static_cast<double>(k) / static_cast<double>(turns);
      // First the turn about z, then the least rotation that carries z to the direction.
      const Eigen::Quaterniond turn(std::cos(half), 0.0, 0.0, std::sin(half));
      const Eigen::Quaterniond q = canonical(tilt * turn);
      quaternions.col(column++) << q.w(), q.x(), q.y(), q.z();
    }
  }
  return quaternions;
}

}  // namespace mortise
