#include "fem/stall_map/stall_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <filesystem>
#include <numbers>

#include "fem/stall_map/stall_map_file.h"
#include "fem/stall_map/stall_map_output.h"
#include "fem/stall_map/stall_travel.h"
#include "io/study/study_reader.h"
#include "io/study/study_text.h"
#include "io/text/toml_document.h"
#include "io/text/whole_file.h"
#include "tests/support/described_study.h"
#include "tests/support/input_error_message.h"
#include "tests/support/test_folder.h"

namespace menger::fem {
namespace {

namespace fs = std::filesystem;

/// 50 cm^3 that grow by 3 cm^3 per kPa up to 20 kPa.
StallMapStudy example() {
  StallMapStudy study;
  study.plenum = {{0.0, 20e3}, {5e-5, 11e-5}};
  study.piston = {.name = "piston", .bore_m = 0.03, .dead_volume_m3 = 1e-6};
  study.cylinder_length_m = 0.1;
  study.line_volume_m3 = 2e-6;
  study.frequencies_Hz = {1.0, 3.0};
  study.resistances_Pa_s_per_m3 = {1e3, 1e8};
  study.strokes_m = {0.02, 0.04, 0.06};
  return study;
}

/// Pressure to which Boyle's law compresses all air, by bisection.
double boyle_Pa(const StallMapStudy& study, double stroke_m) {
  Piston piston = study.piston;
  piston.stroke_m = stroke_m;
  piston.cylinder_length_m = study.cylinder_length_m.value_or(stroke_m);
  const double withdrawn = cylinder_volume_m3(piston, 0.0) + study.line_volume_m3;
  const double air = standard_atmosphere_Pa * (withdrawn + 5e-5);
  double low = 0.0;
  double high = 20e3;
  for (int n = 0; n < 60; ++n) {
    const double middle = 0.5 * (low + high);
    const double volume = withdrawn - swept_volume_m3(piston) + 5e-5 + 3e-9 * middle;
    ((standard_atmosphere_Pa + middle) * volume < air ? low : high) = middle;
  }
  return low;
}

TEST(StallMap, ShortLineReachesThePressureOfBoyle) {
  StallMapStudy study = example();
  for (const double stroke : study.strokes_m) {
    if (stroke == study.strokes_m.back()) study.cylinder_length_m.reset();
    const StallPoint point = stall_point(study, 1.0, 1e3, stroke);
    EXPECT_EQ(point.status, io::RunStatus::completed);
    EXPECT_NEAR(point.peak_pressure_Pa, boyle_Pa(study, stroke), 0.1);
    EXPECT_NEAR(point.lowest_pressure_Pa, 0.0, 1.0);
    EXPECT_NEAR(point.largest_volume_m3, 5e-5 + 3e-9 * point.peak_pressure_Pa, 1e-12);
  }
}

// Little strokes about the withdrawn piston: K = V / P_ambient + dV/dp of the plenum and C of the cylinder take up air per
// pressure, so the plenum's amplitude is half the stroke over |K + C (1 + i w R K)|.
TEST(StallMap, SwingFollowsTheLowPassOfTheLine) {
  StallMapStudy study = example();
  const double stroke = 1e-5;
  const double half_line = 1e-6;
  const double plenum = (5e-5 + half_line) / standard_atmosphere_Pa + 3e-9;
  const double swept = std::numbers::pi * 0.25 * 9e-4 * stroke;
  const double cylinder = (std::numbers::pi * 0.25 * 9e-4 * 0.1 + 1e-6 + half_line) / standard_atmosphere_Pa;
  for (const double resistance : {1e7, 1e8, 1e9}) {
    const std::complex<double> turn(1.0, 2.0 * std::numbers::pi * 3.0 * resistance * plenum);
    const double swing = swept / std::abs(plenum + cylinder * turn);
    const StallPoint point = stall_point(study, 3.0, resistance, stroke);
    ASSERT_EQ(point.status, io::RunStatus::completed);
    EXPECT_NEAR(point.peak_pressure_Pa - point.lowest_pressure_Pa, swing, 1e-3 * swing) << resistance;
  }
}

TEST(StallMap, IsobarsAreWhereTheirPressureIsReached) {
  StallMapStudy study = example();
  study.strokes_m.clear();
  for (int n = 1; n <= 20; ++n) study.strokes_m.push_back(0.003 * n);
  const StallMap map = stall_map(study);
  ASSERT_EQ(map.status, io::RunStatus::completed);
  ASSERT_EQ(map.points.size(), 80U);
  for (const PressureMeasure measure : {PressureMeasure::peak, PressureMeasure::swing}) {
    const Isobar line = isobar(study, map, 1, measure, 2e3);
    ASSERT_EQ(line.strokes_m.size(), 2U);
    for (std::size_t r = 0; r < 2; ++r) {
      ASSERT_TRUE(line.strokes_m[r]);
      const StallPoint point = stall_point(study, 3.0, study.resistances_Pa_s_per_m3[r], *line.strokes_m[r]);
      const double reached = point.peak_pressure_Pa - (measure == PressureMeasure::peak ? 0.0 : point.lowest_pressure_Pa);
      EXPECT_NEAR(reached, 2e3, 10.0);  // straight lines between strokes
    }
  }
  EXPECT_FALSE(isobar(study, map, 1, PressureMeasure::swing, 12e3).strokes_m[1]);
}

// 13 kPa lie between the stroke of 40 mm and that of 100 mm, which leaves the curve.
TEST(StallMap, IsobarsReachTheEndOfTheCurve) {
  StallMapStudy study = example();
  study.plenum = {{0.0, 15e3}, {5e-5, 9.5e-5}};
  study.strokes_m = {0.02, 0.04, 0.1};
  const StallMap map = stall_map(study);
  ASSERT_EQ(map.points[1].status, io::RunStatus::completed);
  ASSERT_LT(map.points[1].peak_pressure_Pa, 13e3);
  ASSERT_EQ(map.points[2].status, io::RunStatus::diverged);
  const Isobar line = isobar(study, map, 0, PressureMeasure::peak, 13e3);
  ASSERT_TRUE(line.strokes_m[0]);
  EXPECT_GT(*line.strokes_m[0], 0.04);
  EXPECT_NEAR(stall_point(study, 1.0, 1e3, *line.strokes_m[0]).peak_pressure_Pa, 13e3, 0.5);  // twenty halvings of 60 mm
}

// Air at 70 kPa is thinner, so that its flow stays laminar further: Re and 1 / D* go with its density.
TEST(StallMap, ReynoldsNumberKnowsTheAmbientPressure) {
  const PneumaticLine line = round_line_of(2.0, 1e7);
  const PneumaticGas usual;
  const PneumaticGas thin{.ambient_pressure_Pa = 70e3};
  const double share = 70e3 / standard_atmosphere_Pa;
  EXPECT_DOUBLE_EQ(reynolds_number(thin, 1e-4, *line.bore), share * reynolds_number(usual, 1e-4, *line.bore));
  EXPECT_DOUBLE_EQ(share * laminar_drive_Pa(thin, line), laminar_drive_Pa(usual, line));
}

TEST(StallMap, PressureBeyondTheCurveIsSaid) {
  StallMapStudy study = example();
  study.plenum = {{0.0, 10e3}, {5e-5, 8e-5}};
  const StallPoint point = stall_point(study, 1.0, 1e3, 0.1);
  EXPECT_EQ(point.status, io::RunStatus::diverged);
  EXPECT_GT(point.peak_pressure_Pa, 10e3);
}

TEST(StallMap, TubesHaveTheirDiameterFromTheirResistance) {
  StallMapStudy study = example();
  study.line_length_m = 2.0;
  study.frequencies_Hz = {3.0};
  study.resistances_Pa_s_per_m3 = {1e7};
  const StallMap map = stall_map(study);
  const io::CsvContents table = io::parse_csv(stall_map_table(study, map).text(), "stall_map.csv");
  ASSERT_EQ(table.row_count(), 3U);
  EXPECT_NEAR(table.number(0, "diameter_m"), std::pow(128.0 * 1.82e-5 * 2.0 / (std::numbers::pi * 1e7), 0.25), 1e-9);
  EXPECT_GT(table.number(2, "reynolds_number"), 2000.0);
  // turbulence takes from the swing
  StallMapStudy laminar = study;
  laminar.line_volume_m3 = line_of(study, 1e7).volume_m3;
  laminar.line_length_m.reset();
  const auto swing = [](const StallPoint& point) { return point.peak_pressure_Pa - point.lowest_pressure_Pa; };
  EXPECT_LT(swing(map.points[2]), 0.99 * swing(stall_point(laminar, 3.0, 1e7, 0.06)));
}

TEST(StallMap, WalksAreSpreadOverTheMap) {
  StallMapStudy study = example();
  study.strokes_m = {0.01, 0.02, 0.03, 0.04, 0.05};
  study.walker = StallWalker{.every_stroke = 2};
  StallMap map = stall_map(study);
  EXPECT_EQ(travel_points(study, map), (std::vector<std::size_t>{0, 2, 4, 5, 7, 9, 10, 12, 14, 15, 17, 19}));
  study.walker = StallWalker{.every_resistance = 2, .every_stroke = 3};
  EXPECT_EQ(travel_points(study, map), (std::vector<std::size_t>{1, 4, 11, 14})) << "the longest stroke is there";
  map.points[11].status = io::RunStatus::diverged;
  EXPECT_EQ(travel_points(study, map), (std::vector<std::size_t>{1, 4, 14}));
}

TEST(StallMap, SceneHasThePressuresOfItsPoint) {
  StallMapStudy study = example();
  study.walker = StallWalker{
      .design = {"cube", meshes::Polycube::from_digits(1, 1, 1, "1"), 0.02}, .parameters = "fit.toml", .level = 2, .periods = 5};
  const StallPoint point = stall_point(study, 2.0, 1e3, 0.02);
  const io::TomlTable scene = io::parse_toml(travel_scene(study, point), "scene.toml");
  EXPECT_EQ(scene.table("drive").numbers("pressure_Pa"), (std::vector<double>{point.lowest_pressure_Pa, point.peak_pressure_Pa}));
  EXPECT_DOUBLE_EQ(scene.table("drive").number("frequency_Hz"), 2.0);
  EXPECT_DOUBLE_EQ(scene.table("time").number("duration_s"), 2.5);
  EXPECT_DOUBLE_EQ(scene.table("time").number("record_interval_s"), 0.025);
  EXPECT_EQ(scene.table("ground").number("static_friction"), 1.0);
  EXPECT_EQ(scene.table("surrogate").path("parameters"), fs::absolute("fit.toml"));
  EXPECT_EQ(scene.table("design").text_rows("layers"), (std::vector<std::vector<std::string>>{{"1"}}));
  EXPECT_EQ(scene.table("design").number("cell_edge_m"), 0.02);
  EXPECT_EQ(scene.table("design").integer("level"), 2);
}

class StallMapFile : public testing::Test {
 protected:
  StallMapFile() { io::write_whole(folder_ / "curve.csv", "pressure_Pa,volume_m3\n0,5e-6\n1000,6e-6\n5000,9e-6\n"); }

