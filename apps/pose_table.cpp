// SPDX-License-Identifier: GPL-3.0-or-later
// Columns of numbers for a person to read.
#include "pose_table.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "mortise/metrics/quality.hpp"

namespace mortise::app {
namespace {

std::string cell(double value, int width, int digits) {
  char text[64];
  if (std::isnan(value))
    std::snprintf(text, sizeof text, " %*s", width, "-");
  else
    std::snprintf(text, sizeof text, " %*.*f", width, digits, value);
  return text;
}

std::string head(const std::string& name, int width) {
  char text[80];
  std::snprintf(text, sizeof text, " %*s", width, name.c_str());
  return text;
}

// The CAPRI class is stored as its number.
std::string metric_cell(const MetricColumn& metric, std::size_t pose, int width) {
  const double value = metric.values[pose];
  if (metric.name == "capri" && value >= 0.0 && value <= 3.0)
    return head(std::string(to_string(static_cast<CapriClass>(static_cast<int>(value)))), width);
  return cell(value, width, 3);
}

int metric_width(const MetricColumn& metric) {
  return std::max(10, static_cast<int>(metric.name.size()));
}

// What a person compares poses by. What the shape score leaves out is for the page and for tables.
std::vector<const MetricColumn*> shown_metrics(const Run& run) {
  std::vector<const MetricColumn*> shown;
  for (const MetricColumn& metric : run.metrics)
    if (!metric.name.starts_with("shape_")) shown.push_back(&metric);
  return shown;
}

}  // namespace

std::string pose_table(const Run& run, std::size_t count) {
  const std::vector<const MetricColumn*> metrics = shown_metrics(run);
  std::string text = "  rank" + head("score", 12);
  for (const std::string& channel : run.poses.channel_names) text += head(channel, 12);
  for (const MetricColumn* metric : metrics) text += head(metric->name, metric_width(*metric));
  if (metrics.empty())
    text += std::string("   quaternion w x y z                    translation x y z") +
            (run.kind == "dock" ? ", angstrom" : "");
  text += "\n";
  for (std::size_t i = 0; i < std::min(count, run.poses.poses.size()); ++i) {
    const Pose& pose = run.poses.poses[i];
    text += cell(static_cast<double>(i + 1), 5, 0) + cell(pose.score, 12, 3);
    for (const double channel : pose.channels) text += cell(channel, 12, 3);
    for (const MetricColumn* metric : metrics)
      text += metric_cell(*metric, i, metric_width(*metric));
    if (metrics.empty()) {
      const Eigen::Quaterniond& q = pose.moving_in_fixed.rotation;
      text += " ";
      for (const double value : {q.w(), q.x(), q.y(), q.z()}) text += cell(value, 8, 5);
      text += " ";
      for (const double value : pose.moving_in_fixed.translation) text += cell(value, 9, 3);
    }
    text += "\n";
  }
  return text;
}

}  // namespace mortise::app
