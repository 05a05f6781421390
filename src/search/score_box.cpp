// SPDX-License-Identifier: GPL-3.0-or-later
// Maxima of a grid of scores.
#include "search/score_box.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/isa.hpp"

namespace mortise {

namespace isa_baseline {
extern const SearchTable kSearchTable;
}
namespace isa_avx2 {
extern const SearchTable kSearchTable;
}
namespace isa_avx512 {
extern const SearchTable kSearchTable;
}

namespace {

constexpr float kLowest = -std::numeric_limits<float>::infinity();
constexpr std::size_t kMostVisits = 50000;  // cells looked at for summits

int rounded_up(int n, int multiple) { return (n + multiple - 1) / multiple * multiple; }

}  // namespace

const SearchTable& search_loops() {
  static const SearchTable& table = pick_isa(best_isa(), isa_baseline::kSearchTable,
                                             isa_avx2::kSearchTable, isa_avx512::kSearchTable);
  return table;
}

ScoreBox::ScoreBox(const std::array<int, 3>& size)
    : size_(size),
      row_(rounded_up(size[2], 16)),
      plane_row_(rounded_up(size[1], 16)),
      scores_(static_cast<std::size_t>(size[0]) * size[1] * row_, kLowest),
      maxima_(static_cast<std::size_t>(size[0]) * plane_row_, kLowest),
      plane_maxima_(size[0]) {}

void ScoreBox::plane_written(int x) {
  float* const maxima = maxima_.data() + static_cast<std::ptrdiff_t>(x) * plane_row_;
  search_loops().row_maxima(plane(x), size_[1], row_, maxima);
  search_loops().row_maxima(maxima, 1, plane_row_, plane_maxima_.data() + x);
}

std::vector<float> ScoreBox::grid() const {
  std::vector<float> result;
  result.reserve(static_cast<std::size_t>(size_[0]) * size_[1] * size_[2]);
  for (int r = 0; r < size_[0] * size_[1]; ++r) {
    const float* row = scores_.data() + static_cast<std::ptrdiff_t>(r) * row_;
    result.insert(result.end(), row, row + size_[2]);
  }
  return result;
}

GridPeak ScoreBox::peak_at(const std::array<int, 3>& cell) const {
  const auto score = [&](std::array<int, 3> at, int axis, int step) {
    const int n = size_[axis];
    at[axis] = (at[axis] + step + n) % n;
    return scores_[(static_cast<std::size_t>(at[0]) * size_[1] + at[1]) * row_ + at[2]];
  };
  const float top = score(cell, 0, 0);
  GridPeak peak{top, cell, {}};
  for (int d = 0; d < 3; ++d) {  // a parabola through the three points of each axis
    const float below = score(cell, d, -1), above = score(cell, d, 1);
    const float curvature = 2.0F * top - below - above;
    if (!(below > kLowest) || !(above > kLowest) || below > top || above > top ||
        !(curvature > 0.0F))
      continue;  // not a maximum along this axis: a neighbour belongs to a better peak
    peak.offset[d] = 0.5F * (above - below) / curvature;
    peak.score += 0.25F * (above - below) * peak.offset[d];
  }
  return peak;
}

void ScoreBox::clear_ball(const GridPeak& peak, double separation) {
  const auto [nx, ny, nz] = size_;
  // At most half the box, so that one wrap suffices.
  std::array<int, 3> radius;
  for (int d = 0; d < 3; ++d)
    radius[d] = static_cast<int>(std::min(std::ceil(separation + 0.5), 0.5 * size_[d]));
  const auto wrap = [](int i, int n) { return i < 0 ? i + n : i >= n ? i - n : i; };
  const auto off_sq = [&](int d, int step) {
    return std::pow(step - static_cast<double>(peak.offset[d]), 2);
  };
  const double separation_sq = separation * separation;
  for (int a = -radius[0]; a <= radius[0]; ++a) {
    if (a != 0 && off_sq(0, a) >= separation_sq) continue;
    const int i = wrap(peak.cell[0] + a, nx);
    float* const plane = maxima_.data() + static_cast<std::ptrdiff_t>(i) * plane_row_;
    for (int b = -radius[1]; b <= radius[1]; ++b) {
      const double ab = off_sq(0, a) + off_sq(1, b);
      if ((a != 0 || b != 0) && ab >= separation_sq) continue;
      const int j = wrap(peak.cell[1] + b, ny);
      float* const near = scores_.data() + (static_cast<std::ptrdiff_t>(i) * ny + j) * row_;
      for (int c = -radius[2]; c <= radius[2]; ++c)
        if ((a == 0 && b == 0 && c == 0) || ab + off_sq(2, c) < separation_sq)
          near[wrap(peak.cell[2] + c, nz)] = kLowest;
      search_loops().row_maxima(near, 1, row_, plane + j);
    }
    search_loops().row_maxima(plane, 1, plane_row_, plane_maxima_.data() + i);
  }
}

bool ScoreBox::touches_cleared(const std::array<int, 3>& cell) const {
  for (int a = -1; a <= 1; ++a)
    for (int b = -1; b <= 1; ++b) {
      const int i = (cell[0] + a + size_[0]) % size_[0];
      const int j = (cell[1] + b + size_[1]) % size_[1];
      const float* const near =
          scores_.data() + (static_cast<std::ptrdiff_t>(i) * size_[1] + j) * row_;
      for (int c = -1; c <= 1; ++c)
        if ((a != 0 || b != 0 || c != 0) && !(near[(cell[2] + c + size_[2]) % size_[2]] > kLowest))
          return true;
    }
  return false;
}

std::vector<GridPeak> ScoreBox::take_peaks(int count, double separation, bool summits) {
  const auto [nx, ny, nz] = size_;
  const auto first_largest = [](const float* values, int n) {
    return static_cast<int>(std::max_element(values, values + n) - values);
  };
  std::vector<GridPeak> peaks;
  const auto too_near = [&](const GridPeak& a, const GridPeak& b) {
    double distance_sq = 0.0;
    for (int d = 0; d < 3; ++d) {
      const double step = a.cell[d] - b.cell[d] + static_cast<double>(a.offset[d] - b.offset[d]);
      distance_sq += std::pow(step - size_[d] * std::round(step / size_[d]), 2);
    }
    return distance_sq < separation * separation;
  };
  std::size_t visits = 0;
  while (static_cast<int>(peaks.size()) < count && (!summits || visits++ < kMostVisits)) {
    const int i = first_largest(plane_maxima_.data(), nx);
    const int j = first_largest(maxima_.data() + static_cast<std::ptrdiff_t>(i) * plane_row_, ny);
    const std::ptrdiff_t row = static_cast<std::ptrdiff_t>(i) * ny + j;
    const int k = first_largest(scores_.data() + row * row_, nz);
    if (!(scores_[row * row_ + k] > kLowest)) break;  // everything has been taken
    const GridPeak peak = peak_at({i, j, k});
    // A cell outside the cleared ball may have its maximum inside; then only the cell is cleared.
    // Of summits no more than the cell ever is: cells fall from the highest down, so one that
    // touches a cleared one is on its slope.
    const bool taken = (summits && touches_cleared(peak.cell)) ||
                       std::any_of(peaks.begin(), peaks.end(),
                                   [&](const GridPeak& other) { return too_near(peak, other); });
    clear_ball(peak, taken || summits ? 0.0 : separation);
    if (!taken) peaks.push_back(peak);
  }
  // The sub-grid maximum of a lower cell may be the higher one.
  std::stable_sort(peaks.begin(), peaks.end(),
                   [](const GridPeak& a, const GridPeak& b) { return a.score > b.score; });
  return peaks;
}

}  // namespace mortise
