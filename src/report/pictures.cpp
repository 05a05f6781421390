// SPDX-License-Identifier: GPL-3.0-or-later
// POV-Ray and matplotlib as programs.
#include "mortise/report/pictures.hpp"

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "mortise/core/errors.hpp"
#include "mortise/core/threads.hpp"
#include "mortise/store/atomic_file.hpp"
#include "report/page_data.hpp"
#include "report/run_program.hpp"

namespace mortise {
namespace {

#include "plots_script.inc"

nlohmann::json column_json(const std::vector<double>& values) {
  nlohmann::json list = nlohmann::json::array();
  for (const double value : values)
    list.push_back(std::isfinite(value) ? nlohmann::json(value) : nlohmann::json(nullptr));
  return list;
}

// Hands the data to plots.py.
void plot(const char* what, const nlohmann::json& data, const std::string& target) {
  const detail::TemporaryDirectory scratch;
  write_file_atomically(scratch / "plots.py", kPlotsScript);
  write_file_atomically(scratch / "data.json",
                        data.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
  detail::run_program(
      {MORTISE_PYTHON, "-I", scratch / "plots.py", what, scratch / "data.json", target},
      {"MPLBACKEND=Agg", "MPLCONFIGDIR=" + (scratch / "matplotlib")},
      "plots need matplotlib, Debian package python3-matplotlib");
}

}  // namespace

void render_scene(const std::string& scene, const std::string& png_path,
                  const PictureOptions& options) {
  const detail::TemporaryDirectory scratch;
  const std::string source = scratch / "scene.pov";
  const std::string picture = scratch / "scene.png";
  write_file_atomically(source, scene);
  detail::run_program(
      {"povray", "+I" + source, "+O" + picture, "+W" + std::to_string(options.width),
       "+H" + std::to_string(options.height), "+A0.2", "+AM2", "+R2", "-D", "-V", "+FN8",
       "+WT" + std::to_string(resolve_threads(options.threads))},
      {}, "pictures of poses need POV-Ray, Debian package povray");
  write_file_atomically(png_path, read_whole_file(picture));
}

std::vector<std::string> draw_plots(const Run& run, const std::string& directory) {
  if (run.poses.poses.empty()) return {};
  nlohmann::json data;
  data["title"] = detail::body_name(run.fixed) + " + " + detail::body_name(run.moving);
  std::vector<double> scores;
  for (const Pose& pose : run.poses.poses) scores.push_back(pose.score);
  data["score"] = column_json(scores);
  for (const MetricColumn& metric : run.metrics)
    data["metrics"][metric.name] = column_json(metric.values);

  plot("run", data, directory);
  std::vector<std::string> made;
  for (const char* name : {"scores.png", "funnel.png", "best_of_top.png"})
    if (std::filesystem::exists(std::filesystem::path(directory) / name)) made.emplace_back(name);
  return made;
}

void draw_success(const std::vector<SuccessCurve>& curves, int most, const std::string& png_path) {
  if (most < 1) throw InputError("draw_success: most must be >= 1, got " + std::to_string(most));
  if (curves.empty()) throw InputError("draw_success: there is no curve");
  nlohmann::json data = {{"most", most}, {"curves", nlohmann::json::array()}};
  for (const SuccessCurve& curve : curves) {
    if (curve.first_ranks.empty())
      throw InputError("draw_success: the curve \"" + curve.name + "\" has no pairs");
    data["curves"].push_back(
        {{"name", curve.name}, {"first_ranks", column_json(curve.first_ranks)}});
  }
  plot("success", data, png_path);
}

}  // namespace mortise
