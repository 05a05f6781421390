// SPDX-License-Identifier: GPL-3.0-or-later
// Ranking by forms of a molecule's knots: radii, penalties, merged buried atoms.
//
// For each pair of a table (docs/ranking.md), from a random start, each form is searched with the
// default options and its poses ranked by shape alone and by shape and contacts, with the potential
// that was fitted without the pair's fold. In the second ranking a form's shape score is scaled so
// that its spread over the pair's candidates is that of the first form: the potential's factor was
// fitted to that one. Prints a CSV row per pair and form: knots of the moving body, CPU seconds of
// the search, the scale, and for both rankings the rank of the first acceptable pose and of the
// first hit, 0 = none in the top 2,000. bench/knot_forms.py makes tables of it.
//
// Usage: knot_forms PAIRS.csv POTENTIALS_PREFIX FIRST STEP MOST FORM...
//   POTENTIALS_PREFIX  bench/data/contacts_without_fold_
//   FIRST, STEP        rows FIRST, FIRST + STEP, ... of the table, from 0
//   MOST               pairs of more heavy atoms than this are left out
//   FORM               name:radius:merge:penalty:penalty_radius, radius 0 = each atom's own
#include <algorithm>
#include <boost/math/statistics/univariate_statistics.hpp>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include "bench.hpp"
#include "mortise/affinity/double_skin.hpp"
#include "mortise/core/errors.hpp"
#include "mortise/metrics/reference_complex.hpp"
#include "mortise/molecules/contact_types.hpp"
#include "mortise/molecules/radii.hpp"
#include "mortise/molecules/read_molecule.hpp"
#include "mortise/molecules/to_knots.hpp"
#include "mortise/poses/cluster.hpp"
#include "mortise/rotations/rotation_set.hpp"
#include "mortise/runs/benchmark.hpp"
#include "mortise/scoring/contact_potential.hpp"
#include "mortise/scoring/score_maps.hpp"
#include "mortise/search/rotation_search.hpp"

