// SPDX-License-Identifier: GPL-3.0-or-later
// Jobs in processes of their own: results, failures, crashes, stopping.
#include "mortise/runs/processes.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <stdexcept>
#include <vector>

namespace mortise {
namespace {

TEST(Processes, EachJobsFateIsItsOwn) {
  std::vector<JobResult> results(5);
  int ended = 0;
  run_in_processes(5, 2,
                   {.work = [](std::size_t i) -> std::string {
                      if (i == 1) raise(SIGKILL);
                      if (i == 2) throw std::runtime_error("no");
                      if (i == 3) throw JobStopped();
                      return "job " + std::to_string(i) + " in " + std::to_string(getpid());
                    },
                    .done =
                        [&](std::size_t i, const JobResult& result) {
                          results[i] = result;
                          ++ended;
                        }});
  EXPECT_EQ(ended, 5);
  EXPECT_EQ(results[0].text.substr(0, 9), "job 0 in ");
  EXPECT_NE(results[0].text, "job 0 in " + std::to_string(getpid()));
  EXPECT_EQ(results[0].failure, "");
  EXPECT_GT(results[0].peak_memory_mb, 0.1);
  EXPECT_EQ(results[1].failure, "ended by signal 9");
  EXPECT_EQ(results[2].failure, "ended with code 2");
  EXPECT_TRUE(results[3].stopped);
  EXPECT_EQ(results[3].failure, "");
  EXPECT_EQ(results[4].text.substr(0, 6), "job 4 ");
}

TEST(Processes, StoppingBeginsNoFurtherJob) {
  int ended = 0;
  run_in_processes(50, 1,
                   {.work = [](std::size_t) { return std::string("done"); },
                    .done = [&](std::size_t, const JobResult&) { ++ended; },
                    .stop = [&] { return ended >= 3; }});
  EXPECT_EQ(ended, 3);
}

}  // namespace
}  // namespace mortise
