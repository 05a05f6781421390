// SPDX-License-Identifier: GPL-3.0-or-later
// Kernel and filter of the interpolated spectrum; derivation in docs/math.md.
#include "collision/spectrum_table.hpp"

#include <cmath>
#include <cstddef>
#include <numbers>

#include "collision/gap_isa.hpp"

namespace mortise {
namespace {

// Solves c[i - 1] a + c[i] + c[i + 1] a = f[i] in place on every line of one axis.
void filter_axis(std::vector<std::complex<double>>& values, int size, int axis, double a) {
  const std::ptrdiff_t n = size, step = axis == 0 ? n * n : axis == 1 ? n : 1;
  std::vector<double> gain(size);
  for (int i = 0; i < size; ++i) gain[i] = 1.0 / (1.0 - (i > 0 ? a * a * gain[i - 1] : 0.0));
  for (std::ptrdiff_t line = 0; line < n * n; ++line) {
    const std::ptrdiff_t start = axis == 0   ? line
                                 : axis == 1 ? line / n * n * n + line % n
                                             : line * n;
    std::complex<double>* v = values.data() + start;
    for (int i = 0; i < size; ++i)
      v[i * step] = gain[i] * (v[i * step] - (i > 0 ? a * v[(i - 1) * step] : 0.0));
    for (int i = size - 2; i >= 0; --i) v[i * step] -= gain[i] * a * v[(i + 1) * step];
  }
}

}  // namespace

InterpolationKernel::InterpolationKernel(double oversampling) {
  // 0.98 of where the first image would touch the kernel's main lobe: as good as the optimum.
  kernel.width = kStencil;
  kernel.beta = 0.98 * std::numbers::pi * kStencil * (1.0 - 0.5 / oversampling);
  kernel.fit_error = 1e-6;
  const KernelPieces fitted = fit_pieces(kernel, kStencil);
  pieces.assign(static_cast<std::size_t>(kPieceTerms) * 8, 0.0F);
  for (int power = 0; power <= fitted.degree && power < kPieceTerms; ++power)
    for (int j = 0; j < kStencil; ++j) {
      const double c = fitted.coefficients[(fitted.degree - power) * fitted.stride + j];
      pieces[(kPieceTerms - 1 - power) * 8 + j] = static_cast<float>(c);
      // The place runs against the sample's index and twice as fast: d / du = -2 d / dz.
      if (power > 0)
        pieces[(kPieceTerms - power) * 8 + 4 + j] = static_cast<float>(-2.0 * power * c);
    }
}

SpectrumTable make_table(const Eigen::Ref<const Eigen::VectorXcd>& spectrum, int size, int margin,
                         double box, const SpreadKernel& kernel) {
  std::vector<std::complex<double>> values(spectrum.data(), spectrum.data() + spectrum.size());
  for (int axis = 0; axis < 3; ++axis) filter_axis(values, size, axis, kernel(1.0));
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
