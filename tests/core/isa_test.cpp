// SPDX-License-Identifier: GPL-3.0-or-later
// That MORTISE_ISA lowers the instruction set, and never raises it above the processor's.
#include "core/isa.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <string>

namespace {

using mortise::IsaLevel;

IsaLevel of_the_processor() {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
    return __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl")
               ? IsaLevel::kAvx512
               : IsaLevel::kAvx2;
#endif
  return IsaLevel::kBaseline;
}

TEST(Isa, IsWhatTheEnvironmentAsksForAndTheProcessorHas) {
  const char* wish = std::getenv("MORTISE_ISA");
  const std::string name = wish != nullptr ? wish : "avx512";
  const IsaLevel asked = name == "baseline" ? IsaLevel::kBaseline
                         : name == "avx2"   ? IsaLevel::kAvx2
                                            : IsaLevel::kAvx512;
  EXPECT_EQ(mortise::best_isa(), std::min(asked, of_the_processor()));
}

TEST(Isa, PicksTheTableOfTheLevel) {
  const int baseline = 0, avx2 = 1, avx512 = 2;
  EXPECT_EQ(&mortise::pick_isa(IsaLevel::kBaseline, baseline, avx2, avx512), &baseline);
  EXPECT_EQ(&mortise::pick_isa(IsaLevel::kAvx2, baseline, avx2, avx512), &avx2);
  EXPECT_EQ(&mortise::pick_isa(IsaLevel::kAvx512, baseline, avx2, avx512), &avx512);
}

}  // namespace
