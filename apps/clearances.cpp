// SPDX-License-Identifier: GPL-3.0-or-later
// The best score at each clearance of a mating.
#include "clearances.hpp"

#include <algorithm>
#include <cstdio>
#include <vector>

#include "mortise/runs/mate.hpp"
#include "mortise/runs/search_plan.hpp"

namespace mortise::app {
namespace {

// Of equal scores the smaller clearance.
double best_of(const std::vector<OffsetScore>& scores) {
  return std::max_element(
             scores.begin(), scores.end(),
             [](const OffsetScore& a, const OffsetScore& b) { return a.best_score < b.best_score; })
      ->offset;
}

}  // namespace

bool is_clearance_figure(const Figure& figure) {
  return !offset_scores({figure}, kClearance).empty();
}

std::string clearance_lines(const Run& run) {
  const std::vector<OffsetScore> scores = offset_scores(run.figures, kClearance);
  if (scores.empty()) return {};
  const double best = best_of(scores);
  char line[120];
  std::snprintf(line, sizeof line, "clearance %.6g%s%s fits best\n  %12s %12s\n", best,
                run.moving.unit.empty() ? "" : " ", run.moving.unit.c_str(), "clearance",
                "best score");
  std::string text = line;
  for (const OffsetScore& score : scores) {
    std::snprintf(line, sizeof line, "  %12.6g %12.3f%s\n", score.offset, score.best_score,
                  score.offset == best ? "  best" : "");
    text += line;
  }
  return text;
}

void add_clearances(nlohmann::ordered_json& json, const Run& run) {
  const std::vector<OffsetScore> scores = offset_scores(run.figures, kClearance);
  if (scores.empty()) return;
  json["best_clearance"] = best_of(scores);
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const OffsetScore& score : scores)
    list.push_back({{"clearance", score.offset}, {"best_score", score.best_score}});
  json["clearances"] = std::move(list);
}

}  // namespace mortise::app
