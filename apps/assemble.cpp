// SPDX-License-Identifier: GPL-3.0-or-later
// mortise assemble: energy, force and torque along a path at a fixed rate, or a body let go.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <numbers>
#include <utility>

#include "assembly_loop.hpp"
#include "ball_body.hpp"
#include "clock.hpp"
#include "commands.hpp"
#include "line_plot.hpp"
#include "mortise/assembly/assembly_session.hpp"
#include "mortise/assembly/hand_path.hpp"
#include "mortise/assembly/part_field.hpp"
#include "mortise/core/errors.hpp"
#include "mortise/metrics/true_mates.hpp"
#include "mortise/parts/mesh_solid.hpp"
#include "mortise/runs/body_forms.hpp"
#include "mortise/runs/let_go.hpp"
#include "mortise/store/atomic_file.hpp"
#include "mortise/store/body.hpp"
#include "output_guard.hpp"
#include "pose_csv.hpp"

namespace mortise::app {
namespace {

struct AssembleFlags {
  CommonOptions common;
  std::string fixed, moving, path, goal, mates, pair, output, plot, write_path;
  double rate = 1000.0;
  PartFieldOptions field;
  std::string field_kind = "double-skin";
  double sigma = SkeletalFieldOptions().sigma;
  AssemblyOptions assembly;
  HandPathOptions hand;
  int free_starts = 0;
  double start_shift = 0.15, start_angle = 10.0;  // part of the radius; degrees
  FollowOptions follow;
};

void check_flags(const AssembleFlags& options) {
  const auto check = [](double value, double low, double high, const char* name) {
    if (!(value >= low && value <= high))  // so that NaN fails too
      throw InputError("assemble: --" + std::string(name) + " must be in [" + std::to_string(low) +
                       ", " + std::to_string(high) + "], got " + std::to_string(value));
  };
  check(options.field.thickness, 0.0, 1e9, "thickness");
  check(options.start_shift, 0.0, 100.0, "start-shift");
  check(options.start_angle, 0.0, 180.0, "start-angle");
  check(options.rate, 1e-3, 1e6, "rate");
  for (const std::string& output : {options.output, options.plot, options.write_path}) {
    if (output.empty()) continue;
    check_output_file(output,
                      {body_path(options.fixed), body_path(options.moving), options.path,
                       options.goal, options.mates},
                      true, "");
  }
}

struct Session {
  AssemblySession session;
  double seconds;
  std::string fixed_size, moving_size;  // as people count them: triangles, atoms, balls
  long fixed_triangles;
  TriangleMesh moving;
};

// The skeleton is known of a surface of triangles: of balls that is the mesh of their union.
BodyDensity skeletal_density_of(const Part& part, double margin, const AssembleFlags& options) {
  const SkeletalFieldOptions field{.grid = options.field.grid,
                                   .margin = margin,
                                   .sigma = options.sigma,
                                   .penalty = options.field.penalty,
                                   .threads = options.common.threads};
  if (const auto* solid = dynamic_cast<const MeshSolid*>(part.solid.get()))
    return skeletal_field(*solid, field);
  return skeletal_field(MeshSolid(part.mesh, {.threads = options.common.threads}), field);
}

Session make_session(const AssembleFlags& options) {
  const auto start = Clock::now();
  const Body fixed_body = read_body(options.fixed, {.threads = options.common.threads});
  const Body moving_body = read_body(options.moving, {.threads = options.common.threads});
  for (const Body* body : {&fixed_body, &moving_body})
    if (body->part() != nullptr && !options.common.quiet)
      for (const std::string& decision : body->decisions)
        std::fprintf(stderr, "mortise: %s: %s\n", body->record.spec.c_str(), decision.c_str());
  const Part fixed = body_part(fixed_body), moving = body_part(moving_body);
  const double thickness =
      options.field.thickness > 0.0
          ? options.field.thickness
          : std::min(default_thickness(*fixed.solid), default_thickness(*moving.solid));
  const auto density = [&](const Part& part) {
    stop_if_interrupted("nothing was written");
    if (options.field_kind == "skeletal") return skeletal_density_of(part, thickness, options);
    PartFieldOptions field = options.field;
    field.thickness = thickness;
    return double_skin_field(*part.solid, field);
  };
  AssemblySession session(density(fixed), density(moving), options.assembly);
  return {std::move(session),
          seconds_since(start),
          size_text(fixed_body),
          size_text(moving_body),
          static_cast<long>(fixed.mesh.size()),
          moving.mesh};
}

// Where the part belongs: of a truth file with its symmetries, of a table of poses the first.
TrueMate goal_of(const AssembleFlags& options) {
  if (!options.mates.empty())
    return find_true_mate(read_true_mates(options.mates),
                          std::filesystem::path(body_path(options.fixed)).stem().string(),
                          std::filesystem::path(body_path(options.moving)).stem().string(),
                          options.pair);
  const std::vector<RigidMotion> goals = read_pose_csv(options.goal);
  if (goals.empty()) throw FileError(options.goal, "holds no pose");
  TrueMate mate;
  mate.moving_in_fixed = goals.front();
  return mate;
}

std::vector<RigidMotion> path_of(const AssembleFlags& options, const AssemblySession& session) {
  if (!options.path.empty()) return read_pose_csv(options.path);
  HandPathOptions hand = options.hand;
  hand.rate = options.rate;
  return hand_path(goal_of(options).moving_in_fixed, session.moving_centre(),
                   session.moving_radius(), hand);
}

void follow_path(const AssembleFlags& options, const Session& made) {
  const std::vector<RigidMotion> path = path_of(options, made.session);
  if (!options.write_path.empty()) write_pose_csv(options.write_path, path);
  if (path.empty()) throw FileError(options.path, "holds no pose");
  const Loop loop = run_loop(made.session, path, options.rate);
  if (!options.output.empty()) write_wrenches(options.output, loop, options.rate);
  if (!options.plot.empty()) write_plot(options.plot, loop, options.rate);
  const Latency compute = latency(loop.felt), late = latency(loop.late);
  if (options.common.json) {
    const auto quantiles = [](const Latency& l) {
      return nlohmann::ordered_json{{"steps", l.steps},
                                    {"median", l.median},
                                    {"percentile_99", l.percentile_99},
                                    {"percentile_99_9", l.percentile_999},
                                    {"largest", l.largest}};
    };
    const nlohmann::ordered_json figures = {
        {"steps", path.size()},
        {"rate", options.rate},
        {"modes", made.session.modes()},
        {"fixed_triangles", made.fixed_triangles},
        {"moving_triangles", static_cast<long>(made.moving.size())},
        {"preparation_seconds", made.seconds},
        {"compute_microseconds", quantiles(compute)},
        {"step_microseconds", quantiles(late)},
        {"misses", loop.misses}};
    std::printf("%s\n", figures.dump().c_str());
    return;
  }
  if (options.common.quiet) return;
  std::printf("bodies       %s and %s, prepared in %.1f s\n", made.fixed_size.c_str(),
              made.moving_size.c_str(), made.seconds);
  std::printf("path         %zu steps at %g Hz, m' = %d modes\n", path.size(), options.rate,
              made.session.modes());
  std::printf("us per step  median    99%%  99.9%%  largest\n");
  std::printf("  wrench     %6.1f %6.1f %6.1f %8.1f\n", compute.median, compute.percentile_99,
              compute.percentile_999, compute.largest);
  std::printf("  due to end %6.1f %6.1f %6.1f %8.1f\n", late.median, late.percentile_99,
              late.percentile_999, late.largest);
  std::printf("misses       %d\n", loop.misses);
  if (compute.steps < path.size())
    std::printf("out of reach %zu steps, not counted under wrench\n", path.size() - compute.steps);
}

void let_go_and_print(const AssembleFlags& options, const Session& made) {
  LetGoOptions let_go_options{.starts = options.free_starts,
                              .shift = options.start_shift,
                              .angle = options.start_angle * std::numbers::pi / 180.0,
                              .seed = options.hand.seed,
                              .follow = options.follow};
  const LetGoResult result =
      let_go(made.session, made.moving, goal_of(options), let_go_options, [] {
        stop_if_interrupted("no poses of rest were written");
        return true;
      });
  if (!options.output.empty()) write_pose_csv(options.output, result.ends);
  if (options.common.json) {
    const nlohmann::ordered_json figures = {
        {"starts", options.free_starts},
        {"home", result.home},
        {"home_without_symmetries", result.home_without_symmetries},
        {"mate_energy", result.mate.wrench.energy},
        {"mate_drift", result.drift},
        {"mate_holds", result.holds}};
    std::printf("%s\n", figures.dump().c_str());
    return;
  }
  if (options.common.quiet) return;
  std::printf("mate    energy %.4g, rests %.2f%% of the radius from the goal\n",
              result.mate.wrench.energy, 100.0 * result.drift);
  std::printf("starts  %d of %d end %s\n", result.home, options.free_starts,
              result.holds ? "in it" : "there; it is too far off to count as the mate");
}

void run(AssembleFlags options) {
  install_interrupt_handler();  // between two steps
  options.field.threads = options.assembly.threads = options.common.threads;
  if (int{options.path.empty()} + int{options.goal.empty()} + int{options.mates.empty()} != 2)
    throw InputError("assemble: give one of --path, --goal and --mates");
  if (options.free_starts > 0 && !options.path.empty())
    throw InputError("assemble: --free starts around a pose: give --goal or --mates");
  const Session made = make_session(options);
  if (options.free_starts > 0)
    let_go_and_print(options, made);
  else
    follow_path(options, made);
}

}  // namespace

void add_assemble(CLI::App& program) {
  auto options = std::make_shared<AssembleFlags>();
  CLI::App* command = program.add_subcommand(
      "assemble", "Energy, force and torque of two bodies along a path at haptic rate");
  command
      ->add_option("fixed", options->fixed,
                   "Part (mesh, STEP), balls (.xyzr, decompose's file) or molecule (PDB, mmCIF)")
      ->required();
  command->add_option("moving", options->moving, "The body that the path moves, of any kind")
      ->required();
  command->add_option("--path", options->path,
                      "CSV with columns qw, qx, qy, qz, tx, ty, tz: one pose per step");
  command->add_option(
      "--goal", options->goal,
      "CSV whose first pose is the mate: Mortise makes up a hand's path that ends there");
  command->add_option("--mates", options->mates,
                      "File of true placements, as parts/mates.json, in place of --goal; --free "
                      "then counts the mate's symmetries too");
  command->add_option("--pair", options->pair,
                      "Name of the pair in that file; default: by the parts' file names");
  command->add_option("--seconds", options->hand.seconds, "Length of the made-up path")
      ->capture_default_str();
  command->add_option("--seed", options->hand.seed, "Seed of the made-up path or of the starts")
      ->capture_default_str();
  CLI::Option* write_path =
      command->add_option("--write-path", options->write_path, "CSV file to write the path to");
  command->add_option("--rate", options->rate, "Steps per second")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  command->add_option(
      "-o,--output", options->output,
      "CSV: time, energy, force, torque (about the moving part's origin), time spent; "
      "with --free: the poses of rest");
  CLI::Option* plot = command->add_option("--plot", options->plot, "SVG plot of the same");
  command
      ->add_option("--modes", options->assembly.modes, "Fourier modes m'; more make contact harder")
      ->capture_default_str()
      ->check(CLI::Range(1, 10000000));
  command->add_option("--grid", options->field.grid, "Nodes along a body's longest side")
      ->capture_default_str()
      ->check(CLI::Range(8, 1024));
  command
      ->add_option(
          "--field", options->field_kind,
          "What bodies are made of: double-skin, or skeletal (densities of their skeletons)")
      ->capture_default_str()
      ->check(CLI::IsMember({"double-skin", "skeletal"}));
  command
      ->add_option("--sigma", options->sigma,
                   "Thickness factor of the skeletons; smaller is sharper")
      ->capture_default_str();
  command
      ->add_option(
          "--thickness", options->field.thickness,
          "Skin in which parts attract, length unit of the files; 0 = 0.15 of the smaller part")
      ->capture_default_str();
  command->add_option("--penalty", options->field.penalty, "Weight of overlap against fit")
      ->capture_default_str();
  command
      ->add_option(
          "--free", options->free_starts,
          "Let the part go from this many random starts near the goal; count those that snap in")
      ->excludes(plot)
      ->excludes(write_path)
      ->capture_default_str()
      ->check(CLI::NonNegativeNumber);
  command
      ->add_option("--start-shift", options->start_shift,
                   "Largest shift of those starts, in radii of the moving part")
      ->capture_default_str();
  command
      ->add_option("--start-angle", options->start_angle, "Largest turn of those starts, degrees")
      ->capture_default_str();
  add_common_options(
      *command, options->common,
      "  mortise assemble block.stl peg.stl --path hand.csv -o wrench.csv --plot wrench.svg\n"
      "  mortise assemble block.stl peg.stl --goal mate.csv --seconds 30 --json\n"
      "  mortise assemble block.stl peg.stl --goal mate.csv --free 50\n"
      "  mortise assemble block.stl peg.stl --mates mates.json --free 50\n"
      "  mortise assemble receptor.pdb ligand.pdb --goal complex.csv --free 20\n"
      "Of balls, and of a molecule's atoms with their radii, the union is the body. Bodies of two "
      "kinds need\n"
      "one unit of length.\n");
  command->callback([options] {
    check_flags(*options);
    run(*options);
  });
}

}  // namespace mortise::app
