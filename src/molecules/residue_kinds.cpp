// SPDX-License-Identifier: GPL-3.0-or-later
// Residue names of polymers and water, and chemical elements.
#include "molecules/residue_kinds.hpp"

#include <algorithm>
#include <array>
#include <cctype>

namespace mortise::molecules {
namespace {

// Names of the PDB's chemical component dictionary, and those of AMBER, CHARMM and GROMACS for
// protonation states.
constexpr std::array<std::string_view, 90> kAminoAcids = {
    "ACE", "AIB", "ALA", "ALY", "ARG", "ARN", "ASH", "ASN", "ASP", "ASX", "BMT", "CGU", "CME",
    "CMT", "CSD", "CSO", "CSS", "CSW", "CSX", "CYM", "CYS", "CYX", "DAL", "DAR", "DLE", "DSN",
    "DVA", "FME", "FTR", "GLH", "GLN", "GLU", "GLX", "GLY", "HIC", "HID", "HIE", "HIP", "HIS",
    "HSD", "HSE", "HSP", "HYP", "IAS", "ILE", "KCX", "LEU", "LLP", "LYN", "LYS", "LYZ", "M3L",
    "MEN", "MET", "MHO", "MLE", "MLY", "MLZ", "MSE", "MVA", "NH2", "NLE", "NME", "NVA", "OCS",
    "ORN", "PCA", "PHD", "PHE", "PRO", "PTR", "PYL", "SAC", "SAR", "SCY", "SEC", "SEP", "SER",
    "SMC", "SNC", "STA", "TPO", "TRP", "TYR", "TYS", "THR", "UNK", "VAL", "YCM", "5HP"};

constexpr std::array<std::string_view, 39> kNucleotides = {
    "A",   "C",   "G",   "U",   "T",   "I",   "N",   "DA",  "DC",  "DG",  "DT",  "DU",  "DI",
    "DN",  "RA",  "RC",  "RG",  "RU",  "ADE", "CYT", "GUA", "URA", "THY", "PSU", "5MU", "5MC",
    "1MA", "2MG", "7MG", "M2G", "H2U", "OMC", "OMG", "OMU", "YYG", "5BU", "5CM", "8OG", "6OG"};

constexpr std::array<std::string_view, 9> kWaters = {"HOH", "WAT",  "H2O",  "DOD", "SOL",
                                                     "TIP", "TIP3", "TIP4", "SPC"};

constexpr std::string_view kElements =
    " H HE LI BE B C N O F NE NA MG AL SI P S CL AR K CA SC TI V CR MN FE CO NI CU ZN GA GE AS SE "
    "BR KR "
    "RB SR Y ZR NB MO TC RU RH PD AG CD IN SN SB TE I XE CS BA LA CE PR ND PM SM EU GD TB DY HO ER "
    "TM "
    "YB LU HF TA W RE OS IR PT AU HG TL PB BI PO AT RN FR RA AC TH PA U NP PU AM CM ";

std::string upper_letters(std::string_view text) {
  // The leading letters after any digits: "1HB2" gives "HB", "FE1" gives "FE".
  std::string letters;
  for (const char c : text) {
    const auto u = static_cast<unsigned char>(c);
    if (std::isalpha(u)) {
      letters += static_cast<char>(std::toupper(u));
    } else if (!letters.empty() || (!std::isdigit(u) && c != ' ' && c != '\'' && c != '"')) {
      break;
    }
  }
  return letters;
}

std::string symbol_of(std::string_view upper) {
  if (upper == "D") return "H";
  if (upper.empty() || upper.size() > 2) return {};
  std::string key = " ";
  key += upper;
  key += ' ';
  if (kElements.find(key) == std::string_view::npos) return {};
  std::string symbol(upper);
  if (symbol.size() == 2)
    symbol[1] = static_cast<char>(std::tolower(static_cast<unsigned char>(symbol[1])));
  return symbol;
}

}  // namespace

bool is_water(std::string_view name) {
  return std::find(kWaters.begin(), kWaters.end(), name) != kWaters.end();
}

bool is_amino_acid(std::string_view name) {
  if (std::find(kAminoAcids.begin(), kAminoAcids.end(), name) != kAminoAcids.end()) return true;
  // AMBER writes chain ends as NALA and CALA.
  return name.size() == 4 && (name[0] == 'N' || name[0] == 'C') && is_amino_acid(name.substr(1));
}

bool is_nucleotide(std::string_view name) {
  return std::find(kNucleotides.begin(), kNucleotides.end(), name) != kNucleotides.end();
}

std::string element_symbol(std::string_view text) {
  std::string upper;
  for (const char c : text) upper += static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return symbol_of(upper);
}

std::string element_from_name(std::string_view padded_name, std::string_view residue_name) {
  const std::string letters = upper_letters(padded_name);
  if (letters.empty()) return {};
  const bool polymer = is_amino_acid(residue_name) || is_nucleotide(residue_name);
  if (polymer) {
    if (letters.starts_with("SE") && (residue_name == "MSE" || residue_name == "SEC")) return "Se";
    return symbol_of(letters.substr(0, 1));
  }
  // An ion's residue bears its element's name: CA, ZN, FE2.
  std::string residue_symbol = symbol_of(upper_letters(residue_name));
  if (letters.size() == 2 && upper_letters(residue_name) == letters && !residue_symbol.empty())
    return residue_symbol;
  // Two letters and no more, starting in the first column ("FE  ", "CL1 ", not " CA " nor "CAB ").
  // Bare names tell no column, so only symbols that no C, N, O, P, S or H atom's name begins with
  // count there.
  std::string two = letters.size() == 2 ? symbol_of(letters) : std::string();
  const bool left = padded_name.size() == 4 && padded_name[0] != ' ' &&
                    (padded_name[2] == ' ' || padded_name[3] == ' ');
  const bool distinct = std::string_view("CNOPSHD").find(letters[0]) == std::string_view::npos ||
                        letters == "CL" || letters == "SE";
  if (!two.empty() && (left || distinct)) return two;
  return symbol_of(letters.substr(0, 1));
}

bool element_fits_name(std::string_view symbol, std::string_view name,
                       std::string_view residue_name) {
  const std::string letters = upper_letters(name);
  if (letters.empty() || symbol.empty()) return false;
  if (symbol == "H" && letters[0] == 'D') return true;
  if (symbol.size() == 1) return letters[0] == symbol[0];
  if (letters.size() < 2 || letters[0] != symbol[0] ||
      letters[1] != std::toupper(static_cast<unsigned char>(symbol[1])))
    return false;
  // In a polymer CD is a carbon and HG a hydrogen, whatever the column says.
  const bool polymer = is_amino_acid(residue_name) || is_nucleotide(residue_name);
  return !polymer || symbol == "Se" || symbol == "Br" || symbol == "Cl" || symbol == "As";
}

}  // namespace mortise::molecules
