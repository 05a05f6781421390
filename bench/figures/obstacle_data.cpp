// SPDX-License-Identifier: GPL-3.0-or-later
// Data of the obstacle figures: Hausdorff error of truncated obstacles against the number of modes
// [FC, Fig. 3] and an SE(2) obstacle [FC, Fig. 6]. CSV on stdout.
//
//   obstacle_data hausdorff2d | hausdorff3d | se2
//
// Ground truth are rasters: a body is a set of cells, its obstacle the cells where the correlation
// of two such sets is at least one cell. So bounds are compared for these bodies, not for the
// smooth ones they were drawn from, and a distance is uncertain by one cell.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "mortise/collision/cutoff.hpp"
#include "mortise/fourier/aligned.hpp"
#include "mortise/fourier/fft_plan.hpp"

namespace mortise {
namespace {

using Point = std::array<double, 3>;
using Inside = std::function<bool(const Point&)>;

struct Shape {
  const char* name;
  Inside inside;  // within |x| < 1/8 per axis; the period is 1
};

double length(double x, double y, double z = 0.0) { return std::sqrt(x * x + y * y + z * z); }

bool in_box(const Point& p, double x0, double x1, double y0, double y1) {
  return p[0] >= x0 && p[0] <= x1 && p[1] >= y0 && p[1] <= y1;
}

std::vector<Shape> shapes_2d() {
  return {
      {"bracket",
       [](const Point& p) {
         return in_box(p, -.11, .11, -.11, -.05) || in_box(p, -.11, -.05, -.11, .11);
       }},
      {"star",
       [](const Point& p) {
         const double a = std::atan2(p[1], p[0]);
         return length(p[0], p[1]) < 0.075 + 0.04 * std::cos(5.0 * a);
       }},
      {"gear",
       [](const Point& p) {
         const double r = length(p[0], p[1]);
         const bool tooth = std::cos(9.0 * std::atan2(p[1], p[0])) > 0.0;
         return r > 0.03 && r < (tooth ? 0.115 : 0.09);
       }},
      {"channel",
       [](const Point& p) {
         return in_box(p, -.1, .1, -.1, .1) && !in_box(p, -.05, .2, -.03, .03);
       }},
  };
}

std::vector<Shape> shapes_3d() {
  return {
      {"ball", [](const Point& p) { return length(p[0], p[1], p[2]) < 0.1; }},
      {"torus", [](const Point& p) { return length(length(p[0], p[1]) - 0.08, p[2]) < 0.035; }},
      {"cross",
       [](const Point& p) {
         int thin = 0;
         for (const double x : p) thin += std::abs(x) < 0.03 ? 1 : 0;
         return thin >= 2 && std::max({std::abs(p[0]), std::abs(p[1]), std::abs(p[2])}) < 0.11;
       }},
      {"bracket",
       [](const Point& p) {
         return std::abs(p[2]) < 0.06 &&
                (in_box(p, -.1, .1, -.1, -.05) || in_box(p, -.1, -.05, -.1, .1));
       }},
  };
}

// A periodic raster of n cells per axis, first axis slowest.
class Raster {
 public:
  Raster(int dimension, int n) : dimension_(dimension), n_(n) {
    cells_ = 1;
    for (int d = 0; d < dimension; ++d) cells_ *= static_cast<std::size_t>(n);
    modes_ = cells_ / static_cast<std::size_t>(n) * static_cast<std::size_t>(n / 2 + 1);
    const FftLayout layout =
        contiguous_layout(std::vector<int>(static_cast<std::size_t>(dimension), n));
    FftLayout forward = layout;
    FftLayout backward = layout;
    std::ptrdiff_t half_stride = 1;
    std::ptrdiff_t stride = 1;
    for (int d = dimension - 1; d >= 0; --d) {
      auto& f = forward.transform[static_cast<std::size_t>(d)];
      auto& b = backward.transform[static_cast<std::size_t>(d)];
      f = {n, stride, half_stride};
      b = {n, half_stride, stride};
      stride *= n;
      half_stride *= d == dimension - 1 ? n / 2 + 1 : n;
    }
    forward_ = FftPlan<double>::real_to_complex(forward, false);
    backward_ = FftPlan<double>::complex_to_real(backward, false);
  }

