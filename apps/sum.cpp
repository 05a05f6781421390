// SPDX-License-Identifier: GPL-3.0-or-later
// mortise sum: where two bodies meet, or one lies in the other, at one rotation.
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

struct SumFlags {
  ShapeOptions shape;
  std::string fixed, moving, poses;
  std::vector<double> rotation = {1.0, 0.0, 0.0, 0.0};
  int pose = 1;
  bool plain = false, inside = false;
};

Eigen::Quaterniond rotation_of(const SumFlags& flags) {
  if (!flags.poses.empty()) {
    const std::vector<RigidMotion> poses = read_pose_csv(flags.poses);
    if (flags.pose < 1 || static_cast<std::size_t>(flags.pose) > poses.size())
      throw FileError(flags.poses, "has " + std::to_string(poses.size()) +
                                       " poses, --pose asks for number " +
                                       std::to_string(flags.pose));
    return poses[static_cast<std::size_t>(flags.pose - 1)].rotation;
  }
  const Eigen::Quaterniond q(flags.rotation[0], flags.rotation[1], flags.rotation[2],
                             flags.rotation[3]);
  if (!(std::abs(q.norm() - 1.0) < 1e-3))
    throw InputError("sum: --rotation expects a quaternion w,x,y,z of norm 1, got norm " +
                     std::to_string(q.norm()));
  return canonical(q);
}

Eigen::Vector3d middle(const Eigen::Matrix4Xd& balls) {
  return 0.5 * (balls.topRows<3>().rowwise().minCoeff() + balls.topRows<3>().rowwise().maxCoeff());
}

// The product of the two bodies put into SE(3), about their middles: sums are in single precision.
Eigen::Matrix4Xd sum_of(const BallBody& fixed, const BallBody& moving,
                        const Eigen::Quaterniond& rotation, const SumFlags& flags) {
  constexpr double kMostPairs = 268435456.0;  // 2^28 of 16 bytes
  if (static_cast<double>(fixed.balls.cols()) * static_cast<double>(moving.balls.cols()) >
      kMostPairs)
    throw InputError("sum: " + std::to_string(fixed.balls.cols()) + " x " +
                     std::to_string(moving.balls.cols()) +
                     " balls make more than 2^28 pairs; expected fewer, by a smaller --grid");
  const Eigen::Vector3d fixed_middle = middle(fixed.balls), moving_middle = middle(moving.balls);
  Eigen::Matrix4Xd a = fixed.balls, b = moving.balls;
  a.topRows<3>().colwise() -= fixed_middle;
  b.topRows<3>().colwise() -= moving_middle;
  const Configurations first = configurations_of_body(a, rotation),
                       second = configurations_of_body(b);
  const Configurations product =
      configuration_product(first, flags.plain ? second : inverse(second),
                            {.offset = flags.shape.offset, .threads = flags.shape.common.threads});
  Eigen::Matrix4Xd sum = without_contained(product.translations[0]).cast<double>();
  sum.topRows<3>().colwise() +=
      fixed_middle + (flags.plain ? 1.0 : -1.0) * (rotation * moving_middle);
  return sum;
}

void write_places_inside(const BallBody& fixed, const BallBody& moving,
                         const Eigen::Quaterniond& rotation, const SumFlags& flags, Json& figures) {
  Eigen::Matrix4Xd balls = moving.balls;
  balls.row(3) = (balls.row(3).array() + flags.shape.offset).max(0.0);
  const TriangleMesh mesh =
      quotient_mesh(*fixed.solid, balls, rotation,
                    {.spacing = flags.shape.spacing, .threads = flags.shape.common.threads});
  if (mesh.size() == 0)
    throw InputError(
        "sum: the moving body fits into the fixed one nowhere at this rotation, as "
        "far as the grid of translations tells");
  write_mesh(flags.shape.output, mesh);
  figures["error"] = fixed.error + moving.error;
  figures["spacing"] = flags.shape.spacing > 0.0 ? flags.shape.spacing
                                                 : fixed.solid->bounds().sizes().maxCoeff() / 128.0;
  figures.update(mesh_figures(mesh));
}

