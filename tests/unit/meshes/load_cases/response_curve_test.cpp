#include "meshes/load_cases/response_curve.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <stdexcept>

#include "io/text/content_hash.h"
#include "io/text/input_error.h"
#include "io/text/whole_file.h"
#include "tests/support/test_folder.h"

namespace menger::meshes {
namespace {

namespace fs = std::filesystem;

ResponseCurve stretch_curve() {
  ResponseCurve curve;
  CurveProvenance& provenance = curve.provenance;
  provenance.load_case.name = "stretch";
  provenance.load_case.kind = LoadCaseKind::stretch;
  provenance.load_case.cells = {3, 1, 1};
  provenance.load_case.digits = "111";
  provenance.load_case.cell_edge_m = 0.01;
  provenance.load_case.wall_thickness_m = 0.002;
  provenance.load_case.pressures_Pa = {-1000.0, 2000.0};
  provenance.load_case.imposed = {-0.001, 0.0, 0.002};
  provenance.silicone = "Dragon Skin 10";
  provenance.law = "neo_hookean shear_modulus_Pa = 86677";
  provenance.shear_modulus_Pa = 86677.0;
  provenance.density_kg_m3 = 1070.0;
  provenance.model = "finite elements, \"Q2/P1\"";
  provenance.relative_uncertainty = 0.05;
  provenance.inputs = {{"set.toml", "abc"}, {"data/record.toml", "def"}};
  provenance.status = io::RunStatus::wall_contact;
  provenance.reason = "two walls touch";
  provenance.limit_pressure_Pa = 13e3 / 3.0;
  provenance.contact_pressure_Pa = -1.7;
  curve.columns = response_columns(LoadCaseKind::stretch);
  curve.values.resize(curve.columns.size());
  for (const double pressure_Pa : curve.provenance.load_case.pressures_Pa) {
    for (const double displacement_m : curve.provenance.load_case.imposed) {
      const std::vector<double> row{pressure_Pa, displacement_m, 100.0 * displacement_m / 3.0, 1e-17, -1e-5 / 7.0, 2e-5 / 7.0};
      for (std::size_t column = 0; column < row.size(); ++column) curve.values[column].push_back(row[column]);
    }
  }
  return curve;
}

class ResponseCurveFile : public testing::Test {
 protected:
  /// The curve's table replaced by another that its provenance knows.
  void replace_table(const std::string& table) const {
    const std::string before = io::read_whole(folder_ / "stretch.csv");
    replace("stretch.toml", io::content_hash(before), io::content_hash(table));
    io::write_whole(folder_ / "stretch.csv", table);
  }

  void replace(const std::string& name, const std::string& from, const std::string& to) const {
    std::string text = io::read_whole(folder_ / name);
    const std::size_t at = text.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    io::write_whole(folder_ / name, text.replace(at, from.size(), to));
  }

  [[nodiscard]] std::string refusal(const std::string& name = "stretch.toml") const {
    try {
      (void)read_response_curve(folder_ / name);
    } catch (const io::InputError& error) {
      return error.what();
    }
    return "accepted";
  }

