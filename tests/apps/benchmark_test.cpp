// SPDX-License-Identifier: GPL-3.0-or-later
// mortise benchmark on small tables: rows, success counts, restart, failures.
#include <csignal>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "apps/program.hpp"
#include "mortise/store/csv.hpp"

namespace mortise {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using testing::Outcome;

constexpr const char* kHeader =
    "name,unbound_interface_rmsd,fixed,moving,reference_fixed,reference_moving\n";
constexpr const char* kFiles =
    "1hpv_receptor.pdb,1hpv_ligand.pdb,1hpv_complex.pdb:A,1hpv_complex.pdb:B\n";

class Benchmark : public testing::Program {
 protected:
  void write_table(const std::string& rows) const {
    std::ofstream(path("data/pairs.csv")) << kHeader << rows;
  }

  // The table lies in a folder of its own: its paths count from there.
  Benchmark() {
    fs::create_directory(scratch_ / "data");
    for (const char* file : {"1hpv_receptor.pdb", "1hpv_ligand.pdb", "1hpv_complex.pdb"})
      fs::rename(path(file), path(std::string("data/") + file));
    write_table(std::string("HPV1,0.0,") + kFiles + "HPV2,2.5," + kFiles + "\nHPV3,1.5," + kFiles);
  }

  // Cells of the rows, by name of the pair and column.
  std::map<std::string, std::map<std::string, std::string>> rows(const std::string& file) const {
    std::istringstream text(read_whole_file(path(file)));
    std::string line;
    std::getline(text, line);
    EXPECT_THAT(line, ::testing::StartsWith("# mortise benchmark {"));
    std::getline(text, line);
    const std::vector<std::string> columns = csv_cells(line);
    std::map<std::string, std::map<std::string, std::string>> result;
    while (std::getline(text, line)) {
      const std::vector<std::string> values = csv_cells(line);
      EXPECT_EQ(values.size(), columns.size()) << line;
      for (std::size_t i = 0; i < std::min(values.size(), columns.size()); ++i)
        result[values[0]][columns[i]] = values[i];
    }
    return result;
  }
};

TEST_F(Benchmark, DocksEachPairOnceAndCountsSuccesses) {
  const std::string command = "benchmark data/pairs.csv -o results.csv --rotations 900";
  const Outcome fold = must(command + " --fold 1/2 --runs runs");  // HPV1, HPV3
  EXPECT_THAT(fold.out, AllOf(HasSubstr("HPV1 "), HasSubstr("HPV3 "), HasSubstr("class")));
  EXPECT_THAT(fold.out, ::testing::Not(HasSubstr("HPV2")));
  const auto before = rows("results.csv");
  ASSERT_EQ(before.size(), 2U);
  EXPECT_EQ(before.at("HPV1").at("difficulty"), "easy");
  EXPECT_EQ(before.at("HPV3").at("difficulty"), "medium");
  EXPECT_EQ(before.at("HPV1").at("rotations"), "900");
  EXPECT_EQ(before.at("HPV1").at("error"), "");
  for (const char* column : {"seconds", "cpu_seconds", "peak_memory_mb", "poses"})
    EXPECT_GT(std::stod(before.at("HPV1").at(column)), 0.0) << column;

  const nlohmann::json json = this->json(command);
  const auto after = rows("results.csv");
  EXPECT_EQ(after.at("HPV1"), before.at("HPV1"));  // seconds too: not docked again
  EXPECT_EQ(after.at("HPV2").at("difficulty"), "hard");
  EXPECT_EQ(json["pairs"], 3);
  EXPECT_EQ(json["failed"], 0);
  int acceptable = 0;
  for (const auto& [name, row] : after)
    if (const std::string& first = row.at("first_acceptable");
        !first.empty() && std::stoi(first) <= 100)
      ++acceptable;
  EXPECT_GE(acceptable, 2);  // bound partners: nearly always at the top
  EXPECT_EQ(json["success"][0]["criterion"], "acceptable");
  EXPECT_EQ(json["success"][0]["pairs"], 3);
  EXPECT_EQ(json["success"][0]["top_100"], acceptable);
  EXPECT_THAT(read_whole_file(path("results_summary.csv")), HasSubstr("\nall,acceptable,3,0,"));

  // The run that was kept is the one that was measured, and starts differ between pairs.
  const nlohmann::json again = this->json(
      "evaluate runs/HPV1.h5 --reference-fixed data/1hpv_complex.pdb:A --reference-moving "
      "data/1hpv_complex.pdb:B");
  const std::string& first = after.at("HPV1").at("first_acceptable");
  EXPECT_EQ(again["first_acceptable"].dump(), first.empty() ? "null" : first);
  EXPECT_NE(read_run(path("runs/HPV1.h5")).provenance.seed,
            read_run(path("runs/HPV3.h5")).provenance.seed);

  expect_user_error(command + " --spacing 4",
                    "spacing differs: the file was begun with 3.0, asked for now is 4.0");
  expect_user_error(command + " --seed 2", "seed differs");
}

TEST_F(Benchmark, AFailingPairSparesTheRestAndIsTriedAgain) {
  write_table(std::string("BAD,0.0,none.pdb,1hpv_ligand.pdb,1hpv_complex.pdb,x.pdb\nHPV1,0.0,") +
              kFiles);
  const std::string command =
      "benchmark data/pairs.csv -o results.csv --rotations 60 --jobs 2 --threads 1";
  const Outcome outcome = mortise(command);
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.error, AllOf(HasSubstr("mortise: warning: pair BAD failed: data/none.pdb"),
                                   HasSubstr("mortise: error: benchmark: 1 of 2 pairs failed")));
  EXPECT_THAT(outcome.out, HasSubstr("HPV1"));
  const auto before = rows("results.csv");
  EXPECT_THAT(before.at("BAD").at("error"), HasSubstr("none.pdb"));
  EXPECT_EQ(before.at("HPV1").at("error"), "");
  write_table(std::string("BAD,0.0,") + kFiles + "HPV1,0.0," + kFiles);
  must(command);
  EXPECT_EQ(rows("results.csv").at("BAD").at("error"), "");
  EXPECT_EQ(rows("results.csv").at("HPV1"), before.at("HPV1"));
}

