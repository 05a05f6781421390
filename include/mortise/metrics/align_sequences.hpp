// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Global alignment of two sequences of residue names.
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace mortise {

/// What an alignment is worth: the values DockQ 2 aligns chains with. A gap of length k costs open
/// + (k - 1) extend.
struct AlignSequencesOptions {
  double match = 5.0;
  double mismatch = 0.0;
  double gap_open = -4.0;    ///< <= gap_extend
  double gap_extend = -0.5;  ///< <= 0; end gaps cost the same
};

/// The best alignment: which entries stand in one column, gaps left out.
struct SequenceAlignment {
  std::vector<std::pair<std::size_t, std::size_t>> columns;  ///< (index in a, index in b), rising
  double score = 0.0;
};

/// Aligns the whole of `a` with the whole of `b`: Needleman, Wunsch, J. Mol. Biol. 48 (1970)
/// 443-453, with affine gaps after Gotoh, J. Mol. Biol. 162 (1982) 705-708. Names match when they
/// are equal; of equal scores the same alignment always. A gap in one sequence may follow a gap in
/// the other at once.
///
/// @throws InputError unless gap_open <= gap_extend <= 0
/// Time and memory O(|a| |b|), 1 byte per cell.
[[nodiscard]] SequenceAlignment align_sequences(const std::vector<std::string>& a,
                                                const std::vector<std::string>& b,
                                                const AlignSequencesOptions& options = {});

}  // namespace mortise
