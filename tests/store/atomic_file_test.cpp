// SPDX-License-Identifier: GPL-3.0-or-later
// Atomic replacement: killed writers, full disks, concurrent writers, places that cannot be
// written.
#include "mortise/store/atomic_file.hpp"

#include <gmock/gmock.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <atomic>
#include <csignal>
#include <filesystem>
#include <set>
#include <thread>

#include "mortise/core/errors.hpp"
#include "sample_run.hpp"

namespace mortise {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using testing::sample_candidates;
using testing::sample_run;
using tests::ScratchDirectory;

std::vector<std::string> names_in(const fs::path& directory) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(directory))
    names.push_back(entry.path().filename().string());
  return names;
}

std::string write_error(const std::string& path) {
  try {
    write_file_atomically(path, "x");
  } catch (const InputError& e) {
    return e.what();
  }
  return "no error";
}

TEST(AtomicFile, ReplacesAndLeavesNothingBeside) {
  const ScratchDirectory scratch;
  write_file_atomically(scratch / "f", "one");
  write_file_atomically(scratch / "f", "second");
  EXPECT_EQ(read_whole_file(scratch / "f"), "second");
  fs::create_symlink("f", scratch / "link");
  write_file_atomically(scratch / "link", "through the link");
  EXPECT_TRUE(fs::is_symlink(scratch / "link"));
  EXPECT_EQ(read_whole_file(scratch / "f"), "through the link");
  check_writable(scratch / "f");
  EXPECT_EQ(read_whole_file(scratch / "f"), "through the link");
  EXPECT_THAT(names_in(scratch.path()), ::testing::UnorderedElementsAre("f", "link"));
}

TEST(AtomicFile, RefusesPlacesThatCannotBeWritten) {
  const ScratchDirectory scratch;
  EXPECT_THAT(write_error(scratch / "no/such/f"), HasSubstr("there is no directory"));
  EXPECT_THAT(write_error(scratch.path().string()), HasSubstr("it is a directory"));
  EXPECT_THAT(write_error("/dev/null"), HasSubstr("not a regular file"));
  EXPECT_THAT(write_error(""), HasSubstr("an empty one"));
  EXPECT_THROW(check_writable(scratch / "no/such/f"), FileError);
  EXPECT_THROW(check_writable("/proc/f"), FileError);  // not writable, not even by root
  EXPECT_THROW(check_writable(scratch / "f", 1ULL << 62), FileError);
  EXPECT_THAT(names_in(scratch.path()), ::testing::IsEmpty());
}

// A limit on the size of files stands for a full disk: the write fails half way.
TEST(AtomicFile, FailedWriteKeepsTheOldFile) {
  const ScratchDirectory scratch;
  write_file_atomically(scratch / "f", "old");
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{1000, 1000};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    try {
      write_file_atomically(scratch / "f", std::string(5000, 'n'));
    } catch (const FileError& e) {
      ::_exit(std::string(e.what()).find("writing failed") != std::string::npos ? 7 : 8);
    }
    ::_exit(9);
  }
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 7);
  EXPECT_EQ(read_whole_file(scratch / "f"), "old");
  EXPECT_THAT(names_in(scratch.path()), ::testing::ElementsAre("f"));
}

TEST(AtomicFile, ConcurrentWritersTakeTurns) {
  const ScratchDirectory scratch;
  const std::string path = scratch / "f";
  write_file_atomically(path, "start");
  std::vector<std::thread> writers;
  std::atomic<int> busy{4};
  for (int w = 0; w < 4; ++w)
    writers.emplace_back([&, w] {
      for (int i = 0; i < 30; ++i)
        write_file_atomically(path, std::string(2000 + 500 * w, static_cast<char>('a' + w)));
      --busy;
    });
  bool whole = true;
  int reads = 0;
  for (; busy > 0; ++reads) {
    const std::string bytes = read_whole_file(path);
    if (bytes == "start") continue;
    const int w = bytes.empty() ? -1 : bytes[0] - 'a';
    whole = whole && w >= 0 && w < 4 &&
            bytes == std::string(2000 + 500 * w, static_cast<char>('a' + w));
  }
  for (std::thread& writer : writers) writer.join();
  EXPECT_TRUE(whole);
  EXPECT_GT(reads, 0);
  EXPECT_THAT(names_in(scratch.path()), ::testing::ElementsAre("f"));
}

// kill -9 at random moments: the file always is one of the states written, and never an older one
// than before.
TEST(RunFile, SurvivesKillAtAnyMoment) {
  const ScratchDirectory scratch;
  const std::string path = scratch / "run.h5";
  constexpr int kStates = 8;
  std::vector<std::string> states;
  for (int i = 0; i < kStates; ++i) {
    mortise::Run run = sample_run(50 * i, 1);
    run.seconds = i;
    run.candidates = sample_candidates(3000 * (i + 1));
    states.push_back(serialize_run(run));
  }
  const std::set<std::string> known(states.begin(), states.end());
  ASSERT_EQ(known.size(), static_cast<std::size_t>(kStates));
  write_file_atomically(path, states[0]);
  std::mt19937 random(11);
  int leftovers = 0;
  std::set<std::string> seen;
  for (int trial = 0; trial < 120; ++trial) {
    const pid_t child = ::fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      for (int i = trial;; ++i) write_file_atomically(path, states[i % kStates]);
    }
    ::usleep(static_cast<useconds_t>(200 + random() % 9000));
    ::kill(child, SIGKILL);
    ASSERT_EQ(::waitpid(child, nullptr, 0), child);
    const std::string bytes = read_whole_file(path);
    ASSERT_EQ(known.count(bytes), 1U)
        << "trial " << trial << ": " << bytes.size() << " bytes of no known state";
    ASSERT_NO_THROW((void)read_run(path)) << "trial " << trial;
    seen.insert(bytes);
    leftovers += names_in(scratch.path()).size() > 1 ? 1 : 0;
  }
  EXPECT_GT(leftovers, 0) << "no writer was killed in the midst of writing: the test tests nothing";
  EXPECT_GT(seen.size(), 1U);
  write_file_atomically(path, states[0]);
  EXPECT_THAT(names_in(scratch.path()), ::testing::ElementsAre("run.h5"));
}

}  // namespace
}  // namespace mortise
