// SPDX-License-Identifier: GPL-3.0-or-later
// Atomic replacement of files on POSIX.
#include "mortise/store/atomic_file.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "mortise/core/errors.hpp"

namespace mortise {
namespace {

namespace fs = std::filesystem;

class Descriptor {
 public:
  explicit Descriptor(int fd) : fd_(fd) {}
  Descriptor(Descriptor&& other) noexcept : fd_(other.fd_) { other.fd_ = -1; }
  Descriptor& operator=(Descriptor&&) = delete;
  ~Descriptor() {
    if (fd_ >= 0) ::close(fd_);
  }
  [[nodiscard]] int get() const { return fd_; }

 private:
  int fd_;
};

[[noreturn]] void fail(const std::string& path, const std::string& what) {
  throw FileError(path, what + ": " + std::strerror(errno));
}

struct Places {
  fs::path target;     // what rename replaces
  fs::path partial;    // hidden, beside the target, always the same name
  fs::path directory;  // of both
};

Places places_for(const std::string& path) {
  if (path.empty()) throw InputError("write: expected a file name, got an empty one");
  Places p;
  p.target = path;
  std::error_code error;
  if (fs::is_symlink(p.target, error)) {
    const fs::path real = fs::weakly_canonical(p.target, error);
    if (!error) p.target = real;
  }
  if (fs::is_directory(p.target, error))
    throw FileError(path, "cannot be written: it is a directory");
  if (fs::exists(p.target, error) && !fs::is_regular_file(p.target, error))
    throw FileError(path, "cannot be written: it is not a regular file");
  if (!p.target.has_filename()) throw FileError(path, "cannot be written: no file name");
  p.directory = p.target.has_parent_path() ? p.target.parent_path() : fs::path(".");
  p.partial = p.directory / ("." + p.target.filename().string() + ".partial");
  if (!fs::is_directory(p.directory, error))
    throw FileError(path, "cannot be written: there is no directory " + p.directory.string());
  return p;
}

bool same_file(int fd, const fs::path& path) {
  struct stat open_file {};
  struct stat named {};
  return ::fstat(fd, &open_file) == 0 && ::stat(path.c_str(), &named) == 0 &&
         open_file.st_dev == named.st_dev && open_file.st_ino == named.st_ino;
}

// Opens the partial file and takes its lock; the kernel drops the lock of a killed writer.
Descriptor open_locked(const std::string& path, const Places& p) {
  for (;;) {
    Descriptor fd(::open(p.partial.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666));
    if (fd.get() < 0) fail(path, "cannot be written");
    while (::flock(fd.get(), LOCK_EX) != 0)
      if (errno != EINTR) return fd;  // a file system without locks: go on without
    if (same_file(fd.get(), p.partial))
      return fd;  // else the last holder renamed it away: try again
  }
}

}  // namespace

void write_file_atomically(const std::string& path, std::string_view bytes) {
  const Places p = places_for(path);
  const Descriptor fd = open_locked(path, p);
  const auto give_up = [&](const char* what) {
    const int reason = errno;
    ::unlink(p.partial.c_str());
    errno = reason;
    fail(path, what);
  };
  if (::ftruncate(fd.get(), 0) != 0) give_up("cannot be written");
  std::size_t written = 0;
  while (written < bytes.size()) {
    const ssize_t n = ::write(fd.get(), bytes.data() + written, bytes.size() - written);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) give_up("writing failed");
    written += static_cast<std::size_t>(n);
  }
  if (::fsync(fd.get()) != 0) give_up("writing failed");
  if (::rename(p.partial.c_str(), p.target.c_str()) != 0) give_up("cannot be replaced");
  const Descriptor directory(::open(p.directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (directory.get() >= 0)
    ::fsync(directory.get());  // some file systems refuse: the rename stands all the same
}

void check_writable(const std::string& path, std::uint64_t bytes) {
  const Places p = places_for(path);
  {
    const Descriptor fd = open_locked(path, p);
    ::unlink(p.partial.c_str());
  }
  struct statvfs disk {};
  if (::statvfs(p.directory.c_str(), &disk) != 0) return;
  const std::uint64_t left = static_cast<std::uint64_t>(disk.f_bavail) * disk.f_frsize;
  if (left < bytes)
    throw FileError(path, "the disk is full: needs " + std::to_string(bytes) + " bytes, " +
                              std::to_string(left) + " left");
}

}  // namespace mortise
