// SPDX-License-Identifier: GPL-3.0-or-later
// Runs the program as a user does, in a scratch directory.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/types.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>

#include "helpers/scratch_directory.hpp"
#include "mortise/store/atomic_file.hpp"

namespace mortise::tests {

struct Outcome {
  int code = -1;  ///< exit code; -1 if a signal ended it
  std::string out;
  std::string error;
};

class ProgramTest : public ::testing::Test {
 protected:
  [[nodiscard]] std::string path(const std::string& name) const { return scratch_ / name; }

  /// Starts the program in the scratch directory; arguments as the shell takes them.
  [[nodiscard]] pid_t start(const std::string& arguments) const {
    const std::string command = "cd '" + scratch_.path().string() + "' && exec '" +
                                MORTISE_PROGRAM + "' " + arguments + " >.stdout 2>.stderr";
    std::filesystem::remove(path(".stdout"));
    const pid_t process = ::fork();
    if (process == 0) {
      ::execl("/bin/sh", "sh", "-c", command.c_str(), static_cast<char*>(nullptr));
      ::_exit(127);
    }
    return process;
  }

  [[nodiscard]] Outcome finish(pid_t process) const {
    int status = 0;
    ::waitpid(process, &status, 0);
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read_whole_file(path(".stdout")),
            read_whole_file(path(".stderr"))};
  }

  [[nodiscard]] Outcome mortise(const std::string& arguments) const {
    return finish(start(arguments));
  }

  /// Runs it; an exit code other than 0 fails the test.
  Outcome must(const std::string& arguments) const {
    const Outcome outcome = mortise(arguments);
    EXPECT_EQ(outcome.code, 0) << arguments << "\n" << outcome.error;
    return outcome;
  }

  [[nodiscard]] nlohmann::json json(const std::string& arguments) const {
    return nlohmann::json::parse(must(arguments + " --json").out);
  }

  /// The fault is the user's: exit code 1, one line that holds `message`, nothing on stdout.
  void expect_user_error(const std::string& arguments, const std::string& message) const {
    using ::testing::AllOf;
    using ::testing::HasSubstr;
    using ::testing::StartsWith;
    const Outcome outcome = mortise(arguments);
    EXPECT_EQ(outcome.code, 1) << arguments;
    EXPECT_THAT(outcome.error, AllOf(StartsWith("mortise: error: "), HasSubstr(message)))
        << arguments;
    EXPECT_EQ(std::count(outcome.error.begin(), outcome.error.end(), '\n'), 1) << outcome.error;
    EXPECT_EQ(outcome.out, "") << arguments;
  }

  /// Waits until the file is there, and true.
  [[nodiscard]] bool wait_for(const std::string& name) const {
    for (int i = 0; i < 30000; ++i) {  // a minute: sanitized programs on a busy machine are slow
      if (std::filesystem::exists(path(name))) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    return false;
  }

  const ScratchDirectory scratch_;
};

}  // namespace mortise::tests
