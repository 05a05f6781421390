// SPDX-License-Identifier: GPL-3.0-or-later
// Atom records of the atom_site category of a PDBx/mmCIF file (CIF 1.1 syntax).
#include <array>
#include <charconv>

#include "molecules/atom_records.hpp"
#include "molecules/residue_kinds.hpp"
#include "mortise/core/errors.hpp"

namespace mortise::molecules {
namespace {

struct Token {
  std::string_view text;
  long line = 0;
  bool quoted = false;

  [[nodiscard]] bool is_name() const { return !quoted && text.starts_with('_'); }
  [[nodiscard]] bool is_keyword() const {
    return !quoted && (text == "loop_" || text.starts_with("data_") || text.starts_with("save_"));
  }
};

bool blank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

class Tokenizer {
 public:
  Tokenizer(const std::string& path, std::string_view text) : path_(path), text_(text) {}

  /// False at the end of the file.
  bool next(Token& token) {
    skip();
    if (at_ >= text_.size()) return false;
    token = {{}, line_, false};
    const char c = text_[at_];
    if (c == ';' && (at_ == 0 || text_[at_ - 1] == '\n')) return text_field(token);
    if (c == '\'' || c == '"') return quoted(token, c);
    std::size_t end = at_;
    while (end < text_.size() && !blank(text_[end])) ++end;
    token.text = text_.substr(at_, end - at_);
    at_ = end;
    return true;
  }

 private:
  void skip() {
    while (at_ < text_.size()) {
      if (text_[at_] == '#')
        at_ = std::min(text_.find('\n', at_), text_.size());
      else if (!blank(text_[at_]))
        return;
      else if (text_[at_++] == '\n')
        ++line_;
    }
  }
  bool text_field(Token& token) {
    const std::size_t end = text_.find("\n;", at_);
    if (end == std::string_view::npos)
      throw FileError(path_, token.line,
                      "text field: expected a line with ';' to end it, found none");
    token.text = text_.substr(at_ + 1, end - at_ - 1);
    token.quoted = true;
    for (std::size_t i = at_; i <= end; ++i) line_ += text_[i] == '\n';
    at_ = end + 2;
    return true;
  }
  bool quoted(Token& token, char quote) {
    for (std::size_t i = at_ + 1; i < text_.size() && text_[i] != '\n'; ++i) {
      if (text_[i] != quote || (i + 1 < text_.size() && !blank(text_[i + 1]))) continue;
      token.text = text_.substr(at_ + 1, i - at_ - 1);
      token.quoted = true;
      at_ = i + 1;
      return true;
    }
    throw FileError(path_, token.line, "expected a closing quote, found the end of the line");
  }

  const std::string& path_;
  std::string_view text_;
  std::size_t at_ = 0;
  long line_ = 1;
};

enum Item {
  kX,
  kY,
  kZ,
  kName,
  kResidue,
  kNumber,
  kChain,
  kLabelName,
  kLabelResidue,
  kLabelNumber,
  kLabelChain,
  kInsertion,
  kAlternate,
  kElement,
  kModel,
  kItems
};
constexpr std::array<std::string_view, kItems> kItemNames = {
    "Cartn_x",       "Cartn_y",           "Cartn_z",       "auth_atom_id",  "auth_comp_id",
    "auth_seq_id",   "auth_asym_id",      "label_atom_id", "label_comp_id", "label_seq_id",
    "label_asym_id", "pdbx_PDB_ins_code", "label_alt_id",  "type_symbol",   "pdbx_PDB_model_num"};

/// One row of atom_site; items that the file lacks have no text.
struct Row {
  std::array<Token, kItems> items;

