// SPDX-License-Identifier: GPL-3.0-or-later
// Placement errors, minimised over the truth's symmetries.
#include "mortise/metrics/placement.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "core/solve_symmetric.hpp"
#include "mortise/core/errors.hpp"
#include "mortise/core/pose_distance.hpp"
#include "mortise/parts/diameter.hpp"

namespace mortise {
namespace {

Eigen::Matrix3Xd columns(const Eigen::Matrix3Xd& points, const std::vector<Eigen::Index>& which) {
  Eigen::Matrix3Xd result(3, static_cast<Eigen::Index>(which.size()));
  for (std::size_t i = 0; i < which.size(); ++i)
    result.col(static_cast<Eigen::Index>(i)) = points.col(which[i]);
  return result;
}

// Mid-edge points with a third of the triangle's area each integrate quadratics exactly.
PoseDistance surface_distance(const TriangleMesh& mesh) {
  Eigen::Matrix3Xd points(3, 3 * mesh.size());
  Eigen::VectorXd weights(3 * mesh.size());
  for (Eigen::Index t = 0; t < mesh.size(); ++t) {
    const Eigen::Vector3d a = mesh.vertices.col(mesh.triangles(0, t));
    const Eigen::Vector3d b = mesh.vertices.col(mesh.triangles(1, t));
    const Eigen::Vector3d c = mesh.vertices.col(mesh.triangles(2, t));
    points.middleCols<3>(3 * t) << 0.5 * (a + b), 0.5 * (b + c), 0.5 * (c + a);
    weights.segment<3>(3 * t).setConstant((b - a).cross(c - a).norm());
  }
  return {points, weights};
}

double largest_distance(const Eigen::Matrix3Xd& points, const RigidMotion& a,
                        const RigidMotion& b) {
  const Eigen::Matrix3d turn = a.rotation.toRotationMatrix() - b.rotation.toRotationMatrix();
  const Eigen::Vector3d step = a.translation - b.translation;
  return std::sqrt(((turn * points).colwise() + step).colwise().squaredNorm().maxCoeff());
}

// One continuous parameter: its range, whether its ends meet, and a change of it that moves the
// part by about its diameter.
struct Range {
  double from, to;
  bool periodic;
  int samples;
  double scale = 1.0;
};

void add_ranges(const Symmetry& s, double diameter, std::vector<Range>& ranges) {
  constexpr double kPi = std::numbers::pi;
  switch (s.kind) {
    case SymmetryKind::kTurn: {
      const bool whole = s.to - s.from >= 2.0 * kPi - 1e-9;
      ranges.push_back({s.from, s.to, whole, 24});
      break;
    }
    case SymmetryKind::kScrew:
      ranges.push_back(
          {s.from, s.to, false, std::clamp(static_cast<int>((s.to - s.from) * 4.0) + 2, 2, 400)});
      break;
    case SymmetryKind::kRoll:
      ranges.push_back(
          {s.from, s.to, false,
           std::clamp(static_cast<int>((s.to - s.from) * (1.0 + std::abs(s.ratio)) * 4.0) + 2, 2,
                      400)});
      break;
    case SymmetryKind::kSlide:
      ranges.push_back({s.from, s.to, false,
                        std::clamp(static_cast<int>((s.to - s.from) / (0.1 * diameter)) + 2, 2, 50),
                        diameter});
      break;
    case SymmetryKind::kBall:
      for (int d = 0; d < 3; ++d) ranges.push_back({-kPi, kPi, true, 9});
      break;
    case SymmetryKind::kFold:
      break;
  }
}

using Parameters = Eigen::VectorXd;

}  // namespace

struct Placement::Impl {
  explicit Impl(const TriangleMesh& mesh)
      : distance(surface_distance(mesh)),
        vertices(mesh.vertices),
        hull(columns(mesh.vertices, outermost_vertices(mesh.vertices))),
        diameter(diameter_of(mesh.vertices)) {}

  PoseDistance distance;
  Eigen::Matrix3Xd vertices, hull;
  double diameter;
  TrueMate truth;
  std::vector<Range> ranges;
  std::vector<int> folds;  // members of each fold

