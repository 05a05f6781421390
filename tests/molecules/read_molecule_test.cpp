// SPDX-License-Identifier: GPL-3.0-or-later
// Reading: selection of chains, models, alternates and groups; elements; numbering; both formats.
#include "mortise/molecules/read_molecule.hpp"

#include <gmock/gmock.h>

#include <boost/iostreams/copy.hpp>
#include <boost/iostreams/device/back_inserter.hpp>
#include <boost/iostreams/filter/gzip.hpp>
#include <boost/iostreams/filtering_stream.hpp>
#include <thread>

#include "helpers/temporary_file.hpp"
#include "molecules/pdb_lines.hpp"
#include "mortise/core/errors.hpp"

namespace mortise {
namespace {

using test::backbone;
using test::pdb_line;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using tests::TemporaryFile;

const std::string kSamples = std::string(MORTISE_SOURCE_DIR) + "/molecules/";

ReadMoleculeResult read(const std::string& spec, const ReadMoleculeOptions& options = {}) {
  return read_molecule(parse_molecule_spec(spec), options);
}

ReadMoleculeResult read_content(const std::string& content, const std::string& selection = "",
                                const ReadMoleculeOptions& options = {},
                                const std::string& name = "x.pdb") {
  const TemporaryFile file(name, content);
  return read(file.path() + selection, options);
}

std::vector<std::string> names(const ReadMoleculeResult& result) {
  std::vector<std::string> list;
  for (const Atom& atom : result.molecule.atoms) list.push_back(atom.name);
  return list;
}

std::vector<std::string> elements(const ReadMoleculeResult& result) {
  std::vector<std::string> list;
  for (const Atom& atom : result.molecule.atoms) list.push_back(atom.element);
  return list;
}

TEST(ParseMoleculeSpec, SplitsPathModelAndChains) {
  const MoleculeSpec plain = parse_molecule_spec("dir.d/x.pdb");
  EXPECT_EQ(plain.path, "dir.d/x.pdb");
  EXPECT_EQ(plain.model, 0);
  EXPECT_TRUE(plain.chains.empty());
  const MoleculeSpec full = parse_molecule_spec("a:b/x.cif.gz#12:A,BB");
  EXPECT_EQ(full.path, "a:b/x.cif.gz");
  EXPECT_EQ(full.model, 12);
  EXPECT_THAT(full.chains, ElementsAre("A", "BB"));
  const TemporaryFile odd("a#1:b.pdb", "");
  EXPECT_EQ(parse_molecule_spec(odd.path()).path, odd.path());
  const TemporaryFile hash("a#1.pdb", "");
  EXPECT_EQ(parse_molecule_spec(hash.path() + ":A").path, hash.path());
  EXPECT_THAT(parse_molecule_spec(hash.path() + ":A").chains, ElementsAre("A"));
}

TEST(ParseMoleculeSpec, RefusesEmptyChainsAndBadModels) {
  for (const char* text : {"x.pdb:", "x.pdb:A,", "x.pdb:,A", "x.pdb#0", "x.pdb#-1", "x.pdb#",
                           "x.pdb#a", "x.pdb#2x:A", ":A", "#1", ""})
    EXPECT_THROW((void)parse_molecule_spec(text), InputError) << text;
}

TEST(ReadMolecule, ReadsTheSamplesWithTheirExactCoordinates) {
  const ReadMoleculeResult a = read(kSamples + "1hpv_receptor.pdb");
  ASSERT_EQ(a.molecule.atoms.size(), 758u);
  EXPECT_EQ(residues(a.molecule).size(), 99u);
  const Atom& first = a.molecule.atoms.front();
  EXPECT_EQ(first.name, "N");
  EXPECT_EQ(first.residue_name, "PRO");
  EXPECT_EQ(first.chain, "A");
  EXPECT_EQ(first.residue_number, 1);
  EXPECT_EQ(first.element, "N");
  EXPECT_FALSE(first.hetero);
  // The coordinates of the file's first atom line, read here by columns.
  std::ifstream file(kSamples + "1hpv_receptor.pdb");
  std::string line;
  std::size_t i = 0;
  while (std::getline(file, line)) {
    if (!line.starts_with("ATOM")) continue;
    for (int axis = 0; axis < 3; ++axis)
      EXPECT_NEAR(a.molecule.atoms[i].position[axis], std::stod(line.substr(30 + 8 * axis, 8)),
                  1e-9);
    ++i;
  }
  EXPECT_EQ(i, 758u);
  EXPECT_EQ(read(kSamples + "1hpv_complex.pdb:B").molecule.atoms.size(), 758u);
  EXPECT_EQ(read(kSamples + "1tii_ligand.pdb.gz:C").molecule.atoms.size(), 290u);
  EXPECT_EQ(read(kSamples + "1tii_complex.pdb.gz").molecule.atoms.size(), 5469u);
}

TEST(ReadMolecule, SelectsChainsAndSaysSo) {
  const std::string text = backbone("A", "1", 0) + backbone("B", "1", 5) + backbone(" ", "1", 9);
  const ReadMoleculeResult both = read_content(text, ":B,A");
  EXPECT_EQ(both.molecule.atoms.size(), 8u);
  EXPECT_THAT(both.decisions, Contains("took chains B, A of A, B, _"));
  const ReadMoleculeResult blank = read_content(text, ":_");
  ASSERT_EQ(blank.molecule.atoms.size(), 4u);
  EXPECT_EQ(blank.molecule.atoms[0].chain, "");
}

TEST(ReadMolecule, SelectsModels) {
  const std::string text = "MODEL        1\n" + backbone("A", "1", 0) + "ENDMDL\nMODEL        7\n" +
                           backbone("A", "1", 50) + backbone("A", "2", 60) + "ENDMDL\nEND\n";
  EXPECT_EQ(read_content(text).molecule.atoms.size(), 4u);
  EXPECT_THAT(read_content(text).decisions, Contains("took model 1 of 2"));
  const ReadMoleculeResult seventh = read_content(text, "#7");
  ASSERT_EQ(seventh.molecule.atoms.size(), 8u);
  EXPECT_NEAR(seventh.molecule.atoms[0].position[0], 50.0, 1e-9);
}

TEST(ReadMolecule, KeepsTheFirstAlternateOfEachAtom) {
  std::string text = backbone("A", "1", 0);
  // Two conformers with different letters for different atoms, then a point mutation SER/THR at
  // residue 2.
  text += pdb_line({.name = " CB ", .alternate = "B", .x = 1, .y = 1});
  text += pdb_line({.name = " CB ", .alternate = "A", .x = 2, .y = 2});
  text += pdb_line({.name = " CA ", .alternate = "A", .residue = "SER", .number = "2", .x = 3});
  text += pdb_line({.name = " OG ", .alternate = "A", .residue = "SER", .number = "2", .x = 4});
  text += pdb_line({.name = " CA ", .alternate = "B", .residue = "THR", .number = "2", .x = 5});
  text += pdb_line({.name = " OG1", .alternate = "B", .residue = "THR", .number = "2", .x = 6});
  const ReadMoleculeResult result = read_content(text);
  EXPECT_THAT(names(result), ElementsAre("N", "CA", "C", "O", "CB", "CA", "OG"));
  EXPECT_NEAR(result.molecule.atoms[4].position[0], 1.0, 1e-9);
  EXPECT_NEAR(result.molecule.atoms[5].position[0], 3.0, 1e-9);
  EXPECT_THAT(result.decisions,
              Contains("kept the first alternate location of each atom, dropped 3 others"));
}

TEST(ReadMolecule, DropsWatersAndHydrogensAndGroupsByOption) {
  std::string text = backbone("A", "1", 0);
  text += pdb_line({.name = " H  ", .x = 0.5}) + pdb_line({.name = "1HB ", .x = 0.6}) +
          pdb_line({.name = "HG11", .x = 0.7});
  text += pdb_line({.record = "HETATM",
                    .name = "ZN  ",
                    .residue = " ZN",
                    .number = "201",
                    .x = 10,
                    .element = "ZN"});
  text +=
      pdb_line({.record = "HETATM", .name = " C1 ", .residue = "LIG", .number = "202", .x = 20});
  text +=
      pdb_line({.record = "HETATM", .name = " O1 ", .residue = "LIG", .number = "202", .x = 21});
  text +=
      pdb_line({.record = "HETATM", .name = " H1 ", .residue = "LIG", .number = "202", .x = 22});
  text +=
      pdb_line({.record = "HETATM", .name = " O  ", .residue = "HOH", .number = "301", .x = 30});
  text +=
      pdb_line({.record = "HETATM", .name = " H1 ", .residue = "HOH", .number = "301", .x = 31});
  const ReadMoleculeResult plain = read_content(text);
  EXPECT_THAT(names(plain), ElementsAre("N", "CA", "C", "O", "ZN", "C1", "O1"));
  EXPECT_THAT(elements(plain), ElementsAre("N", "C", "C", "O", "Zn", "C", "O"));
  EXPECT_TRUE(plain.molecule.atoms[4].hetero);
  EXPECT_TRUE(plain.molecule.atoms[5].hetero);
  EXPECT_THAT(plain.decisions, Contains("dropped 1 water"));
  EXPECT_THAT(plain.decisions, Contains("dropped 4 hydrogens"));
  EXPECT_THAT(plain.decisions, Contains("kept ligands and ions: LIG, ZN"));
  EXPECT_THAT(names(read_content(text, "", {.keep_ligands = false})),
              ElementsAre("N", "CA", "C", "O", "ZN"));
  EXPECT_THAT(names(read_content(text, "", {.keep_ions = false})),
              ElementsAre("N", "CA", "C", "O", "C1", "O1"));
  EXPECT_EQ(read_content(text, "", {.keep_waters = true}).molecule.atoms.size(), 8u);
  EXPECT_EQ(read_content(text, "", {.keep_hydrogens = true}).molecule.atoms.size(), 11u);
  EXPECT_EQ(
      read_content(text, "", {.keep_hydrogens = true, .keep_waters = true}).molecule.atoms.size(),
      13u);
}

TEST(ReadMolecule, TakesElementsFromNamesWhereTheColumnIsJunk) {
  std::string text;
  text += pdb_line({.name = " CA ", .element = "12"});          // a counter
  text += pdb_line({.name = " CB ", .x = 1, .element = " N"});  // contradicts the name
  text += pdb_line(
      {.name = " CD1", .residue = "LEU", .number = "2", .x = 2, .element = "CD"});  // not cadmium
  text += pdb_line({.name = "SE  ", .residue = "MSE", .number = "3", .x = 3});
  text += pdb_line({.name = "CA  ", .residue = " CA", .number = "4", .x = 4});
  text += pdb_line({.name = "FE  ", .residue = "HEM", .number = "5", .x = 5});
  text += pdb_line({.name = " NA ", .residue = "HEM", .number = "5", .x = 6});
  text += pdb_line({.name = "CL1 ", .residue = "LIG", .number = "6", .x = 7});
  text += pdb_line({.name = " CHA", .residue = "HEM", .number = "7", .x = 8});
  text += pdb_line({.name = " HG ", .residue = "SER", .number = "8", .x = 9});
  text += pdb_line({.name = "HG  ", .residue = " HG", .number = "9", .x = 10});
  text += pdb_line({.name = " O5'", .residue = " DA", .number = "10", .x = 11});
  text += pdb_line({.name = " CA ", .residue = "XYZ", .number = "11", .x = 12});
  text += pdb_line({.name = "ZN  ", .residue = "XYZ", .number = "11", .x = 13});
  const ReadMoleculeResult result = read_content(text, "", {.keep_hydrogens = true});
  EXPECT_THAT(elements(result), ElementsAre("C", "C", "C", "Se", "Ca", "Fe", "N", "Cl", "C", "H",
                                            "Hg", "O", "C", "Zn"));
  EXPECT_FALSE(result.molecule.atoms[3].hetero);  // MSE
  EXPECT_FALSE(result.molecule.atoms[11].hetero);
  EXPECT_TRUE(result.molecule.atoms[4].hetero);
  EXPECT_THAT(result.decisions,
              Contains(HasSubstr("took the element of 14 atoms from the atom name")));
}

TEST(ReadMolecule, CountsUnknownResiduesOfAChainAsPolymer) {
  std::string text = backbone("A", "1", 0);
  text +=
      pdb_line({.record = "HETATM", .name = " N  ", .residue = "QQQ", .number = "2", .y = 5.53});
  text += pdb_line({.record = "HETATM", .name = " CA ", .residue = "QQQ", .number = "2", .y = 7.0});
  text += pdb_line({.record = "HETATM", .name = " N  ", .residue = "QQQ", .number = "9", .x = 30});
  text += pdb_line({.record = "HETATM", .name = " CA ", .residue = "QQQ", .number = "9", .x = 31});
  const ReadMoleculeResult result = read_content(text);
  ASSERT_EQ(result.molecule.atoms.size(), 8u);
  EXPECT_FALSE(result.molecule.atoms[4].hetero);
  EXPECT_TRUE(result.molecule.atoms[6].hetero);
}

TEST(ReadMolecule, KeepsNamesInsertionCodesAndOddNumbers) {
  std::string text = backbone("A", "  52", 0, "HSD") + backbone("A", "  52", 4, "CYX", "A") +
                     backbone("A", "  52", 8, "ALA", "B") + backbone("A", "-3", 12) +
                     backbone("A", "9999", 16) + backbone("A", "A000", 20) +
                     backbone("A", "A001", 24) + backbone("A", "a000", 28);
  const ReadMoleculeResult result = read_content(text);
  const auto ranges = residues(result.molecule);
  std::vector<std::string> shown;
  for (const ResidueRange& range : ranges) {
    const Atom& atom = result.molecule.atoms[range.first];
    shown.push_back(atom.residue_name + std::to_string(atom.residue_number) + atom.insertion_code);
    EXPECT_EQ(range.last - range.first, 4u);
  }
  EXPECT_THAT(shown, ElementsAre("HSD52", "CYX52A", "ALA52B", "ALA-3", "ALA9999", "ALA10000",
                                 "ALA10001", "ALA1223056"));
}

TEST(ReadMolecule, KeepsAtomsThatShareANameInALigand) {
  std::string text;
  for (int i = 0; i < 12; ++i)
    text += pdb_line({.record = "HETATM", .name = " C  ", .residue = "UNL", .x = 1.5 * i});
  const ReadMoleculeResult result = read_content(text);
  ASSERT_EQ(result.molecule.atoms.size(), 12u);
  for (int i = 0; i < 12; ++i) {
    EXPECT_EQ(result.molecule.atoms[i].name, "C");
    EXPECT_NEAR(result.molecule.atoms[i].position[0], 1.5 * i, 1e-9);
  }
  const ReadMoleculeResult twice = read_content(backbone("A", "1", 0) + backbone("A", "1", 7));
  EXPECT_EQ(twice.molecule.atoms.size(), 4u);
  EXPECT_THAT(twice.decisions, Contains("dropped 4 atoms that stand in their residue twice"));
}

constexpr char kMmcif[] = R"(data_TEST
#
_cell.length_a 10.0
_struct.title 'it''s a title'
_struct.note
;a text field
with _atom_site.id and loop_ in it
;
loop_
_atom_site.group_PDB
_atom_site.id
_atom_site.type_symbol
_atom_site.label_atom_id
_atom_site.label_alt_id
_atom_site.label_comp_id
_atom_site.label_asym_id
_atom_site.label_seq_id
_atom_site.pdbx_PDB_ins_code
_atom_site.Cartn_x
_atom_site.Cartn_y
_atom_site.Cartn_z
_atom_site.auth_seq_id
_atom_site.auth_asym_id
_atom_site.pdbx_PDB_model_num
ATOM   1 N  N     . ALA A 1 ? 1.0 2.0 3.0 15 HH 1
ATOM   2 C  CA    A ALA A 1 ? 1.5 2.0 3.0 15 HH 1
ATOM   3 C  CA    B ALA A 1 ? 9.5 2.0 3.0 15 HH 1
ATOM   4 C  C     . ALA A 1 ? 2.5 2.0 3.0 15 HH 1
ATOM   5 O  "O5'" . A   B 1 A 4.5 2.0 3.0 16 HH 1
HETATM 6 CA CA    . CA  C . ? 1.25e1 2.0 3.0 201 HH 1
HETATM 7 O  O     . HOH D . ? 14.5 2.0 3.0 301 HH 1
ATOM   8 N  N     . ALA A 1 ? 51.0 2.0 3.0 15 HH 2
#
_exptl.method 'X-RAY DIFFRACTION'
)";

TEST(ReadMolecule, ReadsMmcif) {
  const ReadMoleculeResult result = read_content(kMmcif, ":HH", {}, "x.cif");
  EXPECT_THAT(names(result), ElementsAre("N", "CA", "C", "O5'", "CA"));
  EXPECT_THAT(elements(result), ElementsAre("N", "C", "C", "O", "Ca"));
  EXPECT_NEAR(result.molecule.atoms[1].position[0], 1.5, 1e-9);
  EXPECT_NEAR(result.molecule.atoms[4].position[0], 12.5, 1e-9);
  EXPECT_EQ(result.molecule.atoms[0].residue_number, 15);
  EXPECT_EQ(result.molecule.atoms[3].insertion_code, "A");
  EXPECT_THAT(result.decisions, Contains("took model 1 of 2"));
  const ReadMoleculeResult second = read_content(kMmcif, "#2", {}, "x.cif");
  ASSERT_EQ(second.molecule.atoms.size(), 1u);
  EXPECT_NEAR(second.molecule.atoms[0].position[0], 51.0, 1e-9);
  // The content decides, not the name.
  EXPECT_EQ(read_content(kMmcif, "", {}, "x.pdb").molecule.atoms.size(), 5u);
}

TEST(ReadMolecule, ReadsGzipWhateverItsName) {
  namespace io = boost::iostreams;
  const std::string text = backbone("A", "1", 0);
  std::string packed;
  io::filtering_ostream out;
  out.push(io::gzip_compressor());
  out.push(io::back_inserter(packed));
  out << text;
  out.reset();
  EXPECT_EQ(read_content(packed, "", {}, "x.pdb.gz").molecule.atoms.size(), 4u);
  EXPECT_EQ(read_content(packed, "", {}, "x.pdb").molecule.atoms.size(), 4u);
}

TEST(ReadMolecule, ReadsWindowsLineEndsAndShortLines) {
  std::string text = backbone("A", "1", 0), windows;
  for (const char c : text) windows += c == '\n' ? std::string("\r\n") : std::string(1, c);
  EXPECT_EQ(read_content(windows).molecule.atoms.size(), 4u);
  EXPECT_EQ(read_content(pdb_line({}).substr(0, 54)).molecule.atoms.size(), 1u);
}

TEST(ReadMolecule, ManyThreadsReadAtOnce) {
  std::vector<std::size_t> sizes(8);
  std::vector<std::thread> threads;
  for (std::size_t& size : sizes)
    threads.emplace_back(
        [&size] { size = read(kSamples + "1hpv_ligand.pdb").molecule.atoms.size(); });
  for (std::thread& thread : threads) thread.join();
  EXPECT_THAT(sizes, testing::Each(758u));
}

}  // namespace
}  // namespace mortise
