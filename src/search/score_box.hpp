// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The scores of all translations at one rotation, and their maxima.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "mortise/fourier/aligned.hpp"
#include "search/search_isa.hpp"

namespace mortise {

/// The inner loops for the processor at hand.
[[nodiscard]] const SearchTable& search_loops();

/// A maximum over translations, in grid cells; `cell` is its grid point.
struct GridPeak {
  float score;
  std::array<int, 3> cell;
  std::array<float, 3> offset;  ///< from the grid point to the sub-grid maximum, within [-1/2, 1/2]
};

/// Scores on the grid of a periodic box, z fastest, rows padded; maxima of rows and planes beside
/// them, so that the best cell is found without looking at all.
class ScoreBox {
 public:
  explicit ScoreBox(const std::array<int, 3>& size);

  /// Row y of plane x: row() floats, of which nz are scores and the rest -infinity.
  [[nodiscard]] float* plane(int x) {
    return scores_.data() + static_cast<std::ptrdiff_t>(x) * size_[1] * row_;
  }
  /// To be called when a plane has been written.
  void plane_written(int x);
  /// The scores without padding, x slowest.
  [[nodiscard]] std::vector<float> grid() const;

  /// Up to `count` translations at least `separation` apart (grid steps), best first: the best
  /// cell, then the best that is not too near, and so on, each moved to its sub-grid maximum.
  /// Overwrites scores.
  /// @param summits  only cells no lower than their 26 neighbours, of at most some 10^4 cells
  [[nodiscard]] std::vector<GridPeak> take_peaks(int count, double separation,
                                                 bool summits = false);

  [[nodiscard]] int row() const noexcept { return row_; }  ///< floats per padded row

 private:
  [[nodiscard]] GridPeak peak_at(const std::array<int, 3>& cell) const;
  [[nodiscard]] bool touches_cleared(const std::array<int, 3>& cell) const;
  /// Takes the peak's cell and those nearer than `separation` to it out of scores and maxima.
  void clear_ball(const GridPeak& peak, double separation);

  std::array<int, 3> size_;
  int row_, plane_row_;              // plane_row_: floats per padded row of maxima
  AlignedVector<float> scores_;      // nx x ny x row_
  std::vector<float> maxima_;        // of each row; nx x ny, rows padded with -infinity
  std::vector<float> plane_maxima_;  // nx
};

}  // namespace mortise
