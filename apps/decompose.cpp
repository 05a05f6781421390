// SPDX-License-Identifier: GPL-3.0-or-later
// mortise decompose: a part as few balls, with the error this makes.
#include "mortise/parts/decompose.hpp"

#include <algorithm>
#include <cstdio>
#include <map>
#include <memory>
#include <mutex>

#include "clock.hpp"
#include "commands.hpp"
#include "interrupt.hpp"
#include "mortise/core/errors.hpp"
#include "mortise/core/progress.hpp"
#include "mortise/parts/ball_mesh.hpp"
#include "mortise/parts/format_part.hpp"
#include "mortise/parts/hausdorff.hpp"
#include "mortise/parts/sphere_tree.hpp"
#include "mortise/runs/body_forms.hpp"
#include "mortise/store/atomic_file.hpp"
#include "mortise/store/balls_file.hpp"
#include "mortise/store/knots_file.hpp"
#include "output_guard.hpp"

namespace mortise::app {
namespace {

using Json = nlohmann::ordered_json;

struct DecomposeFlags {
  CommonOptions common;
  std::string part, output, ply;
  std::string method = "skeletal", reduction = "cover", weights = "unit";
  DecomposeOptions decompose;
  int arity = SphereTreeOptions{}.arity;
  bool allow_open = false;
  bool force = false;
  bool measure = true;
};

const std::map<std::string, DecomposeMethod> kMethods = {
    {"skeletal", DecomposeMethod::kSkeletal},
    {"packing", DecomposeMethod::kInnerPacking},
    {"octree", DecomposeMethod::kOctree}};
const std::map<std::string, Reduction> kReductions = {{"cover", Reduction::kCover},
                                                      {"containment", Reduction::kContainment},
                                                      {"none", Reduction::kNone}};
const std::map<std::string, KnotWeights> kWeights = {{"unit", KnotWeights::kUnit},
                                                     {"share", KnotWeights::kShare}};

template <typename Value>
std::vector<std::string> names(const std::map<std::string, Value>& values) {
  std::vector<std::string> result;
  result.reserve(values.size());
  for (const auto& [name, value] : values) result.push_back(name);
  return result;
}

Json resolved(const DecomposeFlags& options) {
  return {{"method", options.method},
          {"reduction", options.reduction},
          {"grid", options.decompose.grid},
          {"mu", options.decompose.protrusion},
          {"expansion", options.decompose.expansion},
          {"weights", options.weights},
          {"arity", options.arity},
          {"allow_open", options.allow_open},
          {"measure", options.measure}};
}

void print(const DecomposeFlags& options, const Json& figures) {
  const auto number = [&](const char* name) { return figures[name].get<double>(); };
  const auto count = [&](const char* name) { return figures[name].get<long>(); };
  std::printf("balls      %ld: %ld of %ld inner ones and %ld added at the boundary, tree of %ld\n",
              count("n3"), count("n3") - count("n_boundary"), count("n1"), count("n_boundary"),
              count("tree_balls"));
  std::printf("grid       %ld nodes, %ld inside, %.4f of these in the balls\n", count("nodes"),
              count("inside"), number("coverage"));
  std::printf("epsilon    %.6g   half a grid cell's diagonal\n", number("epsilon"));
  if (options.measure) {
    std::printf("hausdorff  %.6g   balls beyond part %.6g, part beyond balls %.6g\n",
                number("hausdorff"), number("balls_beyond_part"), number("part_beyond_balls"));
    std::printf("samples    %.6g apart, in the solid %.6g\n", number("hausdorff_spacing"),
                number("hausdorff_node_spacing"));
    std::printf("surfaces   %.6g   of balls to part %.6g, of part to balls %.6g\n",
                number("hausdorff_surfaces"), number("ball_surface_to_part"),
                number("part_surface_to_balls"));
  }
  std::printf("seconds    %.2f\n", number("seconds"));
  std::printf("wrote      %s%s\n", options.output.c_str(),
              options.ply.empty() ? "" : (", " + options.ply).c_str());
}

// A solid that tells how many of its distances have been asked for.
class CountedSolid : public Solid {
 public:
  CountedSolid(const Solid& solid, std::size_t total, ProgressCallback progress)
      : solid_(solid), total_(total), progress_(std::move(progress)) {}
  [[nodiscard]] Eigen::AlignedBox3d bounds() const override { return solid_.bounds(); }
  [[nodiscard]] Eigen::VectorXd signed_distance(const Eigen::Matrix3Xd& points,
                                                double band) const override {
    Eigen::VectorXd result = solid_.signed_distance(points, band);
    const std::lock_guard lock(mutex_);
    done_ = std::min(total_, done_ + static_cast<std::size_t>(points.cols()));
    progress_(done_, total_);
    return result;
  }