namespace mortise {
namespace {

using bench::cpu_seconds;
using bench::split;

constexpr int kRotations = 3600;
constexpr std::size_t kRanked = 2000;
constexpr double kClusterRadius = 3.0;
constexpr std::size_t kFolds = 5;

struct Form {
  std::string name;
  double radius = 0.0, merge = 0.0, penalty = 0.0, penalty_radius = 0.0;
};

Form parse_form(const std::string& text) {
  const std::vector<std::string> fields = split(text, ':');
  if (fields.size() != 5)
    throw InputError("expected name:radius:merge:penalty:penalty_radius, found " + text);
  return {fields[0], std::stod(fields[1]), std::stod(fields[2]), std::stod(fields[3]),
          std::stod(fields[4])};
}

struct FirstRanks {
  std::size_t acceptable = 0, hit = 0;  // 0 = none
};

// One known complex, the moving body from a random start.
struct Pair {
  Molecule fixed, moving;
  RigidMotion start;
  ReferenceComplex reference;
  PlacedPoints moving_points;
  ContactPotential potential;
  ScoreMaps maps;
};

Pair read_pair(const BenchmarkPair& row, const std::string& potential_file, std::uint32_t seed) {
  const auto read = [](const std::string& spec) {
    return read_molecule(parse_molecule_spec(spec)).molecule;
  };
  const Molecule fixed = read(row.fixed);
  Molecule moving = read(row.moving);
  ReferenceComplex reference(fixed, moving, read(row.reference_fixed), read(row.reference_moving));
  std::mt19937 generator(seed);
  std::normal_distribution<double> normal;
  RigidMotion start;
  const double w = normal(generator), x = normal(generator), y = normal(generator);
  start.rotation = canonical({w, x, y, normal(generator)});
  for (Atom& atom : moving.atoms) atom.position = start * atom.position;
  const ContactPotential potential = read_contact_potential(potential_file, kContactTypes);
  const TypedPoints fixed_points{atom_positions(fixed), contact_types(fixed)};
  PlacedPoints moving_points({atom_positions(moving), contact_types(moving)});
  ScoreMaps maps(fixed_points, potential, {.threads = 1});
  return {fixed,     moving,         start, std::move(reference), std::move(moving_points),
          potential, std::move(maps)};
}

FirstRanks first_ranks(const Pair& pair, const std::vector<RigidMotion>& poses,
                       const std::vector<double>& scores) {
  std::vector<std::size_t> order(poses.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return scores[a] > scores[b]; });
  std::vector<RigidMotion> ranked;
  ranked.reserve(order.size());
  for (const std::size_t i : order) ranked.push_back(poses[i]);
  const Clusters clusters = cluster_poses(ranked, atom_positions(pair.moving),
                                          {.radius = kClusterRadius, .max_clusters = kRanked});
  FirstRanks first;
  for (std::size_t rank = 1; rank <= clusters.founders.size(); ++rank) {
    const ComplexMetrics m =
        pair.reference.evaluate(compose(ranked[clusters.founders[rank - 1]], pair.start));
    if (first.acceptable == 0 && m.is_acceptable()) first.acceptable = rank;
    if (first.hit == 0 && m.is_hit()) first.hit = rank;
    if (first.acceptable != 0 && first.hit != 0) break;
  }
  return first;
}

void run_pair(const Pair& pair, const std::string& name, const std::vector<Form>& forms,
              const RotationSet& rotations) {
  double first_spread = 0.0;
  for (const Form& form : forms) {
    const DoubleSkinOptions skin{.penalty = form.penalty, .penalty_radius = form.penalty_radius};
    const ToKnotsOptions options{
        .radius = form.radius, .merge_buried = form.merge, .offset = skin.offset};
    const double begin = cpu_seconds();
    const Knots fixed = to_knots(pair.fixed, options);
    const Knots moving = to_knots(pair.moving, options);
    RotationSearch search({double_skin_channel(fixed, moving, skin)}, rotations.quaternions,
                          {.threads = 1});
    search.run();
    const double seconds = cpu_seconds() - begin;

    std::vector<RigidMotion> poses;
    std::vector<double> shape;
    for (const Candidate& c : search.candidates()) {
      poses.push_back(search.moving_in_fixed(c));
      shape.push_back(c.score);
    }
    const double spread = std::sqrt(boost::math::statistics::variance(shape));
    if (first_spread == 0.0) first_spread = spread;
    const double scale = first_spread / spread;
    std::vector<double> both(shape.size());
    for (std::size_t i = 0; i < shape.size(); ++i)
      both[i] = pair.potential.shape * scale * shape[i] +
                pair.maps.contact_score(pair.moving_points, poses[i]);
    const FirstRanks by_shape = first_ranks(pair, poses, shape);
    const FirstRanks by_both = first_ranks(pair, poses, both);
    std::printf("%s,%s,%g,%ld,%.3f,%.4f,%zu,%zu,%zu,%zu\n", name.c_str(), form.name.c_str(),
                form.penalty, static_cast<long>(moving.size()), seconds, scale, by_shape.acceptable,
                by_shape.hit, by_both.acceptable, by_both.hit);
    std::fflush(stdout);
  }
}

void run(const std::vector<std::string>& arguments) {
  if (arguments.size() < 6)
    throw InputError("expected PAIRS.csv POTENTIALS FIRST STEP MOST FORM...");
  const std::vector<BenchmarkPair> rows = read_benchmark_pairs(arguments[0]);
  const std::size_t first = std::stoul(arguments[2]), step = std::stoul(arguments[3]);
  const std::size_t most = std::stoul(arguments[4]);
  std::vector<Form> forms;
  for (std::size_t i = 5; i < arguments.size(); ++i) forms.push_back(parse_form(arguments[i]));
  const RotationSet rotations = rotation_set(kRotations);
  std::printf(
      "pair,form,penalty,moving_knots,search_cpu,scale,shape_acceptable,shape_hit,both_acceptable,"
      "both_hit\n");
  for (std::size_t i = first; i < rows.size(); i += step) {
    const Pair pair = read_pair(rows[i], arguments[1] + std::to_string(i % kFolds) + ".txt",
                                static_cast<std::uint32_t>(i));
    if (pair.fixed.atoms.size() + pair.moving.atoms.size() <= most)
      run_pair(pair, rows[i].name, forms, rotations);
  }
}

}  // namespace
}  // namespace mortise

int main(int argc, char** argv) {
  return mortise::bench::bench_main("knot_forms", argc, argv, mortise::run);
}
