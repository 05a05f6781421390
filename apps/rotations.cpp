// SPDX-License-Identifier: GPL-3.0-or-later
// mortise rotations: makes a set of rotations, says how well it covers SO(3), writes it as CSV.
#include <cstdio>
#include <fstream>
#include <iomanip>
#include <limits>
#include <memory>
#include <numbers>

#include "commands.hpp"
#include "mortise/core/errors.hpp"
#include "mortise/rotations/coverage.hpp"
#include "mortise/rotations/rotation_set.hpp"

namespace mortise::app {
namespace {

struct RotationsFlags {
  CommonOptions common;
  Eigen::Index count = 0;
  std::string method = rotation_method_name(RotationMethod::kAuto);
  std::string output;
};

constexpr double kDegrees = 180.0 / std::numbers::pi;

void write_csv(const std::string& path, const Eigen::Matrix4Xd& quaternions) {
  std::ofstream file(path);
  file << "w,x,y,z\n" << std::setprecision(std::numeric_limits<double>::max_digits10);
  for (Eigen::Index i = 0; i < quaternions.cols(); ++i)
    file << quaternions(0, i) << ',' << quaternions(1, i) << ',' << quaternions(2, i) << ','
         << quaternions(3, i) << '\n';
  file.close();
  if (!file) throw FileError(path, "cannot be written");
}

void run(const RotationsFlags& options) {
  const RotationSet set =
      rotation_set(options.count, rotation_method(options.method), options.common.threads);
  const Coverage coverage = measure_coverage(set.quaternions, options.common.threads);
  if (!options.output.empty()) write_csv(options.output, set.quaternions);
  const std::string method = rotation_method_name(set.method);
  if (options.common.json) {
    const nlohmann::ordered_json figures = {
        {"count", set.size()},
        {"method", method},
        {"mean_distance_degrees", kDegrees * coverage.mean_distance},
        {"covering_radius_degrees", kDegrees * coverage.covering_radius},
        {"separation_degrees", kDegrees * coverage.separation},
        {"smallest_cell", coverage.smallest_cell},
        {"largest_cell", coverage.largest_cell}};
    std::printf("%s\n", figures.dump().c_str());
    return;
  }
  if (options.common.quiet) return;
  std::printf("rotations        %ld\n", static_cast<long>(set.size()));
  std::printf("method           %s\n", method.c_str());
  std::printf("mean distance    %.3f degrees   from a random rotation to the nearest\n",
              kDegrees * coverage.mean_distance);
  std::printf("covering radius  %.3f degrees   from the farthest rotation to the nearest\n",
              kDegrees * coverage.covering_radius);
  std::printf("separation       %.3f degrees   between the nearest two\n",
              kDegrees * coverage.separation);
  std::printf("cells            %.3f to %.3f   volumes of the Voronoi cells, mean 1\n",
              coverage.smallest_cell, coverage.largest_cell);
}

}  // namespace

void add_rotations(CLI::App& program) {
  auto options = std::make_shared<RotationsFlags>();
  CLI::App* command = program.add_subcommand(
      "rotations", "Make a set of rotations and say how well it covers all of them");
  command->add_option("--count", options->count, "How many rotations")
      ->required()
      ->check(CLI::Range(Eigen::Index{1}, kMaxRotations));
  command
      ->add_option("--method", options->method,
                   "auto (the best for this count), super-fibonacci, hopf or icosahedral")
      ->capture_default_str();
  command->add_option("-o,--output", options->output,
                      "CSV file for the quaternions: w, x, y, z with w >= 0");
  std::string stored;
  for (const Eigen::Index count : stored_rotation_counts())
    stored += (stored.empty() ? "" : ", ") + std::to_string(count);
  add_common_options(*command, options->common,
                     "  mortise rotations --count 3600\n"
                     "  mortise rotations --count 54000 -o rotations.csv\n"
                     "  mortise rotations --count 4608 --method hopf --json\n"
                     "Stored sets (icosahedral): " +
                         stored + " rotations.");
  command->callback([options] { run(*options); });
}

}  // namespace mortise::app
