// SPDX-License-Identifier: GPL-3.0-or-later
// parallel_for on oneTBB.
#include "mortise/core/threads.hpp"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "mortise/core/errors.hpp"

namespace mortise {
namespace {

// TBB starts no more threads than there are cores, and says so on stderr, unless it is told to; it
// stays told for the rest of the process. Returns how many there may be, which a limit of the
// caller's own keeps lower.
int allow(int workers) {
  using tbb::global_control;
  constexpr auto kThreads = global_control::max_allowed_parallelism;
  static std::mutex mutex;
  static std::unique_ptr<global_control> more;
  static int most = 0;
  const std::lock_guard lock(mutex);
  if (workers > most &&
      static_cast<std::size_t>(workers) > global_control::active_value(kThreads)) {
    more.reset();  // the smallest of several limits would count
    more = std::make_unique<global_control>(kThreads, workers);
    most = workers;
  }
  return static_cast<int>(global_control::active_value(kThreads));
}

}  // namespace

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
  tbb::task_arena arena(std::min(workers, allow(workers)));
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
