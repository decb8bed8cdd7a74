#include "evolution/page/report_sections.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>

#include "evolution/outputs/result_facts.h"
#include "evolution/page/input_table.h"
#include "io/text/whole_file.h"
#include "tests/support/test_folder.h"

namespace menger::evolution {
namespace {

namespace fs = std::filesystem;

class ReportSectionsTest : public testing::Test {
 protected:
  /// An output of a command whose files the test writes.
  CommandOutput output(const std::string& command) {
    return {.program = "menger-" + command,
            .folder = folder_ / command,
            .manifest = folder_ / command / "manifest.json",
            .place = command,
            .name = command,
            .version = "0.1.0"};
  }
  void write(const std::string& file, const std::string& text) { io::write_whole(folder_ / file, text); }

  PageSection section(const std::vector<CommandOutput>& outputs, const std::string& id) {
    notes_.clear();
    for (PageSection& one : report_sections(outputs, notes_))
      if (one.id == id) return one;
    return {};
  }
  tests::TestFolder folder_;
  std::vector<std::string> notes_;
};

TEST_F(ReportSectionsTest, DrawPressureAgainstVolumeWithTheLimitPressure) {
  write("inflate/curves.csv", "step,plenum_0_pressure_Pa,plenum_0_volume_m3\n0,0,1e-6\n1,3000,2e-6\n2,2500,4e-6\n");
  write("inflate/result.toml",
        "status = \"completed\"\nnotes = [\"coarse at (0.018449999999999998, 0.024) m\"]\n[[limit_points]]\nplenum = \"plenum "
        "0\"\npressure_Pa = 3042\nvolume_m3 = "
        "2.1e-6\n[[limit_points]]\nplenum = \"plenum "
        "0\"\npressure_Pa = -200\nvolume_m3 = 5e-7\n");
  const PageSection inflation = section({output("inflate")}, "inflation");
  ASSERT_EQ(inflation.charts.size(), 1U);
  const PageChart& chart = inflation.charts.front();
  ASSERT_EQ(chart.series.size(), 1U);
  EXPECT_EQ(chart.series.front().name, "the chamber");
  EXPECT_EQ(chart.series.front().y, (std::vector<double>{0.0, 3.0, 2.5}));
  EXPECT_NEAR(chart.series.front().x[2], 4.0, 1e-12);
  ASSERT_EQ(chart.markers.size(), 2U);
  EXPECT_FALSE(chart.markers.front().vertical);
  EXPECT_EQ(chart.markers.front().label, "limit pressure 3.04 kPa");
  EXPECT_EQ(inflation.words, std::vector<std::string>{"coarse at (0.01845, 0.024) m."});
  // The verdict takes the limit pressure above 0, and the growth at the highest pressure.
  const ReportFacts facts = read_facts({output("inflate")}, notes_);
  ASSERT_EQ(facts.inflations.size(), 1U);
  EXPECT_EQ(facts.inflations.front().limit->pressure_Pa, 3042.0);
  EXPECT_NEAR(*facts.inflations.front().volume_growth, 1.0, 1e-12);
}

TEST_F(ReportSectionsTest, TakeTheGrowthOfTheChamberThatGrowsMost) {
  write("inflate/curves.csv",
        "step,plenum_0_pressure_Pa,plenum_0_volume_m3,plenum_1_pressure_Pa,plenum_1_volume_m3\n0,0,1e-6,0,1e-6\n"
        "1,3000,2e-6,2900,5e-6\n");
  write("inflate/result.toml", "status = \"completed\"\n");
  const InflationFacts facts = read_facts({output("inflate")}, notes_).inflations.at(0);
  EXPECT_NEAR(*facts.volume_growth, 4.0, 1e-12);
  EXPECT_EQ(facts.plena, 2U);
}

TEST_F(ReportSectionsTest, CallChambersByTheirMaterial) {
  write("inflate/curves.csv",
        "step,plenum_0_pressure_Pa,plenum_0_volume_m3,plenum_1_pressure_Pa,plenum_1_volume_m3\n0,0,1e-6,0,1e-6\n"
        "1,3000,2e-6,0,1e-6\n");
  write("inflate/result.toml", "status = \"completed\"\n[[limit_points]]\nplenum = \"plenum 1\"\npressure_Pa = 1042\n");
  CommandOutput pair = output("inflate");
  pair.stated = {.body = ManifestBody{.layers = {{"21"}}, .cell_edge_m = 0.01}, .chambers = "per-phase"};
  const PageSection inflation = section({pair}, "inflation");
  const std::vector<PageSeries>& series = inflation.charts.at(0).series;
  ASSERT_EQ(series.size(), 2U);
  EXPECT_EQ(series[0].name, "chamber of material 2");
  EXPECT_EQ(series[0].material, 2);
  EXPECT_EQ(series[1].name, "chamber of material 1");
  EXPECT_EQ(series[1].material, 1);
  const auto& rows = inflation.tables.at(0).rows;
  EXPECT_TRUE(std::ranges::any_of(rows, [](const auto& row) { return row[0] == "limit pressure of the chamber of material 1"; }));
  pair.stated.chambers = "single";
  EXPECT_EQ(section({pair}, "inflation").charts.at(0).series.at(0).name, "plenum 0");
}

TEST_F(ReportSectionsTest, DrawChambersAlikeAsOneCurve) {
  write("inflate/curves.csv",
        "step,plenum_0_pressure_Pa,plenum_0_volume_m3,plenum_1_pressure_Pa,plenum_1_volume_m3,plenum_2_pressure_Pa,"
        "plenum_2_volume_m3\n0,0,1e-6,0,1.0000001e-6,0,1e-6\n1,3000,2e-6,3000,2e-6,3000,2.1e-6\n");
  write("inflate/result.toml", "status = \"completed\"\n");
  const std::vector<PageSeries> series = section({output("inflate")}, "inflation").charts.at(0).series;
  ASSERT_EQ(series.size(), 2U);
  EXPECT_EQ(series[0].name, "plenum 0, plenum 1");
  EXPECT_EQ(series[1].name, "plenum 2");
  EXPECT_TRUE(series[1].dashed);
}

TEST_F(ReportSectionsTest, TellTheLimitPressureFromTheLeastPressureAfterSnapThrough) {
  write("inflate/curves.csv", "step,plenum_0_pressure_Pa,plenum_0_volume_m3\n0,0,1e-6\n1,3000,2e-6\n2,1200,4e-6\n");
  write("inflate/result.toml",
        "status = \"completed\"\n[[limit_points]]\nplenum = \"plenum 0\"\npressure_Pa = 3042\n[[limit_points]]\nplenum = "
        "\"plenum 0\"\npressure_Pa = 1200\n");
  const PageSection inflation = section({output("inflate")}, "inflation");
  ASSERT_EQ(inflation.charts.size(), 1U);
  ASSERT_EQ(inflation.charts[0].markers.size(), 2U);
  EXPECT_EQ(inflation.charts[0].markers[0].label, "limit pressure 3.04 kPa");
  EXPECT_EQ(inflation.charts[0].markers[1].label, "later turning point 1.2 kPa");
  EXPECT_EQ(read_facts({output("inflate")}, notes_).inflations.at(0).limit->pressure_Pa, 3042.0);
}

TEST_F(ReportSectionsTest, ThinLongSeriesAndKeepTheirExtremes) {
  std::string walk = "time_s,centre_of_mass_x_m,centre_of_mass_y_m,horizontal_displacement_m\n";
  for (int n = 0; n < 30'000; ++n)
    walk += std::to_string(n) + (n == 12'345 ? ",7,0,7\n" : n == 20'001 ? ",,,\n" : "," + std::to_string(1e-6 * n) + ",0,\n");
  write("simulate/trajectory.csv", walk);
  write("simulate/result.toml", "status = \"completed\"\ntime_s = 30000\n");
  const PageSection walks = section({output("simulate")}, "walks");
  ASSERT_EQ(walks.charts.size(), 2U);
  for (const PageChart& chart : walks.charts) {
    ASSERT_EQ(chart.series.size(), 1U);
    EXPECT_LE(chart.series[0].x.size(), 2000U);
    EXPECT_EQ(chart.series[0].x.size(), chart.series[0].y.size());
    EXPECT_NE(chart.note.find("up to 30000 rows"), std::string::npos) << chart.note;
  }
  const PageSeries& progress = walks.charts[0].series[0];
  EXPECT_EQ(progress.x.front(), 0.0);
  EXPECT_EQ(progress.x.back(), 29'999.0);
  EXPECT_TRUE(std::ranges::any_of(progress.y, [](double y) { return std::abs(y - 7000.0) < 1e-6; })) << "the highest value";
  EXPECT_TRUE(std::ranges::any_of(progress.y, [](double y) { return std::isnan(y); })) << "the gap";
}

TEST_F(ReportSectionsTest, LeaveShortSeriesAsTheyAre) {
  std::string walk = "time_s,centre_of_mass_x_m,centre_of_mass_y_m,horizontal_displacement_m\n";
  for (int n = 0; n < 2000; ++n) walk += std::to_string(n) + ",0,0,0\n";
  write("simulate/trajectory.csv", walk);
  write("simulate/result.toml", "status = \"completed\"\ntime_s = 2000\n");
  const PageSection walks = section({output("simulate")}, "walks");
  EXPECT_EQ(walks.charts.at(0).series.at(0).x.size(), 2000U);
  EXPECT_EQ(walks.charts.at(1).note, "Every path begins at 0, 0.") << "nothing is left out";
}

TEST_F(ReportSectionsTest, DrawsHowAWalkComesBack) {
  write("locomote/trajectory.csv",
        "time_s,centre_of_mass_x_m,centre_of_mass_y_m,horizontal_displacement_m\n0,0.001,0,0\n1,0.001,-0.02,0.02\n2,,,\n"
        "3,0.001,0.015,0.015\n4,0.001,0.01,0.01\n");
  write("locomote/locomotion.toml",
        "status = \"completed\"\ntime_s = 4\ndisplacement_m = [0, 0.01, 0]\nhorizontal_displacement_m = 0.01\n"
        "horizontal_displacement_body_lengths = 0.1\n");
  const PageChart progress = section({output("locomote")}, "walks").charts.at(0);
  EXPECT_EQ(progress.title, "Progress over time");
  write("simulate/trajectory.csv", "time_s,centre_of_mass_x_m,centre_of_mass_y_m\n0,0,0\n1,0,-0.02\n");
  write("simulate/result.toml", "status = \"diverged\"\ntime_s = 1\n");
  const PageChart early = section({output("simulate")}, "walks").charts.at(0);
  EXPECT_NEAR(early.series.at(0).y.at(1), 20.0, 1e-9);
  EXPECT_NE(early.note.find("simulate, voxels (the line to its own end)"), std::string::npos) << early.note;
  EXPECT_EQ(early.note.find("no walk"), std::string::npos) << "what ended early is not judged";
  EXPECT_NEAR(progress.series.at(0).y.at(1), -20.0, 1e-9) << "behind its start";
  EXPECT_NEAR(progress.series.at(0).y.at(3), 15.0, 1e-9);
  EXPECT_NEAR(progress.series.at(0).y.at(4), 10.0, 1e-9);
  const WalkFacts facts = read_facts({output("locomote")}, notes_).walks.at(0);
  EXPECT_NEAR(facts.lowest_lengths.value_or(0.0), -0.2, 1e-9);
  EXPECT_NEAR(facts.highest_lengths.value_or(0.0), 0.15, 1e-9);
  EXPECT_NEAR(facts.retreat_lengths.value_or(0.0), 0.2, 1e-9) << "from the start, before it had gone forth";
  EXPECT_NEAR(facts.farthest_lengths.value_or(0.0), 0.2, 1e-9);
  EXPECT_NEAR(facts.farthest_m.value_or(0.0), 0.02, 1e-9);
}

TEST_F(ReportSectionsTest, DrawsWalksOfOneBodyAlongOneDirection) {
  const auto walk = [&](const std::string& place, const std::string& file, const std::string& x_m, const std::string& elements) {
    write(place + "/trajectory.csv",
          "time_s,centre_of_mass_x_m,centre_of_mass_y_m,horizontal_displacement_m\n0,0,0,0\n1," + x_m + ",0,0.01\n");
    write(place + "/" + file, "status = \"completed\"\ntime_s = 1\ndisplacement_m = [" + x_m +
                                  ", 0, 0]\nhorizontal_displacement_m = 0.01\nhorizontal_displacement_body_lengths = 0.3\n" +
                                  (elements.empty() ? "" : "elements = " + elements + "\n"));
    CommandOutput made = output(place);
    made.stated.body = ManifestBody{.layers = {{"101"}, {"111"}}, .cell_edge_m = 0.01};
    return made;
  };
  CommandOutput coarse = walk("locomote", "locomotion.toml", "0.01", "900");
  CommandOutput fine = walk("locomote_finer", "locomotion.toml", "-0.01", "2000");
  fine.program = "menger-locomote";
  CommandOutput voxels = walk("simulate", "result.toml", "0.01", "");
  const PageChart chart = section({coarse, fine, voxels}, "walks").charts.at(0);
  EXPECT_NEAR(chart.series.at(0).y.back(), -10.0, 1e-9);
  EXPECT_NEAR(chart.series.at(1).y.back(), 10.0, 1e-9) << "the walk on the finest elements";
  EXPECT_NEAR(chart.series.at(2).y.back(), -10.0, 1e-9);
  EXPECT_NE(chart.note.find("in voxels: locomote_finer (finite elements, 180 degrees from x). A curve"), std::string::npos)
      << chart.note;
  EXPECT_EQ(chart.note.find("no walk"), std::string::npos);
  write("locomote_finer/locomotion.toml",
        "status = \"completed\"\ntime_s = 1\ndisplacement_m = [-0.01, 0, 0]\nhorizontal_displacement_m = 0.01\n"
        "horizontal_displacement_body_lengths = 0.08\nelements = 2000\n");
  const PageChart without = section({coarse, fine, voxels}, "walks").charts.at(0);
  EXPECT_NEAR(without.series.at(0).y.back(), 10.0, 1e-9);
  EXPECT_NEAR(without.series.at(1).y.back(), -10.0, 1e-9) << "on one axis with the others, with its sign";
  EXPECT_TRUE(without.series.at(1).name.ends_with(" (no walk)")) << without.series.at(1).name;
  EXPECT_NE(without.note.find("in voxels: locomote (finite elements, 0 degrees from x)."), std::string::npos) << without.note;
  EXPECT_NE(without.note.find("is no walk, and gives no direction"), std::string::npos);
  fine = walk("locomote_finer", "locomotion.toml", "-0.01", "2000");
  fine.program = "menger-locomote";
  fine.stated.body->cell_edge_m = 0.02;
  const PageChart apart = section({coarse, fine}, "walks").charts.at(0);
  EXPECT_NEAR(apart.series.at(0).y.back(), 10.0, 1e-9) << "another body has its own direction";
}

TEST_F(ReportSectionsTest, TellHowBodiesAreHeld) {
  CommandOutput inflation = output("inflate");
  inflation.parameters = R"({"supports": {"kind": "ground_guided"}})";
  inflation.stated.supports = "ground_guided";
  write("validate/curves/robot_inflation.toml", "status = \"completed\"\n");
  const PageTable inputs = input_table({inflation, output("validate")}, folder_);
  const auto row = std::ranges::find_if(inputs.rows, [](const auto& cells) { return cells.at(0) == "supports"; });
  ASSERT_NE(row, inputs.rows.end());
  EXPECT_EQ(row->at(1),
            "slides on the ground, which it does not leave (inflate); free, only its rigid motions are held (validate)");
}

TEST_F(ReportSectionsTest, TellTheDriveOfARobotThatIsOnlyInflated) {
  write("manifest.json",
        R"({"program": "menger-loop", "parameters": {"robot": {"name": "finger"}, "drive": {"mode": "hold", "frequency_Hz": 3,
            "pressure_Pa": [0, 12000]}, "walk": {"present": false}}})");
  const CommandOutput loop = read_command_output(folder_ / "manifest.json").value();
  CommandOutput validation = output("validate");
  validation.inputs = {{"/x/voxel/parameters/soft_12mm.toml", "00"}};
  const std::vector<CommandOutput> outputs{loop, validation};
  const auto value_of = [&](const std::string& name) {
    const PageTable inputs = input_table(outputs, folder_);
    const auto row = std::ranges::find_if(inputs.rows, [&](const auto& cells) { return cells.at(0) == name; });
    return row == inputs.rows.end() ? "" : row->at(1);
  };
  EXPECT_EQ(value_of("pressure of the drive"), "") << "it is held";
  EXPECT_EQ(value_of("mode of the drive"), "held at 12 kPa");
  EXPECT_EQ(value_of("parameters of the surrogate"), "soft_12mm.toml, which came with menger");
  EXPECT_FALSE(read_facts({loop}, notes_).robot_walks);
  EXPECT_TRUE(read_facts({}, notes_).robot_walks);
}

TEST_F(ReportSectionsTest, ReadsThePressureAtWhichWallsTouch) {
  write("inflate/result.toml", "status = \"wall_contact\"\n");
  write("inflate/curves.csv",
        "step,plenum_0_pressure_Pa,plenum_0_volume_m3,plenum_1_pressure_Pa,plenum_1_volume_m3\n0,0,1e-6,0,1e-6\n"
        "1,2000,2e-6,-2000,0.9e-6\n2,-534,0.7e-6,534,1.1e-6\n");
  EXPECT_EQ(read_facts({output("inflate")}, notes_).inflations.at(0).last_pressure_Pa.value_or(0.0), -534.0);
  write("inflate/curves.csv", "step,plenum_0_pressure_Pa,plenum_0_volume_m3\n0,0,1e-6\n1,-900,0.6e-6\n2,0,1e-6\n");
  EXPECT_NEAR(read_facts({output("inflate")}, notes_).inflations.at(0).volume_growth.value_or(0.0), -0.4, 1e-9);
}

TEST_F(ReportSectionsTest, DrawsTheDistanceFromTheStartOfWhatIsNoWalk) {
  write("locomote/trajectory.csv",
        "time_s,centre_of_mass_x_m,centre_of_mass_y_m,horizontal_displacement_m\n0,0.001,0,0\n1,-0.013,0,0.014\n2,,,\n"
        "3,0.001,0.0003,0.0003\n");
  write("locomote/locomotion.toml",
        "status = \"completed\"\ntime_s = 3\ndisplacement_m = [0, 0.0003, 0]\nhorizontal_displacement_m = 0.0003\n"
        "horizontal_displacement_body_lengths = 0.01\n");
  const PageSection walks = section({output("locomote")}, "walks");
  const PageChart& progress = walks.charts.at(0);
  EXPECT_EQ(progress.y.title, "distance of the centre of mass from its start (mm)");
  EXPECT_NE(progress.note.find("is no walk: drawn is the horizontal distance from its start"), std::string::npos);
  EXPECT_EQ(progress.title, "Distance from the start over time");
  EXPECT_NEAR(progress.series.at(0).y.at(1), 14.0, 1e-9) << "across the line to its end, on which it is at 0";
  EXPECT_NEAR(progress.series.at(0).y.at(3), 0.3, 1e-9);
  EXPECT_EQ(walks.tables.at(0).rows.at(0).at(4), "\u2013") << "no walk has no direction";

  write("simulate/trajectory.csv",
        "time_s,centre_of_mass_x_m,centre_of_mass_y_m,horizontal_displacement_m\n0,0,0,0\n1,-0.01,0,0.01\n2,0.02,0,0.02\n");
  write("simulate/result.toml",
        "status = \"completed\"\ntime_s = 2\ndisplacement_m = [0.02, 0, 0]\nhorizontal_displacement_m = 0.02\n"
        "horizontal_displacement_body_lengths = 0.6\n");
  const PageChart both = section({output("locomote"), output("simulate")}, "walks").charts.at(0);
  EXPECT_EQ(both.y.title, "progress of the centre of mass (mm)");
  EXPECT_NE(both.note.find("Of what is no walk, and of a body without any, it is the horizontal distance"), std::string::npos);
  EXPECT_TRUE(both.series.at(0).name.ends_with("(no walk: distance from its start)")) << both.series.at(0).name;
  EXPECT_EQ(both.series.at(1).name.find("no walk"), std::string::npos);
  EXPECT_NEAR(both.series.at(1).y.at(1), -10.0, 1e-9) << "a walk is drawn along its line";
}

TEST_F(ReportSectionsTest, ShowResidualsAndFittedValuesOfACalibration) {
  write("calibrate/result.toml", "[fit]\nstatus = \"completed\"\nexplained = false\nnotes = []\n");
  write("calibrate/residuals.csv",
        "case,kind,body,ordinate,rms,worst,unit,relative\na,stretch,3x1x1,force_N,1,1,N,0.02\nb,inflation,3x1x1,extent_y_m,1,1,m,"
        "0.39\na,stretch,3x1x1,volume_change,1,1,,0.04\n");
  write("calibrate/responses.csv",
        "case,kind,body,pressure_Pa,imposed,ordinate,reference,surrogate,sigma\na,stretch,3x1x1,0,1,force_N,-4,-3,1\na,stretch,"
        "3x1x1,0,1,force_N,2,2,1\n");
  const PageSection calibration = section({output("calibrate")}, "calibration");
  ASSERT_EQ(calibration.charts.size(), 2U);
  ASSERT_EQ(calibration.charts[0].series.size(), 2U);
  EXPECT_EQ(calibration.charts[0].series[0].labels, std::vector<std::string>{"b, extent y (mm)"});
  EXPECT_EQ(calibration.charts[1].series[0].x, (std::vector<double>{-1.0, 0.5}));
  EXPECT_EQ(calibration.charts[1].series[0].y, (std::vector<double>{-0.75, 0.5}));
  const CalibrationFacts facts = read_facts({output("calibrate")}, notes_).calibrations.at(0);
  EXPECT_EQ(facts.cases, 2U);
  EXPECT_EQ(facts.quantities, 3U);
  EXPECT_EQ(facts.median_error, 0.04);
  EXPECT_EQ(facts.worst_error, 0.39);
  EXPECT_FALSE(facts.explained);
}

TEST_F(ReportSectionsTest, ReadAValidationInsideTheRangeOfTheFit) {
  write("validate/errors.csv",
        "case,body,kind,observable,pressure_Pa,imposed,finite_elements,surrogate,error,pointwise_error,validity\nc,bar,"
        "displacement,extent_x_m,3000,,0.001,0.0012,0.2,0.2,inside\n"
        "c,bar,displacement,extent_x_m,9000,,0.002,0.0012,0.2,0.2,pressure\n");
  write("validate/summary.csv",
        "body,kind,range,count,without_equilibrium,median,percentile_90,worst,pointwise_median,worst_body,worst_case\nall,"
        "displacement,inside,1,2,0.2,,0.2,0.2,bar,c\n"
        "all,displacement,outside,1,3,0.4,,0.4,0.4,bar,c\nbar,displacement,inside,1,2,0.2,,0.2,0.2,bar,c\n");
  write("validate/signs.csv", "body,observable,count,wrong\nbar,extent_x_m,5,0\nbar,extent_y_m,4,3\n");
  write("validate/volume_actuation.csv", "body,limit_pressure_Pa,change_at_highest\nbar,15190,0.777\n");
  const PageSection validation = section({output("validate")}, "validation");
  ASSERT_EQ(validation.charts.size(), 1U);
  ASSERT_EQ(validation.tables.size(), 2U);
  EXPECT_EQ(validation.tables[0].rows,
            (std::vector<std::vector<std::string>>{{"bar", "displacement", "inside", "1", "2", "20", "\u2013", "20", "c"}}))
      << "per cent, and one body once";
  EXPECT_EQ(validation.tables[1].columns, (std::vector<std::string>{"body", "change at highest (%)", "limit pressure (kPa)"}));
  EXPECT_EQ(validation.tables[1].rows.at(0).at(1), "77.7");
  EXPECT_NE(validation.tables[1].note.find("so may its limit pressure"), std::string::npos) << "two pressures of one body";
  EXPECT_EQ(validation.charts[0].title, "Displacements in both models: validate/errors.csv") << "no claim on what a fit has seen";
  EXPECT_EQ(validation.charts[0].series[0].x, std::vector<double>{1.0});
  const ValidationFacts facts = read_facts({output("validate")}, notes_).validations.at(0);
  EXPECT_EQ(facts.displacement.median, 0.2);
  EXPECT_EQ(facts.displacement.without_equilibrium, 2U);
  EXPECT_EQ(facts.outside, 4U);
  EXPECT_EQ(facts.outside_why, std::vector<std::string>{"its pressures are beyond those of the fit"});
  EXPECT_EQ(facts.bodies, 1U);
  EXPECT_EQ(facts.signs, 9U);
  EXPECT_EQ(facts.wrong_signs, 3U);
  EXPECT_EQ(facts.wrong_ways, std::vector<std::string>{"extent y (3 of 4)"});
}

TEST_F(ReportSectionsTest, ReadHowFarAShapeIsOffInLengths) {
  write("validate/errors.csv",
        "case,body,kind,observable,pressure_Pa,imposed,finite_elements,surrogate,error,pointwise_error,validity\nc,bar,"
        "displacement,top_m,3000,,0.001,0.0012,0.2,0.2,inside\n");
  write("validate/summary.csv",
        "body,kind,range,count,median,worst,worst_body,worst_case,worst_observable,median_m,worst_m,furthest_body,"
        "furthest_observable,furthest_m,furthest_error\nall,displacement,inside,36,0.2,2.67,bar,c,extent_y_m,0.0007,0.00108,bar,"
        "top_m,0.00207,0.25\nbar,displacement,inside,36,0.2,2.67,bar,c,extent_y_m,0.0007,0.00108,bar,top_m,0.00207,0.25\n");
  const PageTable table = section({output("validate")}, "validation").tables.at(0);
  ASSERT_EQ(table.rows.size(), 1U);
  EXPECT_EQ(table.columns.at(7), "worst in") << "without a column of states without equilibrium, of which there are none";
  EXPECT_EQ(table.rows[0].at(7), "the extent along y, by 1.08 mm") << "the only load case goes without saying";
  EXPECT_EQ(table.columns.at(8), "furthest off by (mm)");
  EXPECT_EQ(table.rows[0].at(8), "2.07");
  EXPECT_EQ(table.rows[0].at(9), "the height of the top");
  const ErrorFact shapes = read_facts({output("validate")}, notes_).validations.at(0).displacement;
  EXPECT_EQ(shapes.median_m, 0.0007);
  EXPECT_EQ(shapes.worst_m, 0.00108);
  EXPECT_EQ(shapes.worst_observable, "the extent along y");
  EXPECT_EQ(shapes.furthest_m, 0.00207);
  EXPECT_EQ(shapes.furthest_error, 0.25);
  EXPECT_EQ(shapes.furthest_observable, "the height of the top");
}

TEST_F(ReportSectionsTest, CallTheBodyOfALoopByItsName) {
  write("manifest.json", R"({"program": "menger-loop", "parameters": {"robot": {"name": "crab"}}})");
  write("validate/errors.csv",
        "case,body,kind,observable,pressure_Pa,finite_elements,surrogate,validity\nc,robot,displacement,top_m,3000,0.001,0.0012,"
        "inside\n");
  write("validate/summary.csv",
        "body,kind,range,count,median,worst,worst_body,worst_case\nall,displacement,inside,1,0.2,0.2,robot,c\n"
        "robot,displacement,inside,1,0.2,0.2,robot,c\n");
  write("validate/volume_actuation.csv",
        "body,highest_pressure_Pa,change_at_highest,limit_pressure_Pa,lowest_pressure_Pa,change_at_lowest,contact_pressure_Pa\n"
        "robot,1700,0.45,,0,0,\n");
  const std::vector<CommandOutput> outputs{read_command_output(folder_ / "manifest.json").value(), output("validate")};
  EXPECT_EQ(section(outputs, "validation").tables.at(0).rows.at(0).at(0), "robot") << "a validation of other bodies";
  write("validate/curves/robot_inflation.toml", "status = \"completed\"\n");
  const PageSection validation = section(outputs, "validation");
  EXPECT_EQ(validation.charts.at(0).series.at(0).name, "crab");
  EXPECT_EQ(validation.tables.at(0).rows.at(0).at(0), "crab");
  EXPECT_EQ(validation.tables.at(1).rows, (std::vector<std::vector<std::string>>{{"crab", "1.7", "45"}}));
  EXPECT_EQ(validation.tables.at(1).columns,
            (std::vector<std::string>{"body", "highest pressure (kPa)", "change at highest (%)"}))
      << "no column without numbers, and none of a vacuum that there was not";
  EXPECT_EQ(validation.tables.at(1).note.find("vacuum"), std::string::npos);
  EXPECT_EQ(read_facts(outputs, notes_).validations.at(0).displacement.worst_body, "crab");
}

TEST_F(ReportSectionsTest, CompareRobotsInBothModels) {
  write("reevaluate/reevaluation.csv",
        "rank,individual,selection,cells,surrogate_body_lengths_per_minute,elements_body_lengths_per_minute,surrogate_relative_"
        "error\n1,7,top,20,3,1,2\n2,9,top,21,2,,\n3,4,sample,20,1,4,0.5\n");
  write("reevaluate/ranking.csv",
        "designs,quantity,value,low_95,high_95,count,of,method\ntop,spearman,1,,,2,2,m\nall,spearman,-0.5,-0.9,0.2,2,3,m\nall,"
        "direction_within_45_deg,0.5,0.1,0.9,1,2,m\nall,top_1_regret_body_lengths_per_minute,0.25,,,2,1,m\n"
        "all,top_2_relative_regret,,,,0,2,m\n");
  const PageSection ranking = section({output("reevaluate")}, "ranking");
  ASSERT_EQ(ranking.charts.size(), 1U);
  ASSERT_EQ(ranking.charts[0].series.size(), 2U);
  EXPECT_EQ(ranking.charts[0].series[0].y, std::vector<double>{1.0});
  const PageTable& ranks = ranking.tables.at(1);
  ASSERT_EQ(ranks.rows.size(), 4U) << "nothing without a value";
  EXPECT_EQ(ranks.rows[1],
            (std::vector<std::string>{"all", "rank correlation of distances (Spearman)", "-0.5", "-0.9", "0.2", "2", "3"}));
  EXPECT_EQ(ranks.rows[2].at(1), "share of directions within 45 degrees");
  EXPECT_EQ(ranks.rows[3].at(1), "speed lost if finite elements judge only the search's best 1 (body lengths / min)");
  const auto has_columns_of_search = [&](const std::string& parameters) {
    CommandOutput made = output("reevaluate");
    made.parameters = parameters;
    const PageTable table = section({made}, "ranking").tables.at(0);
    return std::ranges::find_if(table.columns, [](const std::string& title) { return title.starts_with("search"); }) !=
           table.columns.end();
  };
  EXPECT_FALSE(has_columns_of_search(R"({"compare_with": "search", "search": {"evaluation": {"model": "voxels"}}})"));
  EXPECT_FALSE(has_columns_of_search(R"({"compare_with": "voxels", "search": {"evaluation": {"model": "both"}}})"));
  EXPECT_TRUE(has_columns_of_search(R"({"compare_with": "search", "search": {"evaluation": {"model": "finite_elements"}}})"));
  CommandOutput both = output("reevaluate");
  both.parameters =
      R"({"compare_with": "search", "elements": {"fidelity": "standard"}, "search": {"elements": {"fidelity": "draft"},
          "evaluation": {"model": "finite_elements", "measure": "last_periods", "measure_periods": 5}}})";
  const PageSection measured = section({both}, "ranking");
  const PageTable robots = measured.tables.at(0);
  EXPECT_EQ(robots.title, "Robots in both models, in a period of the drive, by its last 5");
  EXPECT_EQ(robots.columns, (std::vector<std::string>{"rank", "individual", "selection", "cells",
                                                      "search (draft finite elements): speed (body lengths / min)",
                                                      "standard finite elements: speed (body lengths / min)",
                                                      "search (draft finite elements): error of the displacement (share)"}));
  EXPECT_EQ(measured.charts.at(0).x.title, "search (draft finite elements) (body lengths / min)");
  EXPECT_NE(robots.note.find("those in the table of walks are from start to end"), std::string::npos);
  both.parameters =
      R"({"search": {"evaluation": {"model": "voxels", "measure": "net_displacement"}, "time": {"measure_from_s": 0.5}}})";
  EXPECT_EQ(section({both}, "ranking").tables.at(0).title, "Robots in both models, from 0.5 s to the end");
  const RankingFacts facts = read_facts({output("reevaluate")}, notes_).rankings.at(0);
  EXPECT_EQ(facts.designs, 3U);
  EXPECT_EQ(facts.compared, 2U);
  EXPECT_EQ(facts.spearman->value, -0.5);
  EXPECT_EQ(facts.within_45_deg, 1U);
  EXPECT_EQ(facts.median_error, 1.25);
  EXPECT_EQ(facts.best_design, "rank 3 of the search");
}

