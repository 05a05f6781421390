// SPDX-License-Identifier: GPL-3.0-or-later
// HDF5 files as whole images in memory: the disk is touched by read_whole_file and
// write_file_atomically only.
#include "store/hdf5_file.hpp"

#include <algorithm>
#include <atomic>
#include <cstring>
#include <limits>
#include <stdexcept>

#include "mortise/core/errors.hpp"
#include "mortise/store/atomic_file.hpp"

namespace mortise::hdf5 {
namespace {

constexpr char kSignature[] = "\x89HDF\r\n\x1a\n";
// Where superblocks of version 2 and 3 say how long the file is [HDF5 File Format
// Specification 3.0, II.A].
constexpr std::size_t kEndOfFileAt = 28;
constexpr hsize_t kMostElements = 1ULL << 31;  // more than this in one array is damage, not data

// A failure while writing to memory is ours, not the user's.
hid_t must(hid_t id, const char* what) {
  if (id < 0) throw std::runtime_error(std::string("HDF5: ") + what + " failed");
  return id;
}

Handle properties(hid_t kind) { return {must(H5Pcreate(kind), "H5Pcreate"), H5Pclose}; }

Handle in_memory_access() {
  Handle access = properties(H5P_FILE_ACCESS);
  must(H5Pset_fapl_core(access.get(), 1 << 20, false), "H5Pset_fapl_core");
  // The 1.8 layout: its metadata carry checksums, and every HDF5 since 2008 reads it.
  must(H5Pset_libver_bounds(access.get(), H5F_LIBVER_V18, H5F_LIBVER_V18), "H5Pset_libver_bounds");
  return access;
}

// HDF5 takes two open in-memory files of one name for the same file, so each gets its own.
std::string unique_name() {
  static std::atomic<unsigned long> count{0};
  return "mortise-" + std::to_string(++count);
}

hsize_t element_count(const Shape& shape) {
  hsize_t count = 1;
  for (const hsize_t n : shape) {
    if (n != 0 && count > kMostElements / n) return kMostElements + 1;
    count *= n;
  }
  return count;
}

std::string shape_text(const Shape& shape) {
  std::string text;
  for (const hsize_t n : shape) text += (text.empty() ? "" : " x ") + std::to_string(n);
  return text.empty() ? "a single value" : text;
}

herr_t collect_name(hid_t, const char* name, const H5L_info_t*, void* names) {
  static_cast<std::vector<std::string>*>(names)->emplace_back(name);
  return 0;
}

herr_t collect_attribute(hid_t, const char* name, const H5A_info_t*, void* names) {
  static_cast<std::vector<std::string>*>(names)->emplace_back(name);
  return 0;
}

// FNV-1a, 64 bits: chunk indexes of HDF5 1.8 have no checksum, and a lost chunk would read as
// zeros.
constexpr char kChecksum[] = "fnv1a64";

std::uint64_t checksum(const void* data, std::size_t size) {
  std::uint64_t hash = 14695981039346656037ULL;
  for (const auto* byte = static_cast<const unsigned char*>(data); size > 0; --size)
    hash = (hash ^ *byte++) * 1099511628211ULL;
  return hash;
}

std::uint64_t little_endian(const char* bytes) {
  std::uint64_t value = 0;
  for (int i = 7; i >= 0; --i) value = value << 8 | static_cast<unsigned char>(bytes[i]);
  return value;
}

}  // namespace

Silence::Silence() {
  // After a damaged file HDF5 1.10 complains on stderr at exit. Our files are in memory: nothing is
  // left to close.
  [[maybe_unused]] static const herr_t once = H5dont_atexit();
  H5Eget_auto2(H5E_DEFAULT, &function_, &data_);
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

Silence::~Silence() { H5Eset_auto2(H5E_DEFAULT, function_, data_); }

bool has_signature(const std::string& bytes) {
  return bytes.size() >= 8 && std::memcmp(bytes.data(), kSignature, 8) == 0;
}

Writer::Writer() {
  const Handle access = in_memory_access();
  // No property that needs a superblock extension: that object's header always carries the time.
  const Handle creation = properties(H5P_FILE_CREATE);
  must(H5Pset_obj_track_times(creation.get(), false), "H5Pset_obj_track_times");
  must(H5Pset_attr_creation_order(creation.get(), H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED),
       "H5Pset_attr_creation_order");
  file_ = {must(H5Fcreate(unique_name().c_str(), H5F_ACC_TRUNC, creation.get(), access.get()),
                "H5Fcreate"),
           H5Fclose};
}

void Writer::group(const std::string& name) {
  const Handle creation = properties(H5P_GROUP_CREATE);
  const unsigned order = H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED;
  must(H5Pset_obj_track_times(creation.get(), false), "H5Pset_obj_track_times");
  must(H5Pset_link_creation_order(creation.get(), order), "H5Pset_link_creation_order");
  must(H5Pset_attr_creation_order(creation.get(), order), "H5Pset_attr_creation_order");
  const Handle made(
      must(H5Gcreate2(file_.get(), name.c_str(), H5P_DEFAULT, creation.get(), H5P_DEFAULT),
           "H5Gcreate2"),
      H5Gclose);
}

void Writer::attribute(const std::string& object, const std::string& name,
                       const std::string& value) {
  const Handle type(must(H5Tcopy(H5T_C_S1), "H5Tcopy"), H5Tclose);
  must(H5Tset_size(type.get(), std::max<std::size_t>(value.size(), 1)), "H5Tset_size");
  must(H5Tset_strpad(type.get(), H5T_STR_NULLPAD), "H5Tset_strpad");
  must(H5Tset_cset(type.get(), H5T_CSET_UTF8), "H5Tset_cset");
  number(object, name, type.get(), type.get(), value.empty() ? "" : value.data());
}

void Writer::attribute(const std::string& object, const std::string& name, double value) {
  number(object, name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, &value);
}

void Writer::attribute(const std::string& object, const std::string& name, std::int64_t value) {
  number(object, name, H5T_STD_I64LE, H5T_NATIVE_INT64, &value);
}

void Writer::attribute(const std::string& object, const std::string& name, std::uint64_t value) {
  number(object, name, H5T_STD_U64LE, H5T_NATIVE_UINT64, &value);
}

void Writer::number(const std::string& object, const std::string& name, hid_t stored, hid_t given,
                    const void* value) {
  const Handle space(must(H5Screate(H5S_SCALAR), "H5Screate"), H5Sclose);
  const Handle made(must(H5Acreate_by_name(file_.get(), object.c_str(), name.c_str(), stored,
                                           space.get(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                         "H5Acreate_by_name"),
                    H5Aclose);
  must(H5Awrite(made.get(), given, value), "H5Awrite");
}

void Writer::array(const std::string& name, const Shape& shape, const double* data) {
  array(name, shape, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, data);
}

void Writer::array(const std::string& name, const Shape& shape, const float* data) {
  array(name, shape, H5T_IEEE_F32LE, H5T_NATIVE_FLOAT, data);
}

void Writer::array(const std::string& name, const Shape& shape, const std::int32_t* data) {
  array(name, shape, H5T_STD_I32LE, H5T_NATIVE_INT32, data);
}

void Writer::array(const std::string& name, const Shape& shape, const std::uint8_t* data) {
  array(name, shape, H5T_STD_U8LE, H5T_NATIVE_UINT8, data);
}

void Writer::array(const std::string& name, const Shape& shape, hid_t stored, hid_t given,
                   const void* data) {
  const Handle creation = properties(H5P_DATASET_CREATE);
  must(H5Pset_obj_track_times(creation.get(), false), "H5Pset_obj_track_times");
  const hsize_t count = element_count(shape);
  if (count > 0) {
    Shape chunk = shape;
    const hsize_t row = count / shape[0];
    chunk[0] = std::clamp<hsize_t>(65536 / row, 1, shape[0]);
    must(H5Pset_chunk(creation.get(), static_cast<int>(chunk.size()), chunk.data()),
         "H5Pset_chunk");
    must(H5Pset_shuffle(creation.get()), "H5Pset_shuffle");
    must(H5Pset_deflate(creation.get(), 4), "H5Pset_deflate");
  }
  const Handle space(must(H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr),
                          "H5Screate_simple"),
                     H5Sclose);
  const Handle made(must(H5Dcreate2(file_.get(), name.c_str(), stored, space.get(), H5P_DEFAULT,
                                    creation.get(), H5P_DEFAULT),
                         "H5Dcreate2"),
                    H5Dclose);
  if (count > 0) must(H5Dwrite(made.get(), given, H5S_ALL, H5S_ALL, H5P_DEFAULT, data), "H5Dwrite");
  attribute(name, kChecksum, checksum(data, count * H5Tget_size(given)));
}

std::string Writer::bytes() {
  must(H5Fflush(file_.get(), H5F_SCOPE_GLOBAL), "H5Fflush");
  // Not H5Fget_file_image: in 1.10 it clears flags of the superblock and leaves the old checksum.
  void* memory = nullptr;
  must(H5Fget_vfd_handle(file_.get(), H5P_DEFAULT, &memory), "H5Fget_vfd_handle");
  const char* image = *static_cast<const char* const*>(memory);
  return {image,
          little_endian(image + kEndOfFileAt)};  // the buffer itself is rounded up to a megabyte
}

Reader::Reader(const std::string& path) : path_(path), image_(read_whole_file(path)) {
  if (image_.empty()) fail("expected an HDF5 file, found an empty file");
  if (!has_signature(image_)) fail("expected an HDF5 file, found something else");
  // Superblocks of version 2 and 3 say where the file ends [HDF5 File Format Specification 3.0,
  // II.A].
  if (image_.size() >= 48 && (image_[8] == 2 || image_[8] == 3) && image_[9] == 8) {
    const std::uint64_t end = little_endian(image_.data() + kEndOfFileAt);
    if (end > image_.size())
      fail("truncated: expected " + std::to_string(end) + " bytes, found " +
           std::to_string(image_.size()));
  }
  const Handle access = in_memory_access();
  if (H5Pset_file_image(access.get(), image_.data(), image_.size()) < 0)
    throw std::runtime_error("HDF5: H5Pset_file_image failed");
  file_ = {H5Fopen(unique_name().c_str(), H5F_ACC_RDONLY, access.get()), H5Fclose};
  image_ = {};
  if (!file_) fail("an HDF5 file, but truncated or damaged");
}

void Reader::fail(const std::string& message) const { throw FileError(path_, message); }

bool Reader::has(const std::string& name) const {
  for (std::size_t slash = name.find('/', 1); slash != std::string::npos;
       slash = name.find('/', slash + 1))
    if (H5Lexists(file_.get(), name.substr(0, slash).c_str(), H5P_DEFAULT) <= 0) return false;
  return name == "/" || H5Lexists(file_.get(), name.c_str(), H5P_DEFAULT) > 0;
}

bool Reader::has_attribute(const std::string& object, const std::string& name) const {
  return has(object) &&
         H5Aexists_by_name(file_.get(), object.c_str(), name.c_str(), H5P_DEFAULT) > 0;
}

Handle Reader::open(const std::string& name) const {
  if (!has(name)) fail(name + " is missing");
  Handle object(H5Oopen(file_.get(), name.c_str(), H5P_DEFAULT), H5Oclose);
  if (!object) fail(name + " is damaged");
  return object;
}

Handle Reader::open_attribute(const std::string& object, const std::string& name) const {
  const std::string where = "attribute " + name + " of " + object;
  if (!has_attribute(object, name)) fail(where + " is missing");
  Handle attribute(
      H5Aopen_by_name(file_.get(), object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT),
      H5Aclose);
  if (!attribute) fail(where + " is damaged");
  return attribute;
}

std::string Reader::text(const std::string& object, const std::string& name) const {
  const std::string where = "attribute " + name + " of " + object;
  const Handle attribute = open_attribute(object, name);
  const Handle type(H5Aget_type(attribute.get()), H5Tclose);
  const Handle space(H5Aget_space(attribute.get()), H5Sclose);
  if (!type || !space || H5Tget_class(type.get()) != H5T_STRING ||
      H5Tis_variable_str(type.get()) != 0 || H5Sget_simple_extent_npoints(space.get()) != 1)
    fail(where + ": expected one text");
  std::string value(H5Tget_size(type.get()), '\0');
  if (H5Aread(attribute.get(), type.get(), value.data()) < 0) fail(where + " is damaged");
  value.erase(value.find_last_not_of('\0') + 1);
  return value;
}

void Reader::number(const std::string& object, const std::string& name, hid_t type,
                    void* value) const {
  const std::string where = "attribute " + name + " of " + object;
  const Handle attribute = open_attribute(object, name);
  const Handle stored(H5Aget_type(attribute.get()), H5Tclose);
  const Handle space(H5Aget_space(attribute.get()), H5Sclose);
  if (!stored || !space || H5Tget_class(stored.get()) != H5Tget_class(type) ||
      H5Sget_simple_extent_npoints(space.get()) != 1)
    fail(where + ": expected one number");
  if (H5Aread(attribute.get(), type, value) < 0) fail(where + " is damaged");
}

double Reader::real(const std::string& object, const std::string& name) const {
  double value = 0.0;
  number(object, name, H5T_NATIVE_DOUBLE, &value);
  return value;
}

std::int64_t Reader::integer(const std::string& object, const std::string& name) const {
  std::int64_t value = 0;
  number(object, name, H5T_NATIVE_INT64, &value);
  return value;
}

std::uint64_t Reader::natural(const std::string& object, const std::string& name) const {
  std::uint64_t value = 0;
  number(object, name, H5T_NATIVE_UINT64, &value);
  return value;
}

std::vector<std::string> Reader::children(const std::string& group) const {
  const Handle object = open(group);
  std::vector<std::string> names;
  hsize_t from = 0;
  if (H5Literate(object.get(), H5_INDEX_CRT_ORDER, H5_ITER_INC, &from, collect_name, &names) < 0)
    fail(group + ": expected a group with its members in order");
  return names;
}

std::vector<std::string> Reader::attributes(const std::string& object) const {
  const Handle opened = open(object);
  std::vector<std::string> names;
  hsize_t from = 0;
  if (H5Aiterate2(opened.get(), H5_INDEX_CRT_ORDER, H5_ITER_INC, &from, collect_attribute, &names) <
      0)
    fail(object + ": its attributes are damaged");
  return names;
}

Handle Reader::open_array(const std::string& name) const {
  if (!has(name)) fail("dataset " + name + " is missing");
  Handle dataset(H5Dopen2(file_.get(), name.c_str(), H5P_DEFAULT), H5Dclose);
  if (!dataset) fail("dataset " + name + " is damaged or not a dataset");
  return dataset;
}

Shape Reader::shape(const std::string& name) const {
  const Handle dataset = open_array(name);
  const Handle space(H5Dget_space(dataset.get()), H5Sclose);
  const int rank = space ? H5Sget_simple_extent_ndims(space.get()) : -1;
  if (rank < 0) fail("dataset " + name + " is damaged");
  Shape shape(static_cast<std::size_t>(rank));
  if (rank > 0 && H5Sget_simple_extent_dims(space.get(), shape.data(), nullptr) < 0)
    fail("dataset " + name + " is damaged");
  return shape;
}

template <typename T>
std::vector<T> Reader::numbers(const std::string& name, const Shape& expected, hid_t type) const {
  const Shape found = shape(name);
  if (found != expected)
    fail("dataset " + name + ": expected " + shape_text(expected) + ", found " + shape_text(found));
  if (element_count(found) > kMostElements)
    fail("dataset " + name + ": too large, " + shape_text(found));
  const Handle dataset = open_array(name);
  const Handle stored(H5Dget_type(dataset.get()), H5Tclose);
  if (!stored || H5Tget_class(stored.get()) != H5Tget_class(type))
    fail("dataset " + name + ": expected " +
         (H5Tget_class(type) == H5T_FLOAT ? "real numbers" : "whole numbers"));
  std::vector<T> values(element_count(found));
  if (!values.empty() &&
      H5Dread(dataset.get(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0)
    fail("dataset " + name + " is damaged");
  if (has_attribute(name, kChecksum) &&
      natural(name, kChecksum) != checksum(values.data(), values.size() * sizeof(T)))
    fail("dataset " + name + " is damaged: its checksum does not fit");
  return values;
}

std::vector<double> Reader::reals(const std::string& name, const Shape& expected) const {
  return numbers<double>(name, expected, H5T_NATIVE_DOUBLE);
}

std::vector<float> Reader::floats(const std::string& name, const Shape& expected) const {
  return numbers<float>(name, expected, H5T_NATIVE_FLOAT);
}

std::vector<std::int32_t> Reader::integers(const std::string& name, const Shape& expected) const {
  return numbers<std::int32_t>(name, expected, H5T_NATIVE_INT32);
}

std::vector<std::uint8_t> Reader::bytes(const std::string& name, const Shape& expected) const {
  return numbers<std::uint8_t>(name, expected, H5T_NATIVE_UINT8);
}

}  // namespace mortise::hdf5
