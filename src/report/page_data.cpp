// SPDX-License-Identifier: GPL-3.0-or-later
// A run and its bodies as the JSON that the page reads.
#include "report/page_data.hpp"

#include <openssl/evp.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <numbers>

#include "mortise/core/errors.hpp"
#include "mortise/core/version.hpp"
#include "mortise/molecules/write_molecule.hpp"
#include "report/heavy_atoms.hpp"
#include "report/part_view.hpp"

namespace mortise::detail {
namespace {

using Json = nlohmann::ordered_json;

// Seven significant digits: a quaternion's error moves an atom 100 angstrom away by 1e-5.
void append_number(std::string& text, double value) {
  if (!std::isfinite(value)) {
    text += "null";
    return;
  }
  std::array<char, 32> buffer;
  const auto result = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value,
                                    std::chars_format::general, 7);
  text.append(buffer.data(), result.ptr);
}

// [f(0), ..., f(count - 1)]
template <class Value>
std::string numbers(std::size_t count, Value&& value) {
  std::string text = "[";
  for (std::size_t i = 0; i < count; ++i) {
    if (i > 0) text += ',';
    append_number(text, value(i));
  }
  return text + "]";
}

std::string quoted(const std::string& text) {
  return Json(text).dump(-1, ' ', false, Json::error_handler_t::replace);
}

template <class Scalar>
std::string base64(const Scalar* values, std::size_t count) {
  const std::size_t bytes = count * sizeof(Scalar);
  std::string text(4 * ((bytes + 2) / 3) + 1, '\0');
  const int size =
      EVP_EncodeBlock(reinterpret_cast<unsigned char*>(text.data()),
                      reinterpret_cast<const unsigned char*>(values), static_cast<int>(bytes));
  text.resize(static_cast<std::size_t>(size));
  return text;
}

// PDB where numbers and names fit its plain columns, else mmCIF: the viewer knows no hybrid-36.
Json structure_json(const Molecule& molecule) {
  constexpr std::size_t kMostAtoms = 99'999;
  const bool plain = molecule.atoms.size() < kMostAtoms &&
                     std::all_of(molecule.atoms.begin(), molecule.atoms.end(), [](const Atom& a) {
                       return a.residue_number > -1000 && a.residue_number < 10'000;
                     });
  if (plain) {
    try {
      return {{"format", "pdb"}, {"text", format_pdb_atoms(molecule) + "END\n"}};
    } catch (const InputError&) {
      // names or coordinates that have no room; mmCIF has
    }
  }
  return {{"format", "cif"}, {"text", format_mmcif_head("body") + format_mmcif_atoms(molecule)}};
}

Json body_json(const BodyRecord& record, const ReportBody& body, const PagePart& part,
               const char* role) {
  Json json = {{"name", body_name(record)},   {"role", role},
               {"path", record.path},         {"spec", record.spec},
               {"sha256", record.sha256},     {"found", body.found},
               {"knots", record.knots.size()}};
  json["unit"] = body.unit;
  const Eigen::Matrix3Xd points = report_points(body);
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  double radius = 1.0;
  if (points.cols() > 0) {
    center = points.rowwise().mean();
    radius = (points.colwise() - center).colwise().norm().maxCoeff();
  }
  json["center"] = {center.x(), center.y(), center.z()};
  json["radius"] = radius;
  if (body.is_mesh()) {
    const Eigen::Matrix3Xf vertices = body.mesh.vertices.cast<float>();
    const Eigen::Matrix<std::uint32_t, 3, Eigen::Dynamic> triangles =
        body.mesh.triangles.cast<std::uint32_t>();
    json["triangles"] = part.triangles;
    if (part.deviation > 0.0) {
      json["shown_triangles"] = body.mesh.size();
      json["deviation"] = part.deviation;
    }
    json["mesh"] = {{"vertices", base64(vertices.data(), vertices.size())},
                    {"triangles", base64(triangles.data(), triangles.size())}};
  } else if (!body.molecule.atoms.empty()) {
    const Molecule heavy = heavy_atoms(body.molecule);
    json["atoms"] = heavy.atoms.size();
    json["residues"] = residues(heavy).size();
    json["structure"] = structure_json(heavy);
  }
  return json;
}

Json options_json(const std::string& text) {
  const Json options = Json::parse(text, nullptr, false);
  return options.is_object() ? options : Json{{"options", text}};
}

Json head_json(const Run& run, const ReportBodies& bodies, int frequency_poses) {
  Json figures = Json::array();
  for (const Figure& figure : run.figures)
    figures.push_back({figure.name, std::isfinite(figure.value) ? Json(figure.value) : Json(0.0)});
  const Provenance& p = run.provenance;
  return {{"format", 1},
          {"kind", run.kind},
          {"complete", run.complete},
          {"title", body_name(run.fixed) + "_" + body_name(run.moving)},
          {"notices", bodies.notices},
          {"page_version", kVersion},
          {"version", p.mortise_version},
          {"command", p.command_line},
          {"directory", p.working_directory},
          {"options", options_json(p.options_json)},
          {"seed", p.seed},
          {"time", p.utc_time},
          {"host", p.host},
          {"seconds", run.seconds},
          {"figures", figures},
          {"rotations",
           {{"count", run.rotations.done.size()},
            {"done", std::count(run.rotations.done.begin(), run.rotations.done.end(), 1)},
            {"covering_radius", run.rotations.covering_radius * 180.0 / std::numbers::pi}}},
          {"frequency_poses", frequency_poses}};
}

}  // namespace

