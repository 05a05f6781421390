// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// How long computations tell their caller how far they are, and are told to stop.
#pragma once

#include <cstddef>
#include <functional>

namespace mortise {

/// Called now and then from the calling thread's computation with work done so far; returns false
/// to stop early.
using ProgressCallback = std::function<bool(std::size_t done, std::size_t total)>;

}  // namespace mortise
