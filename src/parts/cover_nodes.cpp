// SPDX-License-Identifier: GPL-3.0-or-later
// A small set of balls that holds all nodes: greedy set cover on rows of bits.
#include <bit>
#include <numeric>
#include <queue>

#include "mortise/core/threads.hpp"
#include "parts/reduce_balls.hpp"

namespace mortise::parts {
namespace {

// One bit per node, so that a row of a ball is counted or cleared by words.
class NodeBits {
 public:
  explicit NodeBits(const NodeField& field) : words_((field.depth.size() + 63) / 64, 0) {
    for (std::int64_t i = 0; i < field.count(); ++i)
      if (field.depth[i] > 0.0F) words_[i / 64] |= std::uint64_t{1} << (i % 64);
  }

  [[nodiscard]] std::int64_t count() const {
    std::int64_t sum = 0;
    for (const std::uint64_t word : words_) sum += std::popcount(word);
    return sum;
  }

  [[nodiscard]] int count(std::int64_t first, std::int64_t last) const {
    int sum = 0;
    for (std::int64_t w = first / 64; w <= last / 64; ++w)
      sum += std::popcount(words_[w] & mask(w, first, last));
    return sum;
  }

  void clear(std::int64_t first, std::int64_t last) {
    for (std::int64_t w = first / 64; w <= last / 64; ++w) words_[w] &= ~mask(w, first, last);
  }

 private:
  // The bits of word w that are in [first, last].
  static std::uint64_t mask(std::int64_t w, std::int64_t first, std::int64_t last) {
    std::uint64_t bits = ~std::uint64_t{0};
    if (w == first / 64) bits &= ~std::uint64_t{0} << (first % 64);
    if (w == last / 64) bits &= ~std::uint64_t{0} >> (63 - last % 64);
    return bits;
  }

  std::vector<std::uint64_t> words_;
};

std::int64_t gain(const NodeField& field, const NodeBits& open, const GridBall& ball) {
  std::int64_t sum = 0;
  for_rows_in(field, ball,
              [&](std::int64_t first, std::int64_t last) { sum += open.count(first, last); });
  return sum;
}

}  // namespace

// The ball that holds most nodes not yet held, again and again. What a ball adds only shrinks, so a
// ball that still leads after a recount is the best one.
std::vector<std::size_t> cover_nodes(const NodeField& field, const std::vector<GridBall>& balls,
                                     int threads) {
  NodeBits open(field);
  std::int64_t left = open.count();
  using Entry = std::pair<std::int64_t, std::size_t>;
  const auto later = [](const Entry& a, const Entry& b) {
    return a.first != b.first ? a.first < b.first : a.second > b.second;
  };
  std::vector<Entry> entries(balls.size());
  constexpr std::size_t kChunk = 256;
  parallel_for((balls.size() + kChunk - 1) / kChunk, threads, [&](std::size_t chunk, int) {
    for (std::size_t i = chunk * kChunk; i < std::min(balls.size(), (chunk + 1) * kChunk); ++i)
      entries[i] = {gain(field, open, balls[i]), i};
  });
  std::priority_queue<Entry, std::vector<Entry>, decltype(later)> queue(later, std::move(entries));
  std::vector<std::size_t> chosen;
  while (left > 0 && !queue.empty()) {
    const std::size_t i = queue.top().second;
    queue.pop();
    const GridBall& ball = balls[i];
    const std::int64_t now = gain(field, open, ball);
    if (now == 0) continue;
    if (!queue.empty() && later({now, i}, queue.top())) {
      queue.emplace(now, i);
      continue;
    }
    for_rows_in(field, ball,
                [&](std::int64_t first, std::int64_t last) { open.clear(first, last); });
    left -= now;
    chosen.push_back(i);
  }
  return chosen;
}

std::vector<double> shares(const NodeField& field, const std::vector<GridBall>& balls) {
  std::vector<std::int32_t> holders(field.depth.size(), 0);
  for (const GridBall& ball : balls)
    for_rows_in(field, ball, [&](std::int64_t first, std::int64_t last) {
      for (std::int64_t k = first; k <= last; ++k) ++holders[k];
    });
  std::vector<double> result;
  for (const GridBall& ball : balls) {
    double sum = 0.0;
    std::int64_t nodes = 0;
    for_rows_in(field, ball, [&](std::int64_t first, std::int64_t last) {
      nodes += last - first + 1;
      for (std::int64_t k = first; k <= last; ++k) sum += 1.0 / holders[k];
    });
    result.push_back(nodes == 0 ? 1.0 : sum / static_cast<double>(nodes));
  }
  return result;
}

double covered_part(const NodeField& field, const std::vector<GridBall>& balls) {
  NodeBits open(field);
  const std::int64_t inside = open.count();
  for (const GridBall& ball : balls)
    for_rows_in(field, ball,
                [&](std::int64_t first, std::int64_t last) { open.clear(first, last); });
  return inside == 0 ? 0.0
                     : static_cast<double>(inside - open.count()) / static_cast<double>(inside);
}

}  // namespace mortise::parts
