// SPDX-License-Identifier: GPL-3.0-or-later
// Pairs of atoms of two bodies that are near each other, and what one body's atoms cover of the
// other's surroundings.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "core/point_grid.hpp"

namespace mortise::detail {

// Those atoms of one body that have a neighbour in the other.
struct Neighbours {
  std::vector<std::int32_t> atoms;     // rising
  std::vector<std::int32_t> first;     // one more than atoms: their part of `partners`
  std::vector<std::int32_t> partners;  // atoms of the other body, rising for each atom
};

struct NearPairs {
  Neighbours fixed, moving;
};

// Pairs at a distance below the grid's cutoff. `fixed`: the grid of M fixed atoms; `moving`: in the
// same frame.
[[nodiscard]] NearPairs near_pairs(const PointGrid& fixed, Eigen::Index fixed_count,
                                   const Eigen::Matrix3Xd& moving);

// Places of a probe's centre around a body, each in touch with one of the body's atoms.
struct ProbePlaces {
  Eigen::Matrix3Xd centres;         // 3 x P
  std::vector<Eigen::Index> first;  // atoms + 1: those of atom i are first[i] to first[i + 1]
  Eigen::VectorXd grown;            // the atoms' radii plus the probe's
};

// Calls visit(place) for all places, rising, that the other body takes away: those within one of
// its grown atoms. `partners` and `partner_grown`: the other body's, its centres in this body's
// frame.
template <class Visit>
void for_each_covered(const ProbePlaces& places, const Eigen::Matrix3Xd& own,
                      const Neighbours& neighbours, const Eigen::Matrix3Xd& partners,
                      const Eigen::VectorXd& partner_grown, Visit&& visit) {
  struct Ball {
    double x, y, z, radius_sq;
  };
  std::vector<Ball> balls;
  for (std::size_t a = 0; a < neighbours.atoms.size(); ++a) {
    const std::int32_t i = neighbours.atoms[a];
    if (places.first[i] == places.first[i + 1]) continue;
    balls.clear();
    for (std::int32_t k = neighbours.first[a]; k < neighbours.first[a + 1]; ++k) {
      const std::int32_t j = neighbours.partners[k];
      const double reach = places.grown[i] + partner_grown[j];
      if ((partners.col(j) - own.col(i)).squaredNorm() < reach * reach)
        balls.push_back(
            {partners(0, j), partners(1, j), partners(2, j), partner_grown[j] * partner_grown[j]});
    }
    if (balls.empty()) continue;
    std::size_t last = 0;  // often covers the next place too
    for (Eigen::Index p = places.first[i]; p < places.first[i + 1]; ++p) {
      const double x = places.centres(0, p), y = places.centres(1, p), z = places.centres(2, p);
      const auto covers = [&](const Ball& b) {
        return (b.x - x) * (b.x - x) + (b.y - y) * (b.y - y) + (b.z - z) * (b.z - z) < b.radius_sq;
      };
      if (covers(balls[last])) {
        visit(p);
        continue;
      }
      for (std::size_t k = 0; k < balls.size(); ++k)
        if (covers(balls[k])) {
          last = k;
          visit(p);
          break;
        }
    }
  }
}

}  // namespace mortise::detail
