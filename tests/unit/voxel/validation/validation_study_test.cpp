#include "voxel/validation/validation_study.h"

#include <gtest/gtest.h>

#include "io/study/study_reader.h"
#include "io/text/content_hash.h"
#include "io/text/input_error.h"
#include "io/text/whole_file.h"
#include "tests/support/described_study.h"
#include "tests/support/test_folder.h"
#include "tests/unit/voxel/validation/validation_samples.h"

namespace menger::voxel {
namespace {

namespace fs = std::filesystem;
using meshes::LoadCaseKind;
using samples::bar_curve;
using samples::validation_parameters;

class ValidationStudyFile : public testing::Test {
 protected:
  [[nodiscard]] ValidationStudy study(const std::string& text) const {
    io::write_whole(folder_ / "study.toml", text);
    return read_validation_study(folder_ / "study.toml");
  }

  /// A curve in the folder "curves".
  void write_curve(const std::string& name, const std::string& silicone = "test silicone", double edge_m = 0.01) const {
    meshes::ResponseCurve curve = bar_curve(name, LoadCaseKind::blocked, {{1e3, 2e3}, {-0.1, -0.2}, {0.1, 0.2}});
    curve.provenance.silicone = silicone;
    curve.provenance.load_case.cell_edge_m = edge_m;
    meshes::write_response_curve(folder_ / "curves", curve);
  }

  /// What reading the curves of a study on the folder "curves" complains of; empty if it does not.
  [[nodiscard]] std::string complaint(const FitRecord& record = {}) const {
    try {
      (void)read_held_out_curves(study("parameters = 'p.toml'\ncurves = ['curves']"), validation_parameters(), record);
    } catch (const io::InputError& error) {
      return error.what();
    }
    return "";
  }

