// SPDX-License-Identifier: GPL-3.0-or-later
// Jobs by fork, their results through pipes.
#include "mortise/runs/processes.hpp"

#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <map>
#include <stdexcept>

namespace mortise {
namespace {

constexpr int kStoppedCode = 130;
constexpr int kFailedCode = 2;

struct Worker {
  std::size_t index = 0;
  int result = -1;  // read end of the pipe that its text comes through
};

[[noreturn]] void work_and_exit(const JobHooks& hooks, std::size_t index, pid_t parent,
                                int result) {
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  int code = getppid() == parent ? 0 : kStoppedCode;
  try {
    if (code == 0) {
      const std::string text = hooks.work(index);  // far below what a pipe holds
      if (write(result, text.data(), text.size()) != static_cast<ssize_t>(text.size()))
        code = kFailedCode;
    }
  } catch (const JobStopped&) {
    code = kStoppedCode;
  } catch (const std::exception&) {
    code = kFailedCode;
  }
  _exit(code);  // the parent's objects are not ours to destroy
}

std::pair<pid_t, Worker> start(const JobHooks& hooks, std::size_t index) {
  int ends[2];
  if (pipe(ends) != 0) throw std::runtime_error(std::string("pipe: ") + std::strerror(errno));
  std::fflush(nullptr);
  const pid_t parent = getpid();
  const pid_t process = fork();
  if (process < 0) throw std::runtime_error(std::string("fork: ") + std::strerror(errno));
  if (process == 0) {
    close(ends[0]);
    work_and_exit(hooks, index, parent, ends[1]);
  }
  close(ends[1]);
  return {process, {index, ends[0]}};
}

double seconds_of(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

JobResult collect(const Worker& worker, int status, const rusage& usage) {
  JobResult result;
  char buffer[4096];
  for (ssize_t n = 0; (n = read(worker.result, buffer, sizeof buffer)) > 0;)
    result.text.append(buffer, static_cast<std::size_t>(n));
  close(worker.result);
  result.stopped = WIFEXITED(status) && WEXITSTATUS(status) == kStoppedCode;
  if (WIFSIGNALED(status))
    result.failure = "ended by signal " + std::to_string(WTERMSIG(status));
  else if (WEXITSTATUS(status) != 0 && !result.stopped)
    result.failure = "ended with code " + std::to_string(WEXITSTATUS(status));
  if (result.stopped || !result.failure.empty()) result.text.clear();
  result.cpu_seconds = seconds_of(usage.ru_utime) + seconds_of(usage.ru_stime);
  result.peak_memory_mb = static_cast<double>(usage.ru_maxrss) * 1024.0 / 1e6;  // Linux: KiB
  return result;
}

}  // namespace

void run_in_processes(std::size_t count, int at_once, const JobHooks& hooks) {
  std::map<pid_t, Worker> workers;
  std::size_t next = 0;
  bool told = false;
  const auto stopping = [&] { return hooks.stop && hooks.stop(); };
  while (true) {
    while (!stopping() && next < count && workers.size() < static_cast<std::size_t>(at_once))
      workers.insert(start(hooks, next++));
    if (stopping() && !told) {  // a terminal tells them itself; others tell only us
      for (const auto& [process, worker] : workers) kill(process, SIGTERM);
      told = true;
    }
    if (workers.empty()) return;
    int status = 0;
    rusage usage = {};
    const pid_t process = wait4(-1, &status, 0, &usage);
    if (process < 0 && errno != EINTR)
      throw std::runtime_error(std::string("wait: ") + std::strerror(errno));
    const auto worker = workers.find(process);
    if (worker == workers.end()) continue;
    const Worker ended = worker->second;
    workers.erase(worker);
    hooks.done(ended.index, collect(ended, status, usage));
  }
}

}  // namespace mortise
