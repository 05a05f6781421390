// SPDX-License-Identifier: GPL-3.0-or-later
// Parts as balls for mating's search.
#include "runs/part_knots.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "mortise/core/errors.hpp"
#include "mortise/parts/decompose.hpp"

namespace mortise {
namespace {

// A solid that knows no depth beyond `deepest`: balls about its nodes are no larger.
class ShallowSolid : public Solid {
 public:
  ShallowSolid(const Solid& solid, double deepest) : solid_(solid), deepest_(deepest) {}
  [[nodiscard]] Eigen::AlignedBox3d bounds() const override { return solid_.bounds(); }
  [[nodiscard]] Eigen::VectorXd signed_distance(const Eigen::Matrix3Xd& points,
                                                double band) const override {
    return solid_.signed_distance(points, std::min(band, deepest_)).cwiseMax(-deepest_);
  }

 private:
  const Solid& solid_;
  double deepest_;
};

}  // namespace

Knots part_balls(const char* name, const LocalFrame& frame, const Solid& solid,
                 const PartBallsOptions& options) {
  const double longest = solid.bounds().sizes().maxCoeff();
  // As fine as asked, but within what decompose() takes.
  const int grid = std::clamp(static_cast<int>(std::ceil(longest / options.step)), 2, 1024);
  try {
    Knots knots = decompose(ShallowSolid(solid, options.largest), {.grid = grid,
                                                                   .protrusion = options.mu,
                                                                   .weights = KnotWeights::kShare,
                                                                   .expansion = options.expansion,
                                                                   .threads = options.threads})
                      .knots;
    knots.points.topRows<3>() = frame.to_input(knots.points.topRows<3>());
    knots.points.row(3) *= frame.unit;
    return knots;
  } catch (const InputError& e) {
    throw InputError(std::string("mate: the ") + name + " part as balls: " + e.what());
  }
}

}  // namespace mortise
