// SPDX-License-Identifier: GPL-3.0-or-later
// Written files read back as the same atoms, by Mortise and by OpenMM alone.
#include "mortise/molecules/write_molecule.hpp"

#include <gmock/gmock.h>

#include <cstdlib>

#include "helpers/temporary_file.hpp"
#include "molecules/hybrid36.hpp"
#include "mortise/core/errors.hpp"
#include "mortise/molecules/read_molecule.hpp"

namespace mortise {
namespace {

using testing::HasSubstr;
using tests::TemporaryFile;

const RigidMotion kMotion = {canonical(Eigen::Quaterniond(0.3, -0.5, 0.7, 0.1)),
                             Eigen::Vector3d(-30.25, 111.5, 7.125)};

Molecule sample(const std::string& name) {
  return read_molecule({.path = std::string(MORTISE_SOURCE_DIR) + "/molecules/" + name}).molecule;
}

Molecule read_back(const std::string& text, const std::string& name, int model = 0) {
  const TemporaryFile file(name, text);
  return read_molecule({.path = file.path(), .model = model},
                       {.keep_hydrogens = true, .keep_waters = true})
      .molecule;
}

void expect_same(const Molecule& found, const Molecule& expected, const RigidMotion& motion) {
  ASSERT_EQ(found.atoms.size(), expected.atoms.size());
  for (std::size_t i = 0; i < found.atoms.size(); ++i) {
    const Atom &a = found.atoms[i], &b = expected.atoms[i];
    EXPECT_EQ(a.name, b.name);
    EXPECT_EQ(a.residue_name, b.residue_name);
    EXPECT_EQ(a.chain, b.chain);
    EXPECT_EQ(a.residue_number, b.residue_number);
    EXPECT_EQ(a.insertion_code, b.insertion_code);
    EXPECT_EQ(a.element, b.element);
    EXPECT_LT((a.position - motion * b.position).cwiseAbs().maxCoeff(), 0.001);
  }
}

Molecule odd_molecule() {
  Molecule molecule;
  const auto add = [&](const char* name, const char* residue, int number, const char* code,
                       const char* element, bool hetero) {
    Atom atom;
    atom.name = name;
    atom.residue_name = residue;
    atom.chain = "x";
    atom.residue_number = number;
    atom.insertion_code = code;
    atom.element = element;
    atom.position =
        Eigen::Vector3d(1.5, -2.25, 3.0) * static_cast<double>(molecule.atoms.size() + 1);
    atom.hetero = hetero;
    molecule.atoms.push_back(atom);
  };
  add("N", "ALA", -5, "", "N", false);
  add("CA", "ALA", -5, "", "C", false);
  add("HG11", "VAL", 9999, "B", "H", false);
  add("CA", "VAL", 9999, "B", "C", false);
  add("O5'", "DA", 10000, "", "O", false);
  add("CA", "CA", 300000, "", "Ca", true);
  add("FE", "HEM", 2000000, "", "Fe", true);
  add("N A", "HEM", 2000000, "", "N", true);
  return molecule;
}

TEST(Hybrid36, HasTheEndsOfItsDefinition) {
  const auto check = [](const char* text, std::size_t width, int number) {
    EXPECT_EQ(molecules::encode_hybrid36(number, width), text);
    std::string field = text;
    field.erase(0, field.find_first_not_of(' '));
    EXPECT_EQ(molecules::decode_hybrid36(field, width), number);
  };
  check(" -42", 4, -42);
  check("9999", 4, 9999);
  check("A000", 4, 10000);
  check("ZZZZ", 4, 1223055);
  check("a000", 4, 1223056);
  check("zzzz", 4, 2436111);
  check("99999", 5, 99999);
  check("A0000", 5, 100000);
  check("ZZZZZ", 5, 43770015);
  check("a0000", 5, 43770016);
  check("zzzzz", 5, 87440031);
  EXPECT_FALSE(molecules::encode_hybrid36(2436112, 4));
  EXPECT_FALSE(molecules::encode_hybrid36(-1000, 4));
  for (const char* text : {"", "A00", "A00a", "a00A", "A-00", "1.5", "12A"})
    EXPECT_FALSE(molecules::decode_hybrid36(text, 4)) << text;
}

TEST(FormatPdb, RoundTrips) {
  for (const char* name : {"1hpv_complex.pdb", "1tii_ligand.pdb.gz"}) {
    const Molecule molecule = sample(name);
    expect_same(read_back(format_pdb_atoms(molecule, kMotion) + "END\n", "x.pdb"), molecule,
                kMotion);
  }
  const Molecule odd = odd_molecule();
  expect_same(read_back(format_pdb_atoms(odd, kMotion, {.first_serial = 99996}), "x.pdb"), odd,
              kMotion);
}

TEST(FormatPdb, ColumnsAreThoseOfTheFormat) {
  const std::string text = format_pdb_atoms(odd_molecule(), {}, {.first_serial = 99998});
  const auto line = [&](int n) {
    std::size_t at = 0;
    while (n-- > 0) at = text.find('\n', at) + 1;
    return text.substr(at, text.find('\n', at) - at);
  };
  EXPECT_EQ(line(0),
            "ATOM  99998  N   ALA x  -5       1.500  -2.250   3.000  1.00  0.00           N  ");
  EXPECT_EQ(line(2),
            "ATOM  A0000 HG11 VAL x9999B      4.500  -6.750   9.000  1.00  0.00           H  ");
  EXPECT_EQ(line(4),
            "ATOM  A0002  O5'  DA xA000       7.500 -11.250  15.000  1.00  0.00           O  ");
  EXPECT_EQ(line(5), "TER   A0003       DA xA000 ");
  EXPECT_EQ(line(6),
            "HETATMA0004 CA    CA xG7RK       9.000 -13.500  18.000  1.00  0.00          CA  ");
}

TEST(FormatPdb, Models) {
  const Molecule molecule = sample("1hpv_ligand.pdb");
  std::string text;
  for (int i = 1; i <= 3; ++i) {
    const RigidMotion motion = {kMotion.rotation, Eigen::Vector3d(i, 0, 0)};
    text += format_pdb_model(i, format_pdb_atoms(molecule, motion));
  }
  text += "END\n";
  expect_same(read_back(text, "x.pdb", 2), molecule, {kMotion.rotation, Eigen::Vector3d(2, 0, 0)});
  EXPECT_EQ(format_pdb_model(12, ""), "MODEL       12\nENDMDL\n");
  EXPECT_THROW((void)format_pdb_model(0, ""), InputError);
}

TEST(FormatPdb, RefusesWhatTheFormatCannotHold) {
  const auto refusal = [](auto&& change) -> std::string {
    Molecule molecule = odd_molecule();
    change(molecule.atoms[1]);
    try {
      (void)format_pdb_atoms(molecule);
    } catch (const InputError& e) {
      return e.what();
    }
    return "accepted";
  };
  EXPECT_EQ(refusal([](Atom& a) { a.chain = "AA"; }),
            "PDB output: atom CA of ALA -5 in chain 'AA': expected a chain name of one letter; "
            "write mmCIF instead");
  EXPECT_THAT(refusal([](Atom& a) { a.name = "C1234"; }),
              HasSubstr("atom name of at most 4 letters"));
  EXPECT_THAT(refusal([](Atom& a) { a.residue_name = "A1BCD"; }),
              HasSubstr("residue name of at most 4"));
  EXPECT_THAT(refusal([](Atom& a) { a.residue_number = -1000; }),
              HasSubstr("a residue number from -999"));
  EXPECT_THAT(refusal([](Atom& a) { a.residue_number = 3000000; }),
              HasSubstr("a residue number from -999"));
  EXPECT_THAT(refusal([](Atom& a) { a.position.x() = -1000; }), HasSubstr("coordinates between"));
  EXPECT_THAT(refusal([](Atom& a) { a.position.x() = 10000; }), HasSubstr("coordinates between"));
  EXPECT_THAT(refusal([](Atom& a) { a.position.x() = std::nan(""); }),
              HasSubstr("coordinates between"));
}

TEST(FormatMmcif, RoundTrips) {
  const Molecule molecule = sample("1tii_complex.pdb.gz");
  expect_same(read_back(format_mmcif_head("a b") + format_mmcif_atoms(molecule, kMotion), "x.cif"),
              molecule, kMotion);
  Molecule odd = odd_molecule();
  for (Atom& atom : odd.atoms) atom.chain = "long chain";
  odd.atoms[0].name = "'N\"";
  EXPECT_THROW((void)format_mmcif_atoms(odd), InputError);
  odd.atoms[0].name = "_N";
  odd.atoms[1].name = "CA'\"";
  odd.atoms[2].position.x() = -123456.0;
  EXPECT_THAT(format_mmcif_atoms(odd), HasSubstr("-123456.000"));
  odd.atoms[2].position.x() = -1234.0;
  const std::string text = format_mmcif_head("x") + format_mmcif_atoms(odd, kMotion, {.model = 1}) +
                           format_mmcif_atoms(odd, {}, {.first_serial = 9, .model = 2});
  expect_same(read_back(text, "x.cif", 1), odd, kMotion);
  expect_same(read_back(text, "x.cif", 2), odd, {});
  odd.atoms[0].position.x() = std::nan("");
  EXPECT_THROW((void)format_mmcif_atoms(odd), InputError);
}

TEST(Format, OpenMmItselfReadsBothFormats) {
  const Molecule molecule = sample("1hpv_ligand.pdb");
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Atom& atom : molecule.atoms) sum += kMotion * atom.position;
  const TemporaryFile pdb("x.pdb", format_pdb_model(1, format_pdb_atoms(molecule, kMotion)) +
                                       format_pdb_model(2, format_pdb_atoms(molecule)) + "END\n");
  const TemporaryFile cif("x.cif",
                          format_mmcif_head("x") + format_mmcif_atoms(molecule, kMotion) +
                              format_mmcif_atoms(molecule, {}, {.first_serial = 759, .model = 2}));
  const TemporaryFile script(
      "check.py",
      "import sys\n"
      "from openmm.app import PDBFile, PDBxFile\n"
      "from openmm.unit import angstrom\n"
      "for reader, path in ((PDBFile, sys.argv[1]), (PDBxFile, sys.argv[2])):\n"
      "    s = reader(path)\n"
      "    x = s.getPositions().value_in_unit(angstrom)\n"
      "    assert s.getNumFrames() == 2, s.getNumFrames()\n"
      "    assert len(x) == 758, len(x)\n"
      "    assert [c.id for c in s.topology.chains()] == ['B']\n"
      "    assert len(list(s.topology.residues())) == 99\n"
      "    for axis in range(3):\n"
      "        total = sum(p[axis] for p in x)\n"
      "        assert abs(total - float(sys.argv[3 + axis])) < 0.38, total\n");
  std::string command =
      std::string(MORTISE_PYTHON) + " " + script.path() + " " + pdb.path() + " " + cif.path();
  for (int axis = 0; axis < 3; ++axis) command += " " + std::to_string(sum[axis]);
  EXPECT_EQ(std::system(command.c_str()), 0);
}

TEST(WithDistinctChains, RenamesOnlyWhatClashes) {
  Molecule fixed, moving;
  for (const char* chain : {"A", "C"}) fixed.atoms.emplace_back().chain = chain;
  for (const char* chain : {"A", "B", "C", "A"}) moving.atoms.emplace_back().chain = chain;
  const Molecule renamed = with_distinct_chains(moving, fixed);
  std::string chains;
  for (const Atom& atom : renamed.atoms) chains += atom.chain;
  EXPECT_EQ(chains, "DBED");
}

}  // namespace
}  // namespace mortise
