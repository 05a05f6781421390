// SPDX-License-Identifier: GPL-3.0-or-later
// Poses scored by the fixed body's maps.
#include "mortise/scoring/score_maps.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "core/isa.hpp"
#include "mortise/core/errors.hpp"
#include "mortise/core/threads.hpp"
#include "scoring/by_place.hpp"
#include "scoring/fill_maps.hpp"

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

namespace {

const FieldTable& field_table() {
  return pick_isa(best_isa(), isa_baseline::kFieldTable, isa_avx2::kFieldTable,
                  isa_avx512::kFieldTable);
}

void check_points(const TypedPoints& body, Eigen::Index types, const char* name) {
  const std::string where = std::string("score maps: ") + name + " body: ";
  if (body.points.cols() != body.types.size())
    throw InputError(where + "expected one type per point, got " +
                     std::to_string(body.types.size()) + " for " +
                     std::to_string(body.points.cols()));
  if (body.types.size() > 0 && body.types.maxCoeff() >= types)
    throw InputError(where + "type " + std::to_string(body.types.maxCoeff()) +
                     " is not one of the potential's " + std::to_string(types));
  if (!body.points.allFinite()) throw InputError(where + "a coordinate is not finite");
}

void check_shape(const ShapeTerms& shape) {
  const auto refuse = [](const std::string& what) {
    throw InputError("score maps: shape: " + what);
  };
  if (shape.points.cols() != shape.weights.size() ||
      shape.points.cols() != shape.kernel_of.size() || shape.points.cols() == 0)
    refuse("expected one weight and kernel per point and a point, got " +
           std::to_string(shape.weights.size()) + " and " + std::to_string(shape.kernel_of.size()) +
           " for " + std::to_string(shape.points.cols()));
  if (!shape.points.allFinite() || !shape.weights.allFinite())
    refuse("a coordinate or weight is not finite");
  if (shape.kernels.empty() || shape.kernels.front().empty())
    refuse("expected a term with a kernel, got none");
  const TabulatedKernel& first = shape.kernels.front().front();
  for (const auto& term : shape.kernels) {
    if (shape.kernel_of.minCoeff() < 0 ||
        static_cast<std::size_t>(shape.kernel_of.maxCoeff()) >= term.size())
      refuse("a knot's kernel is not one of its term's " + std::to_string(term.size()));
    for (const TabulatedKernel& kernel : term)
      if (kernel.range != first.range || kernel.values.size() != first.values.size())
        refuse("kernels are not all of one range and size");
  }
}

// A pose as the instruction sets' copies take it, lengths in grid steps.
struct Placement {
  Placement(const PlacedPoints& moving, const RigidMotion& moving_in_fixed,
            const Eigen::Vector3d& low, double spacing)
      : rotation((moving_in_fixed.rotation.toRotationMatrix() / spacing).cast<float>()),
        centre(((moving_in_fixed * moving.centre - low) / spacing).cast<float>()) {}
  Eigen::Matrix<float, 3, 3, Eigen::RowMajor> rotation;
  Eigen::Vector3f centre;
};

FieldPoints field_points(const PlacedPoints& moving, Eigen::Index shapes, double spacing) {
  return {moving.places.col(0).data(),
          moving.places.col(1).data(),
          moving.places.col(2).data(),
          moving.types.data(),
          moving.contact_weights.data(),
          moving.shape_weights.data(),
          moving.places.rows(),
          shapes,
          moving.groups.col(0).data(),
          moving.groups.col(1).data(),
          moving.groups.col(2).data(),
          moving.groups.col(3).data(),
          static_cast<float>(1.0 / spacing)};
}

}  // namespace

ShapeTerms shape_terms(const Eigen::Matrix3Xd& points, const Eigen::VectorXd& weights,
                       const TabulatedKernel& kernel) {
  return {points, weights, Eigen::VectorXi::Zero(points.cols()), {{kernel}}};
}

ScoreMaps::ScoreMaps(const TypedPoints& fixed, const ContactPotential& potential,
                     const ScoreMapsOptions& options)
    : ScoreMaps(fixed, potential, nullptr, options) {}

ScoreMaps::ScoreMaps(const TypedPoints& fixed, const ContactPotential& potential,
                     const ShapeTerms& shape, const ScoreMapsOptions& options)
    : ScoreMaps(fixed, potential, &shape, options) {}