  [[nodiscard]] std::size_t cells() const { return cells_; }
  [[nodiscard]] double cell_volume() const { return 1.0 / static_cast<double>(cells_); }

  [[nodiscard]] std::array<int, 3> index(std::size_t cell) const {
    std::array<int, 3> result = {};
    for (int d = dimension_ - 1; d >= 0; --d) {
      result[static_cast<std::size_t>(d)] = static_cast<int>(cell % static_cast<std::size_t>(n_));
      cell /= static_cast<std::size_t>(n_);
    }
    return result;
  }

  [[nodiscard]] AlignedVector<double> fill(const Inside& inside) const {
    AlignedVector<double> result(cells_);
    for (std::size_t i = 0; i < cells_; ++i) {
      const auto at = index(i);
      Point p = {};
      for (int d = 0; d < dimension_; ++d) {
        const auto a = static_cast<std::size_t>(d);
        p[a] = static_cast<double>(at[a] < n_ / 2 ? at[a] : at[a] - n_) / n_;
      }
      result[i] = inside(p) ? 1.0 : 0.0;
    }
    return result;
  }

  // Chebyshev distance in cells to the nearest set cell: rounds of 3^d neighbours, a line at a
  // time.
  [[nodiscard]] std::vector<int> distance(const AlignedVector<double>& set, int most) const {
    std::vector<int> result(cells_, most + 1);
    AlignedVector<double> grown = set;
    for (int step = 0; step <= most; ++step) {
      bool any = false;
      for (std::size_t i = 0; i < cells_; ++i)
        if (grown[i] != 0.0 && result[i] > step) {
          result[i] = step;
          any = true;
        }
      if (!any && step > 0) break;
      grown = dilate(grown, 1);
    }
    return result;
  }

  // Dilation by a cube of half edge `reach` cells: a running count along each axis.
  [[nodiscard]] AlignedVector<double> dilate(const AlignedVector<double>& set, int reach) const {
    AlignedVector<double> result = set;
    std::vector<double> line(static_cast<std::size_t>(n_));
    std::size_t stride = 1;
    for (int d = 0; d < dimension_; ++d, stride *= static_cast<std::size_t>(n_))
      for (std::size_t start = 0; start < cells_; ++start) {
        if (start / stride % static_cast<std::size_t>(n_) != 0) continue;
        for (int i = 0; i < n_; ++i)
          line[static_cast<std::size_t>(i)] = result[start + static_cast<std::size_t>(i) * stride];
        double count = 0.0;
        for (int i = -reach; i <= reach; ++i)
          count += line[static_cast<std::size_t>((i + n_) % n_)];
        for (int i = 0; i < n_; ++i) {
          result[start + static_cast<std::size_t>(i) * stride] = count > 0.5 ? 1.0 : 0.0;
          count += line[static_cast<std::size_t>((i + reach + 1) % n_)] -
                   line[static_cast<std::size_t>((i - reach + n_) % n_)];
        }
      }
    return result;
  }

  [[nodiscard]] AlignedVector<std::complex<double>> spectrum(
      const AlignedVector<double>& field) const {
    AlignedVector<double> copy = field;
    AlignedVector<std::complex<double>> result(modes_);
    forward_.run(copy.data(), result.data());
    return result;
  }