void run(const SumFlags& flags) {
  exit_at_once_on_interrupt("nothing was written");
  const ShapeOptions& shape = flags.shape;
  check_shape_options(shape, !flags.inside,
                      {body_path(flags.fixed), body_path(flags.moving), flags.poses});
  const Eigen::Quaterniond rotation = rotation_of(flags);
  const Clock::time_point start = Clock::now();
  BallBodyOptions body{
      .grid = shape.grid, .quiet = shape.common.quiet, .threads = shape.common.threads};
  const BallBody moving = read_ball_body(flags.moving, body);
  body.as_solid = flags.inside;
  body.as_balls = !flags.inside;
  const BallBody fixed = read_ball_body(flags.fixed, body);
  const Json resolved = {{"rotation", {rotation.w(), rotation.x(), rotation.y(), rotation.z()}},
                         {"grid", shape.grid},
                         {"offset", shape.offset},
                         {"slack", shape.slack},
                         {"spacing", shape.spacing},
                         {"plain", flags.plain},
                         {"inside", flags.inside}};
  Json figures = {{"fixed_balls", fixed.balls.cols()}, {"moving_balls", moving.balls.cols()}};
  std::string lines;
  if (flags.inside) {
    write_places_inside(fixed, moving, rotation, flags, figures);
    lines = "inside    places of " + std::to_string(moving.balls.cols()) + " balls in the solid\n";
  } else {
    const long pairs = static_cast<long>(fixed.balls.cols() * moving.balls.cols());
    figures["pairs"] = pairs;
    finish_shape(sum_of(fixed, moving, rotation, flags), fixed.error + moving.error,
                 body_path(flags.fixed), shape, resolved, figures);
    lines = "pairs     " + std::to_string(fixed.balls.cols()) + " x " +
            std::to_string(moving.balls.cols()) + " = " + std::to_string(pairs) + "\n";
  }
  figures["seconds"] = seconds_since(start);
  print_shape(shape, figures, lines);
}

}  // namespace

void add_sum(CLI::App& program) {
  auto flags = std::make_shared<SumFlags>();
  CLI::App& command = *program.add_subcommand(
      "sum", "Make the obstacle: all translations at which two bodies meet, at one rotation");
  command
      .add_option("fixed", flags->fixed,
                  "Molecule (PDB, mmCIF), part (mesh, STEP), or balls (.xyzr, decompose's file)")
      ->required();
  command.add_option("moving", flags->moving, "The body that is turned and shifted; any of these")
      ->required();
  add_shape_options(command, flags->shape, "The obstacle",
                    "what meets by this length: a clearance");
  auto* rotation = command
                       .add_option("--rotation", flags->rotation,
                                   "Quaternion w,x,y,z that turns the moving body about its origin")
                       ->delimiter(',')
                       ->expected(4)
                       ->capture_default_str();
  command.add_option("--poses", flags->poses, "The rotation of a pose of this CSV (qw, ..., tz)")
      ->excludes(rotation);
  command.add_option("--pose", flags->pose, "Which pose of --poses, from 1")->capture_default_str();
  auto* plain = command.add_flag("--plain", flags->plain,
                                 "The Minkowski sum itself: all x + R y, the moving body not "
                                 "mirrored");
  command
      .add_flag("--inside", flags->inside,
                "The quotient instead: all translations at which the moving body lies inside the "
                "fixed one; a mesh")
      ->excludes(plain);
  add_common_options(
      command, flags->shape.common,
      "  mortise sum block.stl peg.stl -o obstacle.stl\n"
      "  mortise sum receptor.pdb ligand.pdb --poses poses.csv --pose 3 -o obstacle.h5\n"
      "  mortise sum box.stl part.stl --inside --offset 0.5 -o places.stl\n"
      "A point t of the obstacle is a translation at which the moving body, turned and then "
      "moved by t,\n"
      "meets the fixed one. Each pair of balls gives a ball with both radii. Lengths are in the "
      "bodies' unit.\n");
  command.callback([flags] { run(*flags); });
}

}  // namespace mortise::app
