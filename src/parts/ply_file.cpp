// SPDX-License-Identifier: GPL-3.0-or-later
// PLY files, text and binary. CGAL's reader takes the memory that a list's length asks for before
// it looks at the rest.
#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>

#include "mortise/core/errors.hpp"
#include "parts/mesh_files.hpp"
#include "parts/words.hpp"

namespace mortise::parts {
namespace {

enum class Number { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat, kDouble };

struct Property {
  std::string name;
  Number number = Number::kFloat;
  std::optional<Number> length;  ///< of a list
};

struct Element {
  std::string name;
  long count = 0;
  std::vector<Property> properties;
};

std::optional<Number> number_named(std::string_view word) {
  struct Name {
    std::string_view word;
    Number number;
  };
  static constexpr std::array<Name, 16> kNames = {{{"char", Number::kInt8},
                                                   {"int8", Number::kInt8},
                                                   {"uchar", Number::kUint8},
                                                   {"uint8", Number::kUint8},
                                                   {"short", Number::kInt16},
                                                   {"int16", Number::kInt16},
                                                   {"ushort", Number::kUint16},
                                                   {"uint16", Number::kUint16},
                                                   {"int", Number::kInt32},
                                                   {"int32", Number::kInt32},
                                                   {"uint", Number::kUint32},
                                                   {"uint32", Number::kUint32},
                                                   {"float", Number::kFloat},
                                                   {"float32", Number::kFloat},
                                                   {"double", Number::kDouble},
                                                   {"float64", Number::kDouble}}};
  for (const Name& name : kNames) {
    if (name.word == word) return name.number;
  }
  return std::nullopt;
}

/// The numbers of the body one after another, whichever way they are written.
class Body {
 public:
  enum class Form { kText, kLittle, kBig };

  Body(const std::string& path, std::string_view bytes, Form form, std::size_t start)
      : path_(path), bytes_(bytes.substr(start)), words_(bytes_), form_(form) {}

  double next(Number number) {
    if (form_ == Form::kText) {
      double value = 0.0;
      const std::string_view word = words_.next();
      if (!parse_number(word, value))
        throw FileError(path_, "expected a PLY file with a number in its body, found " +
                                   (word.empty() ? std::string("the end of the file")
                                                 : "'" + std::string(word.substr(0, 40)) + "'"));
      return value;
    }
    switch (number) {
      case Number::kInt8:
        return raw<std::int8_t>();
      case Number::kUint8:
        return raw<std::uint8_t>();
      case Number::kInt16:
        return raw<std::int16_t>();
      case Number::kUint16:
        return raw<std::uint16_t>();
      case Number::kInt32:
        return raw<std::int32_t>();
      case Number::kUint32:
        return raw<std::uint32_t>();
      case Number::kFloat:
        return static_cast<double>(raw<float>());
      case Number::kDouble:
        break;
    }
    return raw<double>();
  }

 private:
  template <class T>
  T raw() {
    if (bytes_.size() - at_ < sizeof(T))
      throw FileError(path_, "expected a PLY file with more data, found the end of the file");
    std::array<char, sizeof(T)> place;
    std::memcpy(place.data(), bytes_.data() + at_, sizeof(T));
    at_ += sizeof(T);
    if (form_ == Form::kBig) std::reverse(place.begin(), place.end());
    T value;
    std::memcpy(&value, place.data(), sizeof(T));
    return value;
  }

  const std::string& path_;
  std::string_view bytes_;
  Words words_;
  Form form_;
  std::size_t at_ = 0;
};

struct Header {
  Body::Form form = Body::Form::kText;
  std::vector<Element> elements;
  std::size_t end = 0;
};

Header read_header(const std::string& path, std::string_view bytes) {
  Header header;
  Words words(bytes);
  const auto fail = [&](const std::string& expected, std::string_view found) {
    throw FileError(
        path, words.line(),
        "expected a PLY file with " + expected + ", found " +
            (found.empty() ? "the end of the file" : "'" + std::string(found.substr(0, 40)) + "'"));
  };
  for (std::string_view word = words.next(); word != "end_header"; word = words.next()) {
    if (word == "format") {
      const std::string_view form = words.next();
      if (form == "binary_little_endian") {
        header.form = Body::Form::kLittle;
      } else if (form == "binary_big_endian") {
        header.form = Body::Form::kBig;
      } else if (form != "ascii") {
        fail("a known format", form);
      }
      words.skip_line();
    } else if (word == "element") {
      Element element;
      element.name = words.next();
      const std::string_view count = words.next();
      // Each element takes a byte at least, so no count can be larger than the file.
      if (!parse_number(count, element.count) || element.count < 0 ||
          element.count > static_cast<long>(bytes.size()))
        fail("a number of elements that fits it", count);
      header.elements.push_back(element);
    } else if (word == "property") {
      Property property;
      std::string_view type = words.next();
      if (type == "list") {
        type = words.next();
        property.length = number_named(type);
        if (!property.length) fail("a known type", type);
        type = words.next();
      }
      const auto number = number_named(type);
      if (!number) fail("a known type", type);
      property.number = *number;
      property.name = words.next();
      if (header.elements.empty()) fail("an element before its properties", property.name);
      header.elements.back().properties.push_back(property);
    } else if (word == "comment" || word == "obj_info" || word == "ply") {
      words.skip_line();
    } else {
      fail("a header", word);
    }
  }
  words.skip_line();
  header.end = std::min(words.position() + 1, bytes.size());
  return header;
}

}  // namespace

PolygonSoup read_ply(const std::string& path, std::string_view bytes) {
  const Header header = read_header(path, bytes);
  Body body(path, bytes, header.form, header.end);
  PolygonSoup soup;
  for (const Element& element : header.elements) {
    const bool vertex = element.name == "vertex";
    const bool face = element.name == "face";
    if (element.properties.empty()) continue;
    for (long i = 0; i < element.count; ++i) {
      Eigen::Vector3d p = Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
      std::vector<std::size_t> corners;
      for (const Property& property : element.properties) {
        if (property.length) {
          const bool indices =
              face && (property.name == "vertex_indices" || property.name == "vertex_index");
          const double length = body.next(*property.length);
          for (double k = 0; k < length; ++k) {
            const double value = body.next(property.number);
            // A negative or broken index becomes one that is out of range.
            if (indices)
              corners.push_back(value >= 0.0 && value < 4294967296.0
                                    ? static_cast<std::size_t>(value)
                                    : std::numeric_limits<std::size_t>::max() / 2);
          }
          continue;
        }
        const double value = body.next(property.number);
        if (vertex && property.name == "x") p.x() = value;
        if (vertex && property.name == "y") p.y() = value;
        if (vertex && property.name == "z") p.z() = value;
      }
      if (vertex) soup.points.push_back(p);
      if (face) soup.polygons.push_back(std::move(corners));
    }
  }
  return soup;
}

}  // namespace mortise::parts
