// SPDX-License-Identifier: GPL-3.0-or-later
// Kernel and filter of the interpolated spectrum; derivation in docs/math.md.
#include "collision/spectrum_table.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "collision/gap_isa.hpp"
#include "core/solve_symmetric.hpp"

namespace mortise {
namespace {

// Half-width of the filter: with 8 samples its own error is a hundredth of the interpolation's.
constexpr int kTaps = SpectrumTable::kMargin;

// Taps a_n of the filter sum_n a_n exp(2 pi i n nu) that undoes the kernel over the body, |nu| <= 1
// / (2 oversampling): there the least-squares answer is phi^(nu) / sum_m phi^(nu + m)^2.
std::vector<double> filter_taps(const SpreadKernel& kernel, double oversampling) {
  constexpr int kNodes = 64, kImages = 6;
  Eigen::MatrixXd basis(kNodes, kTaps + 1);
  Eigen::VectorXd target(kNodes);
  for (int i = 0; i < kNodes; ++i) {
    const double nu = (i + 0.5) / kNodes * 0.5 / oversampling;
    double images = 0.0;
    for (int m = -kImages; m <= kImages; ++m) images += std::pow(kernel.transform(nu + m), 2);
    target[i] = kernel.transform(nu) / images;
    for (int n = 0; n <= kTaps; ++n)
      basis(i, n) = (n == 0 ? 1.0 : 2.0) * std::cos(2.0 * std::numbers::pi * n * nu);
  }
  // Without the second term the taps, free outside the body, grow and alternate: they would magnify
  // rounding errors.
  constexpr double kDamping = 1e-8;
  const Eigen::MatrixXd normal =
      basis.transpose().lazyProduct(basis) +
      kDamping * kNodes * Eigen::MatrixXd::Identity(kTaps + 1, kTaps + 1);
  const Eigen::VectorXd taps = detail::solve_symmetric(normal, basis.transpose() * target);
  return {taps.data(), taps.data() + taps.size()};
}

// Largest error with which one axis interpolates exp(-2 pi i nu u), |nu| <= 1 / (2 oversampling),
// by the pieces and taps as they are, on a fine mesh of nu and places (spacing an order below both
// scales).
double axis_error(const InterpolationKernel& kernel, double oversampling) {
  constexpr int kNu = 200, kPlaces = 200;
  double most = 0.0;
  for (int i = 0; i <= kNu; ++i) {
    const double nu = 0.5 / oversampling * i / kNu, turn = 2.0 * std::numbers::pi * nu;
    double gain = kernel.taps[0];
    for (int n = 1; n <= kTaps; ++n) gain += 2.0 * kernel.taps[n] * std::cos(turn * n);
    for (int j = 0; j <= kPlaces; ++j) {
      const double place = static_cast<double>(j) / kPlaces, z = 1.0 - 2.0 * place;
      std::complex<double> sum = 0.0;
      for (int k = 0; k < kStencil; ++k) {
        double weight = 0.0;
        for (int term = 0; term < kPieceTerms; ++term)
          weight = weight * z + static_cast<double>(kernel.pieces[term * 8 + k]);
        sum += weight * std::polar(gain, -turn * (k - 1 - place));
      }
      most = std::max(most, std::abs(sum - 1.0));
    }
  }
  return most;
}

// Applies the filter along one axis; values past the ends count as zero.
void filter_axis(std::vector<std::complex<double>>& values, int size, int axis,
                 const std::vector<double>& taps) {
  const std::ptrdiff_t n = size, step = axis == 0 ? n * n : axis == 1 ? n : 1;
  std::vector<std::complex<double>> padded(n + 2 * static_cast<std::ptrdiff_t>(kTaps));
  for (std::ptrdiff_t line = 0; line < n * n; ++line) {
    const std::ptrdiff_t start = axis == 0   ? line
                                 : axis == 1 ? line / n * n * n + line % n
                                             : line * n;
    std::complex<double>* v = values.data() + start;
    for (std::ptrdiff_t i = 0; i < n; ++i) padded[i + kTaps] = v[i * step];
    for (std::ptrdiff_t i = 0; i < n; ++i) {
      const std::complex<double>* p = padded.data() + i + kTaps;
      std::complex<double> sum = taps[0] * p[0];
      for (int t = 1; t <= kTaps; ++t) sum += taps[t] * (p[t] + p[-t]);
      v[i * step] = sum;
    }
  }
}

}  // namespace

InterpolationKernel::InterpolationKernel(double oversampling) {
  // 0.98 of where the first image would touch the kernel's main lobe: as good as the optimum.
  kernel.width = kStencil;
  kernel.beta = 0.98 * std::numbers::pi * kStencil * (1.0 - 0.5 / oversampling);
  // Pieces of degree 6: a few 1e-5 from the kernel, a tenth of what the kernel itself leaves.
  KernelPieces fitted;
  for (kernel.fit_error = 1e-6; fitted.degree == 0 || fitted.degree >= kPieceTerms;
       kernel.fit_error *= 1.5)
    fitted = fit_pieces(kernel, kStencil);
  taps = filter_taps(kernel, oversampling);
  pieces.assign(static_cast<std::size_t>(kPieceTerms) * 8, 0.0F);
  for (int power = 0; power <= fitted.degree && power < kPieceTerms; ++power)
    for (int j = 0; j < kStencil; ++j) {
      const double c = fitted.coefficients[(fitted.degree - power) * fitted.stride + j];
      pieces[(kPieceTerms - 1 - power) * 8 + j] = static_cast<float>(c);
      // The place runs against the sample's index and twice as fast: d / du = -2 d / dz.
      if (power > 0)
        pieces[(kPieceTerms - power) * 8 + 4 + j] = static_cast<float>(-2.0 * power * c);
    }
  // Three axes one after another, each on top of what the others leave; 2% for the mesh, and what
  // single precision adds.
  error_bound = 1.02 * (std::pow(1.0 + axis_error(*this, oversampling), 3) - 1.0) + 1e-5;
}

SpectrumTable make_table(const Eigen::Ref<const Eigen::VectorXcd>& spectrum, int size, double box,
                         const InterpolationKernel& kernel) {
  constexpr std::ptrdiff_t margin = SpectrumTable::kMargin;
  std::vector<std::complex<double>> values(spectrum.data(), spectrum.data() + spectrum.size());
  for (int axis = 0; axis < 3; ++axis) filter_axis(values, size, axis, kernel.taps);
  const std::ptrdiff_t n = size, kept = size - 2 * margin;
  SpectrumTable table{static_cast<int>(kept), box,
                      AlignedVector<float>(static_cast<std::size_t>(kept * kept * kept * 4))};
  float* out = table.samples.data();
  for (std::ptrdiff_t x = margin; x < n - margin; ++x)
    for (std::ptrdiff_t y = margin; y < n - margin; ++y)
      for (std::ptrdiff_t z = margin; z < n - margin; ++z, out += 4) {
        const std::complex<double> here = values[(x * n + y) * n + z],
                                   above = y + 1 < n ? values[(x * n + y + 1) * n + z] : 0.0;
        out[0] = static_cast<float>(here.real());
        out[1] = static_cast<float>(here.imag());
        out[2] = static_cast<float>(above.real());
        out[3] = static_cast<float>(above.imag());
      }
  return table;
}

std::complex<double> SpectrumTable::at(const Eigen::Vector3d& w, const SpreadKernel& kernel) const {
  const Eigen::Vector3d u = (w * box).array() + size / 2;
  const Eigen::Vector3i first = u.array().floor().cast<int>() - 1;
  std::complex<double> sum = 0.0;
  for (int x = first[0]; x < first[0] + kStencil; ++x)
    for (int y = first[1]; y < first[1] + kStencil; ++y)
      for (int z = first[2]; z < first[2] + kStencil; ++z) {
        const float* sample =
            samples.data() + 4 * ((static_cast<std::ptrdiff_t>(x) * size + y) * size + z);
        sum += kernel(x - u[0]) * kernel(y - u[1]) * kernel(z - u[2]) *
               std::complex<double>(sample[0], sample[1]);
      }
  return sum;
}

}  // namespace mortise
