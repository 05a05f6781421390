// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The seam under RotationSearch: what searches a batch of rotations, on whatever hardware.
#pragma once

#include <Eigen/Core>
#include <array>
#include <memory>
#include <vector>

#include "mortise/search/rotation_search.hpp"
#include "search/components.hpp"
#include "search/lifted_parts.hpp"

namespace mortise {

/// All that a backend needs to know, the same at every rotation. Either `components` or `lifted` is
/// filled. Their spectra hold kernels, low-pass, signs, channel weights and 1 / volume; the box is
/// periodic with integer frequencies.
struct SearchSetup {
  std::array<int, 3> size = {};  ///< grid points per axis, even
  double reach = 0.0;            ///< largest distance of a moving point from the origin
  Components components;         ///< compressed radii; points centred on the origin
  LiftedParts lifted;            ///< the exact 4D form; likewise
  SearchOptions options;
};

/// Finds the best translations at rotations of the moving body about the origin. Results do not
/// depend on threads, on how rotations are put into batches, or on what was searched before.
class SearchBackend {
 public:
  virtual ~SearchBackend() = default;

  /// options.per_rotation places for each offset of each rotation, in this order; best first, then
  /// those without a candidate (rotation_index -1). rotation_index is the index within the batch.
  [[nodiscard]] virtual std::vector<Candidate> search(
      const std::vector<Eigen::Matrix3d>& rotations) = 0;
  /// Rotations of the smallest batch that keeps the backend busy.
  [[nodiscard]] virtual std::size_t least_batch() const = 0;
  /// Scores of all translations, x slowest.
  [[nodiscard]] virtual std::vector<float> score_grid(const Eigen::Matrix3d& rotation,
                                                      int offset) = 0;
  /// Where the moving body's centre is for a cell of score_grid(), search frame.
  [[nodiscard]] virtual Eigen::Vector3d translation(const std::array<double, 3>& cell) const = 0;
};

/// The processor's cores, FFTW and vector instructions.
[[nodiscard]] std::unique_ptr<SearchBackend> make_cpu_backend(SearchSetup setup);

}  // namespace mortise
