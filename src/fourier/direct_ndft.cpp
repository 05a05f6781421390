// SPDX-License-Identifier: GPL-3.0-or-later
// Direct Fourier sums from tables of phases per axis.
#include "mortise/fourier/direct_ndft.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <numbers>
#include <string>

#include "core/isa.hpp"
#include "fourier/direct_isa.hpp"
#include "mortise/core/errors.hpp"
#include "mortise/core/threads.hpp"
#include "mortise/fourier/aligned.hpp"

namespace mortise {
namespace isa_baseline {
extern const DirectTable kDirectTable;
}
namespace isa_avx2 {
extern const DirectTable kDirectTable;
}
namespace isa_avx512 {
extern const DirectTable kDirectTable;
}

namespace {

using Complex = std::complex<double>;

void check_sum(const Eigen::Ref<const Eigen::MatrixXd>& points, const Eigen::VectorXcd& weights) {
  if (points.cols() != weights.size())
    throw InputError("direct_ndft: expected one weight per point, got " +
                     std::to_string(weights.size()) + " weights for " +
                     std::to_string(points.cols()) + " points");
  if (!points.allFinite() || !weights.allFinite())
    throw InputError("direct_ndft: a point's coordinate or weight is not finite");
}

// exp(-2 pi i k x / side) for the modes of one axis, one exponential each; the fraction of x first,
// to keep its digits.
std::vector<Complex> phases(double x, double side, int modes) {
  double t = x / side;
  t -= std::floor(t);
  std::vector<Complex> result(modes);
  for (int i = 0; i < modes; ++i) {
    const double turns = t * (i - modes / 2);
    result[i] = std::polar(1.0, -2.0 * std::numbers::pi * (turns - std::floor(turns)));
  }
  return result;
}

// The modes form a matrix: outer axes (0 .. D-3) by inner axes (the last two). Blocks of points
// have a table of inner phases that stays in cache; each outer row then takes four points at a
// time.
template <int D>
Eigen::VectorXcd sum_over_box(const Eigen::Matrix<double, D, Eigen::Dynamic>& points,
                              const Eigen::VectorXcd& weights, const std::array<int, D>& modes,
                              const std::array<double, D>& box, int threads) {
  check_sum(points, weights);
  for (int d = 0; d < D; ++d)
    if (modes[d] < 1 || !(box[d] > 0.0) || std::isinf(box[d]))
      throw InputError("direct_ndft: expected mode counts >= 1 and box sides > 0, got " +
                       std::to_string(modes[d]) + " modes on side " + std::to_string(box[d]));
  const DirectTable& table = pick_isa(best_isa(), isa_baseline::kDirectTable,
                                      isa_avx2::kDirectTable, isa_avx512::kDirectTable);
  constexpr Eigen::Index kBlock = 16;  // a multiple of four
  const std::ptrdiff_t inner_modes = std::ptrdiff_t{modes[D - 2]} * modes[D - 1];
  const std::ptrdiff_t length = (inner_modes + 7) / 8 * 8;  // whole vectors of any width
  std::ptrdiff_t outer = 1;
  for (int d = 0; d < D - 2; ++d) outer *= modes[d];

  AlignedVector<double> sums(static_cast<std::size_t>(outer * 2 * length), 0.0);
  AlignedVector<double> inner(static_cast<std::size_t>(kBlock * 2 * length));
  AlignedVector<double> outer_real(static_cast<std::size_t>(outer * kBlock)),
      outer_imag(outer_real.size());
  for (Eigen::Index first = 0; first < points.cols(); first += kBlock) {
    std::fill(outer_real.begin(), outer_real.end(),
              0.0);  // so that an incomplete block adds nothing
    std::fill(outer_imag.begin(), outer_imag.end(), 0.0);
    if (first == 0 || first + kBlock > points.cols()) std::fill(inner.begin(), inner.end(), 0.0);
    for (Eigen::Index i = first; i < std::min(first + kBlock, points.cols()); ++i) {
      std::array<std::vector<Complex>, D> phase;
      for (int d = 0; d < D; ++d) phase[d] = phases(points(d, i), box[d], modes[d]);
      double* const real = inner.data() + (i - first) * 2 * length;
      for (int y = 0; y < modes[D - 2]; ++y)
        for (int z = 0; z < modes[D - 1]; ++z) {
          const Complex value = phase[D - 2][y] * phase[D - 1][z];
          real[y * modes[D - 1] + z] = value.real();
          real[length + y * modes[D - 1] + z] = value.imag();
        }
      for (std::ptrdiff_t row = 0; row < outer; ++row) {
        const Complex value =
            weights[i] *
            (D == 3 ? phase[0][row] : phase[0][row / modes[1]] * phase[1][row % modes[1]]);
        outer_real[row * kBlock + (i - first)] = value.real();
        outer_imag[row * kBlock + (i - first)] = value.imag();
      }
    }
    const auto add_row = [&](std::size_t row, int) {
      for (Eigen::Index i = 0; i < kBlock; i += 4)
        table.add_four(outer_real.data() + row * kBlock + i, outer_imag.data() + row * kBlock + i,
                       inner.data() + i * 2 * length, length, sums.data() + row * 2 * length);
    };
    parallel_for(static_cast<std::size_t>(outer), threads, std::ref(add_row));
  }
  Eigen::VectorXcd result(outer * inner_modes);
  for (std::ptrdiff_t row = 0; row < outer; ++row)
    for (std::ptrdiff_t m = 0; m < inner_modes; ++m)
      result[row * inner_modes + m] = {sums[row * 2 * length + m],
                                       sums[row * 2 * length + length + m]};
  return result;
}

}  // namespace

Eigen::VectorXcd direct_ndft(const Eigen::Matrix3Xd& points, const Eigen::VectorXcd& weights,
                             const std::array<int, 3>& modes, const std::array<double, 3>& box,
                             int threads) {
  return sum_over_box<3>(points, weights, modes, box, threads);
}

Eigen::VectorXcd direct_ndft(const Eigen::Matrix4Xd& points, const Eigen::VectorXcd& weights,
                             const std::array<int, 4>& modes, const std::array<double, 4>& box,
                             int threads) {
  return sum_over_box<4>(points, weights, modes, box, threads);
}

Eigen::VectorXcd direct_ndft(const Eigen::MatrixXd& points, const Eigen::VectorXcd& weights,
                             const Eigen::MatrixXd& frequencies, int threads) {
  check_sum(points, weights);
  if (frequencies.rows() != points.rows())
    throw InputError("direct_ndft: points have " + std::to_string(points.rows()) +
                     " coordinates, frequencies " + std::to_string(frequencies.rows()));
  Eigen::VectorXcd result(frequencies.cols());
  const auto one = [&](std::size_t m, int) {
    const auto index = static_cast<Eigen::Index>(m);
    Complex sum = 0.0;
    for (Eigen::Index i = 0; i < points.cols(); ++i) {
      const double turns = frequencies.col(index).dot(points.col(i));
      sum += weights[i] * std::polar(1.0, -2.0 * std::numbers::pi * (turns - std::floor(turns)));
    }
    result[index] = sum;
  };
  parallel_for(static_cast<std::size_t>(frequencies.cols()), threads, std::ref(one));
  return result;
}

}  // namespace mortise
