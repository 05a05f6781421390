// SPDX-License-Identifier: GPL-3.0-or-later
// Translations by 4D sums.
#include "search/lifted_correlator.hpp"

#include <numbers>
#include <utility>

namespace mortise {

LiftedCorrelator::LiftedCorrelator(const std::array<int, 3>& size, double spacing,
                                   const std::array<double, 3>& origin_cell, LiftedParts parts,
                                   const std::vector<double>& offsets)
    : size_(size),
      spacing_(spacing),
      tolerance_(parts.tolerance),
      origin_(spacing * Eigen::Vector3d(origin_cell[0], origin_cell[1], origin_cell[2])),
      offsets_(offsets.size()) {
  const auto [nx, ny, nz] = size;
  const int nc = nz / 2 + 1;
  Frequencies frequencies(size, spacing);
  length_of_ = std::move(frequencies.of_mode);
  for (int i = 0; i < nx; ++i)
    for (int j = 0; j < ny; ++j)
      for (int k = 0; k < nc; ++k)
        place_of_.push_back(static_cast<std::uint32_t>(
            ((i + nx - nx / 2) % nx * ny + (j + ny - ny / 2) % ny) * nc + k));
  for (LiftedPart& from : parts.parts) {
    const int modes = from.cone.modes();
    Part part{std::move(from.points), std::move(from.weights), modes, from.cone.period(), {}, {}};
    const auto lengths = static_cast<Eigen::Index>(frequencies.lengths.size());
    part.series.assign(offsets_, Eigen::MatrixXcf(lengths, modes));
    for (Eigen::Index s = 0; s < lengths; ++s) {
      const Eigen::VectorXcd g = from.cone.coefficients(frequencies.lengths[s]);
      for (std::size_t o = 0; o < offsets_; ++o)
        for (int m = 0; m < modes; ++m)
          part.series[o](s, m) =
              std::complex<float>(g[m] * std::polar(1.0, -2.0 * std::numbers::pi * (m - modes / 2) *
                                                             offsets[o] / part.period));
    }
    part.fixed.resize(place_of_.size());
    for (std::size_t n = 0; n < place_of_.size(); ++n)
      part.fixed[place_of_[n]] = std::complex<float>(from.fixed[n]);
    parts_.push_back(std::move(part));
  }
  const std::ptrdiff_t row = ScoreBox(size).row();
  backward_ = FftPlan<float>::complex_to_real(
      {{{nx, std::ptrdiff_t{ny} * nc, ny * row}, {ny, nc, row}, {nz, 1, 1}}, {}}, false);
}

LiftedCorrelator::Workspace::Workspace(const LiftedCorrelator& plan)
    : product(plan.offsets_), slice(plan.place_of_.size()), box(plan.size_) {
  const auto [nx, ny, nz] = plan.size_;
  for (const Part& part : plan.parts_)
    sums.emplace_back(
        std::array{part.modes, nx, ny, nz},
        std::array{part.period, nx * plan.spacing_, ny * plan.spacing_, nz * plan.spacing_},
        NfftOptions{.tolerance = plan.tolerance_,
                    .weights = WeightKind::kReal,
                    .expected_points = part.points.cols(),
                    .threads = 1});
  for (auto& p : product) p.resize(plan.place_of_.size());
}

void LiftedCorrelator::correlate(const Eigen::Matrix3d& rotation, Workspace& w) const {
  for (std::size_t p = 0; p < parts_.size(); ++p) {
    const Part& part = parts_[p];
    w.points = part.points;
    w.points.bottomRows<3>() = (rotation * part.points.bottomRows<3>()).colwise() + origin_;
    const auto sums = w.sums[p].transform(w.points, part.weights);
    for (std::size_t o = 0; o < offsets_; ++o) {
      std::fill(w.slice.begin(), w.slice.end(), 0.0F);
      for (int m = 0; m < part.modes; ++m) {
        const std::complex<float>* const of_mode = sums.data() + m * length_of_.size();
        const auto series = part.series[o].col(m);
        for (std::size_t n = 0; n < length_of_.size(); ++n)
          w.slice[place_of_[n]] += series[length_of_[n]] * of_mode[n];
      }
      search_loops().multiply_conjugate(reinterpret_cast<const float*>(part.fixed.data()),
                                        reinterpret_cast<const float*>(w.slice.data()),
                                        static_cast<std::ptrdiff_t>(w.slice.size()), p == 0,
                                        reinterpret_cast<float*>(w.product[o].data()));
    }
  }
}

void LiftedCorrelator::finish(int offset, Workspace& w) const {
  backward_.run(w.product[offset].data(), w.box.plane(0));
  for (int i = 0; i < size_[0]; ++i) w.box.plane_written(i);
}

}  // namespace mortise
