// SPDX-License-Identifier: GPL-3.0-or-later
// Radices and twiddle factors of LaneFft.
#include "fourier/lane_fft.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "core/isa.hpp"
#include "mortise/core/errors.hpp"

namespace mortise {
namespace isa_baseline {
extern const LaneFftTable kLaneFftTable;
}
namespace isa_avx2 {
extern const LaneFftTable kLaneFftTable;
}
namespace isa_avx512 {
extern const LaneFftTable kLaneFftTable;
}

namespace {

constexpr int kRadices[] = {16, 15, 14, 12, 10, 9, 8, 7, 6, 5, 4, 3, 2};

// The fewest passes, and of these the ones whose largest radix is the smallest; larger ones first.
void choose(int n, std::vector<int>& chosen, std::vector<int>& best) {
  if (n == 1) {
    if (best.empty() || chosen.size() < best.size() ||
        (chosen.size() == best.size() && chosen.front() < best.front()))
      best = chosen;
    return;
  }
  if (!best.empty() && chosen.size() >= best.size()) return;
  for (const int radix : kRadices) {
    if (n % radix != 0 || (!chosen.empty() && radix > chosen.back())) continue;
    chosen.push_back(radix);
    choose(n / radix, chosen, best);
    chosen.pop_back();
  }
}

}  // namespace

LaneFft::LaneFft(int n) : n_(n) {
  std::vector<int> chosen;
  if (n > 1) choose(n, chosen, radices_);
  if (radices_.empty() || radices_.size() > LaneFftPasses::kMost)
    throw InputError("LaneFft: expected a size >= 2 without prime factors above 7, got " +
                     std::to_string(n));
  for (int forward = 0; forward < 2; ++forward) {
    int left = n;
    for (const int radix : radices_) {
      std::vector<float>& factors = twiddles_[forward].emplace_back();
      for (int p = 0; p < left / radix && left > radix; ++p)
        for (int u = 1; u < radix; ++u) {
          const double angle = (forward != 0 ? -2.0 : 2.0) * std::numbers::pi * p * u / left;
          const auto re = static_cast<float>(std::cos(angle)),
                     im = static_cast<float>(std::sin(angle));
          factors.insert(factors.end(), {re, re, -im, im});
        }
      left /= radix;
    }
  }
  table_ = &pick_isa(best_isa(), isa_baseline::kLaneFftTable, isa_avx2::kLaneFftTable,
                     isa_avx512::kLaneFftTable);
}

LaneFftPasses LaneFft::passes(bool forward) const {
  LaneFftPasses result;
  result.n = n_;
  result.count = static_cast<int>(radices_.size());
  for (std::size_t i = 0; i < radices_.size(); ++i) {
    result.radix[i] = radices_[i];
    result.twiddles[i] = twiddles_[forward ? 1 : 0][i].data();
  }
  return result;
}

void LaneFft::run(bool forward, const std::complex<float>* in, std::ptrdiff_t in_stride,
                  std::ptrdiff_t in_count, std::complex<float>* out, std::ptrdiff_t out_stride,
                  std::ptrdiff_t columns, Work& work) const {
  table_->run(passes(forward), forward, reinterpret_cast<const float*>(in), 2 * in_stride, in_count,
              reinterpret_cast<float*>(out), 2 * out_stride, columns, work.data());
}

void LaneFft::forward_rows(const float* in, std::ptrdiff_t in_stride, std::ptrdiff_t rows,
                           std::complex<float>* out, std::ptrdiff_t out_stride, Work& work) const {
  table_->forward_rows(passes(true), in, in_stride, rows, reinterpret_cast<float*>(out),
                       2 * out_stride, work.data());
}

void LaneFft::backward_rows(const std::complex<float>* in, std::ptrdiff_t in_stride,
                            std::ptrdiff_t rows, float* out, std::ptrdiff_t out_stride,
                            Work& work) const {
  table_->backward_rows(passes(false), reinterpret_cast<const float*>(in), 2 * in_stride, rows, out,
                        out_stride, work.data());
}

}  // namespace mortise
