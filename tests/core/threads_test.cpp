// SPDX-License-Identifier: GPL-3.0-or-later
// parallel_for: every index once, workers never shared, errors rethrown.
#include "mortise/core/threads.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <thread>
#include <vector>

#include "mortise/core/errors.hpp"

namespace mortise {
namespace {

TEST(ParallelFor, MoreThreadsThanCoresWorkInSilence) {
  // First in this file: TBB warns once per process, and right after nested loops (the next test) it
  // may give a loop one thread only, with or without more threads than cores.
  const int threads = static_cast<int>(std::thread::hardware_concurrency()) + 3;
  std::vector<std::atomic<int>> used(threads);
  testing::internal::CaptureStderr();
  for (int repeat = 0; repeat < 3; ++repeat)
    parallel_for(200, threads, [&](std::size_t, int worker) {
      used[worker] = 1;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    });
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  int count = 0;
  for (const auto& u : used) count += u;
  EXPECT_EQ(count, threads);
}

TEST(ParallelFor, VisitsEachIndexOnceAndNeverSharesAWorker) {
  for (const int threads : {1, 2, 5}) {
    std::vector<std::atomic<int>> visits(1000);
    std::vector<std::atomic<int>> busy(threads);
    std::atomic<bool> shared{false};
    parallel_for(visits.size(), threads, [&](std::size_t i, int worker) {
      if (worker < 0 || worker >= threads || busy[worker].exchange(1) != 0) {
        shared = true;
        return;
      }
      parallel_for(3, threads, [&](std::size_t, int) {});  // nested work must not re-enter
      ++visits[i];
      busy[worker] = 0;
    });
    EXPECT_FALSE(shared);
    for (const auto& v : visits) EXPECT_EQ(v, 1);
  }
}

TEST(ParallelFor, RethrowsAndRefusesNegativeThreads) {
  EXPECT_THROW(parallel_for(10, 2, [](std::size_t, int) { throw InputError("x"); }), InputError);
  EXPECT_THROW((void)resolve_threads(-1), InputError);
  EXPECT_EQ(resolve_threads(3), 3);
  EXPECT_GE(resolve_threads(0), 1);
}

}  // namespace
}  // namespace mortise
