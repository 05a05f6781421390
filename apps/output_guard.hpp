// SPDX-License-Identifier: GPL-3.0-or-later
// What every command asks of a file before it writes it: no input is overwritten.
#pragma once

#include <string>
#include <vector>

namespace mortise::app {

/// Whether both names mean one file, there or not.
[[nodiscard]] bool same_file(const std::string& a, const std::string& b);

/// Throws FileError if `output` is one of `inputs`, by whatever name; empty names are passed over.
void refuse_to_overwrite_input(const std::string& output, const std::vector<std::string>& inputs);

/// The same; and throws FileError where `output` cannot be written, or is there already unless
/// `may_exist`. `remedy` tells the user what to do then.
void check_output_file(const std::string& output, const std::vector<std::string>& inputs,
                       bool may_exist, const std::string& remedy);

}  // namespace mortise::app
