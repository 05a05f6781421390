// SPDX-License-Identifier: GPL-3.0-or-later
// Values as the CIF syntax writes them.
#pragma once

#include <string>

namespace mortise::molecules {

/// `value` bare or in quotes; "." if empty. @throws InputError if no quotes of either kind can hold
/// it
[[nodiscard]] std::string cif_value(const std::string& value);

}  // namespace mortise::molecules
