// SPDX-License-Identifier: GPL-3.0-or-later
// FftPlan on FFTW's guru interface.
#include "mortise/fourier/fft_plan.hpp"

#include <fftw3.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <mutex>
#include <string>
#include <type_traits>

#include "mortise/core/errors.hpp"
#include "mortise/fourier/aligned.hpp"

namespace mortise {
namespace {

// FFTW's planner, of both precisions, is not thread safe.
std::mutex& planner_mutex() {
  static std::mutex mutex;
  return mutex;
}

unsigned flags_of(PlanRigor rigor) {
  return rigor == PlanRigor::kEstimate  ? FFTW_ESTIMATE
         : rigor == PlanRigor::kMeasure ? FFTW_MEASURE
                                        : FFTW_PATIENT;
}

std::vector<fftw_iodim64> to_fftw(const std::vector<FftDim>& dims) {
  std::vector<fftw_iodim64> result;
  result.reserve(dims.size());
  for (const FftDim& d : dims) result.push_back({d.size, d.in_stride, d.out_stride});
  return result;
}

// Elements an array must have for `layout`; a halved last axis has size / 2 + 1.
std::size_t extent(const FftLayout& layout, bool input, bool halved) {
  std::ptrdiff_t last = 0;
  for (std::size_t i = 0; i < layout.transform.size(); ++i) {
    const FftDim& d = layout.transform[i];
    const bool half = halved && i + 1 == layout.transform.size();
    last += (half ? d.size / 2 : d.size - 1) * (input ? d.in_stride : d.out_stride);
  }
  for (const FftDim& d : layout.loops) last += (d.size - 1) * (input ? d.in_stride : d.out_stride);
  return static_cast<std::size_t>(last) + 1;
}

void check_layout(const FftLayout& layout) {
  if (layout.transform.empty())
    throw InputError("FftPlan: expected at least one axis to transform, got none");
  for (const auto* dims : {&layout.transform, &layout.loops})
    for (const FftDim& d : *dims)
      if (d.size < 1 || d.in_stride < 1 || d.out_stride < 1)
        throw InputError("FftPlan: sizes and strides must be >= 1, got size " +
                         std::to_string(d.size) + " with strides " + std::to_string(d.in_stride) +
                         " and " + std::to_string(d.out_stride));
}

}  // namespace

FftLayout contiguous_layout(const std::vector<int>& size) {
  FftLayout layout;
  std::ptrdiff_t stride = 1;
  layout.transform.resize(size.size());
  for (std::size_t d = size.size(); d-- > 0;) {
    layout.transform[d] = {size[d], stride, stride};
    stride *= size[d];
  }
  return layout;
}

template <class Real>
void FftPlan<Real>::Destroy::operator()(void* plan) const noexcept {
  const std::lock_guard lock(planner_mutex());
  if constexpr (std::is_same_v<Real, float>)
    fftwf_destroy_plan(static_cast<fftwf_plan>(plan));
  else
    fftw_destroy_plan(static_cast<fftw_plan>(plan));
}

template <class Real>
FftPlan<Real> FftPlan<Real>::complex_to_complex(const FftLayout& layout, bool forward,
                                                bool in_place, PlanRigor rigor) {
  check_layout(layout);
  const auto dims = to_fftw(layout.transform), loops = to_fftw(layout.loops);
  const int rank = static_cast<int>(dims.size()), count = static_cast<int>(loops.size());
  const int sign = forward ? FFTW_FORWARD : FFTW_BACKWARD;
  const std::size_t in_size = extent(layout, true, false), out_size = extent(layout, false, false);
  AlignedVector<std::complex<Real>> a(in_place ? std::max(in_size, out_size) : in_size);
  AlignedVector<std::complex<Real>> b(in_place ? 0 : out_size);
  auto* const in = reinterpret_cast<Real(*)[2]>(a.data());
  auto* const out = in_place ? in : reinterpret_cast<Real(*)[2]>(b.data());
  const std::lock_guard lock(planner_mutex());
  void* plan = nullptr;
  if constexpr (std::is_same_v<Real, float>)
    plan = fftwf_plan_guru64_dft(rank, dims.data(), count, loops.data(), in, out, sign,
                                 flags_of(rigor));
  else
    plan = fftw_plan_guru64_dft(rank, dims.data(), count, loops.data(), in, out, sign,
                                flags_of(rigor));
  if (!plan) throw InputError("FftPlan: this layout cannot be transformed");
  return FftPlan(plan, Kind::kComplex, in_place);
}

template <class Real>
FftPlan<Real> FftPlan<Real>::real_to_complex(const FftLayout& layout, bool in_place,
                                             PlanRigor rigor) {
  check_layout(layout);
  const auto dims = to_fftw(layout.transform), loops = to_fftw(layout.loops);
  const int rank = static_cast<int>(dims.size()), count = static_cast<int>(loops.size());
  const std::size_t in_size = extent(layout, true, false), out_size = extent(layout, false, true);
  AlignedVector<std::complex<Real>> b(in_place ? std::max(in_size / 2 + 1, out_size) : out_size);
  AlignedVector<Real> a(in_place ? 0 : in_size);
  auto* const out = reinterpret_cast<Real(*)[2]>(b.data());
  Real* const in = in_place ? reinterpret_cast<Real*>(b.data()) : a.data();
  const std::lock_guard lock(planner_mutex());
  void* plan = nullptr;
  if constexpr (std::is_same_v<Real, float>)
    plan =
        fftwf_plan_guru64_dft_r2c(rank, dims.data(), count, loops.data(), in, out, flags_of(rigor));
  else
    plan =
        fftw_plan_guru64_dft_r2c(rank, dims.data(), count, loops.data(), in, out, flags_of(rigor));
  if (!plan) throw InputError("FftPlan: this layout cannot be transformed");
  return FftPlan(plan, Kind::kRealToComplex, in_place);
}

template <class Real>
FftPlan<Real> FftPlan<Real>::complex_to_real(const FftLayout& layout, bool in_place,
                                             PlanRigor rigor) {
  check_layout(layout);
  const auto dims = to_fftw(layout.transform), loops = to_fftw(layout.loops);
  const int rank = static_cast<int>(dims.size()), count = static_cast<int>(loops.size());
  const std::size_t in_size = extent(layout, true, true), out_size = extent(layout, false, false);
  AlignedVector<std::complex<Real>> a(in_place ? std::max(in_size, out_size / 2 + 1) : in_size);
  AlignedVector<Real> b(in_place ? 0 : out_size);
  auto* const in = reinterpret_cast<Real(*)[2]>(a.data());
  Real* const out = in_place ? reinterpret_cast<Real*>(a.data()) : b.data();
  const std::lock_guard lock(planner_mutex());
  void* plan = nullptr;
  if constexpr (std::is_same_v<Real, float>)
    plan =
        fftwf_plan_guru64_dft_c2r(rank, dims.data(), count, loops.data(), in, out, flags_of(rigor));
  else
    plan =
        fftw_plan_guru64_dft_c2r(rank, dims.data(), count, loops.data(), in, out, flags_of(rigor));
  if (!plan) throw InputError("FftPlan: this layout cannot be transformed");
  return FftPlan(plan, Kind::kComplexToReal, in_place);
}

template <class Real>
void FftPlan<Real>::check(Kind kind, const void* in, const void* out) const {
  if (!plan_ || kind != kind_)
    throw InputError("FftPlan: the plan is empty or of another kind of transform");
  if ((in == out) != in_place_)
    throw InputError(std::string("FftPlan: the plan is ") + (in_place_ ? "" : "not ") +
                     "in place, the call is otherwise");
  if (reinterpret_cast<std::uintptr_t>(in) % 16 != 0 ||
      reinterpret_cast<std::uintptr_t>(out) % 16 != 0)
    throw InputError("FftPlan: arrays must be aligned to 16 bytes");
}

template <class Real>
void FftPlan<Real>::run(const std::complex<Real>* in, std::complex<Real>* out) const {
  check(Kind::kComplex, in, out);
  auto* const from = reinterpret_cast<Real(*)[2]>(const_cast<std::complex<Real>*>(in));
  auto* const to = reinterpret_cast<Real(*)[2]>(out);
  if constexpr (std::is_same_v<Real, float>)
    fftwf_execute_dft(static_cast<fftwf_plan>(plan_.get()), from, to);
  else
    fftw_execute_dft(static_cast<fftw_plan>(plan_.get()), from, to);
}

template <class Real>
void FftPlan<Real>::run(const Real* in, std::complex<Real>* out) const {
  check(Kind::kRealToComplex, in, out);
  auto* const to = reinterpret_cast<Real(*)[2]>(out);
  if constexpr (std::is_same_v<Real, float>)
    fftwf_execute_dft_r2c(static_cast<fftwf_plan>(plan_.get()), const_cast<Real*>(in), to);
  else
    fftw_execute_dft_r2c(static_cast<fftw_plan>(plan_.get()), const_cast<Real*>(in), to);
}

template <class Real>
void FftPlan<Real>::run(const std::complex<Real>* in, Real* out) const {
  check(Kind::kComplexToReal, in, out);
  auto* const from = reinterpret_cast<Real(*)[2]>(const_cast<std::complex<Real>*>(in));
  if constexpr (std::is_same_v<Real, float>)
    fftwf_execute_dft_c2r(static_cast<fftwf_plan>(plan_.get()), from, out);
  else
    fftw_execute_dft_c2r(static_cast<fftw_plan>(plan_.get()), from, out);
}

template class FftPlan<float>;
template class FftPlan<double>;

int good_fft_size(int n) {
  if (n > std::numeric_limits<int>::max() / 2)
    throw InputError("good_fft_size: expected at most 2^30, got " + std::to_string(n));
  for (int size = std::max(2, n + n % 2);; size += 2) {
    int rest = size;
    for (const int prime : {2, 3, 5, 7})
      while (rest % prime == 0) rest /= prime;
    if (rest == 1) return size;
  }
}

}  // namespace mortise
