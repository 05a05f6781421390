// SPDX-License-Identifier: GPL-3.0-or-later
// Score maps between grid points as smooth functions of the pose.
#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "core/isa.hpp"
#include "mortise/core/errors.hpp"
#include "mortise/scoring/score_maps.hpp"
#include "scoring/field_isa.hpp"

namespace mortise {
namespace isa_baseline {
extern const FieldTable kFieldTable;
}
namespace isa_avx2 {
extern const FieldTable kFieldTable;
}
namespace isa_avx512 {
extern const FieldTable kFieldTable;
}

PlacedPoints::PlacedPoints(const TypedPoints& typed, const Eigen::Matrix3Xd& shape_points,
                           const Eigen::VectorXd& shape_weights) {
  if (typed.points.cols() != typed.types.size() || shape_points.cols() != shape_weights.size() ||
      shape_points.cols() == 0)
    throw InputError("placed points: expected a type or weight for each point, got " +
                     std::to_string(typed.types.size()) + " for " +
                     std::to_string(typed.points.cols()) + " and " +
                     std::to_string(shape_weights.size()) + " for " +
                     std::to_string(shape_points.cols()));
  centre = shape_points.rowwise().mean();
  // A body of one point turns too, by nothing: its atom's size keeps the step finite.
  constexpr double kLeastGyration = 1.0;
  gyration = std::max(kLeastGyration, std::sqrt((shape_points.colwise() - centre).squaredNorm() /
                                                static_cast<double>(shape_points.cols())));
  const auto key = [](const auto& p) { return std::array<double, 3>{p[0], p[1], p[2]}; };
  std::map<std::array<double, 3>, Eigen::Index> shape_at;  // the knots that no typed point takes
  for (Eigen::Index i = 0; i < shape_points.cols(); ++i)
    shape_at.emplace(key(shape_points.col(i)), i);
  std::vector<Eigen::Vector3d> places;
  std::vector<int> kinds;
  std::vector<double> shares;
  const auto add = [&](const Eigen::Vector3d& place, int type, double weight) {
    places.emplace_back(place - centre);
    kinds.push_back(type);
    shares.push_back(weight);
  };
  std::vector<std::uint8_t> taken(shape_points.cols(), 0);
  for (Eigen::Index j = 0; j < typed.points.cols(); ++j) {
    if (typed.types[j] < 0) continue;
    const auto found = shape_at.find(key(typed.points.col(j)));
    const bool shared = found != shape_at.end() && taken[found->second] == 0;
    if (shared) taken[found->second] = 1;
    add(typed.points.col(j), typed.types[j], shared ? shape_weights[found->second] : 0.0);
  }
  for (Eigen::Index i = 0; i < shape_points.cols(); ++i)
    if (taken[i] == 0) add(shape_points.col(i), -1, shape_weights[i]);
  const auto count = static_cast<Eigen::Index>(places.size());
  x.resize(count);
  y.resize(count);
  z.resize(count);
  types = Eigen::Map<const Eigen::VectorXi>(kinds.data(), count);
  weights = Eigen::Map<const Eigen::VectorXd>(shares.data(), count);
  for (Eigen::Index n = 0; n < count; ++n) {
    x[n] = places[n][0];
    y[n] = places[n][1];
    z[n] = places[n][2];
  }
}

PlacedScore ScoreMaps::smooth(const PlacedPoints& moving, const RigidMotion& moving_in_fixed,
                              double contact, double shape) const {
  if (!has_shape_) throw InputError("score maps: smooth scores need the shape's map");
  if (moving.types.maxCoeff() >= types_)
    throw InputError("score maps: moving body: type " + std::to_string(moving.types.maxCoeff()) +
                     " is not one of the potential's " + std::to_string(types_));
  static const FieldTable& table = pick_isa(best_isa(), isa_baseline::kFieldTable,
                                            isa_avx2::kFieldTable, isa_avx512::kFieldTable);
  const Eigen::Matrix<double, 3, 3, Eigen::RowMajor> rotation =
      moving_in_fixed.rotation.toRotationMatrix() / spacing_;
  const Eigen::Vector3d centre = (moving_in_fixed * moving.centre - low_) / spacing_;
  const FieldMaps maps{values_.data(), nearby_.data(), {size_[0], size_[1], size_[2]},
                       types_,         contact,        shape};
  const FieldPoints points{moving.x.data(),     moving.y.data(),       moving.z.data(),
                           moving.types.data(), moving.weights.data(), moving.x.size()};
  double out[7];
  table.evaluate(maps, points, rotation.data(), centre.data(), out);
  return {out[0],
          Eigen::Vector3d(out[1], out[2], out[3]) / spacing_,
          {out[4], out[5], out[6]}};  // arm and force: the steps cancel
}

PlacedScore ScoreMaps::smooth_score(const PlacedPoints& moving,
                                    const RigidMotion& moving_in_fixed) const {
  return smooth(moving, moving_in_fixed, 1.0, 1.0);
}

std::array<double, 2> ScoreMaps::smooth_terms(const PlacedPoints& moving,
                                              const RigidMotion& moving_in_fixed) const {
  return {smooth(moving, moving_in_fixed, 0.0, 1.0).value,
          smooth(moving, moving_in_fixed, 1.0, 0.0).value};
}

}  // namespace mortise
