// SPDX-License-Identifier: GPL-3.0-or-later
// A channel's score of given poses: sums over pairs, and maps of the low-passed score.
#include "mortise/scoring/shape_scores.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>

#include "core/point_grid.hpp"
#include "mortise/core/errors.hpp"
#include "mortise/core/threads.hpp"
#include "mortise/scoring/shape_kernel.hpp"

namespace mortise {
namespace {

void check(const Channel& channel, const std::vector<RigidMotion>& poses,
           const std::vector<double>& offsets, const char* who) {
  check_channel(channel, who);
  const auto refuse = [&](const std::string& what) {
    throw InputError(std::string(who) + ": " + what);
  };
  if (offsets.empty()) refuse("expected at least one offset, got none");
  const double least = channel.moving.points.row(3).minCoeff();
  for (const double o : offsets)
    if (!(least + o > 0.0) || !std::isfinite(o))
      refuse("offset " + std::to_string(o) + " leaves nothing of radius " + std::to_string(least));
  for (const RigidMotion& pose : poses)
    if (!pose.translation.allFinite() || !pose.rotation.coeffs().allFinite())
      refuse("a pose is not finite");
}

double most(const std::vector<double>& values) {
  return *std::max_element(values.begin(), values.end());
}

// Distinct radii in ascending order, and each knot's index among them.
struct RadiusClasses {
  std::vector<double> radii;
  std::vector<int> of_knot;

  explicit RadiusClasses(const Knots& knots) {
    std::map<double, int> index;
    for (const double r : knots.points.row(3)) index.emplace(r, 0);
    for (auto& [r, i] : index) {
      i = static_cast<int>(radii.size());
      radii.push_back(r);
    }
    for (const double r : knots.points.row(3)) of_knot.push_back(index.at(r));
  }
};

// K of each pair of radii and offset by squared distance, or evaluated where pairs are too many.
class PairTables {
 public:
  PairTables(const Channel& channel, const std::vector<double>& fixed_radii,
             const std::vector<double>& moving_radii, const std::vector<double>& offsets,
             double range)
      : channel_(channel),
        fixed_(fixed_radii),
        moving_(moving_radii),
        offsets_(offsets),
        scale_((kEntries - 1) / (range * range)) {
    constexpr std::size_t kMostTables = 4096;
    const std::size_t count = fixed_.size() * moving_.size() * offsets_.size();
    if (count > kMostTables) return;
    tables_.resize(count * kEntries);
    for (std::size_t t = 0; t < count; ++t)
      for (int i = 0; i < kEntries; ++i)
        tables_[t * kEntries + i] = exact(t, range * std::sqrt(i / (kEntries - 1.0)));
  }

  [[nodiscard]] std::size_t table(int fixed, int moving, std::size_t offset) const {
    return (static_cast<std::size_t>(fixed) * moving_.size() + moving) * offsets_.size() + offset;
  }
  [[nodiscard]] double operator()(std::size_t t, double d_sq) const {
    if (tables_.empty()) return exact(t, std::sqrt(d_sq));
    const double at = d_sq * scale_;
    const int i = std::min(static_cast<int>(at), kEntries - 2);
    const double* const v = tables_.data() + t * kEntries + i;
    return v[0] + (at - i) * (v[1] - v[0]);
  }

 private:
  static constexpr int kEntries = 2048;

  [[nodiscard]] double exact(std::size_t t, double d) const {
    const std::size_t o = t % offsets_.size(), m = t / offsets_.size() % moving_.size(),
                      f = t / offsets_.size() / moving_.size();
    return channel_.pair(d, fixed_[f], moving_[m] + offsets_[o]);
  }

