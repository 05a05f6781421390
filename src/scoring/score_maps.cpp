// SPDX-License-Identifier: GPL-3.0-or-later
// A body's contact potential on a grid.
#include "mortise/scoring/score_maps.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "mortise/core/errors.hpp"
#include "mortise/core/threads.hpp"

namespace mortise {
namespace {

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

}  // namespace

ScoreMaps::ScoreMaps(const TypedPoints& fixed, const ContactPotential& potential,
                     const ScoreMapsOptions& options)
    : spacing_(options.spacing), types_(static_cast<int>(potential.near.rows())) {
  check_points(fixed, potential.near.rows(), "fixed");
  lay_out(fixed.points, kContactRange);
  values_.resize(types_ * cells());
  fill_contacts(fixed, potential, options.threads);
}

ScoreMaps::ScoreMaps(const TypedPoints& fixed, const ContactPotential& potential,
                     const Eigen::Matrix3Xd& shape_points, const Eigen::VectorXd& shape_weights,
                     const TabulatedKernel& shape_kernel, const ScoreMapsOptions& options)
    : spacing_(options.spacing), types_(static_cast<int>(potential.near.rows())), has_shape_(true) {
  check_points(fixed, potential.near.rows(), "fixed");
  if (shape_points.cols() != shape_weights.size() || shape_points.cols() == 0)
    throw InputError("score maps: shape: expected one weight per point and a point, got " +
                     std::to_string(shape_weights.size()) + " for " +
                     std::to_string(shape_points.cols()));
  if (!shape_points.allFinite() || !shape_weights.allFinite())
    throw InputError("score maps: shape: a coordinate or weight is not finite");
  Eigen::Matrix3Xd all(3, fixed.points.cols() + shape_points.cols());
  all << fixed.points, shape_points;
  // Two steps more, so that the cubics' stencils at the border see zeros only; whole steps, so that
  // grid points and linear scores are those of the maps without a shape.
  const double margin = std::max(kContactRange, shape_kernel.range) + 2.0 * spacing_;
  lay_out(all, kContactRange + std::ceil((margin - kContactRange) / spacing_) * spacing_);
  values_.resize((types_ + 1) * cells());
  fill_contacts(fixed, potential, options.threads);
  fill_shape(shape_points, shape_weights, shape_kernel, options.threads);
  mark_nearby();
}

void ScoreMaps::lay_out(const Eigen::Matrix3Xd& points, double margin) {
  if (!(spacing_ > 0.0))
    throw InputError("score maps: spacing must be > 0, got " + std::to_string(spacing_));
  size_ = {2, 2, 2};
  low_.setZero();
  if (points.cols() == 0) return;
  low_ = points.rowwise().minCoeff().array() - margin;
  const Eigen::Vector3d high = points.rowwise().maxCoeff().array() + margin;
  for (int d = 0; d < 3; ++d)
    size_[d] = static_cast<int>(std::ceil((high[d] - low_[d]) / spacing_)) + 2;
}

std::size_t ScoreMaps::cells() const {
  return static_cast<std::size_t>(size_[0]) * size_[1] * size_[2];
}

// Calls visit(index in the plane, squared distance) for grid points of x-plane i within `range`.
template <class Visit>
void ScoreMaps::visit_plane(std::size_t i, const Eigen::Vector3d& point, double range,
                            const Visit& visit) const {
  const int ny = size_[1], nz = size_[2];
  const Eigen::Vector3d at = point - low_;
  const double dx = at[0] - static_cast<double>(i) * spacing_;
  const double left = range * range - dx * dx;
  if (left <= 0.0) return;
  const double reach = std::sqrt(left);
  const int first = std::max(0, static_cast<int>(std::ceil((at[1] - reach) / spacing_)));
  const int last = std::min(ny - 1, static_cast<int>((at[1] + reach) / spacing_));
  for (int j = first; j <= last; ++j) {
    const double dy = at[1] - j * spacing_;
    const double width = std::sqrt(std::max(0.0, left - dy * dy));
    const int begin = std::max(0, static_cast<int>(std::ceil((at[2] - width) / spacing_)));
    const int end = std::min(nz - 1, static_cast<int>((at[2] + width) / spacing_));
    for (int k = begin; k <= end; ++k) {
      const double dz = at[2] - k * spacing_;
      visit(static_cast<Eigen::Index>(j) * nz + k, dx * dx + dy * dy + dz * dz);
    }
  }
}

void ScoreMaps::fill_contacts(const TypedPoints& fixed, const ContactPotential& potential,
                              int threads) {
  const std::size_t plane = static_cast<std::size_t>(size_[1]) * size_[2];
  const Eigen::MatrixXf near = potential.near.cast<float>(), far = potential.far.cast<float>();
  // One x-plane at a time, so that threads share nothing and each sum runs in the order of the
  // points.
  parallel_for(static_cast<std::size_t>(size_[0]), threads, [&](std::size_t i, int) {
    Eigen::MatrixXf sums = Eigen::MatrixXf::Zero(types_, static_cast<Eigen::Index>(plane));
    for (Eigen::Index p = 0; p < fixed.points.cols(); ++p) {
      if (fixed.types[p] < 0) continue;
      visit_plane(i, fixed.points.col(p), kContactRange, [&](Eigen::Index n, double d_sq) {
        const double d = std::sqrt(d_sq);
        sums.col(n).noalias() += static_cast<float>(near_contact(d)) * near.col(fixed.types[p]) +
                                 static_cast<float>(far_contact(d)) * far.col(fixed.types[p]);
      });
    }
    for (int t = 0; t < types_; ++t)
      for (std::size_t n = 0; n < plane; ++n)
        values_[(static_cast<std::size_t>(t) * size_[0] + i) * plane + n] =
            sums(t, static_cast<Eigen::Index>(n));
  });
}

void ScoreMaps::fill_shape(const Eigen::Matrix3Xd& points, const Eigen::VectorXd& weights,
                           const TabulatedKernel& kernel, int threads) {
  const std::size_t plane = static_cast<std::size_t>(size_[1]) * size_[2];
  parallel_for(static_cast<std::size_t>(size_[0]), threads, [&](std::size_t i, int) {
    Eigen::VectorXd sums = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(plane));
    for (Eigen::Index p = 0; p < points.cols(); ++p)
      visit_plane(i, points.col(p), kernel.range,
                  [&](Eigen::Index n, double d_sq) { sums[n] += weights[p] * kernel(d_sq); });
    for (std::size_t n = 0; n < plane; ++n)
      values_[(static_cast<std::size_t>(types_) * size_[0] + i) * plane + n] =
          static_cast<float>(sums[static_cast<Eigen::Index>(n)]);
  });
}

