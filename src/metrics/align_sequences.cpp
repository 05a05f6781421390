// SPDX-License-Identifier: GPL-3.0-or-later
// Needleman-Wunsch with affine gaps: three scores per cell, one byte of traceback.
#include "mortise/metrics/align_sequences.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>

#include "mortise/core/errors.hpp"

namespace mortise {
namespace {

// What the last column of a prefix alignment is.
enum State : std::uint8_t { kPair = 0, kGapInB = 1, kGapInA = 2 };

struct Best {
  double score;
  std::uint8_t from;
};

// The best of three predecessors; pairs win ties, so that a gap is opened only where it pays.
Best best_of(double pair, double gap_in_b, double gap_in_a) {
  Best best{pair, kPair};
  if (gap_in_b > best.score) best = {gap_in_b, kGapInB};
  if (gap_in_a > best.score) best = {gap_in_a, kGapInA};
  return best;
}

struct Cell {
  double score[3];  // by State
};

}  // namespace

SequenceAlignment align_sequences(const std::vector<std::string>& a,
                                  const std::vector<std::string>& b,
                                  const AlignSequencesOptions& options) {
  if (!(options.gap_open <= options.gap_extend && options.gap_extend <= 0.0))
    throw InputError("align_sequences: expected gap_open <= gap_extend <= 0, got " +
                     std::to_string(options.gap_open) + " and " +
                     std::to_string(options.gap_extend));
  constexpr double kNever = -std::numeric_limits<double>::infinity();
  const std::size_t rows = a.size() + 1;
  const std::size_t cols = b.size() + 1;
  const double open = options.gap_open;
  const double extend = options.gap_extend;
  // Two bits per state: where it came from.
  std::vector<std::uint8_t> trace(rows * cols, 0);
  std::vector<Cell> above(cols);
  std::vector<Cell> row(cols);

  for (std::size_t i = 0; i < rows; ++i) {
    for (std::size_t j = 0; j < cols; ++j) {
      Best pair{kNever, kPair};
      Best gap_in_b{kNever, kPair};
      Best gap_in_a{kNever, kPair};
      if (i == 0 && j == 0) pair.score = 0.0;
      if (i > 0 && j > 0) {
        const double* d = above[j - 1].score;
        pair = best_of(d[kPair], d[kGapInB], d[kGapInA]);
        pair.score += a[i - 1] == b[j - 1] ? options.match : options.mismatch;
      }
      if (i > 0) {
        const double* u = above[j].score;
        gap_in_b = best_of(u[kPair] + open, u[kGapInB] + extend, u[kGapInA] + open);
      }
      if (j > 0) {
        const double* l = row[j - 1].score;
        gap_in_a = best_of(l[kPair] + open, l[kGapInB] + open, l[kGapInA] + extend);
      }
      row[j] = {{pair.score, gap_in_b.score, gap_in_a.score}};
      trace[i * cols + j] =
          static_cast<std::uint8_t>(pair.from | (gap_in_b.from << 2) | (gap_in_a.from << 4));
    }
    std::swap(above, row);
  }

  const double* last = above[cols - 1].score;
  Best end = best_of(last[kPair], last[kGapInB], last[kGapInA]);
  SequenceAlignment out;
  out.score = end.score;
  std::uint8_t state = end.from;
  for (std::size_t i = a.size(), j = b.size(); i > 0 || j > 0;) {
    const auto from = static_cast<std::uint8_t>((trace[i * cols + j] >> (2 * state)) & 3);
    if (state == kPair) out.columns.emplace_back(i - 1, j - 1);
    if (state != kGapInA) --i;
    if (state != kGapInB) --j;
    state = from;
  }
  std::reverse(out.columns.begin(), out.columns.end());
  return out;
}

}  // namespace mortise