ScoreMaps::ScoreMaps(const TypedPoints& fixed, const ContactPotential& potential,
                     const ShapeTerms* shape, const ScoreMapsOptions& options)
    : spacing_(options.spacing), types_(static_cast<int>(potential.near.rows())) {
  if (!(spacing_ > 0.0))
    throw InputError("score maps: spacing must be > 0, got " + std::to_string(spacing_));
  check_points(fixed, potential.near.rows(), "fixed");
  double margin = kContactRange;
  Eigen::Matrix3Xd all = fixed.points;
  if (shape != nullptr) {
    check_shape(*shape);
    shapes_ = static_cast<int>(shape->kernels.size());
    all.conservativeResize(3, fixed.points.cols() + shape->points.cols());
    all.rightCols(shape->points.cols()) = shape->points;
    // Whole steps more, so that contacts are those of the maps without a shape.
    const double more = shape->kernels.front().front().range - kContactRange;
    margin += std::ceil(std::max(0.0, more) / spacing_) * spacing_;
  }
  lay_out(all, margin);
  detail::FilledMaps filled = detail::fill_maps(field_table(), {size_, low_, spacing_}, fixed,
                                                potential, shape, options.threads);
  blocks_ = std::move(filled.blocks);
  values_ = std::move(filled.values);
}

void ScoreMaps::lay_out(const Eigen::Matrix3Xd& points, double margin) {
  if (points.cols() == 0) return;
  low_ = points.rowwise().minCoeff().array() - margin;
  const Eigen::Vector3d high = points.rowwise().maxCoeff().array() + margin;
  for (int d = 0; d < 3; ++d)
    size_[d] = static_cast<int>(std::ceil((high[d] - low_[d]) / (kBrickCells * spacing_)));
}

std::size_t ScoreMaps::bytes() const {
  return blocks_.size() * sizeof blocks_[0] + values_.size() * sizeof values_[0];
}

void ScoreMaps::check(const PlacedPoints& moving) const {
  if (moving.largest_type >= types_)
    throw InputError("score maps: moving body: type " + std::to_string(moving.largest_type) +
                     " is not one of the potential's " + std::to_string(types_));
}

double ScoreMaps::contact_score(const PlacedPoints& moving,
                                const RigidMotion& moving_in_fixed) const {
  check(moving);
  const Placement at(moving, moving_in_fixed, low_, spacing_);
  const FieldMaps maps{values_.data(), blocks_.data(), {size_[0], size_[1], size_[2]}, types_};
  return field_table().value(maps, field_points(moving, 0, spacing_), at.rotation.data(),
                             at.centre.data());
}

Eigen::VectorXd ScoreMaps::contact_scores(const PlacedPoints& moving,
                                          const std::vector<RigidMotion>& poses,
                                          int threads) const {
  check(moving);
  Eigen::VectorXd scores(static_cast<Eigen::Index>(poses.size()));
  const std::vector<std::size_t> order = detail::by_place(poses, moving.centre);
  constexpr std::size_t kAtOnce = 256;  // large enough that handing them out costs nothing
  parallel_for((poses.size() + kAtOnce - 1) / kAtOnce, threads, [&](std::size_t piece, int) {
    const std::size_t end = std::min(poses.size(), (piece + 1) * kAtOnce);
    for (std::size_t i = piece * kAtOnce; i < end; ++i)
      scores[static_cast<Eigen::Index>(order[i])] = contact_score(moving, poses[order[i]]);
  });
  return scores;
}

PlacedScore ScoreMaps::slope(const PlacedPoints& moving, const RigidMotion& moving_in_fixed) const {
  check(moving);
  if (shapes_ == 0 || moving.shape_weights.cols() != shapes_)
    throw InputError(
        "score maps: slopes need as many terms of the shape in maps and moving body, "
        "and at least one, got " +
        std::to_string(shapes_) + " and " + std::to_string(moving.shape_weights.cols()));
  const Placement at(moving, moving_in_fixed, low_, spacing_);
  const FieldMaps maps{values_.data(), blocks_.data(), {size_[0], size_[1], size_[2]}, types_};
  double out[7];
  field_table().slope(maps, field_points(moving, shapes_, spacing_), at.rotation.data(),
                      at.centre.data(), out);
  return {out[0],
          Eigen::Vector3d(out[1], out[2], out[3]) / spacing_,
          {out[4], out[5], out[6]}};  // arm and force: the steps cancel
}

std::array<double, 2> ScoreMaps::terms(const PlacedPoints& moving,
                                       const RigidMotion& moving_in_fixed) const {
  const double contact = contact_score(moving, moving_in_fixed);
  return {slope(moving, moving_in_fixed).value - contact, contact};
}

double contact_score(const TypedPoints& fixed, const TypedPoints& moving,
                     const RigidMotion& moving_in_fixed, const ContactPotential& potential) {
  check_points(fixed, potential.near.rows(), "fixed");
  check_points(moving, potential.near.rows(), "moving");
  const Eigen::Matrix3Xd moved = moving_in_fixed * moving.points;
  double sum = 0.0;
  for (Eigen::Index j = 0; j < moved.cols(); ++j)
    for (Eigen::Index i = 0; i < fixed.points.cols(); ++i) {
      if (fixed.types[i] < 0 || moving.types[j] < 0) continue;
      const double d = (fixed.points.col(i) - moved.col(j)).norm();
      if (d < kContactRange)
        sum += potential.near(fixed.types[i], moving.types[j]) * near_contact(d) +
               potential.far(fixed.types[i], moving.types[j]) * far_contact(d);
    }
  return sum;
}

}  // namespace mortise
