// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Which residue of a model is which residue of a reference.
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "mortise/molecules/molecule.hpp"

namespace mortise {

/// How the residues of two chains were paired.
enum class MatchMethod {
  kNumbering,  ///< equal residue number and insertion code
  kAlignment,  ///< equal residue name in one column of the global alignment
};

/// Two chains that were found to be the same.
struct ChainMatch {
  std::string model_chain;
  std::string reference_chain;
  MatchMethod method = MatchMethod::kNumbering;
  std::size_t matched = 0;  ///< residue pairs
  std::size_t identical =
      0;  ///< of these, with the same residue name (modified residues count as their parent)
};

/// The residues that a model and a reference have in common.
struct ResidueMatch {
  /// (residue of the model, residue of the reference), indices into residues(molecule); rising in
  /// the model
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  std::vector<ChainMatch> chains;
  std::size_t model_residues = 0;      ///< amino acids and nucleotides in the model
  std::size_t reference_residues = 0;  ///< and in the reference

  /// Share of the reference's residues that the model has too.
  [[nodiscard]] double matched_fraction() const noexcept {
    return reference_residues == 0
               ? 0.0
               : static_cast<double>(pairs.size()) / static_cast<double>(reference_residues);
  }
};

struct MatchResiduesOptions {
  double min_fraction = 0.5;  ///< least share of the smaller side that must match; in [0, 1]
  std::size_t min_residues =
      10;  ///< least number of pairs, or the whole smaller side if it is less
};

/// Pairs the amino acids and nucleotides of two molecules. Missing residues on either side are left
/// out.
///
/// Chains of equal name are paired by residue number and insertion code where at least half of the
/// shorter chain pairs up and 70% of the pairs have the same residue name. All other chains are
/// paired whatever their names, by numbers under the same condition, else by align_sequences, where
/// at least half of the shorter chain must be identical. Of several assignments of equivalent
/// chains (a homodimer under other names) the one that superposes best is taken, of chains whose
/// names agree the name is believed.
///
/// @throws InputError if a molecule has no such residue or fewer match than the options ask; the
/// message gives both
///         sides' chains and residue counts
[[nodiscard]] ResidueMatch match_residues(const Molecule& model, const Molecule& reference,
                                          const MatchResiduesOptions& options = {});

}  // namespace mortise
