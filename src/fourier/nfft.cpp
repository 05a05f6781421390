// SPDX-License-Identifier: GPL-3.0-or-later
// NFFT of type 1: spread, transform axis by axis keeping only the columns that lead to modes,
// correct.
#include "mortise/fourier/nfft.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <type_traits>

#include "mortise/core/errors.hpp"
#include "mortise/core/threads.hpp"

namespace mortise {
namespace {

template <int D, class Real>
void check(const std::array<int, D>& modes, const NfftOptions& options) {
  for (const int n : modes)
    if (n < 1) throw InputError("Nfft: mode counts must be >= 1, got " + std::to_string(n));
  const double finest = std::is_same_v<Real, float> ? 1e-6 : 1e-12;
  if (!(options.tolerance >= 0.999 * finest && options.tolerance <= 0.1))
    throw InputError("Nfft: tolerance must be in [" +
                     std::string(std::is_same_v<Real, float> ? "1e-6" : "1e-12") +
                     ", 0.1] in this precision, got " + std::to_string(options.tolerance));
  if (options.upsampling != 0.0 && !(options.upsampling >= 1.1 && options.upsampling <= 4.0))
    throw InputError("Nfft: upsampling must be 0 or in [1.1, 4], got " +
                     std::to_string(options.upsampling));
  if (options.expected_points < 0)
    throw InputError("Nfft: expected_points must be >= 0, got " +
                     std::to_string(options.expected_points));
}

struct Choice {
  SpreadKernel kernel;
  double cost =
      std::numeric_limits<double>::infinity();  // of one transform, nanoseconds on a 2020s core
};

// Fine grid and kernel for one upsampling; the grid is rounded up to sizes that transform fast.
template <int D, class Real>
Choice choose(const std::array<int, D>& modes, const NfftOptions& options, double upsampling,
              std::array<int, D>& size) {
  double all_modes = 1.0, cells = 1.0;
  for (int d = 0; d < D; ++d) {
    size[d] = good_fft_size(static_cast<int>(std::ceil(upsampling * modes[d])));
    all_modes *= modes[d];
  }
  // The kernel must fit into the grid, and on small grids its width is not known before the grid:
  // once more if need be.
  Choice choice;
  for (bool fits = false; !fits;) {
    choice.kernel =
        design_spread_kernel(options.tolerance, modes, size, std::numeric_limits<Real>::epsilon());
    fits = true;
    for (int d = 0; d < D; ++d)
      if (size[d] < choice.kernel.width) size[d] = good_fft_size(choice.kernel.width), fits = false;
  }
  for (const int n : size) cells *= n;
  double updates = 1.0;
  for (int d = 0; d < D; ++d) updates *= choice.kernel.width;
  const double points =
      options.expected_points > 0 ? static_cast<double>(options.expected_points) : 0.25 * all_modes;
  const double scale = (std::is_same_v<Real, float> ? 1.0 : 2.0) *
                       (options.weights == WeightKind::kComplex ? 2.0 : 1.0);
  choice.cost = scale * (points * (10.0 + 0.08 * updates) + cells * 0.08 * std::log2(cells));
  return choice;
}

template <int D, class Real>
Spreader<D, Real> make_spreader(const std::array<int, D>& modes, const std::array<double, D>& box,
                                const NfftOptions& options) {
  check<D, Real>(modes, options);
  std::array<int, D> size{}, best_size{};
  Choice best;
  if (options.upsampling != 0.0) {
    best = choose<D, Real>(modes, options, options.upsampling, best_size);
  } else {
    // Generous first: where it cannot be had, nothing can, and its error message is the one to see.
    best = choose<D, Real>(modes, options, 2.0, best_size);
    for (const double upsampling : {1.5, 1.25}) {
      try {
        const Choice choice = choose<D, Real>(modes, options, upsampling, size);
        if (choice.cost < best.cost) best = choice, best_size = size;
      } catch (const InputError&) {  // out of reach of this upsampling
      }
    }
  }
  return Spreader<D, Real>(best_size, box, best.kernel, options.weights, options.threads);
}

int wrapped(int k, int n) { return k < 0 ? k + n : k; }

}  // namespace

template <int D, class Real>
Nfft<D, Real>::Nfft(const std::array<int, D>& modes, const std::array<double, D>& box,
                    const NfftOptions& options)
    : modes_(modes),
      shape_(modes),
      options_(options),
      spreader_(make_spreader<D, Real>(modes, box, options)) {
  const bool real = options.weights == WeightKind::kReal;
  if (real) shape_[D - 1] = modes[D - 1] / 2 + 1;
  const std::array<int, D>& size = spreader_.size();
  for (int d = 0; d < D; ++d) {
    const int lowest = real && d == D - 1 ? 0 : -(modes[d] / 2);
    for (int i = 0; i < shape_[d]; ++i) {
      const int k = lowest + i;
      if (d < D - 1) kept_[d].push_back(wrapped(k, size[d]));
      correction_[d].push_back(
          static_cast<Real>(1.0 / spreader_.kernel().transform(static_cast<double>(k) / size[d])));
    }
  }
  // Modes of the last axis: 0 .. and, for complex weights, the negative ones at the row's end.
  // Column plans start on 16-byte boundaries.
  const int n = modes[D - 1], last = size[D - 1], unit = 16 / static_cast<int>(2 * sizeof(Real));
  if (real) {
    ranges_ = {{0, n / 2 + 1}};
  } else {
    const int below = (last - n / 2) / unit * unit;
    if (n / 2 == 0)
      ranges_ = {{0, 1}};
    else if (below <= n - n / 2)
      ranges_ = {{0, last}};
    else
      ranges_ = {{0, n - n / 2}, {below, last - below}};
  }
  const auto in_complex = [&](int d) { return spreader_.stride(d) / 2; };
  const FftDim loop{size[D - 2], real ? spreader_.stride(D - 2) : in_complex(D - 2),
                    in_complex(D - 2)};
  const FftLayout layout{{FftDim{last, 1, 1}}, {loop}};
  rows_ = real ? FftPlan<Real>::real_to_complex(layout, true, options.rigor)
               : FftPlan<Real>::complex_to_complex(layout, true, true, options.rigor);
  for (int d = 0; d < D - 1; ++d)
    for (const Range& range : ranges_)
      columns_[d].push_back(FftPlan<Real>::complex_to_complex(
          {{FftDim{size[d], in_complex(d), in_complex(d)}}, {FftDim{range.count, 1, 1}}}, true,
          true, options.rigor));
  grid_.resize(spreader_.grid_size());
  std::size_t results = 1;
  for (const int s : shape_) results *= static_cast<std::size_t>(s);
  result_.resize(results);
}

// All axes but the first, for one index of the first.
template <int D, class Real>
void Nfft<D, Real>::transform_block(int index) {
  const std::array<int, D>& size = spreader_.size();
  Real* const block = grid_.data() + index * spreader_.stride(0);
  const auto at = [](Real* p) { return reinterpret_cast<Complex*>(p); };
  const int planes = D == 3 ? 1 : size[1];
  for (int p = 0; p < planes; ++p) {
    Real* const plane = block + (D == 3 ? 0 : p * spreader_.stride(1));
    spreader_.fold_rows(plane, size[D - 2]);
    if (options_.weights == WeightKind::kReal)
      rows_.run(plane, at(plane));
    else
      rows_.run(at(plane), at(plane));
    for (std::size_t r = 0; r < ranges_.size(); ++r)
      columns_[D - 2][r].run(at(plane) + ranges_[r].first, at(plane) + ranges_[r].first);
  }
  if constexpr (D == 4) {
    for (const int z : kept_[2]) {
      Complex* const column = at(block + z * spreader_.stride(2));
      for (std::size_t r = 0; r < ranges_.size(); ++r)
        columns_[1][r].run(column + ranges_[r].first, column + ranges_[r].first);
    }
  }
}

// The first axis for one mode of the axes between first and last, and what leaves it as modes.
template <int D, class Real>
void Nfft<D, Real>::transform_first_axis(std::size_t index) {
  const std::size_t inner = D == 3 ? 1 : kept_[2 % (D - 1)].size();
  const std::size_t y = index / inner, z = index % inner;
  Complex* column = reinterpret_cast<Complex*>(grid_.data() + kept_[1][y] * spreader_.stride(1));
  Real factor = correction_[1][y];
  if constexpr (D == 4) {
    column += kept_[2][z] * (spreader_.stride(2) / 2);
    factor *= correction_[2][z];
  }
  for (std::size_t r = 0; r < ranges_.size(); ++r)
    columns_[0][r].run(column + ranges_[r].first, column + ranges_[r].first);

  const int row = shape_[D - 1],
            below = options_.weights == WeightKind::kReal ? 0 : modes_[D - 1] / 2;
  const Real* const last_correction = correction_[D - 1].data();
  for (int x = 0; x < shape_[0]; ++x) {
    const Complex* const from = column + kept_[0][x] * (spreader_.stride(0) / 2);
    const std::size_t to_row = D == 3 ? static_cast<std::size_t>(x) * shape_[1] + y
                                      : (static_cast<std::size_t>(x) * shape_[1] + y) * inner + z;
    Complex* const to = result_.data() + to_row * row;
    const Real f = factor * correction_[0][x];
    const Complex* const tail = from + spreader_.size()[D - 1] - below;
    for (int k = 0; k < below; ++k) to[k] = tail[k] * (f * last_correction[k]);
    for (int k = below; k < row; ++k) to[k] = from[k - below] * (f * last_correction[k]);
  }
}

template <int D, class Real>
std::span<const std::complex<Real>> Nfft<D, Real>::run(const PointsRef<D>& points,
                                                       const Real* weights, std::ptrdiff_t count,
                                                       WeightKind kind) {
  spreader_.spread_unfolded(points, weights, count, kind, grid_.data());
  const auto block = [this](std::size_t i, int) { transform_block(static_cast<int>(i)); };
  parallel_for(static_cast<std::size_t>(spreader_.size()[0]), options_.threads, std::ref(block));
  const auto first_axis = [this](std::size_t i, int) { transform_first_axis(i); };
  parallel_for(kept_[1].size() * (D == 3 ? 1 : kept_[2 % (D - 1)].size()), options_.threads,
               std::ref(first_axis));
  return {result_.data(), result_.size()};
}

template <int D, class Real>
std::span<const std::complex<Real>> Nfft<D, Real>::transform(
    const PointsRef<D>& points, const Eigen::Ref<const Eigen::VectorX<Complex>>& weights) {
  return run(points, reinterpret_cast<const Real*>(weights.data()), weights.size(),
             WeightKind::kComplex);
}

template <int D, class Real>
std::span<const std::complex<Real>> Nfft<D, Real>::transform(
    const PointsRef<D>& points, const Eigen::Ref<const Eigen::VectorX<Real>>& weights) {
  return run(points, weights.data(), weights.size(), WeightKind::kReal);
}

template class Nfft<3, float>;
template class Nfft<3, double>;
template class Nfft<4, float>;
template class Nfft<4, double>;

namespace {

template <int D>
Eigen::VectorXcd one_shot(const Eigen::Matrix<double, D, Eigen::Dynamic>& points,
                          const Eigen::VectorXcd& weights, const std::array<int, D>& modes,
                          const std::array<double, D>& box, NfftOptions options) {
  options.weights = WeightKind::kComplex;
  if (options.expected_points == 0) options.expected_points = points.cols();
  Nfft<D, double> plan(modes, box, options);
  const auto result = plan.transform(points, weights);
  return Eigen::Map<const Eigen::VectorXcd>(result.data(),
                                            static_cast<Eigen::Index>(result.size()));
}

}  // namespace

Eigen::VectorXcd nfft(const Eigen::Matrix3Xd& points, const Eigen::VectorXcd& weights,
                      const std::array<int, 3>& modes, const std::array<double, 3>& box,
                      NfftOptions options) {
  return one_shot<3>(points, weights, modes, box, options);
}

Eigen::VectorXcd nfft(const Eigen::Matrix4Xd& points, const Eigen::VectorXcd& weights,
                      const std::array<int, 4>& modes, const std::array<double, 4>& box,
                      NfftOptions options) {
  return one_shot<4>(points, weights, modes, box, options);
}

}  // namespace mortise
