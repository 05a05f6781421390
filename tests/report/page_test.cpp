// SPDX-License-Identifier: GPL-3.0-or-later
// The page holds the run's numbers, lets nothing from files become markup and loads nothing.
#include "mortise/report/page.hpp"

#include <gmock/gmock.h>
#include <openssl/evp.h>

#include <boost/iostreams/device/back_inserter.hpp>
#include <boost/iostreams/filter/gzip.hpp>
#include <boost/iostreams/filtering_stream.hpp>
#include <limits>
#include <nlohmann/json.hpp>

#include "mortise/core/errors.hpp"
#include "mortise/parts/ball_mesh.hpp"
#include "sample_report.hpp"

namespace mortise::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

std::string between(const std::string& text, const std::string& before, const std::string& after) {
  const std::size_t from = text.find(before) + before.size();
  return text.substr(from, text.find(after, from) - from);
}

std::string from_base64(const std::string& text) {
  std::string bytes(3 * text.size() / 4, '\0');
  EXPECT_GE(EVP_DecodeBlock(reinterpret_cast<unsigned char*>(bytes.data()),
                            reinterpret_cast<const unsigned char*>(text.data()),
                            static_cast<int>(text.size())),
            0);
  bytes.resize(bytes.size() - (text.size() - text.find_last_not_of('=') - 1));
  return bytes;
}

// What the page's script unpacks.
nlohmann::json data_of(const std::string& page) {
  namespace io = boost::iostreams;
  std::string text;
  {
    io::filtering_ostream out;
    out.push(io::gzip_decompressor());
    out.push(io::back_inserter(text));
    const std::string packed =
        from_base64(between(page, "<script id=\"data\" type=\"text/plain\">", "</script>"));
    out.write(packed.data(), static_cast<std::streamsize>(packed.size()));
  }
  return nlohmann::json::parse(text);
}

class Page : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!report_page_available()) GTEST_SKIP() << "built with MORTISE_REPORT=OFF";
  }
};

TEST_F(Page, HoldsTheRunsNumbersToSevenDigits) {
  const ReportBodies bodies = protease();
  mortise::Run run = report_run(bodies, 30);
  run.metrics[2].values[4] = std::numeric_limits<double>::quiet_NaN();
  const nlohmann::json data = data_of(report_page(run, bodies, {.frequency_poses = 7}));
  EXPECT_EQ(data["poses"]["count"], 30);
  EXPECT_EQ(data["frequency_poses"], 7);
  EXPECT_EQ(data["frequency"].size(), 99u);
  const auto expect_near = [](const nlohmann::json& value, double expected) {
    EXPECT_NEAR(value.get<double>(), expected, 1e-6 * std::abs(expected) + 1e-300);
  };
  std::map<std::string, nlohmann::json> columns;
  for (const nlohmann::json& column : data["columns"]) columns[column["key"]] = column["values"];
  ASSERT_EQ(columns.size(), 1u + 2u + 1u + run.metrics.size());
  for (std::size_t i = 0; i < 30; ++i) {
    const Pose& pose = run.poses.poses[i];
    expect_near(columns["score"][i], pose.score);
    expect_near(columns["contact"][i], pose.channels[1]);
    expect_near(data["poses"]["rotation"][4 * i], pose.moving_in_fixed.rotation.w());
    expect_near(data["poses"]["rotation"][4 * i + 3], pose.moving_in_fixed.rotation.z());
    expect_near(data["poses"]["translation"][3 * i + 1], pose.moving_in_fixed.translation.y());
    if (i == 4)
      EXPECT_TRUE(columns["fnat"][i].is_null());
    else
      expect_near(columns["fnat"][i], run.metrics[2].values[i]);
  }
  EXPECT_EQ(data["bodies"][0]["atoms"], bodies.fixed.molecule.atoms.size());
  EXPECT_EQ(data["bodies"][1]["structure"]["format"], "pdb");
}

TEST_F(Page, NamesFromFilesAreNeverMarkup) {
  const std::string markup = "</title></script><img src=x onerror=alert(1)>\"'&";
  const ReportBodies bodies = protease();
  mortise::Run run = report_run(bodies, 3);
  run.fixed.path = run.fixed.spec = "a" + markup + ".pdb";
  run.provenance.command_line = run.provenance.options_json = run.provenance.host = markup;
  run.poses.channel_names[0] = "<b>";
  const std::string page = report_page(run, bodies);
  EXPECT_THAT(page, Not(HasSubstr("<img src=x")));
  EXPECT_THAT(page, HasSubstr("<title>script&gt;&lt;img src=x onerror=alert(1)&gt;&quot;'&amp; + "
                              "1hpv_ligand - Mortise</title>"));
  const nlohmann::json data = data_of(page);
  EXPECT_EQ(data["command"], markup);
  EXPECT_EQ(data["columns"][1]["key"], "<b>");
}

