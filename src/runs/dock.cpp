// SPDX-License-Identifier: GPL-3.0-or-later
// Docking: what is searched, and how candidates become poses.
#include "mortise/runs/dock.hpp"

#include <map>
#include <memory>

#include "mortise/core/errors.hpp"
#include "mortise/molecules/contact_types.hpp"
#include "mortise/molecules/radii.hpp"
#include "mortise/molecules/to_knots.hpp"
#include "mortise/poses/polish.hpp"
#include "mortise/runs/body_forms.hpp"
#include "mortise/scoring/contact_potential.hpp"
#include "mortise/scoring/score_maps.hpp"
#include "mortise/scoring/shape_kernel.hpp"
#include "runs/option_table.hpp"
#include "runs/random_start.hpp"
#include "runs/shape_columns.hpp"
#include "scoring/molecule_scorers.hpp"

namespace mortise {
namespace {

constexpr double kStartReach = 50.0;  // of a random start, angstrom

// What the contact potential sees of a body: the atoms of a molecule.
TypedPoints typed_points(const Body& body) {
  if (const Molecule* molecule = body.molecule())
    return {atom_positions(*molecule), contact_types(*molecule)};
  return {Eigen::Matrix3Xd(3, 0), Eigen::VectorXi(0)};
}

ContactPotential potential_of(const DockOptions& options) {
  if (!options.rescore)  // the shape alone
    return {1.0, Eigen::MatrixXd(0, 0), Eigen::MatrixXd(0, 0)};
  return options.potential.empty() ? fitted_contact_potential()
                                   : read_contact_potential(options.potential, kContactTypes);
}

// The fixed body's terms of the shape score, for knots of any radii. The channel's weights are i w,
// so that a pair counts -w w'.
ShapeTerms fixed_terms(const ShapeKernels& kernels, const Knots& knots, double factor) {
  ShapeTerms terms{
      knots.points.topRows<3>(), -factor * knots.weights.real(), Eigen::VectorXi(knots.size()), {}};
  std::map<double, int> index;
  for (const double r : knots.points.row(3)) index.emplace(r, 0);
  int next = 0;
  for (auto& [radius, i] : index) i = next++;
  for (Eigen::Index k = 0; k < knots.size(); ++k) terms.kernel_of[k] = index.at(knots.points(3, k));
  for (int q = 0; q < kernels.terms(); ++q) {
    std::vector<TabulatedKernel>& of_radius = terms.kernels.emplace_back();
    for (const auto& [radius, i] : index) of_radius.push_back(kernels.kernel(radius, q));
  }
  return terms;
}

// What each moving knot weighs in these terms: Q x N.
Eigen::MatrixXd moving_weights(const ShapeKernels& kernels, const Knots& knots) {
  Eigen::MatrixXd weights(kernels.terms(), knots.size());
  for (Eigen::Index j = 0; j < knots.size(); ++j)
    weights.col(j) = knots.weights[j].real() * kernels.moving_factors(knots.points(3, j));
  return weights;
}

// Contact and shape by maps of the fixed body. Polish needs the shape's map too.
std::shared_ptr<const MapScorer> map_scorer(const Body& fixed, const Body& moving,
                                            const Channel& shape, const SearchPlan& plan,
                                            const ContactPotential& potential,
                                            const DockOptions& options) {
  TypedPoints fixed_points = typed_points(fixed);
  TypedPoints moving_points = typed_points(moving);
  if (!options.rescore) {
    fixed_points.types.setConstant(-1);
    moving_points.types.setConstant(-1);
  }
  const ScoreMapsOptions map_options{.threads = options.threads};
  if (!options.polish)
    return std::make_shared<MapScorer>(
        std::make_shared<ScoreMaps>(fixed_points, potential, map_options),
        PlacedPoints(moving_points));
  const ShapeKernels kernels(shape, {.low_pass = {.cutoff = options.search.cutoff},
                                     .radius_tolerance = options.search.radius_tolerance});
  auto maps = std::make_shared<ScoreMaps>(fixed_points, potential,
                                          fixed_terms(kernels, plan.fixed.knots, potential.shape),
                                          map_options);
  PlacedPoints placed(moving_points, plan.moving.knots.points.topRows<3>(),
                      moving_weights(kernels, plan.moving.knots));
  return std::make_shared<MapScorer>(std::move(maps), std::move(placed));
}

// Moves poses and leaves them the scores by which they were found: ranking by the score at the end
// favours the wrong poses that had most to gain (docs/ranking.md).
MovePoses uphill(std::shared_ptr<const PoseScorer> scorer, const PolishBody& body) {
  return [scorer = std::move(scorer), body](const std::vector<RigidMotion>& poses, int threads) {
    const std::vector<PolishedPose> polished =
        polish_poses([&](const RigidMotion& m) { return scorer->gradient(m); }, body, poses,
                     {.threads = threads});
    std::vector<RigidMotion> moved;
    moved.reserve(polished.size());
    for (const PolishedPose& pose : polished) moved.push_back(pose.moving_in_fixed);
    return moved;
  };
}

std::vector<Stage> stages_of(const std::shared_ptr<const MapScorer>& scorer, const PolishBody& body,
                             const DockOptions& options) {
  const auto count = static_cast<std::size_t>(options.poses);
  Stage first{.name = options.rescore ? "contact" : "shape",
              .scorer = options.rescore ? scorer : nullptr,
              .keep = count,
              .cluster_radius = options.cluster_radius};
  if (!options.polish) return {first};
  first.keep = count + count / 4;  // some will fall together
  return {first,
          {.name = "polish",
           .move = uphill(scorer, body),
           .keep = count,
           .cluster_radius = options.cluster_radius}};
}

}  // namespace

SearchPlan plan_dock(const Body& receptor, const Body& ligand, const DockOptions& options) {
  check_options("dock", dock_option_rows(), options);
  SearchPlan plan;
  plan.kind = "dock";
  plan.options = to_json(options);
  plan.threads = options.threads;
  if (options.random_start) plan.start = random_start(*options.random_start, kStartReach);
  const Body moving = options.random_start ? moved_body(ligand, plan.start) : ligand;
  const ToKnotsOptions knots{.radius = options.radius,
                             .propensity = options.propensity,
                             .merge_buried = options.merge_buried,
                             .offset = options.double_skin.offset,
                             .threads = options.threads};
  plan.fixed = receptor.record;
  plan.fixed.knots = body_knots(receptor, knots, options.ball_grid);
  plan.moving = ligand.record;
  plan.moving.knots = body_knots(moving, knots, options.ball_grid);
  plan.points = plan.moving.knots.points.topRows<3>();
  plan.rotations = rotation_set(options.rotations, RotationMethod::kAuto, options.threads);
  plan.search = options.search;
  const ContactPotential potential = potential_of(options);
  plan.search_weight = potential.shape;
  plan.channels = {double_skin_channel(plan.fixed.knots, plan.moving.knots, options.double_skin)};
  const ShapeColumnsOptions columns{.count = static_cast<std::size_t>(options.described),
                                    .weight = potential.shape,
                                    .cutoff = options.search.cutoff,
                                    .radius_tolerance = options.search.radius_tolerance,
                                    .threads = options.threads};
  // Poses of the plan are of the started body, those described of the body as its file has it.
  const Channel input_channel = double_skin_channel(
      plan.fixed.knots, input_knots(plan.moving.knots, plan.start), options.double_skin);
  plan.describe = [input_channel, columns](const PoseList& list,
                                           const std::vector<FoundPose>& found) {
    return shape_columns(input_channel, list, found, columns);
  };
  if (!options.rescore && !options.polish) {
    plan.stages = stages_of(nullptr, {}, options);
    return plan;
  }
  const std::shared_ptr<const MapScorer> scorer =
      map_scorer(receptor, moving, plan.channels.front(), plan, potential, options);
  plan.stages = stages_of(scorer, {scorer->placed().centre, scorer->placed().gyration}, options);
  return plan;
}

Run dock(const Body& receptor, const Body& ligand, const DockOptions& options,
         const RunWatch& watch) {
  return run_plan(plan_dock(receptor, ligand, options), make_provenance(""), watch);
}

}  // namespace mortise
