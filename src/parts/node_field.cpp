// SPDX-License-Identifier: GPL-3.0-or-later
// Sampling a solid's distance on the grid of a decomposition.
#include "parts/node_field.hpp"

#include <limits>
#include <string>

#include "mortise/core/errors.hpp"
#include "mortise/core/threads.hpp"

namespace mortise::parts {

NodeField node_field(const Solid& solid, int grid, int threads) {
  const Eigen::AlignedBox3d box = solid.bounds();
  const double longest = box.isEmpty() ? 0.0 : box.sizes().maxCoeff();
  if (!(longest > 0.0) || !std::isfinite(longest))
    throw InputError("decompose: the solid's box must have a length, got " +
                     std::to_string(longest));
  NodeField field;
  field.spacing = longest / grid;
  // A side that is a whole number of cells long but for rounding gets no further cell.
  field.size = (box.sizes().array() / field.spacing - 1e-9).ceil().cast<int>().max(1);
  field.origin = box.center() - 0.5 * field.spacing * (field.size - 1).cast<double>().matrix();
  const std::int64_t rows = static_cast<std::int64_t>(field.size.x()) * field.size.y();
  if (rows * field.size.z() > std::int64_t{1} << 30)
    throw InputError("decompose: the grid has more than 2^30 nodes");
  field.depth.resize(rows * field.size.z());
  parallel_for(static_cast<std::size_t>(field.size.x()), threads, [&](std::size_t x, int) {
    Eigen::Matrix3Xd points(3, static_cast<Eigen::Index>(field.size.y()) * field.size.z());
    Eigen::Index i = 0;
    for (int y = 0; y < field.size.y(); ++y)
      for (int z = 0; z < field.size.z(); ++z)
        points.col(i++) = field.position({static_cast<double>(x), double(y), double(z)});
    const Eigen::VectorXd distance =
        solid.signed_distance(points, std::numeric_limits<double>::infinity());
    float* slab = field.depth.data() + static_cast<std::ptrdiff_t>(x) * points.cols();
    for (Eigen::Index k = 0; k < points.cols(); ++k) {
      if (!std::isfinite(distance[k]))
        throw InputError("decompose: the solid's distance is not finite");
      slab[k] = static_cast<float>(-distance[k] / field.spacing);
    }
  });
  return field;
}

}  // namespace mortise::parts
