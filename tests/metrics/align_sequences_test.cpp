// SPDX-License-Identifier: GPL-3.0-or-later
// Sequence alignment: by hand and against trying every alignment.
#include "mortise/metrics/align_sequences.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "mortise/core/errors.hpp"

namespace mortise {
namespace {

std::vector<std::string> letters(const std::string& text) {
  std::vector<std::string> out;
  for (const char c : text) out.emplace_back(1, c);
  return out;
}

// The best score over all alignments of the tails a[i..], b[j..]; last: 0 pair, 1 gap in b, 2 gap
// in a.
double best_by_trial(const std::string& a, const std::string& b, std::size_t i, std::size_t j,
                     int last, const AlignSequencesOptions& o) {
  if (i == a.size() && j == b.size()) return 0.0;
  double best = -1e300;
  if (i < a.size() && j < b.size())
    best = std::max(
        best, (a[i] == b[j] ? o.match : o.mismatch) + best_by_trial(a, b, i + 1, j + 1, 0, o));
  if (i < a.size())
    best = std::max(best,
                    (last == 1 ? o.gap_extend : o.gap_open) + best_by_trial(a, b, i + 1, j, 1, o));
  if (j < b.size())
    best = std::max(best,
                    (last == 2 ? o.gap_extend : o.gap_open) + best_by_trial(a, b, i, j + 1, 2, o));
  return best;
}

// The score of an alignment given by its columns; between two columns the gaps in a and b are one
// run each.
double score_of_columns(const std::string& a, const std::string& b,
                        const SequenceAlignment& aligned, const AlignSequencesOptions& o) {
  const auto run = [&](std::size_t k) {
    return k == 0 ? 0.0 : o.gap_open + static_cast<double>(k - 1) * o.gap_extend;
  };
  double score = 0.0;
  std::size_t i = 0;
  std::size_t j = 0;
  for (const auto& [p, q] : aligned.columns) {
    score += run(p - i) + run(q - j) + (a[p] == b[q] ? o.match : o.mismatch);
    i = p + 1;
    j = q + 1;
  }
  return score + run(a.size() - i) + run(b.size() - j);
}

TEST(AlignSequences, PutsOneGapWhereAResidueIsMissing) {
  const SequenceAlignment aligned = align_sequences(letters("MKTAYI"), letters("MKAYI"));
  const std::vector<std::pair<std::size_t, std::size_t>> expected{
      {0, 0}, {1, 1}, {3, 2}, {4, 3}, {5, 4}};
  EXPECT_EQ(aligned.columns, expected);
  EXPECT_DOUBLE_EQ(aligned.score, 5 * 5.0 - 4.0);
}

TEST(AlignSequences, PrefersOneLongGapToTwoShortOnes) {
  // "ABCABC" to "ABC": kept whole at one end (gap of 3: -5), never split (two gaps: -8.5).
  const SequenceAlignment aligned = align_sequences(letters("ABCABC"), letters("ABC"));
  EXPECT_DOUBLE_EQ(aligned.score, 15.0 - 5.0);
  ASSERT_EQ(aligned.columns.size(), 3u);
  EXPECT_EQ(aligned.columns[2].first - aligned.columns[0].first, 2u);
}

TEST(AlignSequences, EmptySequencesAlignToNothing) {
  EXPECT_TRUE(align_sequences({}, {}).columns.empty());
  EXPECT_DOUBLE_EQ(align_sequences(letters("AB"), {}).score, -4.5);
}

TEST(AlignSequences, ReachesTheBestOfAllAlignments) {
  std::mt19937 random(11);
  std::uniform_int_distribution<int> length(0, 6);
  std::uniform_int_distribution<int> letter(0, 2);
  const std::vector<AlignSequencesOptions> scorings{
      {}, {2.0, -1.0, -3.0, -1.0}, {1.0, -3.0, -1.0, -1.0}, {5.0, 0.0, -4.0, 0.0}};
  for (int trial = 0; trial < 200; ++trial) {
    std::string a(static_cast<std::size_t>(length(random)), 'A');
    std::string b(static_cast<std::size_t>(length(random)), 'A');
    for (char& c : a) c = static_cast<char>('A' + letter(random));
    for (char& c : b) c = static_cast<char>('A' + letter(random));
    for (const auto& scoring : scorings) {
      const SequenceAlignment aligned = align_sequences(letters(a), letters(b), scoring);
      EXPECT_NEAR(aligned.score, best_by_trial(a, b, 0, 0, 0, scoring), 1e-12) << a << ' ' << b;
      EXPECT_NEAR(score_of_columns(a, b, aligned, scoring), aligned.score, 1e-12) << a << ' ' << b;
    }
  }
}

TEST(AlignSequences, RefusesGapsThatPay) {
  AlignSequencesOptions options;
  options.gap_extend = 1.0;
  EXPECT_THROW((void)align_sequences({}, {}, options), InputError);
  options = {};
  options.gap_open = -0.1;
  EXPECT_THROW((void)align_sequences({}, {}, options), InputError);
}

}  // namespace
}  // namespace mortise