  [[nodiscard]] std::string_view value(Item item) const {
    const Token& token = items[item];
    return !token.quoted && (token.text == "." || token.text == "?") ? std::string_view()
                                                                     : token.text;
  }
  /// The authors' value, or the label where there is none.
  [[nodiscard]] std::string_view value(Item item, Item fallback) const {
    return value(item).empty() ? value(fallback) : value(item);
  }
};

int to_int(const Row& row, std::string_view text, std::string_view what, const std::string& path) {
  int value = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || stop != end)
    throw FileError(path, row.items[kX].line,
                    std::string(what) + ": expected a number, found '" + std::string(text) + "'");
  return value;
}

AtomRecord to_record(const Row& row, const std::string& path) {
  AtomRecord record;
  Atom& atom = record.atom;
  record.line = row.items[kX].line;
  atom.name = row.value(kName, kLabelName);
  atom.residue_name = row.value(kResidue, kLabelResidue);
  atom.chain = row.value(kChain, kLabelChain);
  atom.insertion_code = row.value(kInsertion);
  record.alternate = row.value(kAlternate);
  if (atom.name.empty())
    throw FileError(path, record.line, "atom_site: expected an atom name, found none");
  const std::string_view number = row.value(kNumber, kLabelNumber);
  if (!number.empty()) atom.residue_number = to_int(row, number, "atom_site.auth_seq_id", path);
  if (!row.value(kModel).empty())
    record.model = to_int(row, row.value(kModel), "atom_site.pdbx_PDB_model_num", path);
  for (int axis = 0; axis < 3; ++axis) {
    record.coordinates[axis] = row.items[kX + axis].text;
    atom.position[axis] =
        parse_coordinate(record.coordinates[axis], "xyz"[axis], path, row.items[kX + axis].line);
  }
  atom.element = element_symbol(row.value(kElement));
  if (atom.element.empty()) {
    atom.element = element_from_name(atom.name, atom.residue_name);
    record.element_guessed = true;
  }
  return record;
}

int item_of(std::string_view name) {
  constexpr std::string_view kCategory = "_atom_site.";
  for (int i = 0; i < kItems; ++i)
    if (name.substr(kCategory.size()) == kItemNames[i]) return i;
  return -1;
}

void check_columns(const std::array<bool, kItems>& present, const std::string& path, long line) {
  const auto need = [&](bool there, std::string_view name) {
    if (!there)
      throw FileError(path, line,
                      "expected _atom_site." + std::string(name) + ", found no such item");
  };
  for (const Item axis : {kX, kY, kZ}) need(present[axis], kItemNames[axis]);
  need(present[kName] || present[kLabelName], "auth_atom_id or label_atom_id");
}

}  // namespace

std::vector<AtomRecord> scan_mmcif(const std::string& path, std::string_view text) {
  Tokenizer tokenizer(path, text);
  std::vector<AtomRecord> records;
  Token token;
  bool more = tokenizer.next(token);
  while (more && !(token.is_name() && token.text.starts_with("_atom_site."))) {
    more = tokenizer.next(token);
  }
  if (!more) return records;

  // Either a loop, whose header stands before its values, or one atom as name-value pairs.
  std::vector<int> columns;
  std::array<bool, kItems> present{};
  const long header_line = token.line;
  Row single;
  bool pairs = false;
  while (more && token.is_name() && token.text.starts_with("_atom_site.")) {
    const int item = item_of(token.text);
    columns.push_back(item);
    if (item >= 0) present[item] = true;
    more = tokenizer.next(token);
    if (more && !token.is_name() && !token.is_keyword() && (pairs || columns.size() == 1)) {
      pairs = true;
      if (item >= 0) single.items[item] = token;
      more = tokenizer.next(token);
    }
  }
  check_columns(present, path, header_line);
  if (pairs) {
    records.push_back(to_record(single, path));
    return records;
  }
  while (more && !token.is_name() && !token.is_keyword()) {
    Row row;
    const long line = token.line;
    for (std::size_t i = 0; i < columns.size(); ++i) {
      if (!more || token.is_name() || token.is_keyword())
        throw FileError(path, line,
                        "atom_site row cut off: expected " + std::to_string(columns.size()) +
                            " values, found " + std::to_string(i));
      if (columns[i] >= 0) row.items[columns[i]] = token;
      more = tokenizer.next(token);
    }
    records.push_back(to_record(row, path));
  }
  return records;
}

}  // namespace mortise::molecules