  // The true placement at one choice of fold members and parameters.
  RigidMotion placed(const std::vector<int>& fold, const Parameters& at) const {
    RigidMotion motion;
    Eigen::Index next = 0;
    std::size_t next_fold = 0;
    for (const Symmetry& s : truth.symmetries) {
      const double number =
          s.kind == SymmetryKind::kFold ? static_cast<double>(fold[next_fold++]) : 0.0;
      motion = compose(motion, member(s, s.kind == SymmetryKind::kFold ? &number : &at[next]));
      next += parameter_count(s);
    }
    return compose(motion, truth.moving_in_fixed);
  }

  void clamp(Parameters& at) const {
    for (std::size_t d = 0; d < ranges.size(); ++d)
      if (!ranges[d].periodic)
        at[static_cast<Eigen::Index>(d)] =
            std::clamp(at[static_cast<Eigen::Index>(d)], ranges[d].from, ranges[d].to);
  }

  struct Best {
    double value = std::numeric_limits<double>::infinity();
    std::vector<int> fold;
    Parameters at;
  };

  // Newton steps with derivatives by differences: the function is smooth and costs microseconds.
  void refine(const RigidMotion& pose, Best& best) const {
    const auto n = static_cast<Eigen::Index>(ranges.size());
    if (n == 0) return;
    const auto value = [&](Parameters at) {
      clamp(at);
      return distance.mean_square(placed(best.fold, at), pose);
    };
    Eigen::VectorXd scale(n);
    for (Eigen::Index d = 0; d < n; ++d) scale[d] = ranges[static_cast<std::size_t>(d)].scale;
    double damping = 1e-6;
    for (int step = 0; step < 40; ++step) {
      const double h = 1e-4;
      Eigen::VectorXd gradient(n);
      Eigen::MatrixXd hessian(n, n);
      const auto moved = [&](Eigen::Index i, double a, Eigen::Index j, double b) {
        Parameters at = best.at;
        at[i] += a * scale[i];
        at[j] += b * scale[j];
        return distance.mean_square(placed(best.fold, at), pose);
      };
      for (Eigen::Index i = 0; i < n; ++i) {
        gradient[i] = (moved(i, h, i, 0) - moved(i, -h, i, 0)) / (2.0 * h);
        for (Eigen::Index j = 0; j <= i; ++j)
          hessian(i, j) = hessian(j, i) =
              (moved(i, h, j, h) - moved(i, h, j, -h) - moved(i, -h, j, h) + moved(i, -h, j, -h)) /
              (4.0 * h * h);
      }
      const double size = hessian.diagonal().cwiseAbs().maxCoeff() + 1e-12 * diameter * diameter;
      bool better = false;
      double change = 0.0;
      for (int attempt = 0; attempt < 12 && !better; ++attempt) {
        const Eigen::MatrixXd damped = hessian + damping * size * Eigen::MatrixXd::Identity(n, n);
        const Eigen::VectorXd move = -detail::solve_symmetric(damped, gradient);
        Parameters at = best.at + scale.cwiseProduct(move);
        clamp(at);
        const double there = value(at);
        if (there < best.value) {
          change = best.value - there;
          best.value = there;
          best.at = at;
          better = true;
          damping = std::max(1e-9, damping / 10.0);
        } else {
          damping = std::max(1e-4, damping * 10.0);
        }
      }
      if (!better || change < 1e-14 * diameter * diameter) break;
    }
  }

