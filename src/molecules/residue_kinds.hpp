// SPDX-License-Identifier: GPL-3.0-or-later
// What a residue name or an atom name says: water, amino acid, nucleotide; the chemical element.
#pragma once

#include <string>
#include <string_view>

namespace mortise::molecules {

[[nodiscard]] bool is_water(std::string_view residue_name);
/// The 20 amino acids, their variants in force fields, common modified ones and caps.
[[nodiscard]] bool is_amino_acid(std::string_view residue_name);
[[nodiscard]] bool is_nucleotide(std::string_view residue_name);

/// "ZN" or "zn" to "Zn"; empty unless it is an element's symbol. Deuterium "D" is given as "H".
[[nodiscard]] std::string element_symbol(std::string_view text);

/// The element an atom name stands for.
/// @param padded_name  the four columns of a PDB file, or the bare name (mmCIF): two-letter
/// elements
///                     start in the first column, one-letter ones in the second
[[nodiscard]] std::string element_from_name(std::string_view padded_name,
                                            std::string_view residue_name);

/// True if an atom of this name can be of this element: "FE1" can be Fe, "CA" of an ion Ca, never
/// N.
[[nodiscard]] bool element_fits_name(std::string_view symbol, std::string_view name,
                                     std::string_view residue_name);

}  // namespace mortise::molecules
