// SPDX-License-Identifier: GPL-3.0-or-later
// Channels taken apart into the real point sets that the search transforms.
#include "search/components.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "mortise/fourier/nfft.hpp"

namespace mortise {
namespace {

using Spectrum = std::vector<std::complex<double>>;

// Far below what single precision and the coarse grid leave.
constexpr double kFixedTolerance = 1e-5;

// Knots of one radius share a transform: the terms of sum_q a_q(k) b_q(r_i) with b_q an indicator.
std::map<double, std::vector<Eigen::Index>> by_radius(const Knots& knots) {
  std::map<double, std::vector<Eigen::Index>> groups;
  for (Eigen::Index i = 0; i < knots.size(); ++i) groups[knots.points(3, i)].push_back(i);
  return groups;
}

class FixedField {
 public:
  FixedField(const std::array<int, 3>& size, double spacing, int threads)
      : nfft_(size, {size[0] * spacing, size[1] * spacing, size[2] * spacing},
              {.tolerance = kFixedTolerance, .weights = WeightKind::real, .threads = threads}),
        frequency_(static_cast<std::size_t>(size[0]) * size[1] * (size[2] / 2 + 1)) {
    std::size_t n = 0;
    for (int i = 0; i < size[0]; ++i)
      for (int j = 0; j < size[1]; ++j)
        for (int k = 0; k <= size[2] / 2; ++k, ++n) {
          const double x = (i - size[0] / 2) / (size[0] * spacing);
          const double y = (j - size[1] / 2) / (size[1] * spacing);
          const double z = k / (size[2] * spacing);
          frequency_[n] = std::sqrt(x * x + y * y + z * z);
        }
  }

  [[nodiscard]] const std::vector<double>& frequency() const { return frequency_; }

  // sum_i weights_i transform(k, r_i) exp(-2 pi i k.x_i) over all modes.
  [[nodiscard]] Spectrum of(const Knots& knots, const Eigen::VectorXd& weights,
                            const RadialTransform& transform, const RigidMotion& motion) {
    Spectrum field(frequency_.size());
    for (const auto& [radius, members] : by_radius(knots)) {
      Eigen::Matrix3Xd points(3, members.size());
      Eigen::VectorXd chosen(members.size());
      for (std::size_t m = 0; m < members.size(); ++m) {
        points.col(m) = motion * knots.points.col(members[m]).head<3>().eval();
        chosen[m] = weights[members[m]];
      }
      const auto modes = nfft_.transform(points, chosen);
      for (std::size_t n = 0; n < field.size(); ++n)
        field[n] += modes[n] * transform(frequency_[n], radius);
    }
    return field;
  }

 private:
  Nfft3 nfft_;
  std::vector<double> frequency_;
};

}  // namespace

Components make_components(const std::vector<Channel>& channels,
                           const RigidMotion& search_from_fixed, const std::array<int, 3>& size,
                           double spacing, int threads) {
  FixedField fields(size, spacing, threads);
  const double volume =
      static_cast<double>(size[0]) * size[1] * size[2] * spacing * spacing * spacing;

  // Channels often share their centres (all atoms): equal centres are spread once per component.
  Components result;
  std::map<std::array<double, 3>, Eigen::Index> index;
  for (const Channel& channel : channels)
    for (Eigen::Index j = 0; j < channel.moving.size(); ++j)
      index.emplace(std::array<double, 3>{channel.moving.points(0, j), channel.moving.points(1, j),
                                          channel.moving.points(2, j)},
                    0);
  result.points.resize(3, static_cast<Eigen::Index>(index.size()));
  Eigen::Index next = 0;
  for (auto& [centre, i] : index) {
    result.points.col(next) << centre[0], centre[1], centre[2];
    i = next++;
  }

  for (const Channel& channel : channels)
    for (const bool imaginary : {false, true}) {
      const auto part = [&](const Knots& knots) -> Eigen::VectorXd {
        return imaginary ? knots.weights.imag().eval() : knots.weights.real().eval();
      };
      const Eigen::VectorXd fixed_weights = part(channel.fixed),
                            moving_weights = part(channel.moving);
      if (channel.weight == 0.0 || fixed_weights.isZero(0.0) || moving_weights.isZero(0.0))
        continue;
      // Re(c d) = Re c Re d - Im c Im d; 1 / volume is the inverse transform's.
      const double factor = (imaginary ? -1.0 : 1.0) * channel.weight / volume;
      const Spectrum field =
          fields.of(channel.fixed, fixed_weights, channel.fixed_transform, search_from_fixed);
      for (const auto& [radius, members] : by_radius(channel.moving)) {
        Component component{Eigen::VectorXf::Zero(result.points.cols()), field};
        for (const Eigen::Index j : members)
          component.weights[index.at({channel.moving.points(0, j), channel.moving.points(1, j),
                                      channel.moving.points(2, j)})] +=
              static_cast<float>(moving_weights[j]);
        for (std::size_t n = 0; n < field.size(); ++n)
          component.spectrum[n] *= factor * channel.moving_transform(fields.frequency()[n], radius);
        result.parts.push_back(std::move(component));
      }
    }
  return result;
}

}  // namespace mortise
