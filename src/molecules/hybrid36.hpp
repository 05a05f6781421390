// SPDX-License-Identifier: GPL-3.0-or-later
// Hybrid-36 numbers: what the PDB format's narrow columns hold beyond 9,999 residues and 99,999
// atoms.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace mortise::molecules {

/// The number a field of 4 or 5 columns holds: decimal as long as it fits, then A000 to ZZZZ, then
/// a000 to zzzz (Grosse-Kunstleve et al., the computational crystallography toolbox). Nothing if it
/// is no such number.
[[nodiscard]] std::optional<int> decode_hybrid36(std::string_view field, std::size_t width);

/// The inverse, right aligned in `width` (4 or 5) columns; nothing if the number does not fit.
[[nodiscard]] std::optional<std::string> encode_hybrid36(int number, std::size_t width);

}  // namespace mortise::molecules
