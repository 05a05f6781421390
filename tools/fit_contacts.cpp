// SPDX-License-Identifier: GPL-3.0-or-later
// Fits the contact potential (src/scoring/data/contacts.txt) to a table of known complexes.
//
// For each pair the search is run from a random start and its poses are scored by the potential so
// far. The poses that are near the answer, the best others, and a sample of the rest become one
// choice each: the potential is fitted so that the chosen pose tends to be near the answer,
//
//   minimise  sum over pairs of -log( sum_near q e^s / sum_all w e^s )  +  (g / 2) |v|^2,     s =
//   v.(features / spread),
//
// with q the quality of a pose (the RMSD terms of DockQ) and w = 1 over the share of such poses in
// the sample. Rounds repeat this with the potential of the round before to find the best others.
// Besides the potential of all pairs it writes one for each fold, fitted without the pairs whose
// row number modulo the folds is the fold's.
#include <lbfgs.h>

#include <CLI/CLI.hpp>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <numeric>
#include <random>

#include "core/point_grid.hpp"
#include "mortise/core/errors.hpp"
#include "mortise/core/threads.hpp"
#include "mortise/metrics/reference_complex.hpp"
#include "mortise/molecules/contact_types.hpp"
#include "mortise/molecules/radii.hpp"
#include "mortise/molecules/read_molecule.hpp"
#include "mortise/runs/dock.hpp"
#include "mortise/scoring/contact_potential.hpp"
#include "mortise/scoring/score_maps.hpp"
#include "mortise/store/csv.hpp"