TEST_F(ReportSectionsTest, ShowTheProgressAndLineageOfAnExportedSearch) {
  write("export/generations.csv",
        "generation,best_fitness_body_lengths,champion,hausdorff_dimension,mean_fitness_body_lengths,evaluations,pruned\n"
        "0,0.1,1,2.7,0.05,4,0\n1,0.3,7,2.7,0.1,5,0\n");
  write("export/lineage.csv",
        "generation,individual,parent,fitness_body_lengths,cells,phenotype\n0,1,,0.1,20,111000\n1,7,1,0.3,21,111100\n");
  write(
      "export/confirmed.csv",
      "rank,individual,design,cells,fitness_body_lengths,fidelity,score_body_lengths,ratio,angle_deg,along_body_lengths,reason\n"
      "1,7,ab,21,0.3,standard,,,,0,the body has fallen\n1,7,ab,21,0.3,fine,0.25,0.83,12,0.24,\n");
  const PageSection search = section({output("export")}, "search");
  EXPECT_EQ(search.tables.at(0).columns, (std::vector<std::string>{"generation", "best fitness (body lengths)", "champion",
                                                                   "mean fitness (body lengths)", "evaluations"}));
  EXPECT_TRUE(search.tables.at(0).note.starts_with("More columns")) << search.tables.at(0).note;
  ASSERT_EQ(search.charts.size(), 2U);
  EXPECT_EQ(search.charts[0].series[0].y, (std::vector<double>{0.1, 0.3}));
  EXPECT_EQ(search.charts[1].series[0].labels[1], "individual 7, 21 cells, 111100");
  const SearchFacts facts = read_facts({output("export")}, notes_).searches.at(0);
  EXPECT_EQ(facts.first_fitness, 0.1);
  EXPECT_EQ(facts.first_generation, "0");
  EXPECT_EQ(facts.last_generation, "1");
  EXPECT_EQ(facts.last_fitness, 0.3);
  EXPECT_EQ(facts.evaluations, 9.0);
  ASSERT_EQ(facts.confirmed.size(), 2U);
  EXPECT_EQ(facts.confirmed[0].elements, "standard");
  EXPECT_EQ(facts.confirmed[0].score, std::nullopt);
  EXPECT_EQ(facts.confirmed[0].reason, "the body has fallen");
  EXPECT_EQ(facts.confirmed[1].individual, "7");
  EXPECT_EQ(facts.confirmed[1].fitness, 0.3);
  EXPECT_EQ(facts.confirmed[1].score, 0.25);
  EXPECT_EQ(facts.confirmed[1].angle_deg, 12.0);
}

