// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// How long computations report progress to their caller, and how the caller stops them.
#pragma once

#include <cstddef>
#include <functional>

namespace mortise {

/// A long computation calls this now and then with the work done so far. Returning false stops the
/// computation early.
using ProgressCallback = std::function<bool(std::size_t done, std::size_t total)>;

}  // namespace mortise
