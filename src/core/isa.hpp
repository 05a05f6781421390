// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Which of the copies made by mortise_add_isa_sources (cmake/MortiseIsa.cmake) this processor
/// should run.
#pragma once

namespace mortise {

enum class IsaLevel { kBaseline, kAvx2, kAvx512 };

/// The best level this processor and system can run. The environment variable MORTISE_ISA
/// (baseline, avx2, avx512) lowers it, for tests and timings; asking for more than there is changes
/// nothing. Read once per process.
[[nodiscard]] IsaLevel best_isa() noexcept;

/// The copy for `level` of a table of function pointers.
template <class Table>
[[nodiscard]] const Table& pick_isa(IsaLevel level, const Table& baseline, const Table& avx2,
                                    const Table& avx512) noexcept {
  return level == IsaLevel::kAvx512 ? avx512 : level == IsaLevel::kAvx2 ? avx2 : baseline;
}

}  // namespace mortise