TEST_F(ReportSectionsTest, ShowFrequenciesUnderPressure) {
  write("modes/result.toml", "status = \"completed\"\n");
  write("modes/modes.csv",
        "path_parameter,plenum_0_pressure_Pa,rigid_modes,mode,frequency_Hz\n0,0,0,1,12\n0,0,0,2,20\n1,1000,0,1,10\n");
  const PageSection modes = section({output("modes")}, "modes");
  ASSERT_EQ(modes.charts.size(), 1U);
  EXPECT_EQ(modes.charts[0].series[0].x, (std::vector<double>{0.0, 1.0}));
  EXPECT_EQ(modes.charts[0].series[0].y, (std::vector<double>{12.0, 10.0}));
  EXPECT_EQ(read_facts({output("modes")}, notes_).modes.at(0).first_frequency_Hz, 12.0);
}

TEST_F(ReportSectionsTest, DrawErrorAgainstCostWithoutTheReference) {
  write("tradeoff/tradeoff.csv",
        "model,relative_error,cpu_seconds,role,status\nvoxels,0.48,0.07,front,completed\nelements,0,12,reference,"
        "completed\nelements,0.1,1.2,front,completed\n");
  write("tradeoff/recommendation.txt", "Take voxels.\n\nOr elements.\n");
  const PageSection trade_off = section({output("tradeoff")}, "tradeoff");
  ASSERT_EQ(trade_off.charts.size(), 1U);
  ASSERT_EQ(trade_off.charts[0].series.size(), 2U);
  EXPECT_EQ(trade_off.charts[0].series[1].x, std::vector<double>{1.2});
  EXPECT_EQ(trade_off.words, (std::vector<std::string>{"Take voxels.", "Or elements."}));
}

