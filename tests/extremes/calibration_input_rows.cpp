// Curves that a fit must refuse.

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

/// A study with one inflation curve, in a temporary folder.
class StudyFolder {
 public:
  StudyFolder() {
    meshes::LoadCase load_case = voxel::samples::load_cases().front();
    load_case.name = "tube";
    meshes::write_response_curve(folder_ / "curves", voxel::samples::curve_of(load_case, calibration_truth()));
    write_study("", "0.002");
  }

  /// @param keys lines at the top level of the study
  void write_study(const std::string& keys, const std::string& wall_thickness_m) const {
    io::write_whole(folder_ / "study.toml",
                    "curves = [\"curves\"]\n" + keys +
                        "[holds_for]\nsilicone = \"Dragon Skin 10\"\ncell_edge_m = 0.01\nwall_thickness_m = " + wall_thickness_m +
                        "\n");
  }

  void remove_provenance() const { fs::remove(folder_ / "curves/tube.toml"); }

  [[nodiscard]] std::string table() const { return io::read_whole(folder_ / "curves/tube.csv"); }

  /// Replaces the table of the curve. With `signs` the hash in the provenance is replaced too, as the maker of such a table would
  /// do.
  void replace_table(const std::string& text, bool signs) const {
    std::string provenance = io::read_whole(folder_ / "curves/tube.toml");
    const std::string old_hash = io::content_hash(table());
    if (signs) provenance.replace(provenance.find(old_hash), old_hash.size(), io::content_hash(text));
    io::write_whole(folder_ / "curves/tube.csv", text);
    io::write_whole(folder_ / "curves/tube.toml", provenance);
  }

  /// Expects that reading the study fails with a message that contains all of `parts`.
  void expect_refused(Outcome& outcome, const std::vector<std::string>& parts) const {
    try {
      voxel::read_calibration_study(folder_ / "study.toml");
      outcome.expect(false, "the study was accepted");
    } catch (const io::InputError& error) {
      std::string text = error.what();
      const std::string path = folder_.path().string() + "/";  // it differs in each run
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

/// Returns a text with the first occurrence of a part replaced.
std::string with(std::string text, const std::string& part, const std::string& other) {
  return text.replace(text.find(part), part.size(), other);
}

void run_units(Outcome& outcome) {
  const StudyFolder study;
  study.replace_table(with(study.table(), "pressure_Pa", "pressure_kPa"), true);
  study.expect_refused(outcome, {"curves/tube.csv: ", "must be pressure_Pa", "pressure_kPa"});
}

/// Exchanges the third and the fourth state.
void run_order(Outcome& outcome) {
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

void run_unsigned(Outcome& outcome) {
  const StudyFolder study;
  study.replace_table(with(study.table(), "\n-6000", "\n-6500"), false);
  study.expect_refused(outcome, {"curves/tube.toml:", "table_hash"});
}

void run_without_provenance(Outcome& outcome) {
  const StudyFolder study;
  study.remove_provenance();
  study.expect_refused(outcome, {"study.toml", "curves", "no response curve (NAME.toml and NAME.csv)"});
}

void run_missing_case(Outcome& outcome) {
  const StudyFolder study;
  study.write_study("cases = [\"tube\", \"joint\"]\n", "0.002");
  study.expect_refused(outcome, {"study.toml:2: ", "cases", "there is no curve for joint"});
}

void run_other_wall(Outcome& outcome) {
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
                  .run = run_units});
  rows.push_back(
      {.name = "curve that turns back",
       .done = "two states of inflation have changed places, hash included",
       .expected = "InputError that names file, column, value and row: which branch is meant is not for a fit to guess",
       .run = run_order});
  rows.push_back({.name = "table changed by hand",
                  .done = "a pressure in a table is changed after its provenance was written",
                  .expected = "InputError that names the provenance and its hash",
                  .run = run_unsigned});
  rows.push_back({.name = "curve without provenance",
                  .done = "the provenance beside the only table of a study is removed",
                  .expected = "InputError that names study and key: a table that does not say what it is of is not fitted to",
                  .run = run_without_provenance});
  rows.push_back({.name = "load case that is missing",
                  .done = "a study asks for the cases tube and joint, and has a curve of tube alone",
                  .expected = "InputError that names study, line, key and the case that is missing",
                  .run = run_missing_case});
  rows.push_back({.name = "curve of another wall",
                  .done = "a study for walls of 3 mm is given a curve of walls of 2 mm",
                  .expected = "InputError that names the provenance, its key and both values",
                  .run = run_other_wall});
  return rows;
}

}  // namespace menger::extremes
