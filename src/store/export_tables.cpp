// SPDX-License-Identifier: GPL-3.0-or-later
// Poses as CSV and JSON, and the choice of poses.
#include <cmath>
#include <nlohmann/json.hpp>

#include "mortise/core/errors.hpp"
#include "mortise/store/csv.hpp"
#include "mortise/store/export.hpp"

namespace mortise {
namespace {

constexpr std::size_t kDefaultStructures = 10;

nlohmann::ordered_json body_json(const BodyRecord& body) {
  return {{"path", body.path}, {"spec", body.spec}, {"sha256", body.sha256}};
}

}  // namespace

ExportFormat parse_export_format(const std::string& name) {
  if (name == "pdb") return ExportFormat::kPdb;
  if (name == "cif") return ExportFormat::kMmcif;
  if (name == "csv") return ExportFormat::kCsv;
  if (name == "json") return ExportFormat::kJson;
  if (name == "zdock") return ExportFormat::kZdock;
  if (name == "stl") return ExportFormat::kStl;
  if (name == "ply") return ExportFormat::kPly;
  if (name == "step") return ExportFormat::kStep;
  throw InputError("format: expected pdb, cif, csv, json, zdock, stl, ply or step, got \"" + name +
                   "\"");
}

std::vector<std::size_t> chosen_poses(const Run& run, ExportFormat format,
                                      const ExportOptions& options) {
  const std::size_t count = run.poses.poses.size();
  if (options.top < 0)
    throw InputError("top: expected 0 or more, got " + std::to_string(options.top));
  if (options.pose < 0)
    throw InputError("pose: expected 0 or more, got " + std::to_string(options.pose));
  if (count == 0)
    throw InputError(
        run.complete ? "the run holds no poses"
                     : "the run holds no poses: its search is not finished (--resume finishes it)");
  if (options.pose > 0) {
    const auto rank = static_cast<std::size_t>(options.pose);
    if (rank > count)
      throw InputError("pose " + std::to_string(rank) + ": the run holds " + std::to_string(count) +
                       " poses");
    return {rank - 1};
  }
  const bool structures = format == ExportFormat::kPdb || format == ExportFormat::kMmcif;
  const bool parts =
      format == ExportFormat::kStl || format == ExportFormat::kPly || format == ExportFormat::kStep;
  const std::size_t wanted = options.top > 0 ? static_cast<std::size_t>(options.top)
                             : structures    ? kDefaultStructures
                             : parts         ? 1
                                             : count;
  std::vector<std::size_t> chosen(std::min(wanted, count));
  for (std::size_t i = 0; i < chosen.size(); ++i) chosen[i] = i;
  return chosen;
}

std::string export_csv(const Run& run, const ExportOptions& options) {
  std::string text = "rank,score";
  for (const std::string& name : run.poses.channel_names) text += "," + csv_field(name);
  text += ",qw,qx,qy,qz,tx,ty,tz,rotation_index,cluster";
  for (const MetricColumn& metric : run.metrics) text += "," + csv_field(metric.name);
  text += "\n";
  for (const std::size_t i : chosen_poses(run, ExportFormat::kCsv, options)) {
    const Pose& pose = run.poses.poses[i];
    const Eigen::Quaterniond& q = pose.moving_in_fixed.rotation;
    const Eigen::Vector3d& t = pose.moving_in_fixed.translation;
    text += std::to_string(i + 1) + "," + shortest(pose.score);
    for (const double value : pose.channels) text += "," + shortest(value);
    for (const double value : {q.w(), q.x(), q.y(), q.z(), t.x(), t.y(), t.z()})
      text += "," + shortest(value);
    text += "," + std::to_string(pose.rotation_index) + "," + std::to_string(pose.cluster);
    for (const MetricColumn& metric : run.metrics) text += "," + shortest(metric.values[i]);
    text += "\n";
  }
  return text;
}

std::string export_json(const Run& run, const ExportOptions& options) {
  using Json = nlohmann::ordered_json;
  Json all = {{"mortise_version", run.provenance.mortise_version},
              {"kind", run.kind},
              {"utc_time", run.provenance.utc_time},
              {"fixed", body_json(run.fixed)},
              {"moving", body_json(run.moving)}};
  Json rows = Json::array();
  for (const std::size_t i : chosen_poses(run, ExportFormat::kJson, options)) {
    const Pose& pose = run.poses.poses[i];
    const Eigen::Quaterniond& q = pose.moving_in_fixed.rotation;
    const Eigen::Vector3d& t = pose.moving_in_fixed.translation;
    Json channels = Json::object();
    for (std::size_t c = 0; c < pose.channels.size(); ++c)
      channels[run.poses.channel_names[c]] = pose.channels[c];
    Json metrics = Json::object();
    for (const MetricColumn& metric : run.metrics)
      metrics[metric.name] =
          std::isfinite(metric.values[i]) ? Json(metric.values[i]) : Json(nullptr);
    rows.push_back({{"rank", i + 1},
                    {"score", pose.score},
                    {"channels", channels},
                    {"quaternion", {q.w(), q.x(), q.y(), q.z()}},
                    {"translation", {t.x(), t.y(), t.z()}},
                    {"rotation_index", pose.rotation_index},
                    {"cluster", pose.cluster},
                    {"metrics", metrics}});
  }
  all["poses"] = rows;
  return all.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace mortise