void ScoreMaps::mark_nearby() {
  nearby_.assign(cells(), 0);
  for (std::size_t t = 0; t < values_.size() / cells(); ++t)
    for (std::size_t n = 0; n < cells(); ++n) nearby_[n] |= values_[t * cells() + n] != 0.0F;
  // A cell's stencil is its grid point, one before and two after, along each axis in turn.
  std::ptrdiff_t stride = 1;
  for (int d = 2; d >= 0; --d) {
    const std::ptrdiff_t count = size_[d];
    std::vector<std::uint8_t> line(static_cast<std::size_t>(count) + 3, 0);
    for (std::size_t n = 0; n < cells(); ++n) {
      const auto at = static_cast<std::ptrdiff_t>(n);
      if (at / stride % count != 0) continue;
      for (std::ptrdiff_t i = 0; i < count; ++i) line[i + 1] = nearby_[at + i * stride];
      for (std::ptrdiff_t i = 0; i < count; ++i)
        nearby_[at + i * stride] = line[i] | line[i + 1] | line[i + 2] | line[i + 3];
    }
    stride *= count;
  }
}

double ScoreMaps::score(const TypedPoints& moving, const RigidMotion& moving_in_fixed) const {
  const Eigen::Matrix3d rotation = moving_in_fixed.rotation.toRotationMatrix() / spacing_;
  const Eigen::Vector3d shift = (moving_in_fixed.translation - low_) / spacing_;
  const std::ptrdiff_t row = size_[2], plane = row * size_[1], map = plane * size_[0];
  const double top[3] = {size_[0] - 1.0, size_[1] - 1.0, size_[2] - 1.0};
  double sum = 0.0;
  for (Eigen::Index p = 0; p < moving.points.cols(); ++p) {
    const int type = moving.types[p];
    if (type < 0) continue;
    const double x = moving.points(0, p), y = moving.points(1, p), z = moving.points(2, p);
    const double u = rotation(0, 0) * x + rotation(0, 1) * y + rotation(0, 2) * z + shift[0];
    if (!(u >= 0.0 && u < top[0])) continue;
    const double v = rotation(1, 0) * x + rotation(1, 1) * y + rotation(1, 2) * z + shift[1];
    if (!(v >= 0.0 && v < top[1])) continue;
    const double w = rotation(2, 0) * x + rotation(2, 1) * y + rotation(2, 2) * z + shift[2];
    if (!(w >= 0.0 && w < top[2])) continue;
    const int i = static_cast<int>(u), j = static_cast<int>(v), k = static_cast<int>(w);
    const auto a = static_cast<float>(u - i), b = static_cast<float>(v - j),
               c = static_cast<float>(w - k);
    const float* q = values_.data() + type * map + i * plane + j * row + k;
    const float q00 = q[0] + c * (q[1] - q[0]);
    const float q01 = q[row] + c * (q[row + 1] - q[row]);
    const float q10 = q[plane] + c * (q[plane + 1] - q[plane]);
    const float q11 = q[plane + row] + c * (q[plane + row + 1] - q[plane + row]);
    const float q0 = q00 + b * (q01 - q00), q1 = q10 + b * (q11 - q10);
    sum += q0 + a * (q1 - q0);
  }
  return sum;
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
