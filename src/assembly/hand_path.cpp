// SPDX-License-Identifier: GPL-3.0-or-later
// Waypoints around a goal, joined by moves of minimum jerk, with tremor on top.
#include "mortise/assembly/hand_path.hpp"

#include <cmath>
#include <numbers>
#include <random>
#include <string>

#include "mortise/core/errors.hpp"
#include "mortise/core/rotation_vector.hpp"

namespace mortise {
namespace {

// A place of the part: its centre and its turn, both relative to the goal.
struct Waypoint {
  Eigen::Vector3d shift = Eigen::Vector3d::Zero(), turn = Eigen::Vector3d::Zero();
};

// The standard library's distributions differ between implementations; these do not.
double uniform(std::mt19937_64& random) { return static_cast<double>(random() >> 11) * 0x1.0p-53; }

Eigen::Vector3d direction(std::mt19937_64& random) {
  const double z = 2.0 * uniform(random) - 1.0, a = 2.0 * std::numbers::pi * uniform(random);
  const double r = std::sqrt(1.0 - z * z);
  return {r * std::cos(a), r * std::sin(a), z};
}

}  // namespace

std::vector<RigidMotion> hand_path(const RigidMotion& goal, const Eigen::Vector3d& centre,
                                   double radius, const HandPathOptions& options) {
  const auto positive = [](double value, const char* name) {
    if (!(value > 0.0) || !std::isfinite(value))
      throw InputError(std::string("hand_path: ") + name + " must be > 0, got " +
                       std::to_string(value));
  };
  positive(options.seconds, "seconds");
  positive(options.rate, "rate");
  positive(radius, "radius");
  constexpr double kMostPoses = 2e7;  // a gigabyte
  if (options.seconds * options.rate > kMostPoses)
    throw InputError("hand_path: seconds times rate must be <= 2e7, got " +
                     std::to_string(options.seconds * options.rate));
  if (options.visits < 0)
    throw InputError("hand_path: visits must be >= 0, got " + std::to_string(options.visits));
  std::mt19937_64 random(options.seed);
  std::vector<Waypoint> stops;
  for (int i = 0; i <= options.visits; ++i) {
    const Waypoint away{options.distance * radius * direction(random),
                        options.angle * uniform(random) * direction(random)};
    stops.push_back(away);
    if (i < options.visits) {
      stops.push_back({0.25 * away.shift, 0.5 * away.turn});  // pushed on, into contact
      stops.push_back(away);
    }
  }
  stops.emplace_back();  // the goal, and a stay there
  stops.emplace_back();

  struct Wave {
    Eigen::Vector3d direction;
    double frequency, phase;
  };
  constexpr int kWaves = 12;
  std::vector<Wave> waves(kWaves);
  for (Wave& w : waves)
    w = {direction(random), 8.0 + 4.0 * uniform(random), 2.0 * std::numbers::pi * uniform(random)};
  const double amplitude = options.tremor * radius * std::sqrt(2.0 / kWaves);

  const auto count = static_cast<std::size_t>(std::llround(options.seconds * options.rate));
  std::vector<RigidMotion> path(count);
  const Eigen::Vector3d goal_centre = goal * centre;
  for (std::size_t i = 0; i < count; ++i) {
    const double place =
        static_cast<double>(i) / static_cast<double>(count) * static_cast<double>(stops.size() - 1);
    const auto segment = static_cast<std::size_t>(place);
    const double s = place - static_cast<double>(segment);
    const double blend = s * s * s * (10.0 + s * (-15.0 + 6.0 * s));  // minimum jerk
    const Waypoint &from = stops[segment], &to = stops[segment + 1];
    Eigen::Vector3d shift = from.shift + blend * (to.shift - from.shift);
    const Eigen::Vector3d turn = from.turn + blend * (to.turn - from.turn);
    const double time = static_cast<double>(i) / options.rate;
    for (const Wave& w : waves)
      shift +=
          amplitude * std::sin(2.0 * std::numbers::pi * w.frequency * time + w.phase) * w.direction;
    path[i].rotation = canonical(rotation_from_vector(turn) * goal.rotation);
    path[i].translation = goal_centre + shift - path[i].rotation * centre;
  }
  return path;
}

}  // namespace mortise