 private:
  const Solid& solid_;
  std::size_t total_;
  ProgressCallback progress_;
  mutable std::mutex mutex_;
  mutable std::size_t done_ = 0;
};

// Nodes of a grid of cubic cells over the box.
std::size_t node_count(const Eigen::AlignedBox3d& box, int grid) {
  const double longest = box.isEmpty() ? 0.0 : box.sizes().maxCoeff();
  if (!(longest > 0.0)) return 0;  // decompose() refuses it
  const Eigen::Array3d cells = box.sizes().array() / longest * grid;
  return static_cast<std::size_t>((cells - 1e-9).ceil().max(1.0).prod());
}

// Neither file is an input, nor the other one, nor an older answer.
void check_outputs(const DecomposeFlags& options) {
  const char* remedy = "--force replaces it";
  check_output_file(options.output, {options.part}, options.force, remedy);
  if (options.ply.empty()) return;
  if (same_file(options.ply, options.output))
    throw FileError(options.ply, "expected another file than the one for the knots (-o)");
  check_output_file(options.ply, {options.part}, options.force, remedy);
}

void run(DecomposeFlags options) {
  exit_at_once_on_interrupt("no knots were written");
  check_outputs(options);
  options.decompose.method = kMethods.at(options.method);
  options.decompose.reduction = kReductions.at(options.reduction);
  options.decompose.weights = kWeights.at(options.weights);
  options.decompose.threads = options.common.threads;
  const Body body = read_body(options.part, {.part = {.repair = {.allow_open = options.allow_open}},
                                             .threads = options.common.threads});
  const Part part = body_part(body);
  if (!options.common.quiet)
    for (const std::string& decision : body.decisions)
      std::fprintf(stderr, "mortise: %s: %s\n", options.part.c_str(), decision.c_str());

  const Clock::time_point start = Clock::now();
  const Solid& solid = *part.solid;
  const CountedSolid counted(solid, node_count(solid.bounds(), options.decompose.grid),
                             make_progress("distances", options.common));
  const Decomposition result = decompose(counted, options.decompose);
  const SphereTree tree = sphere_tree(result.knots.points, {.arity = options.arity});
  const double seconds = seconds_since(start);

  Json figures = {
      {"n1", result.inner.cols()}, {"n3", result.knots.size()},   {"n_boundary", result.added},
      {"epsilon", result.epsilon}, {"spacing", result.spacing},   {"nodes", result.nodes},
      {"inside", result.inside},   {"coverage", result.coverage}, {"tree_balls", tree.size()}};
  if (options.measure) {
    const double spacing = 0.5 * result.epsilon;
    const HausdorffDistance distance =
        hausdorff_distance(result.knots.points, solid, surface_samples(part.mesh, spacing),
                           {.spacing = spacing, .threads = options.common.threads});
    figures["hausdorff"] = distance.of_solids();
    figures["hausdorff_spacing"] = distance.spacing;
    figures["hausdorff_node_spacing"] = distance.node_spacing;
    figures["balls_beyond_part"] = distance.balls_beyond_solid;
    figures["part_beyond_balls"] = distance.solid_beyond_balls;
    figures["hausdorff_surfaces"] = distance.of_surfaces();
    figures["ball_surface_to_part"] = distance.balls_to_surface;
    figures["part_surface_to_balls"] = distance.surface_to_balls;
  }
  figures["seconds"] = seconds;

  KnotsFile file;
  file.provenance = make_provenance(command_line(), resolved(options).dump());
  file.source_path = options.part;
  file.source_sha256 = body.record.sha256;
  file.knots = result.knots;
  file.tree = tree;
  for (const auto& [name, value] : figures.items())
    if (name != "seconds") file.figures.push_back({name, value.get<double>()});
  if (!options.ply.empty())
    write_file_atomically(options.ply, format_ply(ball_mesh(result.knots.points)));
  if (named_xyzr(options.output))
    write_xyzr(options.output, file.knots);
  else
    write_knots_file(options.output, file);
  if (options.common.json)
    std::printf("%s\n", figures.dump().c_str());
  else if (!options.common.quiet)
    print(options, figures);
}

}  // namespace

void add_decompose(CLI::App& program) {
  auto options = std::make_shared<DecomposeFlags>();
  CLI::App& command = *program.add_subcommand(
      "decompose", "Turn a part into few balls and say how far they are from it");
  command
      .add_option("part", options->part,
                  "STL, OBJ, PLY, OFF or STEP file; or balls, or a molecule, whose union is taken")
      ->required();
  command
      .add_option("-o,--output", options->output,
                  "Knots file (HDF5: balls, weights, sphere tree); NAME.xyzr: plain balls as text")
      ->required();
  DecomposeOptions& decompose = options->decompose;
  command.add_option("--grid", decompose.grid, "Grid nodes along the part's longest side")
      ->capture_default_str()
      ->check(CLI::Range(2, 1024));
  command
      .add_option(
          "--mu", decompose.protrusion,
          "A ball is passed over that sticks out of a chosen one by at most this part of its "
          "radius; less makes more inner balls and fewer in the end")
      ->capture_default_str()
      ->check(CLI::Range(0.0, 1.0));
  command.add_option("--method", options->method, "Order of the inner balls")
      ->capture_default_str()
      ->check(CLI::IsMember(names(kMethods)));
  command
      .add_option("--reduction", options->reduction,
                  "Which balls stay: cover = few that hold every grid node inside, containment = "
                  "those in no other, none = all")
      ->capture_default_str()
      ->check(CLI::IsMember(names(kReductions)));
  command
      .add_option("--expansion", decompose.expansion,
                  "Part of epsilon by which radii grow; epsilon is half a cell's diagonal")
      ->capture_default_str()
      ->check(CLI::Range(0.0, 1.0));
  command
      .add_option("--weights", options->weights,
                  "unit = 1, share = overlaps divided among the balls")
      ->capture_default_str()
      ->check(CLI::IsMember(names(kWeights)));
  command.add_option("--arity", options->arity, "Most children of a ball of the sphere tree")
      ->capture_default_str()
      ->check(CLI::Range(2, 64));
  command.add_option("--ply", options->ply, "PLY file of the balls, to look at");
  command.add_flag("--force", options->force, "Replace the output files if they are there");
  command.add_flag(
      "--allow-open", options->allow_open,
      "Take a surface that does not close as it is; inside is where it winds around a point");
  command.add_flag("!--no-hausdorff", options->measure,
                   "Do not measure the distance between balls and part");
  add_common_options(command, options->common,
                     "  mortise decompose part.stl -o part.h5\n"
                     "  mortise decompose part.step -o part.h5 --grid 128 --ply balls.ply\n"
                     "  mortise decompose part.stl -o part.xyzr --weights share\n"
                     "  mortise decompose part.stl -o part.h5 --grid 64 --mu 0.5 --reduction "
                     "containment --json");
  command.callback([options] { run(*options); });
}

}  // namespace mortise::app