  const tests::TestFolder folder_;
};

TEST_F(ResponseCurveFile, ReadsBackExactlyWhatWasWritten) {
  const ResponseCurve curve = stretch_curve();
  write_response_curve(folder_, curve);
  const ResponseCurve read = read_response_curve(folder_ / "stretch.toml");
  EXPECT_EQ(read.columns, curve.columns);
  EXPECT_EQ(read.values, curve.values);
  EXPECT_EQ(read.column("force_N"), curve.values[2]);
  EXPECT_THROW((void)read.column("force_kN"), std::out_of_range);
  EXPECT_EQ(read.provenance.load_case, curve.provenance.load_case);
  EXPECT_EQ(read.provenance.silicone, curve.provenance.silicone);
  EXPECT_EQ(read.provenance.law, curve.provenance.law);
  EXPECT_EQ(read.provenance.shear_modulus_Pa, curve.provenance.shear_modulus_Pa);
  EXPECT_EQ(read.provenance.density_kg_m3, curve.provenance.density_kg_m3);
  EXPECT_EQ(read.provenance.model, curve.provenance.model);
  EXPECT_EQ(read.provenance.relative_uncertainty, curve.provenance.relative_uncertainty);
  EXPECT_EQ(read.provenance.inputs, curve.provenance.inputs);
  EXPECT_EQ(read.provenance.status, curve.provenance.status);
  EXPECT_EQ(read.provenance.reason, curve.provenance.reason);
  EXPECT_EQ(read.provenance.limit_pressure_Pa, curve.provenance.limit_pressure_Pa);
  EXPECT_EQ(read.provenance.contact_pressure_Pa, curve.provenance.contact_pressure_Pa);
}

TEST_F(ResponseCurveFile, EqualCurvesAreEqualFiles) {
  write_response_curve(folder_, stretch_curve());
  write_response_curve(folder_ / "again", read_response_curve(folder_ / "stretch.toml"));
  for (const char* name : {"stretch.csv", "stretch.toml"})
    EXPECT_EQ(io::read_whole(folder_ / name), io::read_whole(folder_ / "again" / name)) << name;
}

TEST_F(ResponseCurveFile, RefusesATableWithoutProvenance) {
  write_response_curve(folder_, stretch_curve());
  fs::remove(folder_ / "stretch.toml");
  EXPECT_NE(refusal().find("is not the provenance"), std::string::npos);
  EXPECT_NE(refusal("stretch.csv").find("stretch.csv: is not the provenance"), std::string::npos);
}

TEST_F(ResponseCurveFile, RefusesProvenanceWithoutItsTable) {
  write_response_curve(folder_, stretch_curve());
  fs::remove(folder_ / "stretch.csv");
  EXPECT_NE(refusal().find("stretch.csv"), std::string::npos);
}

TEST_F(ResponseCurveFile, RefusesATableThatWasChanged) {
  write_response_curve(folder_, stretch_curve());
  replace("stretch.csv", "0.002", "0.003");
  EXPECT_NE(refusal().find("is not the one for which this provenance was written"), std::string::npos) << refusal();
}

TEST_F(ResponseCurveFile, RefusesOtherUnitsAndMissingOrUnknownColumns) {
  const std::vector<std::pair<std::string, std::string>> changes{
      {"displacement_m", "displacement_mm"}, {"force_N,", ""}, {"force_N", "force_N,stress_Pa"}, {"pressure_Pa", "pressure_kPa"}};
  for (const auto& [from, to] : changes) {
    write_response_curve(folder_, stretch_curve());
    std::string table = io::read_whole(folder_ / "stretch.csv");
    const std::string header = table.substr(0, table.find('\n'));
    std::string changed = header;
    changed.replace(header.find(from), from.size(), to);
    // rows as long as the header
    std::string text = changed + "\n";
    for (std::ptrdiff_t n = 0; n <= std::count(changed.begin(), changed.end(), ','); ++n) text += n > 0 ? ",1" : "1";
    replace_table(text + "\n");
    EXPECT_NE(refusal().find("stretch.csv: the columns of a curve of kind \"stretch\" must be pressure_Pa, displacement_m"),
              std::string::npos)
        << refusal();
    EXPECT_NE(refusal().find("not " + changed.substr(0, 8)), std::string::npos) << refusal();
  }
}

TEST_F(ResponseCurveFile, RefusesNumbersThatAreNotFinite) {
  for (const char* cell : {"nan", "inf", ""}) {
    write_response_curve(folder_, stretch_curve());
    std::string table = io::read_whole(folder_ / "stretch.csv");
    table.replace(table.find("1e-17"), 5, cell);
    replace_table(table);
    EXPECT_NE(refusal().find("stretch.csv:2"), std::string::npos) << refusal();
    EXPECT_NE(refusal().find("volume_change"), std::string::npos) << refusal();
  }
  ResponseCurve curve = stretch_curve();
  curve.values[3][0] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(write_response_curve(folder_ / "never", curve), io::InputError);
  EXPECT_FALSE(fs::exists(folder_ / "never"));
}

TEST_F(ResponseCurveFile, RefusesATableWithoutARow) {
  write_response_curve(folder_, stretch_curve());
  const std::string table = io::read_whole(folder_ / "stretch.csv");
  replace_table(table.substr(0, table.find('\n') + 1));
  EXPECT_NE(refusal().find("at least one row"), std::string::npos) << refusal();
}

TEST_F(ResponseCurveFile, RefusesAbscissaeThatTurnOrStand) {
  struct Case {
    std::size_t column;
    std::size_t row;
    double value;
    std::string message;
  };
  // six rows: two pressures with three displacements each
  const std::vector<Case> cases{{1, 2, -0.0005, "displacement_m = -5e-04 in row 3"},
                                {1, 5, 0.0, "displacement_m = 0 in row 6"},
                                {0, 4, -1000.0, "pressure_Pa = -1000 in row 5"}};
  for (const Case& broken : cases) {
    ResponseCurve curve = stretch_curve();
    curve.values[broken.column][broken.row] = broken.value;
    try {
      write_response_curve(folder_, curve);
      ADD_FAILURE() << broken.message;
    } catch (const io::InputError& error) {
      EXPECT_NE(std::string(error.what()).find(broken.message + ": must be strictly monotone"), std::string::npos)
          << error.what();
    }
  }
}

TEST_F(ResponseCurveFile, ReadsTheDensityUnderItsEarlierName) {
  write_response_curve(folder_, stretch_curve());
  replace("stretch.toml", "density_kg_per_m3", "density_kg_m3");
  EXPECT_EQ(read_response_curve(folder_ / "stretch.toml").provenance.density_kg_m3, 1070.0);
}

TEST_F(ResponseCurveFile, AbscissaeMayFall) {
  ResponseCurve curve = stretch_curve();
  for (std::vector<double>& values : curve.values) std::reverse(values.begin(), values.end());
  write_response_curve(folder_, curve);
  EXPECT_EQ(read_response_curve(folder_ / "stretch.toml").values, curve.values);
}

TEST_F(ResponseCurveFile, RefusesFaultsOfTheProvenanceWithFileKeyAndValue) {
  const std::vector<std::array<std::string, 3>> changes{
      {"relative_uncertainty = 0.05", "relative_uncertainty = 0", "relative_uncertainty = 0: must be > 0"},
      {"relative_uncertainty = 0.05", "", "relative_uncertainty is missing"},
      {"status = \"wall_contact\"", "status = \"fine\"", "status = \"fine\""},
      {"density_kg_per_m3 = 1070", "density_g_cm3 = 1.07", "density_kg_per_m3 is missing"},
      {"silicone = \"Dragon Skin 10\"", "silicone = \"\"", "silicone = \"\": must not be empty"},
      {"limit_pressure_Pa = 4333.333333333333", "limit_pressure_Pa = -1", "limit_pressure_Pa = -1: must be > 0"},
      {"model = ", "modulus = 1\nmodel = ", "modulus"},
      {"[case]", "[former_case]", "case"}};
  for (const auto& [from, to, message] : changes) {
    write_response_curve(folder_, stretch_curve());
    replace("stretch.toml", from, to);
    EXPECT_NE(refusal().find("stretch.toml"), std::string::npos) << refusal();
    EXPECT_NE(refusal().find(message), std::string::npos) << refusal();
  }
}

}  // namespace
}  // namespace menger::meshes
