// SPDX-License-Identifier: GPL-3.0-or-later
// The run and knots files: what goes in comes out, equal runs are equal bytes, and every damage is
// one clear error.
#include "mortise/store/run_file.hpp"

#include <gmock/gmock.h>

#include <cstdlib>
#include <fstream>

#include "mortise/core/errors.hpp"
#include "mortise/core/version.hpp"
#include "mortise/store/atomic_file.hpp"
#include "mortise/store/knots_file.hpp"
#include "sample_run.hpp"
#include "store/hdf5_file.hpp"
#include "store/records.hpp"

namespace mortise {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using testing::sample_candidates;
using testing::sample_knots;
using testing::sample_run;
using tests::ScratchDirectory;

void put(const std::string& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

std::string read_error(const std::string& path) {
  try {
    (void)read_run(path);
  } catch (const FileError& e) {
    EXPECT_THAT(e.what(), ::testing::StartsWith(path + ": "));
    return e.what();
  }
  return "no error";
}

bool same_motion(const RigidMotion& a, const RigidMotion& b) {
  return a.rotation.coeffs() == b.rotation.coeffs() && a.translation == b.translation;
}

void expect_same_knots(const Knots& a, const Knots& b) {
  EXPECT_EQ(a.points, b.points);
  EXPECT_EQ(a.weights, b.weights);
}

TEST(RunFile, KeepsEveryFieldBitForBit) {
  const ScratchDirectory scratch;
  mortise::Run run = sample_run();
  run.kind = "mate";
  run.moving.kind = "part";
  run.moving.unit = "mm";
  run.complete = false;
  run.candidates = sample_candidates(17);
  run.poses.poses[1].candidate = 16;
  write_run(scratch / "run.h5", run);
  const mortise::Run back = read_run(scratch / "run.h5");
  EXPECT_EQ(back.kind, "mate");
  EXPECT_FALSE(back.complete);
  EXPECT_EQ(back.seconds, run.seconds);
  EXPECT_EQ(back.provenance.mortise_version, run.provenance.mortise_version);
  EXPECT_EQ(back.provenance.command_line, run.provenance.command_line);
  EXPECT_EQ(back.provenance.working_directory, run.provenance.working_directory);
  EXPECT_EQ(back.provenance.options_json, run.provenance.options_json);
  EXPECT_EQ(back.provenance.seed, run.provenance.seed);
  EXPECT_EQ(back.provenance.utc_time, run.provenance.utc_time);
  EXPECT_EQ(back.provenance.host, run.provenance.host);
  ASSERT_EQ(back.figures.size(), 3U);
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(back.figures[i].name, run.figures[i].name);
    EXPECT_EQ(back.figures[i].value, run.figures[i].value);
  }
  for (const auto& [a, b] :
       {std::pair{&back.fixed, &run.fixed}, std::pair{&back.moving, &run.moving}}) {
    EXPECT_EQ(a->path, b->path);
    EXPECT_EQ(a->spec, b->spec);
    EXPECT_EQ(a->sha256, b->sha256);
    EXPECT_EQ(a->unit, b->unit);
    EXPECT_EQ(a->kind, b->kind);
    expect_same_knots(a->knots, b->knots);
    EXPECT_TRUE(same_motion(a->search_from_input, b->search_from_input));
  }
  EXPECT_EQ(back.rotations.quaternions, run.rotations.quaternions);
  EXPECT_EQ(back.rotations.covering_radius, run.rotations.covering_radius);
  EXPECT_EQ(back.rotations.done, run.rotations.done);
  EXPECT_EQ(back.poses.channel_names, run.poses.channel_names);
  ASSERT_EQ(back.poses.poses.size(), run.poses.poses.size());
  for (std::size_t i = 0; i < run.poses.poses.size(); ++i) {
    const Pose& a = back.poses.poses[i];
    const Pose& b = run.poses.poses[i];
    EXPECT_TRUE(same_motion(a.moving_in_fixed, b.moving_in_fixed));
    EXPECT_EQ(a.score, b.score);
    EXPECT_EQ(a.channels, b.channels);
    EXPECT_EQ(a.rotation_index, b.rotation_index);
    EXPECT_EQ(a.cluster, b.cluster);
    EXPECT_EQ(a.candidate, b.candidate);
  }
  ASSERT_EQ(back.metrics.size(), 2U);
  EXPECT_EQ(back.metrics[0].name, "interface_rmsd");
  EXPECT_EQ(back.metrics[0].values, run.metrics[0].values);
  EXPECT_TRUE(std::isnan(back.metrics[1].values[1]));
  ASSERT_EQ(back.candidates.size(), 17U);
  for (std::size_t i = 0; i < 17; ++i) {
    EXPECT_EQ(back.candidates[i].rotation_index, run.candidates[i].rotation_index);
    EXPECT_EQ(back.candidates[i].score, run.candidates[i].score);
    EXPECT_EQ(back.candidates[i].offset_index, run.candidates[i].offset_index);
    EXPECT_EQ(back.candidates[i].translation, run.candidates[i].translation);
  }
}

TEST(RunFile, EqualRunsAreEqualBytesAndWritingWhatWasReadChangesNothing) {
  const ScratchDirectory scratch;
  mortise::Run run = sample_run(300);
  run.candidates = sample_candidates(1000);
  write_run(scratch / "a.h5", run);
  const std::string bytes = read_whole_file(scratch / "a.h5");
  ::sleep(1);  // no time but the run's own is in the file
  EXPECT_EQ(bytes, serialize_run(run));
  EXPECT_EQ(bytes, serialize_run(read_run(scratch / "a.h5")));
  run.poses.poses[17].score += 1e-9;
  EXPECT_NE(bytes, serialize_run(run));
}

TEST(RunFile, HoldsEmptyAndLargeContents) {
  const ScratchDirectory scratch;
  const mortise::Run empty;
  write_run(scratch / "empty.h5", empty);
  EXPECT_EQ(serialize_run(read_run(scratch / "empty.h5")), serialize_run(empty));
  mortise::Run large = sample_run(70000);                    // more than one chunk of each array
  large.provenance.options_json = std::string(300000, 'x');  // more than HDF5's old limit of 64 kB
  large.provenance.command_line.clear();
  write_run(scratch / "large.h5", large);
  const mortise::Run back = read_run(scratch / "large.h5");
  EXPECT_EQ(back.provenance.options_json, large.provenance.options_json);
  EXPECT_EQ(back.provenance.command_line, "");
  EXPECT_EQ(back.poses.poses[69999].score, large.poses.poses[69999].score);
}

TEST(RunFile, RefusesRunsThatDoNotAgreeWithThemselves) {
  const auto error_of = [](auto change) -> std::string {
    mortise::Run run = sample_run();
    run.candidates = sample_candidates(4);
    change(run);
    try {
      (void)serialize_run(run);
    } catch (const InputError& e) {
      return e.what();
    }
    return "no error";
  };
  EXPECT_EQ(error_of([](mortise::Run&) {}), "no error");
  EXPECT_THAT(error_of([](mortise::Run& r) { r.kind = "glue"; }),
              HasSubstr("kind: expected dock or mate"));
  EXPECT_THAT(error_of([](mortise::Run& r) { r.rotations.done.pop_back(); }),
              HasSubstr("expected 50 entries, got 49"));
  EXPECT_THAT(error_of([](mortise::Run& r) { r.poses.poses[2].channels.pop_back(); }),
              HasSubstr("pose 3 channels"));
  EXPECT_THAT(error_of([](mortise::Run& r) { r.poses.poses[1].rotation_index = 50; }),
              HasSubstr("rotation index 50"));
  EXPECT_THAT(error_of([](mortise::Run& r) { r.poses.poses[1].candidate = 4; }),
              HasSubstr("candidate 4 is not one of 4"));
  EXPECT_THAT(error_of([](mortise::Run& r) { r.poses.poses[1].score = NAN; }),
              HasSubstr("pose 2: the score"));
  EXPECT_THAT(
      error_of([](mortise::Run& r) { r.poses.poses[0].moving_in_fixed.translation.x() = NAN; }),
      HasSubstr("finite translation"));
  EXPECT_THAT(error_of([](mortise::Run& r) { r.metrics[1].values.pop_back(); }),
              HasSubstr("metric fnat"));
  EXPECT_THAT(error_of([](mortise::Run& r) { r.metrics[1].name = "interface_rmsd"; }),
              HasSubstr("appears twice"));
  EXPECT_THAT(error_of([](mortise::Run& r) { r.poses.channel_names[0] = "a/b"; }),
              HasSubstr("without \"/\""));
  EXPECT_THAT(error_of([](mortise::Run& r) { r.fixed.knots.points(3, 0) = -1.0; }),
              HasSubstr("fixed knots"));
  EXPECT_THAT(error_of([](mortise::Run& r) { r.candidates[0].rotation_index = -1; }),
              HasSubstr("candidate 1: rotation index -1"));
  EXPECT_THAT(error_of([](mortise::Run& r) { r.candidates[1].rotation_index = 3; }),
              HasSubstr("candidate 2: its rotation is not among those done"));
  EXPECT_THAT(error_of([](mortise::Run& r) { r.candidates[2].translation[1] = NAN; }),
              HasSubstr("candidate 3: expected a finite score and translation"));
  EXPECT_THAT(error_of([](mortise::Run& r) { r.moving.kind = "glue"; }),
              HasSubstr("moving kind: expected molecule, part or balls"));
}

TEST(RunFile, SaysWhatIsWrongWithAFile) {
  const ScratchDirectory scratch;
  EXPECT_THAT(read_error(scratch / "none.h5"), HasSubstr("found none"));
  EXPECT_THAT(read_error(scratch.path().string()), HasSubstr("found a directory"));
  put(scratch / "empty.h5", "");
  EXPECT_THAT(read_error(scratch / "empty.h5"), HasSubstr("found an empty file"));
  put(scratch / "text.h5", "ATOM      1  N   MET A   1");
  EXPECT_THAT(read_error(scratch / "text.h5"),
              HasSubstr("expected an HDF5 file, found something else"));
  hdf5::Writer foreign;
  foreign.group("/data");
  put(scratch / "foreign.h5", foreign.bytes());
  EXPECT_THAT(read_error(scratch / "foreign.h5"), HasSubstr("not one of Mortise's"));
  hdf5::Writer future;
  hdf5::write_head(future, "run", 99, sample_run().provenance);
  put(scratch / "future.h5", future.bytes());
  EXPECT_THAT(read_error(scratch / "future.h5"),
              AllOf(HasSubstr("expected format version 2"),
                    HasSubstr("found 99, written by Mortise 0.1.0")));
  hdf5::Writer headless;
  hdf5::write_head(headless, "run", kRunFormatVersion, sample_run().provenance);
  put(scratch / "headless.h5", headless.bytes());
  EXPECT_THAT(read_error(scratch / "headless.h5"), HasSubstr("attribute kind of / is missing"));
  KnotsFile knots;
  std::mt19937 random(3);
  knots.knots = sample_knots(3, random);
  write_knots_file(scratch / "knots.h5", knots);
  EXPECT_THAT(read_error(scratch / "knots.h5"),
              HasSubstr("expected a run file, found a knots file"));
}

TEST(RunFile, NamesTheDatasetThatIsMissingOrMisshapen) {
  const ScratchDirectory scratch;
  hdf5::Writer partial;
  hdf5::write_head(partial, "run", kRunFormatVersion, sample_run().provenance);
  partial.attribute("/", "kind", "dock");
  partial.attribute("/", "complete", std::int64_t{1});
  partial.attribute("/", "seconds", 1.0);
  hdf5::write_figures(partial, "/figures", {});
  partial.group("/fixed");
  for (const char* name : {"path", "spec", "sha256", "kind"})
    partial.attribute("/fixed", name, "x");
  put(scratch / "missing.h5", partial.bytes());
  EXPECT_THAT(read_error(scratch / "missing.h5"), HasSubstr("dataset /fixed/knots is missing"));
  const double six[6] = {1, 2, 3, 4, 5, 6};
  partial.array("/fixed/knots", {2, 3}, six);
  put(scratch / "misshapen.h5", partial.bytes());
  EXPECT_THAT(read_error(scratch / "misshapen.h5"),
              HasSubstr("/fixed/knots: expected 2 x 4, found 2 x 3"));
}

TEST(RunFile, FindsEveryTruncationAndNeverCrashesOnAFlippedByte) {
  const ScratchDirectory scratch;
  const std::string path = scratch / "run.h5";
  const mortise::Run run = sample_run(20);
  const std::string whole = serialize_run(run);
  for (std::size_t size = 0; size < whole.size(); size += 1 + size / 40) {
    put(path, whole.substr(0, size));
    EXPECT_NE(read_error(path), "no error") << size << " of " << whole.size() << " bytes";
  }
  put(path, whole);
  ASSERT_EQ(read_error(path), "no error");
  put(path, whole.substr(0, whole.size() - 1));
  EXPECT_THAT(read_error(path),
              HasSubstr("truncated: expected " + std::to_string(whole.size()) + " bytes, found"));
  std::mt19937 random(5);
  int found = 0;
  constexpr int kTrials = 300;
  for (int i = 0; i < kTrials; ++i) {
    std::string damaged = whole;
    damaged[random() % whole.size()] ^= static_cast<char>(1U << random() % 8);
    put(path, damaged);
    try {
      found += serialize_run(read_run(path)) == whole ? 1 : 0;  // equal: the byte was padding
    } catch (const FileError&) {
      ++found;
    }
  }
  EXPECT_EQ(found, kTrials) << "some damage was read as if it were data";
}

TEST(KnotsFile, KeepsItsContentsAndIsToldApart) {
  const ScratchDirectory scratch;
  KnotsFile file;
  std::mt19937 random(2);
  file.provenance = make_provenance("mortise decompose part.stl", R"({"n1": 10})", 3);
  file.source_path = "part.stl";
  file.source_sha256 = std::string(64, 'c');
  file.knots = sample_knots(11, random);
  file.tree = sphere_tree(file.knots.points, {.arity = 3});
  file.figures = {{"hausdorff", 0.25}};
  write_knots_file(scratch / "k.h5", file);
  const KnotsFile back = read_knots_file(scratch / "k.h5");
  expect_same_knots(back.knots, file.knots);
  ASSERT_TRUE(back.tree);
  EXPECT_EQ(back.tree->balls, file.tree->balls);
  EXPECT_EQ(back.tree->first_child, file.tree->first_child);
  EXPECT_EQ(back.tree->children, file.tree->children);
  EXPECT_EQ(back.tree->leaf, file.tree->leaf);
  file.tree.reset();
  write_knots_file(scratch / "no_tree.h5", file);
  EXPECT_FALSE(read_knots_file(scratch / "no_tree.h5").tree);
  file.tree = sphere_tree(file.knots.points.leftCols(10));
  EXPECT_THROW(write_knots_file(scratch / "none.h5", file), InputError) << "a tree of other knots";
  EXPECT_EQ(back.source_path, file.source_path);
  EXPECT_EQ(back.source_sha256, file.source_sha256);
  EXPECT_EQ(back.provenance.command_line, file.provenance.command_line);
  EXPECT_EQ(back.provenance.mortise_version, kVersion);
  ASSERT_EQ(back.figures.size(), 1U);
  EXPECT_EQ(back.figures[0].value, 0.25);
  write_run(scratch / "r.h5", sample_run());
  put(scratch / "t.pdb", "HEADER");
  hdf5::Writer foreign;
  put(scratch / "f.h5", foreign.bytes());
  EXPECT_EQ(stored_kind(scratch / "k.h5"), StoredKind::kKnots);
  EXPECT_EQ(stored_kind(scratch / "r.h5"), StoredKind::kRun);
  EXPECT_EQ(stored_kind(scratch / "t.pdb"), StoredKind::kNotHdf5);
  EXPECT_EQ(stored_kind(scratch / "f.h5"), StoredKind::kOtherHdf5);
  EXPECT_THROW((void)read_knots_file(scratch / "r.h5"), FileError);
  EXPECT_THROW(write_knots_file(scratch / "none.h5", KnotsFile{}), InputError);
}

TEST(Provenance, TimeFollowsSourceDateEpochAndChecksumsAreThoseOfTheStandard) {
  ::setenv("SOURCE_DATE_EPOCH", "86400", 1);
  EXPECT_EQ(utc_now(), "1970-01-02T00:00:00Z");
  ::setenv("SOURCE_DATE_EPOCH", "soon", 1);
  EXPECT_THROW((void)utc_now(), InputError);
  ::unsetenv("SOURCE_DATE_EPOCH");
  EXPECT_GT(utc_now(), "2025-01-01T00:00:00Z");
  const ScratchDirectory scratch;
  put(scratch / "abc", "abc");  // the test value of FIPS 180-2, B.1
  EXPECT_EQ(sha256_of_file(scratch / "abc"),
            "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  put(scratch / "none", "");
  EXPECT_EQ(sha256_of_file(scratch / "none"),
            "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_THROW((void)sha256_of_file(scratch / "missing"), FileError);
  EXPECT_THROW((void)sha256_of_file(scratch.path().string()), FileError);
}

}  // namespace
}  // namespace mortise
