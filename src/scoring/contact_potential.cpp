// SPDX-License-Identifier: GPL-3.0-or-later
// Contact potentials as tables: kernels, parsing, the fitted one.
#include "mortise/scoring/contact_potential.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "contact_table.inc"
#include "mortise/core/errors.hpp"
#include "mortise/core/read_file.hpp"
#include "mortise/molecules/contact_types.hpp"
#include "scoring/contact_steps.hpp"

namespace mortise {

static_assert(kContactRange == double{kFarEnd});

namespace {

// Reads lines that hold something, counting all.
class Lines {
 public:
  Lines(const std::string& text, std::string name) : stream_(text), name_(std::move(name)) {}

  std::istringstream next(const std::string& expected) {
    std::string line;
    while (std::getline(stream_, line)) {
      ++number_;
      const std::size_t first = line.find_first_not_of(" \t\r");
      if (first != std::string::npos && line[first] != '#') return std::istringstream(line);
    }
    throw FileError(name_, number_, "expected " + expected + ", found the end");
  }
  [[noreturn]] void refuse(const std::string& message) const {
    throw FileError(name_, number_, message);
  }

 private:
  std::istringstream stream_;
  std::string name_;
  long number_ = 0;
};

void expect_word(Lines& lines, std::istringstream& line, const std::string& word) {
  std::string found;
  if (!(line >> found) || found != word)
    lines.refuse("expected '" + word + "', found '" + found + "'");
}

Eigen::MatrixXd read_matrix(Lines& lines, const std::string& word, int types) {
  std::istringstream head = lines.next("'" + word + "'");
  expect_word(lines, head, word);
  Eigen::MatrixXd matrix(types, types);
  for (int a = 0; a < types; ++a) {
    std::istringstream row = lines.next("a row of " + std::to_string(types) + " numbers");
    for (int b = 0; b < types; ++b)
      if (!(row >> matrix(a, b)) || !std::isfinite(matrix(a, b)))
        lines.refuse("expected " + std::to_string(types) + " numbers, found " + std::to_string(b));
    std::string rest;
    if (row >> rest)
      lines.refuse("expected " + std::to_string(types) + " numbers, found more: '" + rest + "'");
  }
  if ((matrix - matrix.transpose()).cwiseAbs().maxCoeff() >
      1e-9 * std::max(1.0, matrix.cwiseAbs().maxCoeff()))
    lines.refuse("the table '" + word + "' that ends here is not symmetric");
  return matrix;
}

}  // namespace

double near_contact(double d) {
  return std::clamp((double{kNearEnd} - d) / double{kContactStep}, 0.0, 1.0);
}

double far_contact(double d) {
  return std::clamp(std::min((d - double{kFarStart}) / double{kContactStep}, kContactRange - d),
                    0.0, 1.0);
}

ContactPotential parse_contact_potential(const std::string& text, int types,
                                         const std::string& name) {
  Lines lines(text, name);
  ContactPotential potential;
  std::istringstream head = lines.next("'shape'");
  expect_word(lines, head, "shape");
  if (!(head >> potential.shape)) lines.refuse("expected a number after 'shape'");
  potential.near = read_matrix(lines, "near", types);
  potential.far = read_matrix(lines, "far", types);
  return potential;
}

ContactPotential read_contact_potential(const std::string& path, int types) {
  return parse_contact_potential(read_whole_file(path), types, path);
}

const ContactPotential& fitted_contact_potential() {
  static const ContactPotential potential =
      parse_contact_potential(kContactTable, kContactTypes, "the built-in contact potential");
  return potential;
}

}  // namespace mortise
