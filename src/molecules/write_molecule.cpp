// SPDX-License-Identifier: GPL-3.0-or-later
// PDB and mmCIF writers.
#include "mortise/molecules/write_molecule.hpp"

#include <cmath>
#include <cstdio>
#include <map>
#include <set>

#include "molecules/cif_value.hpp"
#include "molecules/hybrid36.hpp"
#include "mortise/core/errors.hpp"

namespace mortise {
namespace {

std::string describe(const Atom& atom) {
  return "atom " + atom.name + " of " + atom.residue_name + " " +
         std::to_string(atom.residue_number) + " in chain '" + atom.chain + "'";
}

[[noreturn]] void refuse(const Atom& atom, const std::string& expected) {
  throw InputError("PDB output: " + describe(atom) + ": expected " + expected +
                   "; write mmCIF instead");
}

/// The four name columns: the element's symbol is right aligned in the first two of them.
std::string name_columns(const Atom& atom) {
  if (atom.name.size() > 4) refuse(atom, "an atom name of at most 4 letters");
  const bool from_first = atom.name.size() == 4 || atom.element.size() == 2;
  std::string columns = (from_first ? "" : " ") + atom.name;
  columns.resize(4, ' ');
  return columns;
}

std::string upper(const std::string& text) {
  std::string result = text;
  for (char& c : result)
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  return result;
}

std::string serial_columns(int serial, const Atom& atom) {
  const auto text = molecules::encode_hybrid36(serial, 5);
  if (!text) refuse(atom, "at most 87,440,031 atoms");
  return *text;
}

std::string residue_columns(const Atom& atom) {
  if (atom.residue_name.size() > 4) refuse(atom, "a residue name of at most 4 letters");
  if (atom.chain.size() > 1) refuse(atom, "a chain name of one letter");
  if (atom.insertion_code.size() > 1) refuse(atom, "an insertion code of one letter");
  const auto number = molecules::encode_hybrid36(atom.residue_number, 4);
  if (!number) refuse(atom, "a residue number from -999 to 2,436,111");
  // Columns 18-20, right aligned; a fourth letter stands in column 21, as CHARMM has it.
  std::string text = atom.residue_name;
  if (text.size() < 3) text.insert(0, 3 - text.size(), ' ');
  text.resize(4, ' ');
  return text + (atom.chain.empty() ? " " : atom.chain) + *number +
         (atom.insertion_code.empty() ? " " : atom.insertion_code);
}

}  // namespace

std::string format_pdb_atoms(const Molecule& molecule, const RigidMotion& motion,
                             const FormatPdbOptions& options) {
  std::string text;
  text.reserve(81 * molecule.atoms.size());
  int serial = options.first_serial;
  char numbers[64];
  for (std::size_t i = 0; i < molecule.atoms.size(); ++i, ++serial) {
    const Atom& atom = molecule.atoms[i];
    const Eigen::Vector3d x = motion * atom.position;
    if (!(x.minCoeff() > -999.9995 && x.maxCoeff() < 9999.9995))  // what rounds into eight columns
      refuse(atom, "coordinates between -999.999 and 9999.999");
    std::snprintf(numbers, sizeof numbers, "   %8.3f%8.3f%8.3f  1.00  0.00          %2.2s  \n",
                  x[0], x[1], x[2], upper(atom.element).c_str());
    text += atom.hetero ? "HETATM" : "ATOM  ";
    text += serial_columns(serial, atom);
    text += ' ';
    text += name_columns(atom);
    text += ' ';
    text += residue_columns(atom);
    text += numbers;
    const Atom* next = i + 1 < molecule.atoms.size() ? &molecule.atoms[i + 1] : nullptr;
    if (!atom.hetero && (next == nullptr || next->hetero || next->chain != atom.chain))
      text += "TER   " + serial_columns(++serial, atom) + "      " + residue_columns(atom) + "\n";
  }
  return text;
}

std::string format_pdb_model(int number, const std::string& atoms) {
  if (number < 1 || number > 99'999'999)
    throw InputError("PDB output: expected a model number from 1 to 99,999,999, found " +
                     std::to_string(number));
  char line[32];
  // Columns 11-14 hold the number; larger ones need the columns after them.
  std::snprintf(line, sizeof line, number <= 9999 ? "MODEL     %4d\n" : "MODEL     %d\n", number);
  return line + atoms + "ENDMDL\n";
}

std::string format_mmcif_head(const std::string& block_name) {
  std::string name = block_name.empty() ? "mortise" : block_name;
  for (char& c : name)
    if (c <= ' ' || c > '~') c = '_';
  std::string text = "data_" + name + "\n#\nloop_\n";
  for (const char* item : {"group_PDB",      "id",
                           "type_symbol",    "label_atom_id",
                           "label_alt_id",   "label_comp_id",
                           "label_asym_id",  "label_entity_id",
                           "label_seq_id",   "pdbx_PDB_ins_code",
                           "Cartn_x",        "Cartn_y",
                           "Cartn_z",        "occupancy",
                           "B_iso_or_equiv", "auth_seq_id",
                           "auth_comp_id",   "auth_asym_id",
                           "auth_atom_id",   "pdbx_PDB_model_num"})
    text += std::string("_atom_site.") + item + "\n";
  return text;
}

std::string format_mmcif_atoms(const Molecule& molecule, const RigidMotion& motion,
                               const FormatMmcifOptions& options) {
  using molecules::cif_value;
  std::string text;
  text.reserve(96 * molecule.atoms.size());
  int serial = options.first_serial;
  char numbers[160];
  for (const Atom& atom : molecule.atoms) {
    const Eigen::Vector3d x = motion * atom.position;
    if (!x.allFinite())
      throw InputError("mmCIF output: " + describe(atom) + ": expected finite coordinates");
    const std::string name = cif_value(atom.name), residue = cif_value(atom.residue_name),
                      chain = cif_value(atom.chain), number = std::to_string(atom.residue_number);
    text += (atom.hetero ? "HETATM " : "ATOM ") + std::to_string(serial++) + ' ' +
            cif_value(upper(atom.element)) + ' ' + name + " . " + residue + ' ' + chain + " . " +
            (atom.hetero ? "." : number) + ' ' +
            (atom.insertion_code.empty() ? "?" : cif_value(atom.insertion_code));
    std::snprintf(numbers, sizeof numbers, " %.3f %.3f %.3f 1.00 0.00 ", x[0], x[1], x[2]);
    text += numbers;
    text += number + ' ' + residue + ' ' + chain + ' ' + name + ' ' +
            std::to_string(options.model) + '\n';
  }
  return text;
}

Molecule with_distinct_chains(Molecule moving, const Molecule& fixed) {
  std::set<std::string> taken;
  for (const Atom& atom : fixed.atoms) taken.insert(atom.chain);
  const std::set<std::string> of_fixed = taken;
  for (const Atom& atom : moving.atoms) taken.insert(atom.chain);
  const std::string letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789";
  const auto free_name = [&] {
    for (const char a : letters)
      if (std::string name(1, a); taken.insert(name).second) return name;
    for (const char a : letters)
      for (const char b : letters)
        if (std::string name{a, b}; taken.insert(name).second) return name;
    throw InputError("with_distinct_chains: expected fewer than 3,906 chains, found more");
  };
  std::map<std::string, std::string> renamed;
  for (Atom& atom : moving.atoms) {
    if (!of_fixed.contains(atom.chain)) continue;
    auto it = renamed.find(atom.chain);
    if (it == renamed.end()) it = renamed.emplace(atom.chain, free_name()).first;
    atom.chain = it->second;
  }
  return moving;
}

}  // namespace mortise