  const tests::TestFolder folder_;
};

TEST_F(ValidationStudyFile, CountsPathsFromItsFolder) {
  const ValidationStudy read = study("parameters = 'p.toml'\ncurves = ['a', '/b']\naim = 0.2");
  EXPECT_EQ(read.parameters, folder_ / "p.toml");
  EXPECT_EQ(read.curves, (std::vector<fs::path>{folder_ / "a", "/b"}));
  EXPECT_EQ(read.aim, 0.2);
  EXPECT_EQ(read.actuation_pressure_Pa, 6000.0);
}

TEST_F(ValidationStudyFile, TakesPlacesOfTheUserInsteadOfItsOwn) {
  io::write_whole(folder_ / "study.toml", "aim = 0.2");
  const ValidationStudy read = read_validation_study(folder_ / "study.toml", {.parameters = "p.toml", .curves = {"a", "b"}});
  EXPECT_EQ(read.parameters, "p.toml");
  EXPECT_EQ(read.curves, (std::vector<fs::path>{"a", "b"}));
  EXPECT_THROW((void)read_validation_study(folder_ / "study.toml", {.parameters = "p.toml", .curves = {}}), io::InputError);
  EXPECT_THROW((void)read_validation_study(folder_ / "study.toml", {.parameters = {}, .curves = {"a"}}), io::InputError);
}

TEST_F(ValidationStudyFile, MakesCurvesOfLoadCasesInTheFirstFolder) {
  ValidationStudy with = study("parameters = 'p.toml'\ncurves = ['a', 'b']\nload_cases = 'set.toml'");
  EXPECT_EQ(load_case_folder(with, "elsewhere"), folder_ / "a");
  EXPECT_EQ(with.curves.size(), 2U);
  ValidationStudy without = study("parameters = 'p.toml'\nload_cases = 'set.toml'");
  EXPECT_EQ(load_case_folder(without, "elsewhere"), "elsewhere");
  EXPECT_EQ(without.curves, std::vector<fs::path>{"elsewhere"});
  ValidationStudy file = study("parameters = 'p.toml'\ncurves = ['study.toml']\nload_cases = 'set.toml'");
  EXPECT_THROW((void)load_case_folder(file, "elsewhere"), io::InputError);
}

ValidationStudy parsed(const std::string& text) {
  ValidationStudy study;
  io::read_described(io::parse_toml(text, "study.toml"), study);
  return study;
}

TEST_F(ValidationStudyFile, TemplateIsReadToTheDefaultsAndToEachAlternative) {
  tests::expect_template_is_read<ValidationStudy>(parsed);
}

TEST_F(ValidationStudyFile, TextsOfAllStudiesAreReadBack) { tests::expect_texts_are_read_back<ValidationStudy>(parsed); }

TEST_F(ValidationStudyFile, NamesKeyAndValueOfBadInput) {
  for (const auto& [text, message] :
       {std::pair{"curves = ['a']", "parameters"},
        {"parameters = 'p'", "parameters = \"p\": is neither a file (.toml) nor one of"},
        {"parameters = 'p.toml'", "curves"},
        {"parameters = 'p.toml'\ncurves = []", "curves"},
        {"parameters = 'p.toml'\ncurves = ['a']\naim = 0", "aim = 0"},
        {"parameters = 'p.toml'\ncurves = ['a']\nactuation_amplitude = 1.5", "actuation_amplitude = 1.5"},
        {"parameters = 'p.toml'\ncurves = ['a']\ncurve = 1", "curve"}}) {
    try {
      (void)study(text);
      ADD_FAILURE() << text;
    } catch (const io::InputError& error) {
      EXPECT_NE(std::string(error.what()).find(message), std::string::npos) << error.what();
    }
  }
}

TEST_F(ValidationStudyFile, ReadsEveryCurveOnce) {
  write_curve("b");
  write_curve("a");
  io::write_whole(folder_ / "curves/summary.toml", "what = 'no curve'");
  const ValidationStudy twice = study("parameters = 'p.toml'\ncurves = ['curves/b.toml', 'curves']");
  const std::vector<HeldOutCurve> curves = read_held_out_curves(twice, validation_parameters(), {});
  ASSERT_EQ(curves.size(), 2U);
  EXPECT_EQ(curves[0].file.filename(), "b.toml");
  EXPECT_EQ(curves[1].file.filename(), "a.toml");
}

TEST_F(ValidationStudyFile, RefusesCurvesOfOtherBodies) {
  write_curve("bar");
  EXPECT_EQ(complaint(), "");
  write_curve("bar", "another");
  EXPECT_NE(complaint().find("bar.toml: silicone = \"another\": the parameters"), std::string::npos) << complaint();
  EXPECT_NE(complaint().find("are for \"test silicone\""), std::string::npos) << complaint();
  write_curve("bar", "test silicone", 0.012);
  EXPECT_NE(complaint().find("case.cell_edge_m = 0.012"), std::string::npos) << complaint();
}

TEST_F(ValidationStudyFile, RefusesCurvesThatWereFitted) {
  write_curve("bar");
  for (const char* part : {"curves/bar.csv", "curves/bar.toml"}) {
    const FitRecord record{.curve_count = 1, .hashes = {"0", io::file_hash(folder_ / part)}};
    EXPECT_NE(complaint(record).find("is not held out"), std::string::npos) << part;
  }
  EXPECT_EQ(complaint({.curve_count = 1, .hashes = {"0"}, .subjects = {"blocked of 2x1x1:11, level 1"}}), "");
}

TEST_F(ValidationStudyFile, RefusesTheBodyAndLoadOfTheFitUnderAnotherName) {
  write_curve("renamed");
  const FitRecord record{.curve_count = 1, .hashes = {"0"}, .subjects = {"blocked of 3x1x1:111, level 1"}};
  EXPECT_NE(complaint(record).find("renamed.toml: case = \"blocked of 3x1x1:111, level 1\": is not held out"), std::string::npos)
      << complaint(record);
}

TEST_F(ValidationStudyFile, RefusesTwoCurvesOfOneName) {
  write_curve("bar");
  for (const char* part : {"bar.csv", "bar.toml"}) {
    fs::create_directories(folder_ / "more");
    fs::copy_file(folder_ / "curves" / part, folder_ / "more" / part);
  }
  const ValidationStudy both = study("parameters = 'p.toml'\ncurves = ['curves', 'more']");
  EXPECT_THROW((void)read_held_out_curves(both, validation_parameters(), {}), io::InputError);
}

TEST_F(ValidationStudyFile, RefusesPlacesWithoutCurves) {
  EXPECT_NE(complaint().find("curves"), std::string::npos) << "nothing is there";
  fs::create_directories(folder_ / "curves");
  EXPECT_NE(complaint().find("contains no response curve"), std::string::npos);
}

TEST_F(ValidationStudyFile, FindsTheCurvesOfTheFitInTheParameters) {
  io::write_whole(folder_ / "p.toml",
                  "[fit]\nchi2 = 1.0\n[[fit.curves]]\nname = 'a'\nhash = 'abc'\n"
                  "[[fit.curves]]\nname = 'b'\nhash = 'def'\ntable_hash = 'ghi'\nsubject = 'blocked'\n");
  const FitRecord record = read_fit_record(folder_ / "p.toml");
  EXPECT_EQ(record.curve_count, 2U);
  EXPECT_EQ(record.hashes, (std::vector<std::string>{"abc", "def", "ghi"}));
  EXPECT_EQ(record.subjects, std::vector<std::string>{"blocked"});
  io::write_whole(folder_ / "p.toml", "[mass]\n");
  EXPECT_EQ(read_fit_record(folder_ / "p.toml").curve_count, 0U);
}

}  // namespace
}  // namespace menger::voxel
