// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The modes of a search's grid and their frequencies.
#pragma once

#include <array>
#include <cmath>
#include <complex>
#include <cstdint>
#include <cstdlib>
#include <vector>

namespace mortise {

/// Values at the modes of a grid: kx, ky from -floor(n/2), kz from 0 to n / 2; kz fastest.
using HalfSpectrum = std::vector<std::complex<double>>;

/// |k| of every mode of a half spectrum. Modes that differ in the signs of kx and ky share an
/// entry, so that radial functions are evaluated once for them.
struct Frequencies {
  std::vector<double> lengths;         ///< cycles per length unit; the last is the largest
  std::vector<std::uint32_t> of_mode;  ///< index into lengths

  Frequencies(const std::array<int, 3>& size, double spacing) {
    const auto [nx, ny, nz] = size;
    for (int i = 0; i <= nx / 2; ++i)
      for (int j = 0; j <= ny / 2; ++j)
        for (int k = 0; k <= nz / 2; ++k) {
          const double x = i / (nx * spacing), y = j / (ny * spacing), z = k / (nz * spacing);
          lengths.push_back(std::sqrt(x * x + y * y + z * z));
        }
    of_mode.reserve(static_cast<std::size_t>(nx) * ny * (nz / 2 + 1));
    for (int i = 0; i < nx; ++i)
      for (int j = 0; j < ny; ++j)
        for (int k = 0; k <= nz / 2; ++k)
          of_mode.push_back(static_cast<std::uint32_t>(
              (std::abs(i - nx / 2) * (ny / 2 + 1) + std::abs(j - ny / 2)) * (nz / 2 + 1) + k));
  }
};

}  // namespace mortise
