// SPDX-License-Identifier: GPL-3.0-or-later
// Child processes by posix_spawn.
#include "report/run_program.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include "mortise/core/errors.hpp"
#include "mortise/store/atomic_file.hpp"

extern "C" char** environ;  // NOLINT(readability-redundant-declaration): POSIX leaves it to us

namespace mortise::detail {
namespace {

constexpr std::size_t kOutputShown = 1200;  // bytes of a failed program's output

std::vector<char*> pointers(const std::vector<std::string>& words) {
  std::vector<char*> list;
  list.reserve(words.size() + 1);
  for (const std::string& word : words) list.push_back(const_cast<char*>(word.c_str()));
  list.push_back(nullptr);
  return list;
}

}  // namespace

TemporaryDirectory::TemporaryDirectory() {
  path_ = (std::filesystem::temp_directory_path() / "mortise-XXXXXX").string();
  if (::mkdtemp(path_.data()) == nullptr)
    throw FileError(path_, std::string("no temporary directory: ") + std::strerror(errno));
}

TemporaryDirectory::~TemporaryDirectory() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

void run_program(const std::vector<std::string>& words, const std::vector<std::string>& settings,
                 const std::string& hint) {
  const TemporaryDirectory scratch;
  const std::string log = scratch / "output";
  std::vector<std::string> environment = settings;
  for (char** entry = environ; *entry != nullptr; ++entry) environment.emplace_back(*entry);

  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, 1, log.c_str(), O_WRONLY | O_CREAT, 0600);
  posix_spawn_file_actions_adddup2(&actions, 1, 2);
  pid_t child = 0;
  const int started = ::posix_spawnp(&child, words.front().c_str(), &actions, nullptr,
                                     pointers(words).data(), pointers(environment).data());
  posix_spawn_file_actions_destroy(&actions);
  if (started != 0)
    throw InputError("cannot run " + words.front() + ": " + std::strerror(started) + " (" + hint +
                     ")");
  int status = 0;
  while (::waitpid(child, &status, 0) < 0)
    if (errno != EINTR) throw InputError("waiting for " + words.front() + " failed");
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return;
  // 127: spawned, but the system did not find the program after all.
  if (WIFEXITED(status) && WEXITSTATUS(status) == 127)
    throw InputError("cannot run " + words.front() + " (" + hint + ")");
  std::string said = read_whole_file(log);
  if (said.size() > kOutputShown) said = "..." + said.substr(said.size() - kOutputShown);
  throw InputError(words.front() + " failed (" + hint + "); it said: " + said);
}

}  // namespace mortise::detail