namespace mortise {
namespace {

constexpr int kPairs = kContactTypes * (kContactTypes + 1) / 2;
constexpr int kFeatures = 1 + 2 * kPairs;  // shape, near pairs, far pairs

int pair_index(int a, int b) {
  if (a > b) std::swap(a, b);
  return a * kContactTypes - a * (a - 1) / 2 + (b - a);
}

struct Options {
  std::string pairs, output = "contacts.txt";
  int rounds = 2, folds = 5, hardest = 2500, sample = 8, threads = 0;
  double penalty = 50.0;
};

// One known complex and its sampled poses, one column each.
struct Choice {
  Eigen::MatrixXf features;
  Eigen::VectorXd quality, weight;
};

std::vector<std::vector<std::string>> read_table(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw FileError(path, "cannot be read");
  std::vector<std::vector<std::string>> rows;
  std::string line;
  std::getline(file, line);
  while (std::getline(file, line)) {
    rows.push_back(csv_cells(line));
    if (rows.back().size() < 6)
      throw FileError(path, static_cast<long>(rows.size()) + 1, "expected 6 fields");
  }
  return rows;
}

// `near_fixed`: the fixed points within the potential's range.
void fill_features(const TypedPoints& fixed, const detail::PointGrid& near_fixed,
                   const TypedPoints& moving, const RigidMotion& motion, double shape,
                   Eigen::Ref<Eigen::VectorXf> out) {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(kFeatures);
  sum[0] = shape;
  for (Eigen::Index j = 0; j < moving.points.cols(); ++j) {
    const int type = moving.types[j];
    if (type < 0) continue;
    const Eigen::Vector3d at = motion * Eigen::Vector3d(moving.points.col(j));
    near_fixed.for_each_near(at, [&](std::int32_t i) {
      if (fixed.types[i] < 0) return;
      const double d = (fixed.points.col(i) - at).norm();
      const int pair = 1 + pair_index(type, fixed.types[i]);
      sum[pair] += near_contact(d);
      sum[pair + kPairs] += far_contact(d);
    });
  }
  out = sum.cast<float>();
}

Choice sample_pair(const std::vector<std::string>& row, const std::string& folder,
                   const std::string& potential_file, bool rescore, const Options& options,
                   std::uint32_t seed) {
  const auto read = [&](int column) {
    return read_molecule(parse_molecule_spec(folder + row[column])).molecule;
  };
  const Molecule fixed = read(2);
  Molecule moving = read(3);
  const ReferenceComplex reference(fixed, moving, read(4), read(5));
  std::mt19937 generator(seed);
  std::normal_distribution<double> normal;
  RigidMotion start;
  start.rotation =
      canonical({normal(generator), normal(generator), normal(generator), normal(generator)});
  for (Atom& atom : moving.atoms) atom.position = start * atom.position;

  DockOptions dock;
  dock.threads = 1;
  dock.rescore = rescore;
  dock.polish = false;  // a pose's features are those of the place where it is ranked
  dock.potential = potential_file;
  dock.poses = dock.rotations * dock.search.per_rotation;  // all of them, best first
  dock.cluster_radius = 0.0;
  const PoseList poses = mortise::dock(fixed, moving, dock).poses;
  const double shape_unit =
      rescore ? (potential_file.empty() ? fitted_contact_potential()
                                        : read_contact_potential(potential_file, kContactTypes))
                    .shape
              : 1.0;

  struct Taken {
    std::size_t pose;
    double quality, weight;
  };
  std::vector<Taken> taken;
  for (std::size_t i = 0; i < poses.poses.size(); ++i) {
    const ComplexMetrics m = reference.evaluate(compose(poses.poses[i].moving_in_fixed, start));
    if (m.is_acceptable_by_rmsd())
      taken.push_back({i,
                       1.0 / (1.0 + std::pow(m.interface_rmsd / 1.5, 2)) +
                           1.0 / (1.0 + std::pow(m.ligand_rmsd / 8.5, 2)),
                       1.0});
    else if (static_cast<int>(i) < options.hardest)
      taken.push_back({i, 0.0, 1.0});
    else if (generator() % options.sample == 0)
      taken.push_back({i, 0.0, static_cast<double>(options.sample)});
  }
  const TypedPoints fixed_points{atom_positions(fixed), contact_types(fixed)};
  const TypedPoints moving_points{atom_positions(moving), contact_types(moving)};
  const detail::PointGrid near_fixed(fixed_points.points, kContactRange, kContactRange);
  const auto count = static_cast<Eigen::Index>(taken.size());
  Choice choice{Eigen::MatrixXf(kFeatures, count), Eigen::VectorXd(count), Eigen::VectorXd(count)};
  for (Eigen::Index n = 0; n < count; ++n) {
    const Pose& pose = poses.poses[taken[n].pose];
    fill_features(fixed_points, near_fixed, moving_points, pose.moving_in_fixed,
                  pose.channels[0] / shape_unit, choice.features.col(n));
    choice.quality[n] = taken[n].quality;
    choice.weight[n] = taken[n].weight;
  }
  return choice;
}

struct Problem {
  const std::vector<Choice>* choices;
  std::vector<std::size_t> rows;  // the pairs that take part
  double penalty;
  int threads;
};

// Objective and gradient; pairs in parallel, summed in order.
double evaluate(void* instance, const double* v, double* gradient, int n, double /*step*/) {
  const auto& problem = *static_cast<const Problem*>(instance);
  const Eigen::VectorXf weights = Eigen::Map<const Eigen::VectorXd>(v, n).cast<float>();
  std::vector<double> loss(problem.rows.size());
  std::vector<Eigen::VectorXf> slope(problem.rows.size());
  parallel_for(problem.rows.size(), problem.threads, [&](std::size_t r, int) {
    const Choice& choice = (*problem.choices)[problem.rows[r]];
    Eigen::ArrayXd score = (choice.features.transpose() * weights).cast<double>().array();
    score = (score - score.maxCoeff()).exp();
    const Eigen::ArrayXd all = score * choice.weight.array(), near = score * choice.quality.array();
    const double total = all.sum(), good = near.sum() + 1e-300;
    loss[r] = std::log(total) - std::log(good);
    slope[r] = choice.features * (all / total - near / good).cast<float>().matrix();
  });
  Eigen::Map<Eigen::VectorXd> g(gradient, n);
  const Eigen::Map<const Eigen::VectorXd> x(v, n);
  g = problem.penalty * x;
  for (const Eigen::VectorXf& one : slope) g += one.cast<double>();
  return std::accumulate(loss.begin(), loss.end(), 0.5 * problem.penalty * x.squaredNorm());
}

// Weights of the raw features, fitted to the given rows.
Eigen::VectorXd fit(const std::vector<Choice>& choices, std::vector<std::size_t> rows,
                    const Eigen::VectorXd& spread, const Options& options) {
  std::erase_if(rows, [&](std::size_t r) { return choices[r].quality.sum() <= 0.0; });
  Problem problem{&choices, std::move(rows), options.penalty, options.threads};
  std::vector<double> v(kFeatures, 0.0);
  v[0] = 1.0;  // start from the shape score alone
  lbfgs_parameter_t parameters;
  lbfgs_parameter_init(&parameters);
  parameters.max_iterations = 100;
  double value = 0.0;
  const int status = lbfgs(kFeatures, v.data(), &value, evaluate, nullptr, &problem, &parameters);
  if (status < 0 && status != LBFGSERR_MAXIMUMITERATION)
    std::fprintf(stderr, "fit_contacts: the optimiser stopped early, liblbfgs code %d\n", status);
  return Eigen::Map<const Eigen::VectorXd>(v.data(), kFeatures).cwiseQuotient(spread);
}

void write_potential(const std::string& path, const Eigen::VectorXd& v, const std::string& note) {
  std::ofstream file(path);
  char number[32];
  const auto put = [&](double value, char end) {
    std::snprintf(number, sizeof number, "%.6g", value);
    file << number << end;
  };
  file << "# Contact potential for the types of include/mortise/molecules/contact_types.hpp, made "
          "by "
          "tools/fit_contacts.\n# "
       << note << "\nshape ";
  put(v[0], '\n');
  for (const int first : {1, 1 + kPairs}) {
    file << (first == 1 ? "near\n" : "far\n");
    for (int a = 0; a < kContactTypes; ++a)
      for (int b = 0; b < kContactTypes; ++b)
        put(v[first + pair_index(a, b)], b + 1 == kContactTypes ? '\n' : ' ');
  }
  if (!file) throw FileError(path, "cannot be written");
}

std::string fold_path(const std::string& output, int fold) {
  const std::filesystem::path path(output);
  return (path.parent_path() /
          (path.stem().string() + "_without_fold_" + std::to_string(fold) + ".txt"))
      .string();
}

void run(const Options& options) {
  const auto rows = read_table(options.pairs);
  const std::string folder = std::filesystem::path(options.pairs).parent_path().string() + "/";
  for (int round = 0; round < options.rounds; ++round) {
    std::vector<Choice> choices(rows.size());
    std::size_t done = 0;
    parallel_for(rows.size(), options.threads, [&](std::size_t i, int) {
      // A pair's hardest wrong poses are found by a potential that has not seen the pair.
      choices[i] = sample_pair(
          rows[i], folder,
          round == 0 ? "" : fold_path(options.output, static_cast<int>(i) % options.folds),
          round > 0, options, static_cast<std::uint32_t>(i));
      std::fprintf(stderr, "\rround %d: %zu of %zu pairs ", round + 1, ++done, rows.size());
    });
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(kFeatures);
    for (const Choice& c : choices) {
      const Eigen::MatrixXf centred = c.features.colwise() - c.features.rowwise().mean();
      sum += (centred.rowwise().squaredNorm() / static_cast<float>(centred.cols())).cast<double>();
    }
    const Eigen::VectorXd spread =
        (sum / static_cast<double>(choices.size())).cwiseSqrt().array() + 1e-3;
    for (Choice& c : choices) c.features.array().colwise() /= spread.cast<float>().array();
    std::vector<std::size_t> all(rows.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    const std::string note = std::to_string(rows.size()) + " pairs, round " +
                             std::to_string(round + 1) + ", penalty " +
                             std::to_string(options.penalty);
    write_potential(options.output, fit(choices, all, spread, options), note);
    for (int fold = 0; fold < options.folds; ++fold) {
      std::vector<std::size_t> some = all;
      std::erase_if(some,
                    [&](std::size_t r) { return static_cast<int>(r) % options.folds == fold; });
      write_potential(fold_path(options.output, fold), fit(choices, some, spread, options),
                      note + ", without rows " + std::to_string(fold) + " modulo " +
                          std::to_string(options.folds));
    }
    std::fprintf(stderr, "\n");
  }
}

}  // namespace
}  // namespace mortise

int main(int argc, char** argv) {
  mortise::Options options;
  CLI::App app{"Fits the contact potential to a table of known complexes."};
  app.add_option("pairs", options.pairs, "Table as mortise benchmark takes it")->required();
  app.add_option("-o,--output", options.output, "Potential to write")->capture_default_str();
  app.add_option("--rounds", options.rounds, "Searches and fits")->capture_default_str();
  app.add_option("--folds", options.folds, "Folds of the cross-validation")->capture_default_str();
  app.add_option("--hardest", options.hardest, "Best-scored wrong poses kept of each pair")
      ->capture_default_str();
  app.add_option("--sample", options.sample, "One in so many of the other wrong poses")
      ->capture_default_str();
  app.add_option("--penalty", options.penalty, "g, the weight of the squared norm")
      ->capture_default_str();
  app.add_option("--threads", options.threads, "0 = all cores")->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  try {
    mortise::run(options);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "fit_contacts: error: %s\n", e.what());
    return 1;
  }
  return 0;
}