  // Minima of the mean square, least first: from the best starts of all, and the best of each fold,
  // which the largest distance may prefer.
  std::vector<Best> minima(const RigidMotion& pose) const {
    constexpr std::size_t kStarts = 6;
    std::vector<Best> starts;  // best first
    std::vector<Best> of_folds;
    std::vector<int> fold(folds.size(), 0);
    const auto n = static_cast<Eigen::Index>(ranges.size());
    for (bool more_folds = true; more_folds;) {
      Best best;
      std::vector<int> sample(ranges.size(), 0);
      for (bool more = true; more;) {
        Parameters at = Parameters::Zero(std::max<Eigen::Index>(n, 1));
        for (std::size_t d = 0; d < ranges.size(); ++d) {
          const Range& r = ranges[d];
          const int steps = r.periodic ? r.samples : std::max(1, r.samples - 1);
          at[static_cast<Eigen::Index>(d)] = r.from + (r.to - r.from) * sample[d] / steps;
        }
        const double value = distance.mean_square(placed(fold, at), pose);
        if (value < best.value) best = {value, fold, at};
        if (starts.size() < kStarts || value < starts.back().value) {
          if (starts.size() == kStarts) starts.pop_back();
          const auto place = std::upper_bound(starts.begin(), starts.end(), value,
                                              [](double v, const Best& b) { return v < b.value; });
          starts.insert(place, {value, fold, at});
        }
        more = advance(sample, [&](std::size_t d) { return ranges[d].samples; });
      }
      of_folds.push_back(std::move(best));
      more_folds = advance(fold, [&](std::size_t f) { return folds[f]; });
    }
    for (Best& best : of_folds)
      if (std::none_of(starts.begin(), starts.end(),
                       [&](const Best& s) { return s.value == best.value && s.fold == best.fold; }))
        starts.push_back(std::move(best));
    for (Best& start : starts) refine(pose, start);
    std::stable_sort(starts.begin(), starts.end(),
                     [](const Best& a, const Best& b) { return a.value < b.value; });
    return starts;
  }

  // The least largest distance near the minima; none is below the root of its mean square.
  double least_largest(const RigidMotion& pose, const std::vector<Best>& minima) const {
    double least = std::numeric_limits<double>::infinity();
    for (const Best& start : minima) {
      if (std::sqrt(start.value) >= least) break;
      least = std::min(least, largest_near(pose, start));
    }
    return least;
  }

  // Counts `digits` up by one; false once all combinations have been.
  template <class Size>
  static bool advance(std::vector<int>& digits, const Size& size) {
    for (std::size_t d = 0; d < digits.size(); ++d) {
      if (++digits[d] < size(d)) return true;
      digits[d] = 0;
    }
    return false;
  }

  double largest_near(const RigidMotion& pose, const Best& start) const {
    Parameters at = start.at;
    double best = largest_distance(hull, placed(start.fold, at), pose);
    for (double step = 0.1; step > 1e-5 && !ranges.empty();) {
      bool better = false;
      for (std::size_t d = 0; d < ranges.size(); ++d)
        for (const double sign : {1.0, -1.0}) {
          Parameters there = at;
          const Range& r = ranges[d];
          there[static_cast<Eigen::Index>(d)] +=
              sign * step * std::min(r.scale, 0.5 * (r.to - r.from));
          clamp(there);
          const double value = largest_distance(hull, placed(start.fold, there), pose);
          if (value < best) {
            best = value;
            at = there;
            better = true;
          }
        }
      if (!better) step *= 0.5;
    }
    // All vertices, as the hull's are those of sampled directions.
    return largest_distance(vertices, placed(start.fold, at), pose);
  }
};

Placement::Placement(const TriangleMesh& moving, const TrueMate& truth) {
  if (moving.size() == 0) throw InputError("placement: expected at least one triangle, got none");
  impl_ = std::make_unique<Impl>(moving);
  impl_->truth = truth;
  for (const Symmetry& s : truth.symmetries) {
    if (s.kind == SymmetryKind::kFold) {
      if (s.order < 1)
        throw InputError("placement: a fold's order must be >= 1, got " + std::to_string(s.order));
      impl_->folds.push_back(s.order);
    } else if (s.kind != SymmetryKind::kBall && !(s.from <= s.to)) {
      throw InputError("placement: a symmetry's range must have from <= to");
    }
    add_ranges(s, impl_->diameter, impl_->ranges);
  }
}

Placement::~Placement() = default;
Placement::Placement(Placement&&) noexcept = default;
Placement& Placement::operator=(Placement&&) noexcept = default;

PlacementError Placement::error(const RigidMotion& pose) const {
  const std::vector<Impl::Best> minima = impl_->minima(pose);
  return {impl_->least_largest(pose, minima) / impl_->diameter,
          std::sqrt(minima.front().value) / impl_->diameter};
}

RigidMotion Placement::nearest(const RigidMotion& pose) const {
  const Impl::Best best = impl_->minima(pose).front();
  return impl_->placed(best.fold, best.at);
}

double Placement::diameter() const { return impl_->diameter; }

}  // namespace mortise
