// SPDX-License-Identifier: GPL-3.0-or-later
// Exported poses: tables read back, structures land where the pose says, ZDOCK's rule rebuilds our
// coordinates.
#include "mortise/store/export.hpp"

#include <gmock/gmock.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <set>
#include <sstream>

#include "mortise/core/errors.hpp"
#include "mortise/molecules/read_molecule.hpp"
#include "sample_run.hpp"

namespace mortise {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::sample_run;
using tests::ScratchDirectory;

const std::string kReceptor = std::string(MORTISE_SOURCE_DIR) + "/molecules/1hpv_receptor.pdb";
const std::string kLigand = std::string(MORTISE_SOURCE_DIR) + "/molecules/1hpv_ligand.pdb";

Molecule read(const std::string& path, int model = 0, const std::vector<std::string>& chains = {}) {
  return read_molecule({path, model, chains}, {.keep_hydrogens = true}).molecule;
}

std::vector<std::string> split(const std::string& text, char at) {
  std::vector<std::string> fields;
  std::string field;
  std::istringstream in(text);
  while (std::getline(in, field, at)) fields.push_back(field);
  if (!text.empty() && text.back() == at && at == ',') fields.emplace_back();
  return fields;
}

TEST(Export, ChoosesPosesByTopOrRank) {
  const mortise::Run run = sample_run(25);
  using F = ExportFormat;
  EXPECT_EQ(chosen_poses(run, F::kPdb, {}).size(), 10U);
  EXPECT_EQ(chosen_poses(run, F::kCsv, {}).size(), 25U);
  EXPECT_EQ(chosen_poses(run, F::kZdock, {.top = 3}), (std::vector<std::size_t>{0, 1, 2}));
  EXPECT_EQ(chosen_poses(run, F::kPdb, {.top = 99}).size(), 25U);
  EXPECT_THAT(chosen_poses(run, F::kPdb, {.pose = 25}), ElementsAre(24U));
  EXPECT_THROW((void)chosen_poses(run, F::kPdb, {.pose = 26}), InputError);
  EXPECT_THROW((void)chosen_poses(run, F::kPdb, {.top = -1}), InputError);
  EXPECT_THROW((void)chosen_poses(mortise::Run(), F::kCsv, {}), InputError);
  EXPECT_THROW((void)parse_export_format("xyz"), InputError);
}

TEST(Export, CsvReadsBackBitForBit) {
  mortise::Run run = sample_run(6);
  run.poses.channel_names[1] = "odd, \"name\"";
  const std::vector<std::string> lines = split(export_csv(run), '\n');
  ASSERT_EQ(lines.size(), 7U);
  EXPECT_EQ(lines[0],
            "rank,score,shape,\"odd, "
            "\"\"name\"\"\",qw,qx,qy,qz,tx,ty,tz,rotation_index,cluster,interface_rmsd,fnat");
  for (std::size_t i = 0; i < 6; ++i) {
    const Pose& pose = run.poses.poses[i];
    const std::vector<std::string> f = split(lines[i + 1], ',');
    ASSERT_EQ(f.size(), 15U);
    EXPECT_EQ(f[0], std::to_string(i + 1));
    EXPECT_EQ(std::stod(f[1]), pose.score);
    EXPECT_EQ(std::stod(f[2]), pose.channels[0]);
    const Eigen::Quaterniond& q = pose.moving_in_fixed.rotation;
    EXPECT_EQ(Eigen::Vector4d(std::stod(f[4]), std::stod(f[5]), std::stod(f[6]), std::stod(f[7])),
              Eigen::Vector4d(q.w(), q.x(), q.y(), q.z()));
    EXPECT_EQ(Eigen::Vector3d(std::stod(f[8]), std::stod(f[9]), std::stod(f[10])),
              pose.moving_in_fixed.translation);
    EXPECT_EQ(std::stoi(f[11]), pose.rotation_index);
    EXPECT_EQ(std::stoi(f[12]), pose.cluster);
    EXPECT_EQ(f[14].empty(), i == 1);
  }
}

TEST(Export, JsonHoldsEveryColumn) {
  const mortise::Run run = sample_run(4);
  const nlohmann::json all = nlohmann::json::parse(export_json(run, {.top = 2}));
  ASSERT_EQ(all["poses"].size(), 2U);
  const nlohmann::json& second = all["poses"][1];
  EXPECT_EQ(second["rank"], 2);
  EXPECT_EQ(second["score"].get<double>(), run.poses.poses[1].score);
  EXPECT_EQ(second["channels"]["electrostatics"].get<double>(), 0.1);
  EXPECT_EQ(second["quaternion"][3].get<double>(), run.poses.poses[1].moving_in_fixed.rotation.z());
  EXPECT_EQ(second["translation"][0].get<double>(),
            run.poses.poses[1].moving_in_fixed.translation.x());
  EXPECT_EQ(second["rotation_index"], run.poses.poses[1].rotation_index);
  EXPECT_EQ(second["cluster"], run.poses.poses[1].cluster);
  EXPECT_TRUE(second["metrics"]["fnat"].is_null());
  EXPECT_EQ(second["metrics"]["interface_rmsd"].get<double>(), 0.1);
  EXPECT_EQ(all["fixed"]["sha256"], run.fixed.sha256);
}

// Every model of both formats, read by the reader of molecules, is the moved input.
TEST(Export, StructuresLandWhereThePoseSays) {
  const ScratchDirectory scratch;
  const Molecule fixed = read(kReceptor);
  const Molecule moving = read(kLigand);
  const mortise::Run run = sample_run(3);
  for (const bool complex : {false, true})
    for (const char* name : {"poses.pdb", "poses.cif"}) {
      const ExportOptions options{.complex = complex};
      const bool pdb = std::string(name) == "poses.pdb";
      const std::string text =
          pdb ? export_pdb(run, fixed, moving, options) : export_mmcif(run, fixed, moving, options);
      std::ofstream(scratch / name) << text;
      for (int model = 1; model <= 3; ++model) {
        const Molecule back = read(scratch / name, model);
        const std::size_t first = complex ? fixed.atoms.size() : 0;
        ASSERT_EQ(back.atoms.size(), first + moving.atoms.size()) << name;
        double worst = 0.0;
        for (std::size_t i = 0; i < first; ++i)
          worst = std::max(
              worst, (back.atoms[i].position - fixed.atoms[i].position).cwiseAbs().maxCoeff());
        const RigidMotion& motion =
            run.poses.poses[static_cast<std::size_t>(model) - 1].moving_in_fixed;
        for (std::size_t i = 0; i < moving.atoms.size(); ++i) {
          worst =
              std::max(worst, (back.atoms[first + i].position - motion * moving.atoms[i].position)
                                  .cwiseAbs()
                                  .maxCoeff());
          EXPECT_EQ(back.atoms[first + i].name, moving.atoms[i].name);
          EXPECT_EQ(back.atoms[first + i].residue_number, moving.atoms[i].residue_number);
        }
        EXPECT_LE(worst, 0.0005 + 1e-9) << name << ": three decimals are what the formats carry";
      }
    }
}

TEST(Export, ComplexKeepsChainsApartAndSaysSo) {
  const Molecule moving = read(kLigand);
  const mortise::Run run = sample_run(2);
  const std::string text = export_pdb(run, moving, moving, {.complex = true});
  const std::string chain = moving.atoms.front().chain;
  EXPECT_THAT(text, HasSubstr("REMARK   6 moving chain " + chain + " is written as "));
  EXPECT_THAT(text, HasSubstr("MODEL        2"));
  const ScratchDirectory scratch;
  std::ofstream(scratch / "c.pdb") << text;
  std::set<std::string> chains;
  for (const Atom& atom : read(scratch / "c.pdb", 1).atoms) chains.insert(atom.chain);
  EXPECT_EQ(chains.size(), 2U);
  EXPECT_THAT(export_pdb(run, moving, moving, {.pose = 2}),
              ::testing::Not(HasSubstr("MODEL        1")));
  for (const std::string& line : split(text, '\n')) EXPECT_LE(line.size(), 80U);
}

TEST(Export, MmcifAtomIdsAreUnique) {
  const Molecule moving = read(kLigand);
  const mortise::Run run = sample_run(2);
  std::set<std::string> ids;
  std::size_t rows = 0;
  for (const std::string& line :
       split(export_mmcif(run, moving, moving, {.complex = true}), '\n')) {
    std::istringstream in(line);
    std::string record, id;
    in >> record >> id;
    if (record != "ATOM" && record != "HETATM") continue;
    ids.insert(id);
    ++rows;
  }
  EXPECT_EQ(rows, 4 * moving.atoms.size());
  EXPECT_EQ(ids.size(), rows);
}

// What a .out file says, and the rule by which ZDOCK's create_lig and MEGADOCK's decoygen rebuild a
// ligand, written anew from their description: subtract the ligand's centre, turn by the start
// angles, turn by the pose's angles, step back along the wrapped grid translation, add the
// receptor's centre.
template <typename Real>
struct ZdockFile {
  int n = 0, receptor_is_moving = -1;
  Real spacing = 0;
  std::array<Real, 3> receptor_start{}, start{}, r{}, l{};
  std::string receptor, ligand;
  struct Row {
    std::array<Real, 3> angle{};
    std::array<int, 3> t{};
    double score = 0;
  };
  std::vector<Row> rows;