std::string body_name(const BodyRecord& body) {
  std::filesystem::path name = std::filesystem::path(body.path).filename();
  if (name.extension() == ".gz") name = name.stem();
  if (name.has_extension()) name = name.stem();
  return name.empty() ? std::string("unnamed") : name.string();
}

std::string page_data(const Run& run, const ReportBodies& bodies,
                      const std::array<PagePart, 2>& parts, const ReportClusters& clusters,
                      const Eigen::VectorXd& frequency, int frequency_poses) {
  const std::vector<Pose>& poses = run.poses.poses;
  Json head = head_json(run, bodies, frequency_poses);
  head["clusters"] = {{"measure", clusters.measure},
                      {"radius", clusters.radius},
                      {"min_size", clusters.min_size},
                      {"count", clusters.sizes.size()}};
  head["bodies"] = {body_json(run.fixed, bodies.fixed, parts[0], "fixed"),
                    body_json(run.moving, bodies.moving, parts[1], "moving")};
  if (bodies.fixed.is_mesh()) {  // seen as the best pose asks for
    const RigidMotion best = poses.empty() ? RigidMotion{} : poses.front().moving_in_fixed;
    const Eigen::Vector3d away =
        best * Eigen::Vector3d(report_points(bodies.moving).rowwise().mean()) -
        report_points(bodies.fixed).rowwise().mean();
    const Eigen::Quaterniond view(part_view(bodies.fixed.mesh, away));
    head["view"] = {view.x(), view.y(), view.z(), view.w()};
  }
  std::string text = head.dump(-1, ' ', false, Json::error_handler_t::replace);
  text.pop_back();  // the closing brace
  // Long lists of numbers are written by hand: quicker, and with no more digits than they need.
  text += ",\"frequency\":" +
          numbers(static_cast<std::size_t>(frequency.size()),
                  [&](std::size_t i) { return frequency[static_cast<Eigen::Index>(i)]; });
  text += ",\"poses\":{\"count\":" + std::to_string(poses.size());
  text += ",\"rotation\":" + numbers(4 * poses.size(), [&](std::size_t i) {
            const Eigen::Quaterniond& q = poses[i / 4].moving_in_fixed.rotation;
            return std::array<double, 4>{q.w(), q.x(), q.y(), q.z()}[i % 4];
          });
  text += ",\"translation\":" + numbers(3 * poses.size(), [&](std::size_t i) {
            return poses[i / 3].moving_in_fixed.translation[static_cast<Eigen::Index>(i % 3)];
          });
  text += "},\"columns\":[";
  const auto column = [&](const std::string& key, const char* group, auto&& value) {
    if (text.back() != '[') text += ',';
    text += "{\"key\":" + quoted(key) + ",\"group\":\"" + group +
            "\",\"values\":" + numbers(poses.size(), value) + "}";
  };
  column("score", "score", [&](std::size_t i) { return poses[i].score; });
  for (std::size_t c = 0; c < run.poses.channel_names.size(); ++c)
    column(run.poses.channel_names[c], "score",
           [&](std::size_t i) { return poses[i].channels[c]; });
  column("cluster", "cluster", [&](std::size_t i) { return poses[i].cluster; });
  for (const MetricColumn& metric : run.metrics)
    column(metric.name, "metric", [&](std::size_t i) { return metric.values[i]; });
  return text + "]}";
}

}  // namespace mortise::detail
