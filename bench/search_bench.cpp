// SPDX-License-Identifier: GPL-3.0-or-later
// The rotation loop of docking: seconds per rotation against bare FFTW transforms of the same grid,
// and where they go.
//
//   search_bench [--threads N] [--rotations N] [--spacing S] [--radius R] [--offset O]... [--lift
//   4d]
//                [FIXED MOVING]...
//
// Radius 0: each atom's own. Without files: the sample pairs of molecules/.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <string>
#include <vector>

#include "mortise/core/threads.hpp"
#include "mortise/fourier/aligned.hpp"
#include "mortise/fourier/fft_plan.hpp"
#include "mortise/molecules/read_molecule.hpp"
#include "mortise/molecules/to_knots.hpp"
#include "mortise/rotations/rotation_set.hpp"
#include "mortise/runs/dock.hpp"
#include "search/components.hpp"
#include "search/correlator.hpp"

namespace mortise {
namespace {

double seconds_of(clockid_t clock) {
  timespec t{};
  clock_gettime(clock, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

// Least time of one r2c and one c2r of the whole grid, one thread.
double bare_seconds(const std::array<int, 3>& grid, PlanRigor rigor) {
  const auto [nx, ny, nz] = grid;
  const std::ptrdiff_t nc = nz / 2 + 1;
  const auto forward = FftPlan<float>::real_to_complex(
      {{{nx, std::ptrdiff_t{ny} * nz, ny * nc}, {ny, nz, nc}, {nz, 1, 1}}, {}}, false, rigor);
  const auto backward = FftPlan<float>::complex_to_real(
      {{{nx, ny * nc, std::ptrdiff_t{ny} * nz}, {ny, nc, nz}, {nz, 1, 1}}, {}}, false, rigor);
  AlignedVector<float> real(static_cast<std::size_t>(nx) * ny * nz, 0.0F);
  AlignedVector<std::complex<float>> half(static_cast<std::size_t>(nx) * ny * nc);
  double best = 1e9;
  for (int i = 0; i < 300; ++i) {
    const double start = seconds_of(CLOCK_THREAD_CPUTIME_ID);
    forward.run(real.data(), half.data());
    backward.run(half.data(), real.data());
    best = std::min(best, seconds_of(CLOCK_THREAD_CPUTIME_ID) - start);
  }
  return best;
}

struct Stages {
  double rotate = 0, spread = 0, forward_zy = 0, multiply = 0, backward_yz = 0, peaks = 0;
};

// Mean seconds per rotation of each step, one thread, as RotationSearch runs them.
Stages stages_of(const std::vector<Channel>& channels, RotationSearch& search,
                 const RotationSet& rotations, const SearchOptions& o, int count) {
  Components components =
      make_components(channels, search.search_from_fixed(), search.grid_size(), o.spacing,
                      {.radius_tolerance = o.radius_tolerance,
                       .low_pass = {.cutoff = o.cutoff},
                       .offsets = o.offsets,
                       .threads = 1});
  components.points = search.search_from_moving() * components.points;
  const auto parts = static_cast<int>(components.parts.size()),
             offsets = static_cast<int>(o.offsets.size());
  Correlator correlator(search.grid_size(), o.spacing,
                        components.points.colwise().norm().maxCoeff() + 1e-6, parts, o.spread_width,
                        offsets);
  const auto [nx, ny, nz] = search.grid_size();
  std::vector<Eigen::VectorXf> weights;
  for (int p = 0; p < parts; ++p) {
    weights.push_back(components.parts[p].weights);
    for (int n = 0; n < offsets; ++n)
      correlator.set_fixed(p, n, [&, nx = nx, ny = ny, nz = nz](int kx, int ky, int kz) {
        const std::size_t at =
            (static_cast<std::size_t>(kx + nx / 2) * ny + (ky + ny / 2)) * (nz / 2 + 1) + kz;
        return components.parts[p].spectra[n][at];
      });
  }
  Correlator::Workspace w(correlator);
  Stages sum;
  for (int i = -count / 10; i < count; ++i) {  // the first few warm up
    if (i == 0) sum = {};
    const Eigen::Matrix3d turn =
        rotations.rotation((i + rotations.size()) % rotations.size()).toRotationMatrix();
    double last = seconds_of(CLOCK_THREAD_CPUTIME_ID);
    const auto lap = [&](double& stage) {
      const double now = seconds_of(CLOCK_THREAD_CPUTIME_ID);
      stage += (now - last) / count;
      last = now;
    };
    correlator.rotate(components.points, turn, w);
    lap(sum.rotate);
    for (int p = 0; p < parts; ++p) {
      correlator.spread(weights[p], w);
      lap(sum.spread);
      correlator.forward_zy(p, w);
      lap(sum.forward_zy);
    }
    correlator.multiply(w);
    lap(sum.multiply);
    for (int n = 0; n < offsets; ++n) {
      correlator.backward_yz(n, w);
      lap(sum.backward_yz);
      (void)w.box.take_peaks(o.per_rotation, o.separation / o.spacing);
      lap(sum.peaks);
    }
  }
  return sum;
}

void measure(const std::string& fixed_path, const std::string& moving_path, int count,
             double radius, const SearchOptions& options) {
  const auto knots = [&](const std::string& path) {
    return to_knots(read_molecule(parse_molecule_spec(path)).molecule, {.radius = radius});
  };
  const Knots fixed = knots(fixed_path), moving = knots(moving_path);
  const std::vector<Channel> channels = {double_skin_channel(fixed, moving)};
  const RotationSet rotations = rotation_set(count);
  RotationSearch search(channels, rotations.quaternions, options);
  const auto [nx, ny, nz] = search.grid_size();
  std::printf("%s %s\n  %td and %td knots, grid %d x %d x %d of %.1f\n", fixed_path.c_str(),
              moving_path.c_str(), fixed.size(), moving.size(), nx, ny, nz, options.spacing);
  const double measured = bare_seconds(search.grid_size(), PlanRigor::kMeasure);
  const double patient = bare_seconds(search.grid_size(), PlanRigor::kPatient);
  std::printf("  bare FFTW, one r2c + one c2r: %.1f us MEASURE, %.1f us PATIENT\n", 1e6 * measured,
              1e6 * patient);
  if (options.lift == SearchLift::kCompressed) {
    const Stages s = stages_of(channels, search, rotations, options, count);
    const double total = s.rotate + s.spread + s.forward_zy + s.multiply + s.backward_yz + s.peaks;
    const auto line = [&](const char* name, double seconds) {
      std::printf("    %-24s %8.1f us %5.1f%%\n", name, 1e6 * seconds, 100.0 * seconds / total);
    };
    line("rotate", s.rotate);
    line("spread", s.spread);
    line("forward z, y", s.forward_zy);
    line("x, multiply, x", s.multiply);
    line("backward y, z, row maxima", s.backward_yz);
    line("peaks", s.peaks);
  }
  const double cpu = seconds_of(CLOCK_PROCESS_CPUTIME_ID);
  const double wall = seconds_of(CLOCK_MONOTONIC);
  search.run();
  const double used = (seconds_of(CLOCK_PROCESS_CPUTIME_ID) - cpu) / count;
  const int threads = resolve_threads(options.threads);
  const double held = (seconds_of(CLOCK_MONOTONIC) - wall) * threads / count;
  std::printf(
      "  %d rotations, %d threads: wall x threads %.1f us per rotation, CPU %.1f us\n"
      "  ratio to bare FFTW: wall %.2f MEASURE, %.2f PATIENT; CPU %.2f MEASURE, %.2f PATIENT\n",
      count, threads, 1e6 * held, 1e6 * used, held / measured, held / patient, used / measured,
      used / patient);
}

int run(int argc, char** argv) {
  const DockOptions defaults;
  SearchOptions options = defaults.search;
  int count = 3600;
  double radius = defaults.radius;
  std::vector<double> offsets;
  std::vector<std::string> files;
  for (int i = 1; i < argc; ++i) {
    const std::string arg = argv[i];
    const bool last = i + 1 == argc;
    if (arg == "--threads" && !last)
      options.threads = std::atoi(argv[++i]);
    else if (arg == "--rotations" && !last)
      count = std::atoi(argv[++i]);
    else if (arg == "--radius" && !last)
      radius = std::atof(argv[++i]);
    else if (arg == "--offset" && !last)
      offsets.push_back(std::atof(argv[++i]));
    else if (arg == "--lift" && !last)
      options.lift = argv[++i] == std::string("4d") ? SearchLift::k4d : SearchLift::kCompressed;
    else if (arg == "--spacing" && !last)
      options.spacing = std::atof(argv[++i]);
    else
      files.push_back(arg);
  }
  if (!offsets.empty()) options.offsets = offsets;
  if (files.empty()) {
    const std::string here = std::string(MORTISE_SOURCE_DIR) + "/molecules/";
    files = {here + "1hpv_receptor.pdb", here + "1hpv_ligand.pdb", here + "1tii_receptor.pdb.gz",
             here + "1tii_ligand.pdb.gz"};
  }
  if (files.size() % 2 != 0) {
    std::fprintf(stderr, "search_bench: expected pairs of files\n");
    return 1;
  }
  for (std::size_t i = 0; i < files.size(); i += 2)
    measure(files[i], files[i + 1], count, radius, options);
  return 0;
}

}  // namespace
}  // namespace mortise

int main(int argc, char** argv) {
  try {
    return mortise::run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "search_bench: error: %s\n", error.what());
    return 1;
  }
}
