// SPDX-License-Identifier: GPL-3.0-or-later
// Fork, pipe, wait.
#include "parts/step/guarded.hpp"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>

#include "mortise/core/errors.hpp"

namespace mortise {
namespace {

constexpr char kDone = 'd';
constexpr char kRefused = 'r';

void write_all(int fd, const std::string& bytes) {
  for (std::size_t at = 0; at < bytes.size();) {
    const ssize_t n = ::write(fd, bytes.data() + at, bytes.size() - at);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return;  // the parent is gone
    at += static_cast<std::size_t>(n);
  }
}

[[noreturn]] void child(int fd, unsigned seconds, const std::function<std::string()>& work) {
  const rlimit no_core = {0, 0};
  ::setrlimit(RLIMIT_CORE, &no_core);
  const rlimit time = {seconds, seconds};
  ::setrlimit(RLIMIT_CPU, &time);
  for (const int signal : {SIGSEGV, SIGABRT, SIGBUS, SIGFPE, SIGINT, SIGTERM})
    std::signal(signal, SIG_DFL);
  // What the parent has not written yet is copied in here, and OpenCASCADE flushes std::cout.
  const int nowhere = ::open("/dev/null", O_WRONLY);
  if (nowhere >= 0) {
    ::dup2(nowhere, STDOUT_FILENO);
    ::dup2(nowhere, STDERR_FILENO);
  }
  try {
    write_all(fd, kDone + work());
  } catch (const std::exception& error) {
    write_all(fd, kRefused + std::string(error.what()));
  } catch (...) {
    write_all(fd, std::string(1, kRefused) + "OpenCASCADE cannot read it");
  }
  ::_exit(0);
}

}  // namespace

std::string guarded(const std::string& path, unsigned seconds,
                    const std::function<std::string()>& work) {
  std::array<int, 2> ends = {-1, -1};
  if (::pipe(ends.data()) != 0)
    throw FileError(path, std::string("cannot be read: pipe: ") + std::strerror(errno));
  const pid_t pid = ::fork();
  if (pid < 0) {
    const int error = errno;
    ::close(ends[0]);
    ::close(ends[1]);
    throw FileError(path, std::string("cannot be read: fork: ") + std::strerror(error));
  }
  if (pid == 0) {
    ::close(ends[0]);
    child(ends[1], seconds, work);
  }
  ::close(ends[1]);
  std::string bytes;
  std::string buffer(1 << 16, '\0');
  for (;;) {
    const ssize_t n = ::read(ends[0], buffer.data(), buffer.size());
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) break;
    bytes.append(buffer.data(), static_cast<std::size_t>(n));
  }
  ::close(ends[0]);
  int status = 0;
  while (::waitpid(pid, &status, 0) < 0 && errno == EINTR) {
  }
  const std::string expected = "expected a sound STEP file, found one on which OpenCASCADE ";
  if (WIFSIGNALED(status) && (WTERMSIG(status) == SIGXCPU || WTERMSIG(status) == SIGKILL))
    throw FileError(path, expected + "takes more than " + std::to_string(seconds) +
                              " s or more memory than there is");
  if (WIFSIGNALED(status) || bytes.empty()) throw FileError(path, expected + "crashes");
  if (bytes[0] == kDone) return bytes.substr(1);
  const std::string message = bytes.substr(1);
  const std::string prefix = path + ": ";
  throw FileError(path, message.starts_with(prefix) ? message.substr(prefix.size()) : message);
}

}  // namespace mortise