  const Channel& channel_;
  const std::vector<double>&fixed_, &moving_, &offsets_;
  double scale_;
  std::vector<double> tables_;
};

// The fixed body's low-passed field on a grid: `count` values a node, one after the other.
class LowPassedMaps {
 public:
  LowPassedMaps(const Channel& channel, const ShapeKernels& kernels, std::size_t offsets,
                double spacing, int threads)
      : spacing_(spacing) {
    const Knots& fixed = channel.fixed;
    has_ = {!fixed.weights.real().isZero(0.0) && !channel.moving.weights.real().isZero(0.0),
            !fixed.weights.imag().isZero(0.0) && !channel.moving.weights.imag().isZero(0.0)};
    per_part_ = kernels.terms() * static_cast<int>(offsets);
    count_ = per_part_ * (has_[0] + has_[1]);
    // Two steps more, so that the cubics' stencils at the border see zeros only.
    const double margin = kernels.range() + 2.0 * spacing;
    low_ = fixed.points.topRows<3>().rowwise().minCoeff().array() - margin;
    const Eigen::Vector3d high = fixed.points.topRows<3>().rowwise().maxCoeff().array() + margin;
    double bytes = 4.0 * count_;
    for (int d = 0; d < 3; ++d) {
      size_[d] = static_cast<int>(std::ceil((high[d] - low_[d]) / spacing)) + 2;
      bytes *= size_[d];
    }
    if (!(bytes < 8.0 * 1024 * 1024 * 1024))
      throw InputError("low-passed scores: the maps would take " +
                       std::to_string(bytes / (1 << 30)) + " GiB; take a coarser spacing");
    values_.assign(static_cast<std::size_t>(size_[0]) * size_[1] * size_[2] * count_, 0.0F);
    if (count_ > 0) fill(fixed, kernels, offsets, threads);
  }

  [[nodiscard]] bool has(int part) const { return has_[part]; }
  [[nodiscard]] int per_part() const { return per_part_; }
  [[nodiscard]] int count() const { return count_; }

  // Cubics that agree with the map at nodes and have continuous slopes (Keys).
  // False where there is nothing; `out` has count() values.
  bool at(const Eigen::Vector3d& point, float* out) const {
    std::array<int, 3> cell;
    std::array<std::array<float, 4>, 3> w;
    for (int d = 0; d < 3; ++d) {
      const double u = (point[d] - low_[d]) / spacing_;
      if (!(u >= 1.0 && u < size_[d] - 2.0)) return false;
      cell[d] = static_cast<int>(u) - 1;
      const auto t = static_cast<float>(u - (cell[d] + 1));
      w[d] = {t * (t * (1.0F - 0.5F * t) - 0.5F), 1.0F + t * t * (1.5F * t - 2.5F),
              t * (0.5F + t * (2.0F - 1.5F * t)), t * t * (0.5F * t - 0.5F)};
    }
    std::fill_n(out, count_, 0.0F);
    for (int a = 0; a < 4; ++a)
      for (int b = 0; b < 4; ++b) {
        const float* node =
            values_.data() +
            ((static_cast<std::size_t>(cell[0] + a) * size_[1] + cell[1] + b) * size_[2] +
             cell[2]) *
                count_;
        const float ab = w[0][a] * w[1][b];
        for (int c = 0; c < 4; ++c, node += count_) {
          const float abc = ab * w[2][c];
          for (int m = 0; m < count_; ++m) out[m] += abc * node[m];
        }
      }
    return true;
  }