  // Correlation a(x + t) b(x) for all t, filtered by the kernel on each axis (null: unfiltered).
  [[nodiscard]] AlignedVector<double> correlate(const AlignedVector<std::complex<double>>& a,
                                                const AlignedVector<std::complex<double>>& b,
                                                const InstrumentKernel* kernel) const {
    AlignedVector<std::complex<double>> product(modes_);
    const std::size_t last = static_cast<std::size_t>(n_ / 2 + 1);
    for (std::size_t i = 0; i < modes_; ++i) {
      double factor = 1.0;
      if (kernel != nullptr) {
        std::size_t rest = i;
        for (int d = dimension_ - 1; d >= 0; --d) {
          const std::size_t size = d == dimension_ - 1 ? last : static_cast<std::size_t>(n_);
          auto k = static_cast<Eigen::Index>(rest % size);
          rest /= size;
          k = std::min(k, n_ - k);
          factor *= k <= kernel->degree() ? kernel->coefficients[k] : 0.0;
        }
      }
      product[i] = factor == 0.0 ? 0.0 : factor * a[i] * std::conj(b[i]);
    }
    AlignedVector<double> result(cells_);
    backward_.run(product.data(), result.data());
    const double scale = cell_volume() * cell_volume();  // of the unnormalised FFT; cells to volume
    for (double& v : result) v *= scale;
    return result;
  }

