// SPDX-License-Identifier: GPL-3.0-or-later
// Makes parts/: every sample pair as STL and STEP, each part in a frame of its own, and mates.json.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <map>
#include <nlohmann/json.hpp>
#include <numeric>
#include <random>
#include <set>

#include "mortise/parts/format_part.hpp"
#include "mortise/parts/repair_mesh.hpp"
#include "mortise/store/atomic_file.hpp"
#include "pair.hpp"
#include "parts/step/brep.hpp"

namespace mortise::parts_maker {
namespace {

using Json = nlohmann::ordered_json;

struct Entry {
  Pair (*make)(double clearance);
  std::vector<double> clearances;
};

const std::vector<Entry> kEntries = {{round_peg, {0, 0.005, 0.02}},
                                     {square_peg, {0, 0.005, 0.02}},
                                     {mortise_tenon, {0, 0.005, 0.02}},
                                     {dovetail, {0, 0.005, 0.02}},
                                     {hex_key, {0.005}},
                                     {taper, {0}},
                                     {three_pegs, {0}},
                                     {t_slot, {0.005, 0.02}},
                                     {tongue_groove, {0, 0.005}},
                                     {key_keyway, {0.005, 0.02}},
                                     {cross_lap, {0}},
                                     {finger_joint, {0.005}},
                                     {ball_socket, {0, 0.02}},
                                     {hinge, {0, 0.02}},
                                     {spur_gears, {0.005, 0.02}},
                                     {thread_nut, {0.02}},
                                     {jigsaw, {0, 0.005}},
                                     {snap_hook, {0.005, 0.02}},
                                     {broken_block, {0}},
                                     {broken_sphere, {0}}};

std::string suffix(double clearance) {
  if (clearance == 0.0) return "_exact";
  return clearance < 0.01 ? "_close" : "_loose";
}

/// A rotation and shift about generic axes, the same for the same stem on every machine.
RigidMotion frame_of(const std::string& stem) {
  std::mt19937 random(static_cast<unsigned>(std::accumulate(
      stem.begin(), stem.end(), 2166136261U,
      [](unsigned h, char c) { return (h ^ static_cast<unsigned char>(c)) * 16777619U; })));
  const auto uniform = [&] { return static_cast<double>(random()) / 2147483648.0 - 1.0; };
  Eigen::Vector4d q;
  do q = {uniform(), uniform(), uniform(), uniform()};
  while (q.norm() > 1.0 || q.norm() < 0.1);
  RigidMotion frame;
  frame.rotation = canonical(Eigen::Quaterniond(q(0), q(1), q(2), q(3)).normalized());
  frame.translation = {60 * uniform(), 60 * uniform(), 60 * uniform()};
  return frame;
}

Json json_of(const Eigen::Vector3d& v) { return Json::array({v.x(), v.y(), v.z()}); }

Json json_of(const Symmetry& s, const RigidMotion& frame) {
  const auto direction = [&](const Eigen::Vector3d& d) {
    return json_of(Eigen::Vector3d(frame.rotation * d));
  };
  Json j = {{"kind", s.kind}};
  if (s.kind == "fold") j["order"] = s.order;
  if (s.kind == "screw") j["pitch"] = s.pitch;
  if (s.kind != "slide") j["point"] = json_of(frame * s.point);
  if (s.kind != "ball") j["direction"] = direction(s.direction);
  if (s.kind == "screw" || s.kind == "slide") {
    j["from"] = s.from;
    j["to"] = s.to;
  }
  if (s.kind == "roll") {
    j["moving_point"] = json_of(frame * s.moving_point);
    j["moving_direction"] = direction(s.moving_direction);
    j["ratio"] = s.ratio;
  }
  return j;
}

void write_part(const TopoDS_Shape& mated, const std::string& stem, const Fineness& fineness,
                const std::filesystem::path& folder) {
  const TopoDS_Shape shape = brep::moved(mated, frame_of(stem));
  const auto path = [&](const char* ending) { return (folder / (stem + ending)).string(); };
  write_file_atomically(path(".step"), brep::to_step({.shape = shape}));
  const RepairResult repaired = repair_mesh(brep::tessellate(shape, fineness));
  for (const auto& line : repaired.decisions) std::cerr << stem << ": " << line << '\n';
  write_file_atomically(path(".stl"), format_stl(repaired.mesh));
  std::cerr << stem << ": " << repaired.mesh.size() << " triangles\n";
}

void make_all(const std::filesystem::path& folder, const std::string& only) {
  std::filesystem::create_directories(folder);
  Json pairs = Json::array();
  std::set<std::string> written;
  for (const Entry& entry : kEntries) {
    for (const double clearance : entry.clearances) {
      const Pair pair = entry.make(clearance);
      if (!only.empty() && pair.name != only) continue;
      const std::string fixed = pair.fixed_name + suffix(clearance);
      const Fineness fineness{pair.deviation, pair.angle, pair.smallest};
      write_part(pair.fixed, fixed, fineness, folder);
      if (written.insert(pair.moving_name).second)
        write_part(pair.moving, pair.moving_name, fineness, folder);
      const RigidMotion frame = frame_of(fixed);
      const RigidMotion pose = compose(frame, inverse(frame_of(pair.moving_name)));
      Json symmetries = Json::array();
      for (const Symmetry& s : pair.symmetries) symmetries.push_back(json_of(s, frame));
      const Eigen::Quaterniond& q = pose.rotation;
      pairs.push_back({{"name", pair.name + suffix(clearance)},
                       {"fixed", fixed},
                       {"moving", pair.moving_name},
                       {"clearance", clearance},
                       {"pose",
                        {{"rotation", {q.w(), q.x(), q.y(), q.z()}},
                         {"translation", json_of(pose.translation)}}},
                       {"symmetries", symmetries}});
    }
  }
  // One pair per block, one symmetry per line: made to be read.
  std::string text = "{\"pairs\": [";
  for (const char* separator = "\n"; const Json& pair : pairs) {
    text += separator;
    separator = ",\n";
    Json head = pair;
    head.erase("symmetries");
    std::string line = head.dump();
    line.pop_back();
    text += " " + line + ",\n  \"symmetries\": [";
    for (const char* comma = ""; const Json& s : pair["symmetries"]) {
      text += comma;
      text += "\n   " + s.dump();
      comma = ",";
    }
    text += "]}";
  }
  text += "\n]}\n";
  write_file_atomically((folder / "mates.json").string(), text);
}

}  // namespace
}  // namespace mortise::parts_maker

int main(int argc, char** argv) {
  CLI::App app("Makes the sample parts: STL, STEP and mates.json");
  std::string folder = "parts";
  std::string only;
  app.add_option("folder", folder, "where they are written")->capture_default_str();
  app.add_option("--only", only, "one family, without the clearance; mates.json then has it alone");
  CLI11_PARSE(app, argc, argv);
  try {
    mortise::parts_maker::make_all(folder, only);
    return 0;
  } catch (const Standard_Failure& failure) {
    std::cerr << "make_parts: error: " << failure.GetMessageString() << '\n';
  } catch (const std::exception& error) {
    std::cerr << "make_parts: error: " << error.what() << '\n';
  }
  return 1;
}