 private:
  void fill(const Knots& fixed, const ShapeKernels& kernels, std::size_t offsets, int threads) {
    const RadiusClasses classes(fixed);
    // Entries of all maps beside each other: one look-up serves them all.
    std::vector<std::vector<float>> tables;
    std::size_t entries = 0;
    for (const double r : classes.radii) {
      std::vector<float>& table = tables.emplace_back();
      for (int q = 0; q < kernels.terms(); ++q)
        for (std::size_t o = 0; o < offsets; ++o) {
          const TabulatedKernel kernel = kernels.kernel(r, q, o);
          entries = kernel.values.size();
          table.resize(entries * per_part_);
          for (std::size_t i = 0; i < entries; ++i)
            table[i * per_part_ + q * offsets + o] = static_cast<float>(kernel.values[i]);
        }
    }
    const double range_sq = kernels.range() * kernels.range();
    const double scale = static_cast<double>(entries - 1) / range_sq;
    const std::size_t plane = static_cast<std::size_t>(size_[1]) * size_[2] * count_;
    // One x-plane at a time, so that threads share nothing.
    parallel_for(static_cast<std::size_t>(size_[0]), threads, [&](std::size_t x, int) {
      float* const nodes = values_.data() + x * plane;
      for (Eigen::Index i = 0; i < fixed.size(); ++i) {
        const Eigen::Vector3d p = (fixed.points.col(i).head<3>() - low_) / spacing_;
        const double dx = (p[0] - static_cast<double>(x)) * spacing_;
        if (dx * dx >= range_sq) continue;
        const std::vector<float>& table = tables[classes.of_knot[i]];
        const auto re = static_cast<float>(fixed.weights[i].real()),
                   im = static_cast<float>(fixed.weights[i].imag());
        const double reach = std::sqrt(range_sq - dx * dx) / spacing_;
        const int first = static_cast<int>(std::ceil(p[1] - reach)),
                  last = static_cast<int>(p[1] + reach);
        for (int y = first; y <= last; ++y) {
          const double dy = (p[1] - y) * spacing_, left = range_sq - dx * dx - dy * dy;
          if (left <= 0.0) continue;
          const double width = std::sqrt(left) / spacing_;
          const int begin = static_cast<int>(std::ceil(p[2] - width)),
                    end = static_cast<int>(p[2] + width);
          for (int z = begin; z <= end; ++z) {
            const double dz = (p[2] - z) * spacing_;
            const double at = (dx * dx + dy * dy + dz * dz) * scale;
            const auto entry = std::min(static_cast<std::size_t>(at), entries - 2);
            const auto f = static_cast<float>(at - static_cast<double>(entry));
            const float* v = table.data() + entry * per_part_;
            float* node = nodes + (static_cast<std::size_t>(y) * size_[2] + z) * count_;
            for (int m = 0; m < per_part_; ++m) {
              const float value = v[m] + f * (v[m + per_part_] - v[m]);
              if (has_[0]) node[m] += re * value;
              if (has_[1]) node[m + (has_[0] ? per_part_ : 0)] += im * value;
            }
          }
        }
      }
    });
  }

  std::array<int, 3> size_;
  Eigen::Vector3d low_;
  double spacing_;
  std::array<bool, 2> has_;  // is there a product of real parts, of imaginary ones?
  int per_part_, count_;
  std::vector<float> values_;
};

}  // namespace

Eigen::MatrixXd exact_scores(const Channel& channel, const std::vector<RigidMotion>& poses,
                             const ExactScoresOptions& options) {
  check(channel, poses, options.offsets, "exact scores");
  if (!channel.pair)
    throw InputError("exact scores: channel '" + channel.name + "' has no pair function");
  const double range = std::max(1e-9, channel.range + std::max(0.0, most(options.offsets)));
  const RadiusClasses fixed(channel.fixed), moving(channel.moving);
  const PairTables tables(channel, fixed.radii, moving.radii, options.offsets, range);
  const Eigen::Matrix3Xd centres = channel.fixed.points.topRows<3>();
  const detail::PointGrid grid(centres, range, range);
  Eigen::MatrixXd scores = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(options.offsets.size()),
                                                 static_cast<Eigen::Index>(poses.size()));
  parallel_for(poses.size(), options.threads, [&](std::size_t p, int) {
    for (Eigen::Index j = 0; j < channel.moving.size(); ++j) {
      const Eigen::Vector3d y = poses[p] * channel.moving.points.col(j).head<3>().eval();
      const std::complex<double> d = channel.weight * channel.moving.weights[j];
      grid.for_each_near(y, [&](std::int32_t i) {
        const double weight = (channel.fixed.weights[i] * d).real();
        const double d_sq = (centres.col(i) - y).squaredNorm();
        for (std::size_t o = 0; o < options.offsets.size(); ++o)
          scores(static_cast<Eigen::Index>(o), static_cast<Eigen::Index>(p)) +=
              weight * tables(tables.table(fixed.of_knot[i], moving.of_knot[j], o), d_sq);
      });
    }
  });
  return scores;
}

