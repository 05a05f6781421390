// SPDX-License-Identifier: GPL-3.0-or-later
// Asks the processor what it can run.
#include "core/isa.hpp"

#include <algorithm>
#include <cstdlib>
#include <string_view>

namespace mortise {
namespace {

IsaLevel detect() noexcept {
  IsaLevel level = IsaLevel::kBaseline;
#if defined(__x86_64__)
  __builtin_cpu_init();
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) {
    level = IsaLevel::kAvx2;
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
        __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("avx512dq") &&
        __builtin_cpu_supports("avx512vl"))
      level = IsaLevel::kAvx512;
  }
#endif
  if (const char* wish = std::getenv("MORTISE_ISA")) {
    const std::string_view name = wish;
    if (name == "baseline") level = IsaLevel::kBaseline;
    if (name == "avx2") level = std::min(level, IsaLevel::kAvx2);
  }
  return level;
}

}  // namespace

IsaLevel best_isa() noexcept {
  static const IsaLevel level = detect();
  return level;
}

}  // namespace mortise
