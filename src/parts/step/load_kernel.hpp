// SPDX-License-Identifier: GPL-3.0-or-later
// Loads the STEP module: OpenCASCADE's libraries cost a program 20 to 30 ms at its start, so only
// who meets a STEP file pays.
#pragma once

#include "parts/step/kernel.hpp"

namespace mortise {

/// The kernel, loaded at the first call. Safe to call from several threads at once.
/// @throws std::runtime_error if the module is missing beside the library
[[nodiscard]] const StepKernel& load_step_kernel();

}  // namespace mortise