Eigen::MatrixXd low_passed_scores(const Channel& channel, const std::vector<RigidMotion>& poses,
                                  const LowPassedScoresOptions& options) {
  check(channel, poses, options.offsets, "low-passed scores");
  if (!(options.spacing >= 0.0) || !std::isfinite(options.spacing))
    throw InputError("low-passed scores: spacing must be >= 0 and finite, got " +
                     std::to_string(options.spacing));
  const ShapeKernels kernels(channel, {.low_pass = options.low_pass,
                                       .radius_tolerance = options.radius_tolerance,
                                       .offsets = options.offsets});
  const double spacing = options.spacing > 0.0 ? options.spacing : 0.25 / options.low_pass.cutoff;
  const std::size_t offsets = options.offsets.size();
  const LowPassedMaps maps(channel, kernels, offsets, spacing, options.threads);
  // d_j b_q(r_j) for each part that there is, as the maps have them.
  const RadiusClasses classes(channel.moving);
  Eigen::MatrixXd factors(kernels.terms(), static_cast<Eigen::Index>(classes.radii.size()));
  for (Eigen::Index c = 0; c < factors.cols(); ++c)
    factors.col(c) = kernels.moving_factors(classes.radii[c]);
  Eigen::MatrixXd scores = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(offsets),
                                                 static_cast<Eigen::Index>(poses.size()));
  parallel_for(poses.size(), options.threads, [&](std::size_t p, int) {
    std::vector<float> values(maps.count());
    const Eigen::Matrix3d rotation = poses[p].rotation.toRotationMatrix();
    for (Eigen::Index j = 0; j < channel.moving.size(); ++j) {
      const Eigen::Vector3d y =
          rotation * channel.moving.points.col(j).head<3>() + poses[p].translation;
      if (!maps.at(y, values.data())) continue;
      const float* value = values.data();
      for (const int part : {0, 1}) {
        if (!maps.has(part)) continue;
        // Re(c d) = Re c Re d - Im c Im d
        const double d =
            part == 0 ? channel.moving.weights[j].real() : -channel.moving.weights[j].imag();
        for (int q = 0; q < kernels.terms(); ++q)
          for (std::size_t o = 0; o < offsets; ++o)
            scores(static_cast<Eigen::Index>(o), static_cast<Eigen::Index>(p)) +=
                d * factors(q, classes.of_knot[j]) * static_cast<double>(*value++);
      }
    }
  });
  return scores;
}

std::vector<Truncation> score_truncation(const Channel& channel,
                                         const std::vector<RigidMotion>& poses,
                                         const std::vector<double>& scores,
                                         const LowPassedScoresOptions& options) {
  if (scores.size() != poses.size() || options.offsets.size() != 1)
    throw InputError("score truncation: expected one score per pose and one offset, got " +
                     std::to_string(scores.size()) + " for " + std::to_string(poses.size()) +
                     " poses and " + std::to_string(options.offsets.size()) + " offsets");
  const Eigen::MatrixXd exact =
      exact_scores(channel, poses, {.offsets = options.offsets, .threads = options.threads});
  const Eigen::MatrixXd smooth = low_passed_scores(channel, poses, options);
  std::vector<Truncation> result;
  for (std::size_t p = 0; p < poses.size(); ++p) {
    const auto column = static_cast<Eigen::Index>(p);
    result.push_back({exact(0, column), std::abs(smooth(0, column) - exact(0, column)),
                      std::abs(scores[p] - smooth(0, column))});
  }
  return result;
}

}  // namespace mortise