 private:
  int dimension_, n_;
  std::size_t cells_ = 0, modes_ = 0;
  FftPlan<double> forward_, backward_;
};

double sum(const AlignedVector<double>& field) {
  double total = 0.0;
  for (const double v : field) total += v;
  return total;
}

// Largest distance from a cell of `from` to the set whose distances are given.
int left_hausdorff(const AlignedVector<double>& from, const std::vector<int>& distance) {
  int worst = 0;
  for (std::size_t i = 0; i < from.size(); ++i)
    if (from[i] != 0.0) worst = std::max(worst, distance[i]);
  return worst;
}

void hausdorff(int dimension, int n, const std::vector<Shape>& shapes,
               const std::vector<int>& degrees) {
  const Raster raster(dimension, n);
  std::printf(
      "dimension,fixed,moving,modes_per_axis,bound,measured,missed,fattening,stop_radius,"
      "threshold\n");
  for (std::size_t s = 0; s < shapes.size(); ++s)
    for (std::size_t t = s; t < shapes.size(); ++t) {
      const auto fixed = raster.fill(shapes[s].inside);
      const auto moving = raster.fill(shapes[t].inside);
      auto exact = raster.correlate(raster.spectrum(fixed), raster.spectrum(moving), nullptr);
      for (double& v : exact) v = v > 0.5 * raster.cell_volume() ? 1.0 : 0.0;
      const auto to_exact = raster.distance(exact, n / 2);
      for (const int degree : degrees) {
        // The overlap of the fattened bodies is needed for the bound and known after it: start from
        // the unfattened area with room, and take the bound again until it holds.
        CutoffOptions options{dimension, Fattening::kCube};
        const double smaller = std::min(sum(fixed), sum(moving)) * raster.cell_volume();
        options.largest_overlap = smaller;
        Instrument best;
        int reach = 0;
        AlignedVector<double> fat_fixed, fat_moving;
        bool possible = true;
        for (int round = 0; round < 12; ++round) {
          best = best_instrument(degree, 1.0, options);
          reach = static_cast<int>(std::ceil(best.cutoff.fattening * n));
          possible = best.cutoff.hausdorff_error < 0.25;
          if (!possible) break;
          fat_fixed = raster.dilate(fixed, reach);
          fat_moving = raster.dilate(moving, reach);
          const double overlap = std::min(sum(fat_fixed), sum(fat_moving)) * raster.cell_volume();
          if (overlap <= options.largest_overlap) break;
          options.largest_overlap = 1.02 * overlap;
        }
        if (!possible) continue;  // the period has no room for so large an error
        const auto gap =
            raster.correlate(raster.spectrum(fat_fixed), raster.spectrum(fat_moving), &best.kernel);
        AlignedVector<double> found(raster.cells());
        double missed = 0.0;
        for (std::size_t i = 0; i < found.size(); ++i) {
          found[i] = gap[i] >= best.cutoff.threshold ? 1.0 : 0.0;
          if (exact[i] != 0.0 && found[i] == 0.0) missed += 1.0;
        }
        std::printf("%d,%s,%s,%d,%.6f,%.6f,%.0f,%.6f,%.6f,%.6e\n", dimension, shapes[s].name,
                    shapes[t].name, 2 * degree, best.cutoff.hausdorff_error,
                    static_cast<double>(left_hausdorff(found, to_exact)) / n, missed,
                    best.cutoff.fattening, best.cutoff.stop_radius, best.cutoff.threshold);
        std::fflush(stdout);
      }
    }
}

// The obstacle of two planar bodies for every relative turn, 20 modes per axis as in the paper.
void se2() {
  constexpr int kCells = 256;
  constexpr int kAngles = 90;
  const Raster raster(2, kCells);
  const Shape fixed = shapes_2d()[3];
  const Shape moving = shapes_2d()[0];
  CutoffOptions options{2, Fattening::kBall};
  options.largest_overlap = 0.035;  // a body of edge 1/4 would have 0.0625; checked below
  const Instrument best = best_instrument(10, 1.0, options);
  const double x0 = best.cutoff.fattening;
  const int steps = 24;
  const auto fat = [&](const Inside& inside) {  // union over a disc of directions, 24 per ring
    return [=](const Point& p) {
      if (inside(p)) return true;
      for (const double r : {x0 / 3.0, 2.0 * x0 / 3.0, x0})
        for (int i = 0; i < steps; ++i) {
          const double a = 2.0 * std::numbers::pi * i / steps;
          if (inside({p[0] + r * std::cos(a), p[1] + r * std::sin(a), 0.0})) return true;
        }
      return false;
    };
  };
  const auto fixed_field = raster.fill(fat(fixed.inside));
  const auto fixed_spectrum = raster.spectrum(fixed_field);
  const auto fixed_bare = raster.spectrum(raster.fill(fixed.inside));
  std::printf("angle,x,y,gap,exact\n");
  std::printf("# threshold %.6e error %.6f\n", best.cutoff.threshold, best.cutoff.hausdorff_error);
  for (int a = 0; a < kAngles; ++a) {
    const double angle = 2.0 * std::numbers::pi * a / kAngles;
    const auto turned = [&](const Point& p) {
      return moving.inside({std::cos(angle) * p[0] + std::sin(angle) * p[1],
                            -std::sin(angle) * p[0] + std::cos(angle) * p[1], 0.0});
    };
    const auto field = raster.fill(fat(turned));
    if (std::min(sum(field), sum(fixed_field)) * raster.cell_volume() > options.largest_overlap)
      std::fprintf(stderr, "obstacle_data: largest_overlap is too small for the bound\n");
    const auto gap = raster.correlate(fixed_spectrum, raster.spectrum(field), &best.kernel);
    const auto exact = raster.correlate(fixed_bare, raster.spectrum(raster.fill(turned)), nullptr);
    for (std::size_t i = 0; i < raster.cells(); ++i) {
      const auto at = raster.index(i);
      if (at[0] % 4 != 0 || at[1] % 4 != 0) continue;
      const auto coordinate = [&](int k) {
        return static_cast<double>(k < kCells / 2 ? k : k - kCells) / kCells;
      };
      std::printf("%.5f,%.5f,%.5f,%.6e,%d\n", angle, coordinate(at[0]), coordinate(at[1]), gap[i],
                  exact[i] > 0.5 * raster.cell_volume() ? 1 : 0);
    }
  }
}

}  // namespace
}  // namespace mortise

int main(int argc, char** argv) {
  const std::string what = argc == 2 ? argv[1] : "";
  if (what == "hausdorff2d")
    mortise::hausdorff(2, 512, mortise::shapes_2d(), {6, 8, 12, 16, 24, 32, 48, 64, 96, 128});
  else if (what == "hausdorff3d")
    mortise::hausdorff(3, 96, mortise::shapes_3d(), {6, 8, 12, 16, 24, 32});
  else if (what == "se2")
    mortise::se2();
  else {
    std::fprintf(stderr, "usage: obstacle_data hausdorff2d | hausdorff3d | se2\n");
    return 1;
  }
  return 0;
}
