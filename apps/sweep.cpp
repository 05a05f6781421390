// SPDX-License-Identifier: GPL-3.0-or-later
// mortise sweep: the space that a body passes through along a path.
#include <algorithm>
#include <cmath>
#include <memory>

#include "ball_body.hpp"
#include "clock.hpp"
#include "commands.hpp"
#include "interrupt.hpp"
#include "mortise/collision/configuration.hpp"
#include "mortise/core/errors.hpp"
#include "mortise/store/body.hpp"
#include "pose_csv.hpp"
#include "shape_file.hpp"

namespace mortise::app {
namespace {

using Json = nlohmann::ordered_json;

struct SweepFlags {
  ShapeOptions shape;
  std::string body, path;
  double step = 0.0;
  bool as_given = false;
};

// The ball around the centres of a body's balls.
struct Reach {
  Eigen::Vector3d centre;
  double radius = 0.0;    // to the centres
  double diameter = 0.0;  // of the body, from above
};

Reach reach_of(const Eigen::Matrix4Xd& balls) {
  Reach reach;
  reach.centre =
      0.5 * (balls.topRows<3>().rowwise().minCoeff() + balls.topRows<3>().rowwise().maxCoeff());
  const Eigen::RowVectorXd far = (balls.topRows<3>().colwise() - reach.centre).colwise().norm();
  reach.radius = far.maxCoeff();
  reach.diameter = 2.0 * (far + balls.row(3)).maxCoeff();
  return reach;
}

// No centre of a ball moves farther than this from a to b, shifted and turned at an even rate.
double motion_between(const RigidMotion& a, const RigidMotion& b, const Reach& reach) {
  return (b * reach.centre - a * reach.centre).norm() +
         rotation_angle(a.rotation, b.rotation) * reach.radius;
}

struct Path {
  std::vector<RigidMotion> motions;
  double largest = 0.0;  // motion between two that follow each other
};

Path refined(const std::vector<RigidMotion>& given, const Reach& reach, double step) {
  constexpr double kMostMotions = 1e6;
  Path path{{given.front()}, 0.0};
  for (std::size_t i = 1; i < given.size(); ++i) {
    const RigidMotion &a = given[i - 1], &b = given[i];
    const double motion = motion_between(a, b, reach);
    const double pieces = step > 0.0 ? std::max(1.0, std::ceil(motion / step)) : 1.0;
    if (!(static_cast<double>(path.motions.size()) + pieces <= kMostMotions))
      throw InputError("sweep: the path has more than 1000000 steps; expected a larger --step");
    path.largest = std::max(path.largest, motion / pieces);
    const Eigen::Vector3d from = a * reach.centre, to = b * reach.centre;
    for (int n = 1; n <= static_cast<int>(pieces); ++n) {
      const double s = n / pieces;
      const Eigen::Quaterniond q = canonical(a.rotation.slerp(s, b.rotation));
      path.motions.push_back({q, from + s * (to - from) - q * reach.centre});
    }
  }
  return path;
}

// The product of path and body, about the middle of the path: sums are in single precision.
Eigen::Matrix4Xd sweep_of(const Eigen::Matrix4Xd& body, const Path& path, const Reach& reach,
                          const SweepFlags& flags) {
  constexpr double kMostBalls = 268435456.0;  // 2^28 of 16 bytes
  if (static_cast<double>(body.cols()) * static_cast<double>(path.motions.size()) > kMostBalls)
    throw InputError("sweep: " + std::to_string(path.motions.size()) + " poses of " +
                     std::to_string(body.cols()) +
                     " balls make more than 2^28; expected a larger --step or a smaller --grid");
  Eigen::Matrix4Xd balls = body;
  balls.topRows<3>().colwise() -= reach.centre;
  Eigen::AlignedBox3d box;
  for (const RigidMotion& motion : path.motions) box.extend(motion * reach.centre);
  std::vector<RigidMotion> motions = path.motions;
  for (RigidMotion& motion : motions) motion.translation = motion * reach.centre - box.center();
  const Configurations product =
      configuration_product(configurations_of_motions(motions), configurations_of_body(balls),
                            {.offset = flags.shape.offset, .threads = flags.shape.common.threads});
  Eigen::Matrix4Xd swept = without_contained(all_translations(product)).cast<double>();
  swept.topRows<3>().colwise() += box.center();
  return swept;
}

void run(const SweepFlags& flags) {
  exit_at_once_on_interrupt("nothing was written");
  const ShapeOptions& shape = flags.shape;
  check_shape_options(shape, true, {body_path(flags.body), flags.path});
  const std::vector<RigidMotion> given = read_pose_csv(flags.path);
  if (given.empty()) throw FileError(flags.path, "holds no pose");
  const Clock::time_point start = Clock::now();
  const BallBody body = read_ball_body(
      flags.body,
      {.grid = shape.grid, .quiet = shape.common.quiet, .threads = shape.common.threads});
  const Reach reach = reach_of(body.balls);
  const double step = flags.as_given ? 0.0 : flags.step > 0.0 ? flags.step : reach.diameter / 64.0;
  const Path path = refined(given, reach, step);
  const Json resolved = {{"grid", shape.grid},   {"offset", shape.offset},
                         {"step", step},         {"as_given", flags.as_given},
                         {"slack", shape.slack}, {"spacing", shape.spacing}};
  Json figures = {{"body_balls", body.balls.cols()},
                  {"poses", given.size()},
                  {"steps", path.motions.size()},
                  {"largest_motion", path.largest}};
  // What is swept between two poses is within half the motion between them of one.
  finish_shape(sweep_of(body.balls, path, reach, flags), body.error + 0.5 * path.largest,
               body_path(flags.body), shape, resolved, figures);
  figures["seconds"] = seconds_since(start);
  char motion[32];
  std::snprintf(motion, sizeof motion, "%.4g", path.largest);
  print_shape(shape, figures,
              "path      " + std::to_string(given.size()) + " poses, " +
                  std::to_string(path.motions.size()) +
                  " with those between; no ball moves more "
                  "than " +
                  motion + " from one to the next\n");
}

}  // namespace

void add_sweep(CLI::App& program) {
  auto flags = std::make_shared<SweepFlags>();
  CLI::App& command =
      *program.add_subcommand("sweep", "Make the space that a body sweeps along a path of poses");
  command
      .add_option("body", flags->body,
                  "Part (mesh, STEP), molecule (PDB, mmCIF), or balls (.xyzr, decompose's file)")
      ->required();
  command
      .add_option("--path", flags->path,
                  "CSV with columns qw, qx, qy, qz, tx, ty, tz, one pose a line; others are "
                  "skipped")
      ->required();
  add_shape_options(command, flags->shape, "The swept space",
                    "what is swept by this length: a clearance; by the error that is printed, it "
                    "surely holds the body on its way");
  command
      .add_option("--step", flags->step,
                  "Add poses between the path's until no ball moves farther than this length from "
                  "one to the next; 0 = diameter / 64")
      ->capture_default_str()
      ->check(CLI::NonNegativeNumber);
  command.add_flag("--as-given", flags->as_given, "The path's poses alone, none between");
  add_common_options(
      command, flags->shape.common,
      "  mortise sweep drawer.stl --path opening.csv -o swept.stl\n"
      "  mortise sweep part.h5 --path path.csv --step 0.2 --slack 0.1 -o swept.h5\n"
      "Between two poses the body's middle moves straight and its rotation at an even rate.\n");
  command.callback([flags] { run(*flags); });
}

}  // namespace mortise::app