TEST_F(Benchmark, CtrlCKeepsTheRowsDone) {
  const std::string command =
      "benchmark data/pairs.csv -o results.csv --rotations 1800 --threads 1";
  const pid_t process = start(command);
  ASSERT_TRUE(wait_for("results.csv"));
  ::kill(process, SIGINT);  // only the parent: it passes it on
  const Outcome outcome = finish(process);
  EXPECT_EQ(outcome.code, 130);
  EXPECT_THAT(outcome.error, HasSubstr("of 3 pairs are in results.csv; the same command goes on"));
  const auto before = rows("results.csv");
  EXPECT_GE(before.size(), 1U);
  EXPECT_LT(before.size(), 3U);
  const Outcome rest = must(command);
  EXPECT_THAT(rest.error, HasSubstr("are in results.csv already"));
  EXPECT_EQ(rows("results.csv").size(), 3U);
  EXPECT_EQ(rows("results.csv").at("HPV1"), before.at("HPV1"));
}

TEST_F(Benchmark, NamesEachFaultInOneLine) {
  const std::string command = "benchmark data/pairs.csv -o results.csv";
  expect_user_error("benchmark none.csv -o results.csv", "none.csv");
  expect_user_error("benchmark data/1hpv_ligand.pdb -o results.csv", "pdb:1: expected the header");
  expect_user_error(command + " --subset HPV9", "has no pair HPV9");
  expect_user_error(command + " --subset HPV1 --fold 2/2", "leave no pair");
  for (const char* fold : {"0/2", "3/2", "1", "1/2x", "a/b"})
    expect_user_error(command + " --fold " + fold, "--fold: expected i/k");
  expect_user_error("benchmark data/pairs.csv -o no/such.csv", "there is no directory");
  expect_user_error("benchmark data/pairs.csv -o data/1hpv_ligand.pdb",
                    "expected a file that mortise benchmark wrote");
  write_table("HPV1,0.0,a,b,c\n");
  expect_user_error(command, "pairs.csv:2: expected 6 cells, found 5");
  write_table("../x,0.0,a,b,c,d\n");
  expect_user_error(command, "pairs.csv:2: expected a pair's name");
  write_table("HPV1,far,a,b,c,d\n");
  expect_user_error(command, "unbound_interface_rmsd: expected a number >= 0, found \"far\"");
  write_table("HPV1,0,a,b,c,d\nHPV1,0,a,b,c,d\n");
  expect_user_error(command, "pairs.csv:3: pair HPV1 is there twice");
}

}  // namespace
}  // namespace mortise
