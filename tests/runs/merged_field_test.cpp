// SPDX-License-Identifier: GPL-3.0-or-later
// What merging buried atoms does to the field that the search sees.
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "mortise/affinity/double_skin.hpp"
#include "mortise/kernels/low_pass.hpp"
#include "mortise/molecules/merge_buried.hpp"
#include "mortise/molecules/read_molecule.hpp"
#include "mortise/molecules/surface.hpp"
#include "mortise/molecules/to_knots.hpp"
#include "mortise/scoring/shape_kernel.hpp"

namespace mortise {
namespace {

// The low-passed field of knots at points: each knot against a point of weight 1.
Eigen::VectorXd field_at(const Knots& knots, const Eigen::Matrix3Xd& points,
                         const DoubleSkinOptions& skin, const LowPass& low_pass) {
  Channel channel = double_skin_channel(knots, knots, skin);
  channel.moving_transform = [](double, double) { return 1.0; };
  std::map<double, TabulatedKernel> kernels;
  Eigen::VectorXd field = Eigen::VectorXd::Zero(points.cols());
  for (Eigen::Index i = 0; i < knots.size(); ++i) {
    const double radius = knots.points(3, i);
    if (!kernels.contains(radius))
      kernels.emplace(radius, shape_kernel(channel, radius, 1.0, low_pass));
    const TabulatedKernel& kernel = kernels.at(radius);
    for (Eigen::Index p = 0; p < points.cols(); ++p)
      field[p] += knots.weights[i].real() *
                  kernel((points.col(p) - knots.points.col(i).head<3>()).squaredNorm());
  }
  return field;
}

double relative_error(const Eigen::VectorXd& a, const Eigen::VectorXd& exact) {
  return (a - exact).norm() / exact.norm();
}

TEST(MergedField, IsTheSameAtTheSurfaceAndRougherInside) {
  const Molecule molecule =
      read_molecule(parse_molecule_spec(MORTISE_SOURCE_DIR "/molecules/1hpv_receptor.pdb"))
          .molecule;
  const DoubleSkinOptions skin{.penalty_radius = 1.8};
  const LowPass low_pass{.cutoff = 0.25};
  const Knots atoms = to_knots(molecule);
  const Knots merged = merge_buried(atoms, {.largest = 4.0, .offset = skin.offset});
  ASSERT_LT(merged.size(), atoms.size());
  // Where another body's atoms can be, and where the merged atoms were.
  const Eigen::Matrix3Xd outside =
      accessible_points(atoms.points.topRows<3>(), atoms.points.row(3), {.points_per_atom = 10})
          .positions;
  const Eigen::Matrix3Xd inside =
      merged.points.rightCols(3).topRows<3>();  // middles of merged balls
  const double at_surface = relative_error(field_at(merged, outside, skin, low_pass),
                                           field_at(atoms, outside, skin, low_pass));
  const double within = relative_error(field_at(merged, inside, skin, low_pass),
                                       field_at(atoms, inside, skin, low_pass));
  EXPECT_LT(at_surface, 0.09);  // 0.074 with 713 knots of 758
  EXPECT_LT(within, 0.3);       // 0.22
}

}  // namespace
}  // namespace mortise
