// Curves that must not be fitted to.

#include <filesystem>
#include <string>

#include "io/text/content_hash.h"
#include "io/text/input_error.h"
#include "io/text/whole_file.h"
#include "tests/extremes/calibration_rows.h"
#include "tests/support/temporary_folder.h"
#include "tests/unit/voxel/calibration/calibration_samples.h"
#include "voxel/calibration/calibration_study.h"

namespace menger::extremes {

namespace {

namespace fs = std::filesystem;

/// A study with one curve of inflation, in a folder that goes with it.
class StudyFolder {
 public:
  StudyFolder() {
    meshes::LoadCase load_case = voxel::samples::load_cases().front();
    load_case.name = "tube";
    meshes::write_response_curve(folder_ / "curves", voxel::samples::curve_of(load_case, calibration_truth()));
    write_study("", "0.002");
  }

  /// @param keys lines at the top level
  void write_study(const std::string& keys, const std::string& wall_thickness_m) const {
    io::write_whole(folder_ / "study.toml",
                    "curves = [\"curves\"]\n" + keys +
                        "[holds_for]\nsilicone = \"Dragon Skin 10\"\ncell_edge_m = 0.01\nwall_thickness_m = " + wall_thickness_m +
                        "\n");
  }

  void remove_provenance() const { fs::remove(folder_ / "curves/tube.toml"); }

  [[nodiscard]] std::string table() const { return io::read_whole(folder_ / "curves/tube.csv"); }

  /// Puts a table in place of the curve's, and with `signs` its hash into the provenance, as whoever made it so would.
  void replace_table(const std::string& text, bool signs) const {
    std::string provenance = io::read_whole(folder_ / "curves/tube.toml");
    const std::string old_hash = io::content_hash(table());
    if (signs) provenance.replace(provenance.find(old_hash), old_hash.size(), io::content_hash(text));
    io::write_whole(folder_ / "curves/tube.csv", text);
    io::write_whole(folder_ / "curves/tube.toml", provenance);
  }

  /// Reads the study, which must be refused with all of `parts` in the message.
  void expect_refused(Outcome& outcome, const std::vector<std::string>& parts) const {
    try {
      voxel::read_calibration_study(folder_ / "study.toml");
      outcome.expect(false, "the study was accepted");
    } catch (const io::InputError& error) {
      std::string text = error.what();
      const std::string path = folder_.path().string() + "/";  // another one each time
      for (std::size_t place = text.find(path); place != std::string::npos; place = text.find(path))
        text.erase(place, path.size());
      outcome.note(text);
      for (const std::string& part : parts)
        if (text.find(part) == std::string::npos) outcome.expect(false, "does not say \"" + part + "\"");
    }
  }

 private:
  const tests::TemporaryFolder folder_{"menger-extremes"};
};

/// A text with the first occurrence of a part replaced.
std::string with(std::string text, const std::string& part, const std::string& other) {
  return text.replace(text.find(part), part.size(), other);
}

void judge_units(Outcome& outcome) {
  const StudyFolder study;
  study.replace_table(with(study.table(), "pressure_Pa", "pressure_kPa"), true);
  study.expect_refused(outcome, {"curves/tube.csv: ", "must be pressure_Pa", "pressure_kPa"});
}

/// The fourth state is put before the third.
void judge_order(Outcome& outcome) {
  const StudyFolder study;
  const std::string text = study.table();
  const std::size_t third = text.find("\n-6000") + 1;
  const std::size_t fourth = text.find("\n-3000") + 1;
  const std::size_t fifth = text.find("\n3000") + 1;
  study.replace_table(
      text.substr(0, third) + text.substr(fourth, fifth - fourth) + text.substr(third, fourth - third) + text.substr(fifth),
      true);
  study.expect_refused(outcome, {"curves/tube.csv: ", "pressure_Pa = -6000", "row 4", "monotone"});
}

void judge_unsigned(Outcome& outcome) {
  const StudyFolder study;
  study.replace_table(with(study.table(), "\n-6000", "\n-6500"), false);
  study.expect_refused(outcome, {"curves/tube.toml:", "table_hash"});
}

void judge_without_provenance(Outcome& outcome) {
  const StudyFolder study;
  study.remove_provenance();
  study.expect_refused(outcome, {"study.toml", "curves", "no response curve (NAME.toml and NAME.csv)"});
}

void judge_missing_case(Outcome& outcome) {
  const StudyFolder study;
  study.write_study("cases = [\"tube\", \"joint\"]\n", "0.002");
  study.expect_refused(outcome, {"study.toml:2: ", "cases", "no curve is there for joint"});
}

void judge_other_wall(Outcome& outcome) {
  const StudyFolder study;
  study.write_study("", "0.003");
  study.expect_refused(outcome, {"curves/tube.toml: ", "wall_thickness_m = 0.002", "0.003"});
}

}  // namespace

std::vector<Row> calibration_input_rows() {
  std::vector<Row> rows;
  rows.push_back({.name = "curve in other units",
                  .done = "the table of a curve, with its hash, has pressure_kPa in place of pressure_Pa",
                  .expected = "InputError that names file, column and the columns that must be there",
                  .judge = judge_units});
  rows.push_back(
      {.name = "curve that turns back",
       .done = "two states of inflation have changed places, hash included",
       .expected = "InputError that names file, column, value and row: which branch is meant is not for a fit to guess",
       .judge = judge_order});
  rows.push_back({.name = "table changed by hand",
                  .done = "a pressure in a table is changed after its provenance was written",
                  .expected = "InputError that names the provenance and its hash",
                  .judge = judge_unsigned});
  rows.push_back({.name = "curve without provenance",
                  .done = "the provenance beside the only table of a study is removed",
                  .expected = "InputError that names study and key: a table that does not say what it is of is not fitted to",
                  .judge = judge_without_provenance});
  rows.push_back({.name = "load case that is missing",
                  .done = "a study asks for the cases tube and joint, and has a curve of tube alone",
                  .expected = "InputError that names study, line, key and the case that is missing",
                  .judge = judge_missing_case});
  rows.push_back({.name = "curve of another wall",
                  .done = "a study for walls of 3 mm is given a curve of walls of 2 mm",
                  .expected = "InputError that names the provenance, its key and both values",
                  .judge = judge_other_wall});
  return rows;
}

}  // namespace menger::extremes