  explicit ZdockFile(const std::string& text) {
    std::istringstream in(text);
    in >> n >> spacing >> receptor_is_moving;
    for (Real& x : receptor_start) in >> x;
    for (Real& x : start) in >> x;
    in >> receptor >> r[0] >> r[1] >> r[2] >> ligand >> l[0] >> l[1] >> l[2];
    Row row;
    while (in >> row.angle[0] >> row.angle[1] >> row.angle[2] >> row.t[0] >> row.t[1] >> row.t[2] >>
           row.score)
      rows.push_back(row);
  }

  static std::array<Real, 3> turn(const std::array<Real, 3>& x, const std::array<Real, 3>& angle) {
    std::array<Real, 3> y = x;
    const auto about_z = [&y](Real a) {
      y = {std::cos(a) * y[0] - std::sin(a) * y[1], std::sin(a) * y[0] + std::cos(a) * y[1], y[2]};
    };
    about_z(angle[2]);
    const Real a = angle[1];
    y = {y[0], std::cos(a) * y[1] - std::sin(a) * y[2], std::sin(a) * y[1] + std::cos(a) * y[2]};
    about_z(angle[0]);
    return y;
  }

  Eigen::Vector3d rebuild(const Eigen::Vector3d& atom, const Row& row) const {
    std::array<Real, 3> x{};
    for (int k = 0; k < 3; ++k) x[k] = static_cast<Real>(atom[k]) - l[k];
    x = turn(turn(x, start), row.angle);
    Eigen::Vector3d moved;
    for (int k = 0; k < 3; ++k) {
      const int t = row.t[k] >= n / 2 ? row.t[k] - n : row.t[k];
      moved[k] = static_cast<double>(x[k] - static_cast<Real>(t) * spacing + r[k]);
    }
    return moved;
  }
};

template <typename Real>
double worst_rebuild(const mortise::Run& run, const Molecule& moving) {
  const ZdockFile<Real> file(export_zdock(run));
  EXPECT_EQ(file.receptor_is_moving, 0);
  EXPECT_EQ(file.receptor, run.fixed.path);
  EXPECT_EQ(file.ligand, run.moving.path);
  EXPECT_EQ(file.rows.size(), run.poses.poses.size());
  double worst = 0.0;
  for (std::size_t i = 0; i < file.rows.size(); ++i) {
    EXPECT_NEAR(file.rows[i].score, run.poses.poses[i].score,
                1e-6 * std::abs(run.poses.poses[i].score));
    for (const int t : file.rows[i].t) EXPECT_TRUE(t >= 0 && t < file.n) << "pose " << i;
    for (const Atom& atom : moving.atoms)
      worst = std::max(worst, (file.rebuild(atom.position, file.rows[i]) -
                               run.poses.poses[i].moving_in_fixed * atom.position)
                                  .norm());
  }
  return worst;
}

TEST(Export, ZdockRuleRebuildsOurCoordinates) {
  const Molecule moving = read(kLigand);
  mortise::Run run = sample_run(200);
  // The angles' degenerate cases: no rotation, half turns, turns about z, and just beside them.
  const auto about = [](double angle, const Eigen::Vector3d& axis) {
    return canonical(Eigen::Quaterniond(Eigen::AngleAxisd(angle, axis.normalized())));
  };
  std::size_t i = 0;
  for (const double angle : {0.0, 1e-9, 1e-5, 1.0, 3.0, std::numbers::pi - 1e-9, std::numbers::pi})
    for (const Eigen::Vector3d& axis : {Eigen::Vector3d(0, 0, 1), Eigen::Vector3d(1, 0, 0),
                                        Eigen::Vector3d(0, 1, 0), Eigen::Vector3d(1, -1, 1e-7)})
      run.poses.poses[i++].moving_in_fixed.rotation = about(angle, axis);
  run.poses.poses[i].moving_in_fixed.translation =
      Eigen::Vector3d(3000, -4000, 0);  // sets the size of the grid
  EXPECT_LT(worst_rebuild<double>(run, moving), 0.001);
  run.poses.poses[i].moving_in_fixed.translation = Eigen::Vector3d(300, -400, 0);
  EXPECT_LT(worst_rebuild<float>(run, moving), 0.001);  // some readers compute in single precision
  run.fixed.knots = run.moving.knots = Knots();         // no knots: the centres are the origin
  EXPECT_LT(worst_rebuild<double>(run, moving), 0.001);
}

TEST(Export, ZdockHeaderHasTheLayoutOfVersion302) {
  mortise::Run run = sample_run(2);
  const std::vector<std::string> lines = split(export_zdock(run), '\n');
  ASSERT_EQ(lines.size(), 7U);
  const std::vector<std::size_t> fields = {3, 3, 3, 4, 4, 7, 7};
  for (std::size_t i = 0; i < 7; ++i)
    EXPECT_EQ(split(lines[i], '\t').size(), fields[i]) << lines[i];
  run.moving.path = "my ligand.pdb";
  EXPECT_THROW((void)export_zdock(run), InputError);
  run = sample_run(2);
  run.poses.poses[0].moving_in_fixed.translation.x() = 2e6;
  EXPECT_THROW((void)export_zdock(run), InputError);
  run = sample_run(2);
  run.moving.kind = "part";
  EXPECT_THROW((void)export_zdock(run), InputError);
  EXPECT_THROW((void)export_pdb(run, {}, {}), InputError);
}

}  // namespace
}  // namespace mortise