  StallMapStudy read(const std::string& from = "", const std::string& to = "") const {
    std::string text =
        "[plenum]\ncurve = 'curve.csv'\ncount = 9\n[piston]\nbore_m = 0.03\ncylinder_length_m = 0.1\n[line]\nvolume_m3 = 1e-6\n"
        "[map]\nfrequencies_Hz = [1.2, 3]\nresistances_Pa_s_per_m3 = {lowest = 1e6, highest = 1e9, count = 4}\n"
        "strokes_m = {longest = 0.1, count = 2}\nisobars_Pa = [2000]\n"
        "[[mark]]\nlabel = 'here'\npressure_Pa = 4000\nfrequency_Hz = 3\n";
    if (!from.empty()) text.replace(text.find(from), from.size(), to);
    io::write_whole(folder_ / "study.toml", text);
    return read_stall_map_study(folder_ / "study.toml");
  }

  void refuses(const std::string& from, const std::string& to, const std::string& part) const {
    const std::string message = tests::message_of([&] { static_cast<void>(read(from, to)); });
    EXPECT_NE(message.find(part), std::string::npos) << message;
  }

  const tests::TestFolder folder_;
};

TEST_F(StallMapFile, IsReadWhole) {
  const StallMapStudy study = read();
  EXPECT_DOUBLE_EQ(study.plenum.volume_m3(3000.0), 9 * 7.5e-6);
  ASSERT_EQ(study.resistances_Pa_s_per_m3.size(), 4U);
  EXPECT_NEAR(study.resistances_Pa_s_per_m3[1], 1e7, 1e-6);
  EXPECT_EQ(study.strokes_m, (std::vector<double>{0.05, 0.1}));
  EXPECT_EQ(study.marks.front().label, "here");
  EXPECT_EQ(study.inputs.size(), 2U);
}

TEST_F(StallMapFile, EqualVolumesAreNoDecrease) {
  io::write_whole(folder_ / "curve.csv", "pressure_Pa,volume_m3\n0,6e-6\n1000,6e-6\n5000,9e-6\n");
  EXPECT_EQ(read("count = 9", "count = 7").plenum.volumes_m3[1], 7 * 6e-6);
}

TEST_F(StallMapFile, BadInputIsNamed) {
  refuses("longest = 0.1", "longest = 0.125", "longest = 0.125");
  refuses("volume_m3 = 1e-6\n", "\n", "leaves no room for the air");
  refuses("highest = 1e9", "highest = 1e5", "highest = 1e+05");
  refuses("highest = 1e9", "highest = 1e300", "highest = 1e+300");
  refuses("frequency_Hz = 3", "frequency_Hz = 2", "frequency_Hz = 2");
  refuses("[1.2, 3]", "[]", "frequencies_Hz");
  refuses("[1.2, 3]", "[3, 1.2, 3]", "must not hold a value twice");
  refuses("isobars_Pa = [2000]", "isobars_Pa = [2000, 5001]", "5001");
  refuses("pressure_Pa = 4000", "pressure_Pa = 6000", "pressure_Pa = 6000");
  refuses("bore_m = 0.03", "bore_m = -1", "bore_m = -1");
  refuses("count = 9", "count = 0", "count = 0");
  refuses("isobars_Pa", "isobar_Pa", "isobar_Pa");
  const std::string walker = "[travel]\ndesign = {layers = [['1']], cell_edge_m = 0.01";
  const std::string travel = walker + "}\nparameters = 'curve.csv'\n";
  refuses("[[mark]]", walker + ", level = 4}\nparameters = 'curve.csv'\n[[mark]]", "travel.design.level = 4");
  refuses("[[mark]]", travel + "level = 2\n[[mark]]", "travel.level = 2: is called travel.design.level now");
  refuses("[[mark]]", "[travel]\ndesign = 'curve.csv'\nparameters = 'curve.csv'\n[[mark]]",
          "travel.design = \"curve.csv\": is called travel.design.file now");
  refuses("[[mark]]", travel + "periods = 1\n[[mark]]", "periods = 1");
  refuses("[[mark]]", travel + "static_friction = 0.3\n[[mark]]", "is less than kinetic_friction = 0.5");
  refuses("[[mark]]", "[travel]\ndesign = {file = 'none.toml'}\nparameters = 'curve.csv'\n[[mark]]", "none.toml");
  refuses("cylinder_length_m = 0.1\n", "cylinder_length_m = 0.1\nfill_pressure_Pa = -500\n", "outside the curve");
  io::write_whole(folder_ / "curve.csv", "pressure_Pa,volume_m3\n0,5e-6\n1000,6e-6\n900,9e-6\n");
  refuses("", "", "curve.csv:4");
  io::write_whole(folder_ / "curve.csv", "pressure_Pa,volume_m3\n0,5e-6\n1000,4e-6\n");
  refuses("", "", "curve.csv:3");
}

TEST_F(StallMapFile, CurveMayStandInTheStudy) {
  const std::string inline_curve = "pressures_Pa = [0, 1000, 5000]\nvolumes_m3 = [5e-6, 6e-6, 9e-6]";
  EXPECT_EQ(read("curve = 'curve.csv'", inline_curve).plenum.volumes_m3, read().plenum.volumes_m3);
  refuses("curve = 'curve.csv'", inline_curve + "\ncurve = 'curve.csv'", "keep one of them");
  refuses("curve = 'curve.csv'", "", "pressures_Pa or curve is missing");
  refuses("curve = 'curve.csv'", "pressures_Pa = [0, 1000]\nvolumes_m3 = [5e-6]", "needs at least two");
  refuses("curve = 'curve.csv'", "pressures_Pa = [0, 1000, 900]\nvolumes_m3 = [5e-6, 6e-6, 9e-6]", "pressures_Pa[3] = 900");
  refuses("curve = 'curve.csv'", "pressures_Pa = [0, 1000]\nvolumes_m3 = [5e-6, 2.5e-6]", "volumes_m3[2] = 2.5");
}

TEST_F(StallMapFile, IsReadBackFromItsText) {
  const std::string travel =
      "[travel]\ndesign = {layers = [['1']], cell_edge_m = 0.01, level = 2}\nparameters = 'curve.csv'\n[[mark]]";
  const StallMapStudy study = read("[[mark]]", travel);
  const std::string text = io::described_text(study);
  StallMapStudy again;
  io::read_described(io::parse_toml(text, "study.toml"), again);
  EXPECT_EQ(io::described_text(again), text);
  EXPECT_EQ(again.plenum.volumes_m3, study.plenum.volumes_m3);
  EXPECT_EQ(again.strokes_m, study.strokes_m);
  EXPECT_EQ(again.resistances_Pa_s_per_m3, study.resistances_Pa_s_per_m3);
}

/// A study whose values fit to each other, whatever they are one by one.
struct PossibleStudy {
  StallMapStudy study;
};

void describe(io::StudyVisitor& visitor, PossibleStudy& possible) {
  StallMapStudy& study = possible.study;
  describe(visitor, study);
  if (visitor.source() != nullptr) return;
  study.plenum = {{0.0, 1e4}, {1e-5, 2e-5}};
  study.piston.fill_pressure_Pa = 0.0;
  if (study.cylinder_length_m) study.cylinder_length_m = study.strokes_m.back() + 1.0;
  study.piston.dead_volume_m3 += 1e-6;
  std::ranges::sort(study.frequencies_Hz);
  study.walker.reset();  // names a file
  for (double& isobar_Pa : study.isobars_Pa) isobar_Pa = std::abs(isobar_Pa) + 1.0;
  for (StallMark& mark : study.marks) mark.frequency_Hz = study.frequencies_Hz.front();
}

TEST(StallMapStudy, TemplateAndTextsAreRead) {
  const auto parse = [](const std::string& text) {
    StallMapStudy study;
    io::read_described(io::parse_toml(text, "study.toml"), study);
    return study;
  };
  tests::expect_template_is_read<StallMapStudy>(parse, {"plenum.curve", "travel"});  // name files that are not there
  tests::expect_texts_are_read_back<PossibleStudy>(
      [&](const std::string& text) { return PossibleStudy{parse(text)}; }, 100, {},
      {"frequency_Hz", "dead_volume_m3", "fill_pressure_Pa", "count", "pressures_Pa", "volumes_m3"});
}

}  // namespace
}  // namespace menger::fem
