// SPDX-License-Identifier: GPL-3.0-or-later
// A moving body's points, grouped for looking up maps.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <string>

#include "mortise/core/errors.hpp"
#include "mortise/scoring/score_maps.hpp"
#include "scoring/field_isa.hpp"

namespace mortise {
namespace {

struct Entry {
  Eigen::Vector3d place;
  int type;
  Eigen::Index knot;  // -1 = none
};

void check_typed(const TypedPoints& typed) {
  if (typed.points.cols() != typed.types.size())
    throw InputError("placed points: expected a type for each point, got " +
                     std::to_string(typed.types.size()) + " for " +
                     std::to_string(typed.points.cols()));
  if (!typed.points.allFinite()) throw InputError("placed points: a coordinate is not finite");
}

// Puts the range into an order in which every 16 are near each other: halved along its longest
// side, at a whole number of groups.
void group(std::vector<Entry>& entries, std::size_t begin, std::size_t end) {
  const std::size_t groups = (end - begin + kPointGroup - 1) / kPointGroup;
  if (groups < 2) return;
  Eigen::Vector3d low = entries[begin].place, high = low;
  for (std::size_t i = begin; i < end; ++i) {
    low = low.cwiseMin(entries[i].place);
    high = high.cwiseMax(entries[i].place);
  }
  Eigen::Index axis = 0;
  (high - low).maxCoeff(&axis);
  const std::size_t middle = begin + groups / 2 * kPointGroup;
  const auto at = [&](std::size_t i) { return entries.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(at(begin), at(middle), at(end), [axis](const Entry& a, const Entry& b) {
    return std::array{a.place[axis], a.place[0], a.place[1], a.place[2]} <
           std::array{b.place[axis], b.place[0], b.place[1], b.place[2]};
  });
  group(entries, begin, middle);
  group(entries, middle, end);
}

void fill(PlacedPoints& out, std::vector<Entry> entries, const Eigen::MatrixXd& knot_weights) {
  group(entries, 0, entries.size());
  const auto round_up = [](std::size_t n) {
    return static_cast<Eigen::Index>((n + kPointGroup - 1) / kPointGroup * kPointGroup);
  };
  const Eigen::Index count = round_up(entries.size()), groups = count / kPointGroup;
  out.places.resize(count, 3);
  out.types = Eigen::VectorXi::Zero(count);
  out.contact_weights = Eigen::VectorXf::Zero(count);
  out.shape_weights.setZero(count, knot_weights.rows());
  for (Eigen::Index n = 0; n < count; ++n) {
    const auto size = static_cast<Eigen::Index>(entries.size());
    const Entry& entry = entries[static_cast<std::size_t>(std::min(n, size - 1))];
    out.places.row(n) = (entry.place - out.centre).cast<float>();
    if (n >= size) continue;
    if (entry.type >= 0) {
      out.types[n] = entry.type;
      out.contact_weights[n] = 1.0F;
    }
    if (entry.knot >= 0)
      out.shape_weights.row(n) = knot_weights.col(entry.knot).transpose().cast<float>();
    out.largest_type = std::max(out.largest_type, entry.type);
  }
  out.groups.setZero(round_up(static_cast<std::size_t>(groups)), 4);
  for (Eigen::Index g = 0; g < groups; ++g) {
    const auto members = out.places.middleRows(g * kPointGroup, kPointGroup);
    const Eigen::RowVector3f middle =
        0.5F * (members.colwise().minCoeff() + members.colwise().maxCoeff());
    // A little more, so that rounding leaves nobody out.
    const float reach = (members.rowwise() - middle).rowwise().norm().maxCoeff() + 0.01F;
    out.groups.row(g) << middle, reach;
  }
}

}  // namespace

PlacedPoints::PlacedPoints(const TypedPoints& typed) {
  check_typed(typed);
  std::vector<Entry> entries;
  for (Eigen::Index j = 0; j < typed.points.cols(); ++j)
    if (typed.types[j] >= 0) entries.push_back({typed.points.col(j), typed.types[j], -1});
  if (!entries.empty()) {
    for (const Entry& e : entries) centre += e.place / static_cast<double>(entries.size());
    double sum_sq = 0.0;
    for (const Entry& e : entries) sum_sq += (e.place - centre).squaredNorm();
    gyration = std::max(1.0, std::sqrt(sum_sq / static_cast<double>(entries.size())));
  }
  fill(*this, std::move(entries), {});
}

PlacedPoints::PlacedPoints(const TypedPoints& typed, const Eigen::Matrix3Xd& shape_points,
                           const Eigen::MatrixXd& knot_weights) {
  check_typed(typed);
  if (shape_points.cols() != knot_weights.cols() || shape_points.cols() == 0 ||
      knot_weights.rows() == 0)
    throw InputError("placed points: expected a column of weights for each knot and a knot, got " +
                     std::to_string(knot_weights.cols()) + " for " +
                     std::to_string(shape_points.cols()));
  if (!shape_points.allFinite() || !knot_weights.allFinite())
    throw InputError("placed points: a knot's coordinate or weight is not finite");
  centre = shape_points.rowwise().mean();
  // A body of one point turns too, by nothing: its atom's size keeps the step finite.
  constexpr double kLeastGyration = 1.0;
  gyration = std::max(kLeastGyration, std::sqrt((shape_points.colwise() - centre).squaredNorm() /
                                                static_cast<double>(shape_points.cols())));
  const auto key = [](const auto& p) { return std::array<double, 3>{p[0], p[1], p[2]}; };
  std::map<std::array<double, 3>, Eigen::Index> knot_at;  // those that no typed point takes
  for (Eigen::Index i = 0; i < shape_points.cols(); ++i)
    knot_at.emplace(key(shape_points.col(i)), i);
  std::vector<Entry> entries;
  std::vector<char> taken(static_cast<std::size_t>(shape_points.cols()), 0);
  for (Eigen::Index j = 0; j < typed.points.cols(); ++j) {
    if (typed.types[j] < 0) continue;
    const auto found = knot_at.find(key(typed.points.col(j)));
    const bool shared = found != knot_at.end() && taken[found->second] == 0;
    if (shared) taken[found->second] = 1;
    entries.push_back({typed.points.col(j), typed.types[j], shared ? found->second : -1});
  }
  for (Eigen::Index i = 0; i < shape_points.cols(); ++i)
    if (taken[i] == 0) entries.push_back({shape_points.col(i), -1, i});
  fill(*this, std::move(entries), knot_weights);
}

}  // namespace mortise