TEST_F(Page, LoadsNothingAndSaysSo) {
  const ReportBodies bodies = protease();
  const std::string page = report_page(report_run(bodies, 2), bodies);
  EXPECT_THAT(page, HasSubstr("default-src 'none'; script-src 'sha256-"));
  for (const char* loading : {"<script src", "<link rel=\"stylesheet\"", "@import", "url(http"})
    EXPECT_THAT(page, Not(HasSubstr(loading)));
  EXPECT_THAT(page, Not(HasSubstr("@title@")));
  EXPECT_THAT(page, Not(HasSubstr("@data@")));
}

TEST_F(Page, EqualRunsGiveEqualPages) {
  const ReportBodies bodies = protease();
  const mortise::Run run = report_run(bodies, 50);
  EXPECT_EQ(report_page(run, bodies, {.threads = 1}), report_page(run, bodies, {.threads = 3}));
}

TEST_F(Page, NumbersBeyondPdbColumnsGoAsMmcif) {
  ReportBodies bodies = protease();
  bodies.fixed.molecule.atoms.back().residue_number = 10'000;
  bodies.moving.molecule.atoms.front().chain = "AB";
  const nlohmann::json data = data_of(report_page(report_run(bodies, 1), bodies));
  EXPECT_EQ(data["bodies"][0]["structure"]["format"], "cif");
  EXPECT_EQ(data["bodies"][1]["structure"]["format"], "cif");
}

TEST_F(Page, PartsGoAsMeshes) {
  const ReportBodies bodies = plate_and_pin();
  const nlohmann::json data = data_of(report_page(report_run(bodies, 4), bodies));
  EXPECT_EQ(data["kind"], "mate");
  const std::string bytes = from_base64(data["bodies"][1]["mesh"]["vertices"]);
  ASSERT_EQ(bytes.size(), 4u * bodies.moving.mesh.vertices.size());
  float first = 0.0F;
  std::memcpy(&first, bytes.data(), sizeof first);
  EXPECT_FLOAT_EQ(first, static_cast<float>(bodies.moving.mesh.vertices(0, 0)));
}

TEST_F(Page, SaysWhatBecameOfALargePart) {
  ReportBodies bodies = plate_and_pin();
  bodies.moving.mesh = ball_mesh(Eigen::Vector4d(0.0, 0.0, 0.0, 3.0), 16);  // 5,120 triangles
  const auto body = [&](const PageOptions& options) {
    return data_of(report_page(report_run(bodies, 2), bodies, options))["bodies"][1];
  };
  const nlohmann::json whole = body({});
  EXPECT_EQ(whole["triangles"], 5'120);
  EXPECT_FALSE(whole.contains("deviation"));
  const nlohmann::json less = body({.part_triangles = 1'000});
  EXPECT_EQ(less["triangles"], 5'120);
  EXPECT_LE(less["shown_triangles"], 1'000);
  EXPECT_GT(less["deviation"], 0.0);
  EXPECT_LT(less["deviation"], 0.1);
  EXPECT_EQ(from_base64(less["mesh"]["triangles"]).size(),
            12u * less["shown_triangles"].get<int>());
}

TEST_F(Page, NamesTheRuleOfItsClusters) {
  const ReportBodies bodies = protease();
  mortise::Run run = report_run(bodies, 20);
  const ReportClusters clusters =
      cluster_run(run, bodies, {.measure = ClusterMeasure::kInterface, .radius = 4.0});
  const nlohmann::json data = data_of(report_page(run, bodies, {.clusters = clusters}));
  EXPECT_EQ(data["clusters"]["measure"], "interface");
  EXPECT_EQ(data["clusters"]["radius"], 4.0);
  EXPECT_EQ(data["clusters"]["count"], clusters.sizes.size());
}

TEST_F(Page, RefusesOptionsOutOfRange) {
  const ReportBodies bodies = protease();
  EXPECT_THROW((void)report_page(report_run(bodies, 1), bodies, {.part_triangles = 99}),
               InputError);
  EXPECT_THROW((void)report_page(report_run(bodies, 1), bodies, {.frequency_poses = 0}),
               InputError);
}

}  // namespace
}  // namespace mortise::testing
