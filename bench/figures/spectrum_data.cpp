// SPDX-License-Identifier: GPL-3.0-or-later
// Data of the figure that compares two ways to the spectrum of a union of balls [SD, Fig. 8]:
// rasterise the bumps on a uniform grid and take a 3D FFT, or sum over the 4D knots. CSV on stdout.
//
//   spectrum_data GRID=knots.h5...      the knots of one body decomposed on GRID nodes per axis
//
// One thread; each time is the least of three.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "mortise/core/errors.hpp"
#include "mortise/fourier/aligned.hpp"
#include "mortise/fourier/fft_plan.hpp"
#include "mortise/fourier/lifted_spectrum.hpp"
#include "mortise/kernels/bump.hpp"
#include "mortise/store/knots_file.hpp"

namespace mortise {
namespace {

constexpr double kAlpha = 2.0;

template <class F>
double least_seconds(const F& f) {
  double best = 1e30;
  for (int i = 0; i < 3; ++i) {
    const auto start = std::chrono::steady_clock::now();
    f();
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
    best = std::min(best, took.count());
    if (took.count() > 5.0) break;
  }
  return best;
}

double box_side(const Knots& knots) {
  const Eigen::RowVectorXd radii = knots.points.row(3);
  const Eigen::Vector3d low = (knots.points.topRows<3>().rowwise() - radii).rowwise().minCoeff();
  const Eigen::Vector3d high = (knots.points.topRows<3>().rowwise() + radii).rowwise().maxCoeff();
  return 2.0 * (high - low).maxCoeff();  // room for an obstacle of two such bodies
}

// Sum of bumps at the nodes of an n^3 grid; a table of the bump stands in for its exponential.
void rasterise(const Knots& knots, double side, int n, AlignedVector<float>& grid) {
  constexpr int kTable = 1024;
  static const std::vector<float> table = [] {
    std::vector<float> t(kTable + 2, 0.0F);
    for (int i = 0; i <= kTable; ++i)
      t[static_cast<std::size_t>(i)] =
          static_cast<float>(bump(std::sqrt(static_cast<double>(i) / kTable), kAlpha));
    return t;
  }();
  std::fill(grid.begin(), grid.end(), 0.0F);
  const double h = side / n;
  const Eigen::Vector3d low = knots.points.topRows<3>().rowwise().minCoeff();
  for (Eigen::Index i = 0; i < knots.size(); ++i) {
    const Eigen::Vector3d c =
        (knots.points.col(i).head<3>() - low) / h + Eigen::Vector3d::Constant(0.25 * n);
    const double r = knots.points(3, i) / h;
    const auto from = [&](int d) { return std::max(0, static_cast<int>(std::ceil(c[d] - r))); };
    const auto to = [&](int d) { return std::min(n - 1, static_cast<int>(std::floor(c[d] + r))); };
    for (int x = from(0); x <= to(0); ++x)
      for (int y = from(1); y <= to(1); ++y) {
        const double rest = (x - c[0]) * (x - c[0]) + (y - c[1]) * (y - c[1]);
        float* row = &grid[(static_cast<std::size_t>(x) * n + y) * n];
        for (int z = from(2); z <= to(2); ++z) {
          const double u = (rest + (z - c[2]) * (z - c[2])) / (r * r);
          if (u < 1.0) row[z] += table[static_cast<std::size_t>(u * kTable)];
        }
      }
  }
}

void compare(int n, const Knots& knots) {
  const double side = box_side(knots);
  const auto cells = static_cast<std::size_t>(n) * n * n;
  AlignedVector<float> grid(cells);
  AlignedVector<std::complex<float>> half(static_cast<std::size_t>(n) * n * (n / 2 + 1));
  const std::ptrdiff_t nc = n / 2 + 1;
  const auto plan = FftPlan<float>::real_to_complex(
      {{{n, std::ptrdiff_t{n} * n, n * nc}, {n, n, nc}, {n, 1, 1}}, {}}, false,
      PlanRigor::kMeasure);
  const double raster = least_seconds([&] { rasterise(knots, side, n, grid); });
  const double fft = least_seconds([&] { plan.run(grid.data(), half.data()); });
  const RadialKernel kernel(kAlpha);
  for (int modes = 4; modes <= n; modes *= 2) {
    const auto seconds = [&](LiftedForm form) {
      LiftedOptions options;
      options.form = form;
      options.threads = 1;
      options.tolerance = 1e-3;
      return least_seconds([&] {
        (void)lifted_spectrum(knots, kernel, {modes, modes, modes}, {side, side, side}, options);
      });
    };
    const double terms = static_cast<double>(knots.size()) * std::pow(modes, 3.0);
    const double direct = terms < 3e8 ? seconds(LiftedForm::kDirect4d) : -1.0;
    std::printf("%d,%td,%d,%.6f,%.6f,%.6f,%.6f,%.6f\n", n, knots.size(), modes, raster, fft, direct,
                seconds(LiftedForm::kNfft4d), seconds(LiftedForm::kCompressed));
    std::fflush(stdout);
  }
}

}  // namespace
}  // namespace mortise

int main(int argc, char** argv) {
  try {
    if (argc < 2) throw mortise::InputError("usage: spectrum_data GRID=knots.h5...");
    std::printf("grid,knots,modes,raster,fft,ndft4d,nfft4d,compressed\n");
    for (int i = 1; i < argc; ++i) {
      const std::string item = argv[i];
      const auto sign = item.find('=');
      if (sign == std::string::npos) throw mortise::InputError("expected GRID=FILE, found " + item);
      mortise::compare(std::stoi(item.substr(0, sign)),
                       mortise::read_knots_file(item.substr(sign + 1)).knots);
    }
  } catch (const std::exception& e) {
    std::fprintf(stderr, "spectrum_data: error: %s\n", e.what());
    return 1;
  }
  return 0;
}
