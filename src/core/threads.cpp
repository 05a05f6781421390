// SPDX-License-Identifier: GPL-3.0-or-later
// parallel_for on oneTBB.
#include "mortise/core/threads.hpp"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <optional>
#include <string>
#include <thread>

#include "mortise/core/errors.hpp"

namespace mortise {

int resolve_threads(int threads) {
  if (threads < 0) throw InputError("threads must be >= 0, got " + std::to_string(threads));
  if (threads > 0) return threads;
  return std::max(1, tbb::this_task_arena::max_concurrency());
}

void parallel_for(std::size_t count, int threads,
                  const std::function<void(std::size_t index, int worker)>& body) {
  const int workers = resolve_threads(threads);
  if (workers == 1 || count <= 1) {
    for (std::size_t i = 0; i < count; ++i) body(i, 0);
    return;
  }
  // TBB starts no more threads than there are cores and says so on stderr, unless it is told to.
  // The arena must not ask for more than a smaller limit of the caller's own leaves.
  using tbb::global_control;
  std::optional<global_control> more;
  if (static_cast<std::size_t>(workers) >
      global_control::active_value(global_control::max_allowed_parallelism))
    more.emplace(global_control::max_allowed_parallelism, workers);
  tbb::task_arena arena(std::min(workers, static_cast<int>(global_control::active_value(
                                              global_control::max_allowed_parallelism))));
  arena.execute([&] {
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, count, 1),
        [&](const tbb::blocked_range<std::size_t>& range) {
          const int worker = tbb::this_task_arena::current_thread_index();
          // Isolated: a body that itself runs parallel work must not pick up a second index on this
          // worker.
          tbb::this_task_arena::isolate([&] {
            for (std::size_t i = range.begin(); i != range.end(); ++i) body(i, worker);
          });
        },
        tbb::simple_partitioner());
  });
}

}  // namespace mortise