TEST_F(ReportSectionsTest, ListLoadCasesWithTheirStatus) {
  write("load-cases/stretch.toml",
        "status = \"wall_contact\"\nreason = \"two walls touch\"\n[case]\nname = \"stretch\"\nkind = \"stretch\"\n");
  write("load-cases/stretch.csv", "a\n1\n2\n");
  write("load-cases/other.toml", "x = 1\n");
  const PageSection cases = section({output("load-cases")}, "load-cases");
  ASSERT_EQ(cases.tables.size(), 1U);
  EXPECT_EQ(cases.tables[0].rows,
            (std::vector<std::vector<std::string>>{{"stretch", "stretch", "wall_contact", "two walls touch", "2"}}));
}

TEST_F(ReportSectionsTest, NameTheFolderOfARun) {
  CommandOutput mesh = output("mesh");
  mesh.name = "mesh/mesh_manifest.json";
  EXPECT_EQ(section({mesh}, "provenance").tables.at(0).rows.at(0).at(0), "mesh");
}

TEST_F(ReportSectionsTest, SayWhatCannotBeReadAndGoOn) {
  write("inflate/curves.csv", "step\n0,1\n");
  write("modes/modes.csv", "mode,frequency_Hz\n1,12\n");
  std::vector<std::string> ids;
  for (const PageSection& one : report_sections({output("inflate"), output("modes"), output("simulate")}, notes_))
    ids.push_back(one.id);
  EXPECT_EQ(ids, (std::vector<std::string>{"modes", "provenance"}));
  ASSERT_EQ(notes_.size(), 1U);
  EXPECT_NE(notes_[0].find("inflate/curves.csv"), std::string::npos);
}

}  // namespace
}  // namespace menger::evolution
