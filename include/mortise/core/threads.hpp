// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Running independent pieces of work on the machine's cores.
#pragma once

#include <cstddef>
#include <functional>

namespace mortise {

/// Number of workers for a `threads` option: itself if > 0, all cores for 0. @throws InputError if
/// negative
[[nodiscard]] int resolve_threads(int threads);

/// Calls body(index, worker) once for each index in [0, count), worker in [0,
/// resolve_threads(threads)); no two calls with one worker number overlap, so per-worker scratch
/// needs no lock. The first exception is rethrown.
void parallel_for(std::size_t count, int threads,
                  const std::function<void(std::size_t index, int worker)>& body);

}  // namespace mortise
