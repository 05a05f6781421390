// SPDX-License-Identifier: GPL-3.0-or-later
// The little of HDF5 that Mortise uses: whole files in memory, groups, attributes and numeric
// arrays.
#pragma once

#include <hdf5.h>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace mortise::hdf5 {

/// Owns one HDF5 identifier.
class Handle {
 public:
  Handle() = default;
  Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  Handle& operator=(Handle&& other) noexcept {
    std::swap(id_, other.id_);
    std::swap(close_, other.close_);
    return *this;
  }
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  [[nodiscard]] hid_t get() const { return id_; }
  explicit operator bool() const { return id_ >= 0; }

 private:
  hid_t id_ = -1;
  herr_t (*close_)(hid_t) = nullptr;
};

/// Keeps HDF5 from printing its error stack while alive.
class Silence {
 public:
  Silence();
  ~Silence();
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;

 private:
  H5E_auto2_t function_ = nullptr;
  void* data_ = nullptr;
};

using Shape = std::vector<hsize_t>;

/// A file being built in memory. No timestamps, fixed order: equal calls give equal bytes.
class Writer {
 public:
  Writer();
  void group(const std::string& name);
  void attribute(const std::string& object, const std::string& name, const std::string& value);
  void attribute(const std::string& object, const std::string& name, const char* value) {
    attribute(object, name, std::string(value));
  }
  void attribute(const std::string& object, const std::string& name, double value);
  void attribute(const std::string& object, const std::string& name, std::int64_t value);
  void attribute(const std::string& object, const std::string& name, std::uint64_t value);
  /// Row-major data, compressed; the shape may hold zeros.
  void array(const std::string& name, const Shape& shape, const double* data);
  void array(const std::string& name, const Shape& shape, const float* data);
  void array(const std::string& name, const Shape& shape, const std::int32_t* data);
  void array(const std::string& name, const Shape& shape, const std::uint8_t* data);
  /// The finished file.
  [[nodiscard]] std::string bytes();

 private:
  void array(const std::string& name, const Shape& shape, hid_t stored, hid_t given,
             const void* data);
  void number(const std::string& object, const std::string& name, hid_t stored, hid_t given,
              const void* value);
  Silence silence_;
  Handle file_;
};

/// True if the bytes start as an HDF5 file does.
[[nodiscard]] bool has_signature(const std::string& bytes);

/// A file read into memory; every failure is a FileError that names the file and the object.
class Reader {
 public:
  /// @throws FileError if the file is missing, not HDF5, truncated or damaged
  explicit Reader(const std::string& path);
  [[nodiscard]] bool has(const std::string& name) const;
  [[nodiscard]] bool has_attribute(const std::string& object, const std::string& name) const;
  [[nodiscard]] std::string text(const std::string& object, const std::string& name) const;
  [[nodiscard]] double real(const std::string& object, const std::string& name) const;
  [[nodiscard]] std::int64_t integer(const std::string& object, const std::string& name) const;
  [[nodiscard]] std::uint64_t natural(const std::string& object, const std::string& name) const;
  /// Names in a group, in the order they were written.
  [[nodiscard]] std::vector<std::string> children(const std::string& group) const;
  /// Names of an object's attributes, in the order they were written.
  [[nodiscard]] std::vector<std::string> attributes(const std::string& object) const;
  [[nodiscard]] Shape shape(const std::string& name) const;
  /// The array's numbers, row-major; its shape must be the one expected.
  [[nodiscard]] std::vector<double> reals(const std::string& name, const Shape& expected) const;
  [[nodiscard]] std::vector<float> floats(const std::string& name, const Shape& expected) const;
  [[nodiscard]] std::vector<std::int32_t> integers(const std::string& name,
                                                   const Shape& expected) const;
  [[nodiscard]] std::vector<std::uint8_t> bytes(const std::string& name,
                                                const Shape& expected) const;
  [[noreturn]] void fail(const std::string& message) const;

 private:
  [[nodiscard]] Handle open(const std::string& name) const;
  [[nodiscard]] Handle open_attribute(const std::string& object, const std::string& name) const;
  [[nodiscard]] Handle open_array(const std::string& name) const;
  void number(const std::string& object, const std::string& name, hid_t type, void* value) const;
  template <typename T>
  [[nodiscard]] std::vector<T> numbers(const std::string& name, const Shape& expected,
                                       hid_t type) const;
  std::string path_;
  Silence silence_;
  std::string image_;
  Handle file_;
};

}  // namespace mortise::hdf5
