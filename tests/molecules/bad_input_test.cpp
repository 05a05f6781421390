// SPDX-License-Identifier: GPL-3.0-or-later
// Every bad structure file gets one clear line, with its line number where there is one.
#include <gmock/gmock.h>
#include <sys/stat.h>

#include "helpers/temporary_file.hpp"
#include "molecules/pdb_lines.hpp"
#include "mortise/core/errors.hpp"
#include "mortise/molecules/read_molecule.hpp"

namespace mortise {
namespace {

using test::backbone;
using test::pdb_line;
using ::testing::HasSubstr;
using ::testing::StartsWith;
using tests::TemporaryFile;

std::string error_of(const std::string& spec) {
  try {
    (void)read_molecule(parse_molecule_spec(spec));
  } catch (const InputError& e) {
    const std::string text = e.what();
    EXPECT_EQ(text.find('\n'), std::string::npos) << text;
    return text;
  }
  return "no error";
}

/// The message for a file of this content, without its path.
std::string error_in(const std::string& content, const std::string& selection = "",
                     const std::string& name = "x.pdb") {
  const TemporaryFile file(name, content);
  std::string text = error_of(file.path() + selection);
  return text.starts_with(file.path()) ? text.substr(file.path().size()) : "(no path) " + text;
}

TEST(BadInput, MissingUnreadableFolderEmpty) {
  EXPECT_EQ(error_of("/nosuch/x.pdb"), "/nosuch/x.pdb: expected a structure file, found none");
  EXPECT_EQ(error_of("/"), "/: expected a structure file, found a directory");
  EXPECT_EQ(error_in(""), ": expected a structure, found an empty file");
  EXPECT_EQ(error_in("HEADER    X\nEND\n"), ": expected atoms, found no ATOM or HETATM records");
  EXPECT_EQ(error_in("\n\n"), ": expected atoms, found no ATOM or HETATM records");
  EXPECT_EQ(error_in("data_x\n_a.b 1\n", "", "x.cif"), ": expected atoms, found no atom_site rows");
}

TEST(BadInput, FilesWithoutPermission) {
  const TemporaryFile file("x.pdb", backbone("A", "1", 0));
  chmod(file.path().c_str(), 0);
  const bool root = geteuid() == 0;  // root reads every file, so be someone else for a moment
  if (root) {
    ASSERT_EQ(seteuid(65534), 0);
  }
  const std::string found = error_of(file.path());
  if (root) {
    ASSERT_EQ(seteuid(0), 0);
  }
  EXPECT_EQ(found, file.path() + ": cannot be opened: Permission denied");
}

TEST(BadInput, ChainsAndModelsThatAreNotThere) {
  const std::string text = backbone("A", "1", 0) + backbone("C", "1", 9);
  EXPECT_EQ(error_in(text, ":B"), ": expected chain B, found chains A, C");
  EXPECT_EQ(error_in(text, ":A,a"), ": expected chain a, found chains A, C");
  EXPECT_EQ(error_in(text, "#2"), ": expected model 2, found only model 1");
  const std::string models =
      "MODEL        3\n" + text + "ENDMDL\nMODEL        5\n" + text + "ENDMDL\n";
  EXPECT_EQ(error_in(models, "#4"), ": expected model 4, found models 3, 5");
}

TEST(BadInput, TracesAndPoints) {
  std::string trace, phosphates;
  for (int i = 0; i < 5; ++i) {
    const std::string number = std::to_string(i + 1);
    trace += pdb_line({.number = number.c_str(), .x = 3.8 * i});
    phosphates += pdb_line(
        {.name = " P  ", .residue = " DA", .chain = "D", .number = number.c_str(), .x = 6.0 * i});
  }
  EXPECT_EQ(
      error_in(backbone("B", "1", 40) + trace),
      ": chain A: expected all heavy atoms, found 5 of 5 residues with a CA (or P) atom only");
  EXPECT_THAT(error_in(phosphates), HasSubstr("chain D: expected all heavy atoms"));
  EXPECT_EQ(error_in(backbone("B", "1", 40) + trace, ":B"), "(no path) no error");
  std::string point;
  for (const char* name : {" N  ", " CA ", " C  "}) point += pdb_line({.name = name});
  EXPECT_EQ(error_in(point), ": expected atoms in different places, found all 3 in one point");
  EXPECT_EQ(error_in(pdb_line({.record = "HETATM", .name = " O  ", .residue = "HOH"})),
            ": nothing is left of 1 atom after dropping waters, hydrogens and unwanted groups");
}

TEST(BadInput, CoordinatesThatAreNoPlaces) {
  const auto with = [](const std::string& x) {
    std::string line = pdb_line({.name = " N  "});
    return "REMARK\n" + backbone("A", "7", 4) + line.replace(30, 8, x);
  };
  EXPECT_EQ(error_in(with("     nan")),
            ":6: x coordinate: expected a finite number below 9999 in size, found 'nan'");
  EXPECT_EQ(error_in(with("     inf")),
            ":6: x coordinate: expected a finite number below 9999 in size, found 'inf'");
  EXPECT_EQ(error_in(with("9999.000")),
            ":6: x coordinate: expected a finite number below 9999 in size, found '9999.000'");
  EXPECT_EQ(error_in(with("  -1e300")),
            ":6: x coordinate: expected a finite number below 9999 in size, found '-1e300'");
  EXPECT_EQ(error_in(with("********")), ":6: x coordinate: expected a number, found '********'");
  EXPECT_EQ(error_in(with("        ")), ":6: x coordinate: expected a number, found ''");
  EXPECT_EQ(error_in(with("1.0  2.0")), ":6: x coordinate: expected a number, found '1.0  2.0'");
  EXPECT_EQ(error_in(with("  0x10p2")), ":6: x coordinate: expected a number, found '0x10p2'");
}

TEST(BadInput, RecordsCutOff) {
  const std::string text = backbone("A", "1", 0);
  EXPECT_EQ(error_in(text + pdb_line({}).substr(0, 50)),
            ":5: atom record cut off: expected coordinates up to column 54, found 50 columns");
  EXPECT_EQ(error_in(text + "HETATM"),
            ":5: atom record cut off: expected coordinates up to column 54, found 6 columns");
  EXPECT_EQ(error_in(text + "ATOM"), ":5: atom record cut off after 'ATOM'");
  EXPECT_EQ(error_in(text + pdb_line({.name = "    "})),
            ":5: columns 13-16: expected an atom name, found blanks");
  EXPECT_EQ(error_in(text + pdb_line({.number = "    "})),
            ":5: columns 23-26: expected a residue number, found '    '");
  EXPECT_EQ(error_in(text + pdb_line({.number = " 1.5"})),
            ":5: columns 23-26: expected a residue number, found ' 1.5'");
  EXPECT_EQ(error_in("MODEL       x\n" + text), ":1: MODEL record: expected a number, found 'x'");
}

TEST(BadInput, OtherKindsOfFile) {
  EXPECT_EQ(error_in("<!DOCTYPE html>\n<html><body>404</body></html>"),
            ":1: expected a PDB or mmCIF file, found an HTML page (a download that failed?)");
  EXPECT_EQ(error_in("\n  <html>\n", "", "x.cif"),
            ":2: expected a PDB or mmCIF file, found an HTML page (a download that failed?)");
  EXPECT_EQ(error_in("<?xml version=\"1.0\"?>\n<PDBx:datablock>"),
            ":1: expected a PDB or mmCIF file, found XML");
  EXPECT_EQ(error_in(std::string("\x7f"
                                 "ELF\0\0\1",
                                 7)),
            ": expected a PDB or mmCIF file, found binary data");
  EXPECT_EQ(error_in(std::string(4000, '\x03')),
            ": expected a PDB or mmCIF file, found binary data");
  EXPECT_EQ(error_in("solid cube\nfacet normal 0 0 1\n"),
            ": expected atoms, found no ATOM or HETATM records");
}

TEST(BadInput, DamagedGzip) {
  std::ifstream file(std::string(MORTISE_SOURCE_DIR) + "/molecules/1tii_ligand.pdb.gz",
                     std::ios::binary);
  const std::string packed((std::istreambuf_iterator<char>(file)), {});
  ASSERT_GT(packed.size(), 10000u);
  EXPECT_THAT(error_in(packed.substr(0, 9000), "", "x.pdb.gz"),
              StartsWith(": expected gzip data, found it damaged or cut off after "));
  EXPECT_THAT(error_in(packed.substr(0, 5), "", "x.pdb.gz"),
              StartsWith(": expected gzip data, found it damaged or cut off"));
  std::string flipped = packed;
  for (std::size_t i = 5000; i < 5100; ++i) flipped[i] = static_cast<char>(flipped[i] ^ 0x55);
  EXPECT_THAT(error_in(flipped, "", "x.pdb.gz"),
              StartsWith(": expected gzip data, found it damaged"));
  std::string bad_sum = packed;
  bad_sum[bad_sum.size() - 6] = static_cast<char>(bad_sum[bad_sum.size() - 6] ^ 1);
  EXPECT_THAT(error_in(bad_sum, "", "x.pdb.gz"),
              StartsWith(": expected gzip data, found it damaged"));
  EXPECT_EQ(error_in(backbone("A", "1", 0), "", "x.pdb.gz"),
            ": expected gzip data after its name, found something else");
}

TEST(BadInput, Mmcif) {
  const std::string head =
      "data_x\nloop_\n_atom_site.auth_atom_id\n_atom_site.Cartn_x\n_atom_site.Cartn_y\n_atom_site."
      "Cartn_z\n";
  EXPECT_EQ(error_in(head + "CA 1 2 3\nCB 4 5\n"),
            ":8: atom_site row cut off: expected 4 values, found 3");
  EXPECT_EQ(error_in(head + "CA 1 2 3\nCB 4 5\nloop_\n_b.c\n1\n"),
            ":8: atom_site row cut off: expected 4 values, found 3");
  EXPECT_EQ(error_in(head + "CA 1 2 ?\n"), ":7: z coordinate: expected a number, found '?'");
  EXPECT_EQ(error_in(head + "CA 1 NaN 3\n"),
            ":7: y coordinate: expected a finite number below 9999 in size, found 'NaN'");
  EXPECT_EQ(error_in(head + "'CA 1 2 3\n"),
            ":7: expected a closing quote, found the end of the line");
  EXPECT_EQ(error_in(head + "CA\n;text 1 2 3\n"),
            ":8: text field: expected a line with ';' to end it, found none");
  EXPECT_EQ(error_in("data_x\nloop_\n_atom_site.id\n_atom_site.Cartn_x\n1 2\n"),
            ":3: expected _atom_site.Cartn_y, found no such item");
  EXPECT_EQ(
      error_in(
          "data_x\nloop_\n_atom_site.Cartn_x\n_atom_site.Cartn_y\n_atom_site.Cartn_z\n1 2 3\n"),
      ":3: expected _atom_site.auth_atom_id or label_atom_id, found no such item");
  EXPECT_EQ(error_in(head + ". 1 2 3\n"), ":7: atom_site: expected an atom name, found none");
}

TEST(BadInput, ManyAtomsAreNoError) {
  // 120,000 atoms: serial numbers overflow to stars, residue numbers go on as hybrid-36.
  std::string text;
  const std::string digits = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZ";
  for (int r = 0; r < 30000; ++r) {
    std::string number = std::to_string(r + 1);
    if (r + 1 >= 10000) {
      number.clear();
      for (int rest = r + 1 - 10000 + 10 * 36 * 36 * 36, i = 0; i < 4; ++i, rest /= 36)
        number.insert(0, 1, digits[rest % 36]);
    }
    for (const char* name : {" N  ", " CA ", " C  ", " O  "})
      text += pdb_line({.serial = "*****",
                        .name = name,
                        .number = number.c_str(),
                        .x = 3.0 * (r % 100),
                        .y = 3.0 * (r / 100),
                        .z = name[1] * 0.1});
  }
  const TemporaryFile file("x.pdb", text);
  const ReadMoleculeResult result = read_molecule({.path = file.path()});
  ASSERT_EQ(result.molecule.atoms.size(), 120000u);
  EXPECT_EQ(residues(result.molecule).size(), 30000u);
  for (const std::size_t i : {0u, 39996u, 119996u}) {
    EXPECT_EQ(result.molecule.atoms[i].residue_number, static_cast<int>(i) / 4 + 1);
    EXPECT_NEAR(result.molecule.atoms[i].position[0], 3.0 * static_cast<double>(i / 4 % 100), 1e-9);
    EXPECT_NEAR(result.molecule.atoms[i].position[1], 3.0 * static_cast<double>(i / 400), 1e-9);
  }
}

}  // namespace
}  // namespace mortise
