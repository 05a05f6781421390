// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Fast Fourier transforms of regular grids: plans that are made once and run many times.
#pragma once

#include <complex>
#include <cstddef>
#include <memory>
#include <vector>

namespace mortise {

/// How long to look for a fast plan. `estimate` is immediate and always finds the same plan; the
/// others time candidates, so another process may find another plan, whose results differ in the
/// last bits.
enum class PlanRigor { kEstimate, kMeasure, kPatient };

/// One axis of a transform or of a loop around it: element i is at i * stride, counted in elements
/// of its array.
struct FftDim {
  int size = 1;
  std::ptrdiff_t in_stride = 1;
  std::ptrdiff_t out_stride = 1;
};

/// Axes to transform (the last one is halved by real transforms) and axes over which to repeat
/// that.
struct FftLayout {
  std::vector<FftDim> transform;
  std::vector<FftDim> loops;
};

/// The layout of one contiguous row-major array of `size`.
[[nodiscard]] FftLayout contiguous_layout(const std::vector<int>& size);

/// An unnormalised discrete Fourier transform, forward with exp(-2 pi i ...). Real is float or
/// double. Plans may be made and destroyed on any thread; run() may be called from many at once on
/// different arrays.
template <class Real>
class FftPlan {
 public:
  FftPlan() = default;  ///< empty: run() must not be called

  /// Complex to complex; `forward` false: the backward transform, exp(+2 pi i ...).
  [[nodiscard]] static FftPlan complex_to_complex(const FftLayout& layout, bool forward,
                                                  bool in_place,
                                                  PlanRigor rigor = PlanRigor::kEstimate);
  /// Real to half-complex, forward. In place, the rows of reals are padded to 2 (n / 2 + 1).
  [[nodiscard]] static FftPlan real_to_complex(const FftLayout& layout, bool in_place,
                                               PlanRigor rigor = PlanRigor::kEstimate);
  /// Half-complex to real, backward; in more than one dimension the input is destroyed.
  [[nodiscard]] static FftPlan complex_to_real(const FftLayout& layout, bool in_place,
                                               PlanRigor rigor = PlanRigor::kEstimate);

  /// Runs the plan. Arrays are aligned to 16 bytes and hold what the layout reaches; in == out iff
  /// the plan is in place.
  /// @throws InputError if the kind of transform, the alignment or in-placeness is another
  void run(const std::complex<Real>* in, std::complex<Real>* out) const;
  void run(const Real* in, std::complex<Real>* out) const;
  void run(const std::complex<Real>* in, Real* out) const;

  [[nodiscard]] explicit operator bool() const noexcept { return plan_ != nullptr; }

 private:
  enum class Kind { kComplex, kRealToComplex, kComplexToReal };
  struct Destroy {
    void operator()(void* plan) const noexcept;
  };
  FftPlan(void* plan, Kind kind, bool in_place) : plan_(plan), kind_(kind), in_place_(in_place) {}
  void check(Kind kind, const void* in, const void* out) const;

  std::unique_ptr<void, Destroy> plan_;
  Kind kind_ = Kind::kComplex;
  bool in_place_ = false;
};

extern template class FftPlan<float>;
extern template class FftPlan<double>;

/// The smallest even number >= n with no prime factor above 7: a grid size that transforms fast.
[[nodiscard]] int good_fft_size(int n);

}  // namespace mortise
