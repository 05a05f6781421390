// SPDX-License-Identifier: GPL-3.0-or-later
// Truth files and the families of motions in them.
#include "mortise/metrics/true_mates.hpp"

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>

#include "mortise/core/errors.hpp"
#include "mortise/core/read_file.hpp"

namespace mortise {
namespace {

using Json = nlohmann::json;

struct KindName {
  const char* name;
  SymmetryKind kind;
};
constexpr KindName kKinds[] = {
    {"turn", SymmetryKind::kTurn},   {"fold", SymmetryKind::kFold}, {"screw", SymmetryKind::kScrew},
    {"slide", SymmetryKind::kSlide}, {"ball", SymmetryKind::kBall}, {"roll", SymmetryKind::kRoll},
};

template <int Rows>
Eigen::Matrix<double, Rows, 1> numbers(const Json& json, const char* key) {
  const auto values = json.at(key).get<std::vector<double>>();
  if (values.size() != Rows)
    throw InputError(std::string(key) + ": expected " + std::to_string(Rows) + " numbers, found " +
                     std::to_string(values.size()));
  Eigen::Matrix<double, Rows, 1> result =
      Eigen::Map<const Eigen::Matrix<double, Rows, 1>>(values.data());
  if (!result.allFinite()) throw InputError(std::string(key) + ": expected finite numbers");
  return result;
}

Eigen::Vector3d unit(const Json& json, const char* key) {
  const Eigen::Vector3d v = numbers<3>(json, key);
  if (!(v.norm() > 0.0)) throw InputError(std::string(key) + ": expected a direction, found 0");
  return v.normalized();
}

Symmetry parse_symmetry(const Json& json) {
  Symmetry s;
  const std::string name = json.at("kind").get<std::string>();
  bool known = false;
  for (const KindName& kind : kKinds)
    if (name == kind.name) {
      s.kind = kind.kind;
      known = true;
    }
  if (!known)
    throw InputError("kind: expected turn, fold, screw, slide, ball or roll, found \"" + name +
                     "\"");
  if (s.kind != SymmetryKind::kSlide) s.point = numbers<3>(json, "point");
  if (s.kind != SymmetryKind::kBall) s.direction = unit(json, "direction");
  if (s.kind == SymmetryKind::kFold) {
    s.order = json.at("order").get<int>();
    if (s.order < 1)
      throw InputError("order: expected 1 or more, found " + std::to_string(s.order));
    return s;
  }
  if (s.kind == SymmetryKind::kBall) return s;
  if (s.kind == SymmetryKind::kScrew) s.pitch = json.at("pitch").get<double>();
  if (s.kind == SymmetryKind::kRoll) {
    s.moving_point = numbers<3>(json, "moving_point");
    s.moving_direction = unit(json, "moving_direction");
    s.ratio = json.at("ratio").get<double>();
  }
  const bool slide = s.kind == SymmetryKind::kSlide;
  s.from = slide ? json.at("from").get<double>() : json.value("from", 0.0);
  s.to = slide ? json.at("to").get<double>() : json.value("to", 2.0 * std::numbers::pi);
  if (!(s.from <= s.to) || !std::isfinite(s.to - s.from))
    throw InputError("from, to: expected a range, found " + std::to_string(s.from) + " to " +
                     std::to_string(s.to));
  return s;
}

// A file of one pair alone need not name its parts.
TrueMate parse_mate(const Json& json, bool alone) {
  TrueMate mate;
  mate.fixed = alone ? json.value("fixed", "") : json.at("fixed").get<std::string>();
  mate.moving = alone ? json.value("moving", "") : json.at("moving").get<std::string>();
  const bool unnamed = mate.fixed.empty() && mate.moving.empty();
  mate.name = json.value("name", unnamed ? "" : mate.fixed + " " + mate.moving);
  mate.clearance = json.value("clearance", 0.0);
  const Json& pose = json.at("pose");
  const Eigen::Vector4d q = numbers<4>(pose, "rotation");
  if (!(std::abs(q.norm() - 1.0) < 1e-6))
    throw InputError("rotation: expected a unit quaternion w x y z, found norm " +
                     std::to_string(q.norm()));
  mate.moving_in_fixed = {canonical({q[0], q[1], q[2], q[3]}), numbers<3>(pose, "translation")};
  if (json.contains("symmetries"))
    for (const Json& symmetry : json["symmetries"])
      mate.symmetries.push_back(parse_symmetry(symmetry));
  return mate;
}

RigidMotion turn(const Eigen::Vector3d& point, const Eigen::Vector3d& direction, double angle) {
  const Eigen::Quaterniond q(Eigen::AngleAxisd(angle, direction));
  return {canonical(q), point - q * point};
}

}  // namespace

int parameter_count(const Symmetry& symmetry) {
  if (symmetry.kind == SymmetryKind::kFold) return 0;
  return symmetry.kind == SymmetryKind::kBall ? 3 : 1;
}

RigidMotion member(const Symmetry& s, const double* parameters) {
  const double a = parameters[0];
  switch (s.kind) {
    case SymmetryKind::kTurn:
      return turn(s.point, s.direction, a);
    case SymmetryKind::kFold:
      return turn(s.point, s.direction, 2.0 * std::numbers::pi * a / s.order);
    case SymmetryKind::kScrew: {
      RigidMotion motion = turn(s.point, s.direction, a);
      motion.translation += s.direction * (s.pitch * a / (2.0 * std::numbers::pi));
      return motion;
    }
    case SymmetryKind::kSlide:
      return {Eigen::Quaterniond::Identity(), a * s.direction};
    case SymmetryKind::kBall: {
      const Eigen::Vector3d v(parameters[0], parameters[1], parameters[2]);
      const double angle = v.norm();
      return angle > 0.0 ? turn(s.point, v / angle, angle) : RigidMotion{};
    }
    case SymmetryKind::kRoll:
      return compose(turn(s.point, s.direction, a),
                     turn(s.moving_point, s.moving_direction, s.ratio * a));
  }
  return {};
}

std::vector<TrueMate> read_true_mates(const std::string& path) {
  const std::string text = read_whole_file(path);
  std::vector<TrueMate> mates;
  std::string where;
  try {
    const Json json = Json::parse(text);
    if (json.contains("pose")) {
      mates.push_back(parse_mate(json, true));
      return mates;
    }
    for (const Json& pair : json.at("pairs")) {
      where = "pair " + std::to_string(mates.size() + 1) + ": ";
      mates.push_back(parse_mate(pair, false));
    }
  } catch (const Json::exception& e) {
    throw FileError(path, where + e.what());
  } catch (const InputError& e) {
    throw FileError(path, where + e.what());
  }
  return mates;
}

TrueMate find_true_mate(const std::vector<TrueMate>& mates, const std::string& fixed,
                        const std::string& moving, const std::string& name) {
  std::vector<const TrueMate*> found;
  std::string names;
  for (const TrueMate& mate : mates) {
    names += (names.empty() ? "" : ", ") + mate.name;
    const bool unnamed = mate.fixed.empty() && mate.moving.empty() && mates.size() == 1;
    if (name.empty() ? unnamed || (mate.fixed == fixed && mate.moving == moving)
                     : mate.name == name)
      found.push_back(&mate);
  }
  if (found.size() == 1) return *found.front();
  for (const TrueMate& mate : mates)
    if (name.empty() && found.empty() && mate.fixed == moving && mate.moving == fixed)
      throw InputError("true mates: expected a pair of fixed " + fixed + " and moving " + moving +
                       ", found it the other way round (" + mate.name +
                       "): swap the two inputs of the run");
  const std::string what = name.empty() ? fixed + " and " + moving : "'" + name + "'";
  throw InputError("true mates: expected one pair for " + what + ", found " +
                   std::to_string(found.size()) + "; the file has " + names);
}

}  // namespace mortise
