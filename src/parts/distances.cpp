// SPDX-License-Identifier: GPL-3.0-or-later
// Distances of many points from one body.
#include "parts/distances.hpp"

#include <algorithm>

#include "mortise/core/threads.hpp"

namespace mortise {

Eigen::VectorXd distances(const Solid& solid, const Eigen::Matrix3Xd& points, double band,
                          int threads) {
  Eigen::VectorXd result(points.cols());
  constexpr Eigen::Index kPiece = 1024;
  const auto pieces = static_cast<std::size_t>((points.cols() + kPiece - 1) / kPiece);
  parallel_for(pieces, threads, [&](std::size_t piece, int) {
    const Eigen::Index begin = static_cast<Eigen::Index>(piece) * kPiece;
    const Eigen::Index count = std::min(kPiece, points.cols() - begin);
    result.segment(begin, count) = solid.signed_distance(points.middleCols(begin, count), band);
  });
  return result;
}

}  // namespace mortise
