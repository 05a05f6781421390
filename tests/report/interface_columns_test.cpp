// SPDX-License-Identifier: GPL-3.0-or-later
// Interface descriptions as columns: right numbers at the right poses.
#include "mortise/report/interface_columns.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "mortise/core/errors.hpp"
#include "mortise/molecules/read_molecule.hpp"

namespace mortise {
namespace {

TEST(InterfaceColumns, HoldTheDescriptionsOfTheBestPoses) {
  const auto read = [](const char* name) {
    return read_molecule({.path = std::string(MORTISE_SOURCE_DIR) + "/molecules/" + name}).molecule;
  };
  const MolecularInterface interface(read("1hpv_receptor.pdb"), read("1hpv_ligand.pdb"));
  PoseList poses;
  poses.poses.resize(4);
  poses.poses[1].moving_in_fixed.translation.x() = 3.0;
  poses.poses[2].moving_in_fixed.translation.x() = 300.0;
  const std::vector<MetricColumn> columns = interface_columns(interface, poses, 3, 2);
  const std::vector<std::string> names{"interface_area", "buried_area", "contacts",
                                       "hydrogen_bonds", "clashes",     "sc"};
  ASSERT_EQ(columns.size(), names.size());
  for (std::size_t c = 0; c < names.size(); ++c) {
    EXPECT_EQ(columns[c].name, names[c]);
    ASSERT_EQ(columns[c].values.size(), 4U);
    EXPECT_TRUE(std::isnan(columns[c].values[3])) << names[c];
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const InterfaceDescription d = interface.describe(poses.poses[i].moving_in_fixed);
    EXPECT_EQ(columns[0].values[i], d.buried_area / 2);
    EXPECT_EQ(columns[1].values[i], d.buried_area);
    EXPECT_EQ(columns[2].values[i], static_cast<double>(d.residue_contacts.size()));
    EXPECT_EQ(columns[3].values[i], static_cast<double>(d.hydrogen_bonds.size()));
    EXPECT_EQ(columns[4].values[i], static_cast<double>(d.clashes));
    if (i < 2) {
      EXPECT_EQ(columns[5].values[i], d.shape.sc);
    }
  }
  EXPECT_GT(columns[1].values[0], 500.0);
  EXPECT_EQ(columns[1].values[2], 0.0);
  EXPECT_TRUE(std::isnan(columns[5].values[2]));  // nothing to fit
  EXPECT_EQ(interface_columns(interface, poses, 100, 1)[1].values[3], columns[1].values[0]);
}

TEST(InterfaceColumns, ReplaceThoseOfTheirNamesAndRefuseWrongIndices) {
  mortise::Run run;
  run.metrics = {{"sc", {0.5}}, {"fnat", {0.25}}};
  set_metric_columns(run, {{"buried_area", {9.0}}, {"sc", {0.75}}});
  ASSERT_EQ(run.metrics.size(), 3U);
  EXPECT_EQ(run.metrics[0].values, std::vector<double>{0.75});
  EXPECT_EQ(run.metrics[1].name, "fnat");
  EXPECT_EQ(run.metrics[2].name, "buried_area");
  const std::vector<InterfaceDescription> one(1);
  EXPECT_THROW((void)interface_columns(one, {0, 1}, 3), InputError);
  EXPECT_THROW((void)interface_columns(one, {3}, 3), InputError);
  EXPECT_EQ(interface_columns(one, {2}, 3)[1].values[2], 0.0);
}

}  // namespace
}  // namespace mortise
