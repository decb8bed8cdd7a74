#include "evolution/trade_off/trade_off_settled.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "io/text/input_error.h"
#include "io/text/whole_file.h"
#include "tests/support/surrogate_example.h"
#include "tests/support/test_folder.h"
#include "voxel/model/surrogate_file.h"
#include "voxel/picture/vtk_output.h"
#include "voxel/statics/equilibrium.h"
#include "voxel/statics/load_case_response.h"

namespace menger::evolution {
namespace {

namespace fs = std::filesystem;

constexpr double rounding_m = 1e-14;  // for lengths of centimetres, after an iterated fit of the rotation

/// Voxels of 10 mm with known half lengths and bulges at 1000 Pa.
class SettledBodyTest : public testing::Test {
 protected:
  /// Parameters with extension 0.01 and bulge 0.001 for every wall beside an axis, at 1000 Pa. @param softening q of the
  /// extension
  [[nodiscard]] static voxel::SurrogateParameters driven(double softening = 0.0) {
    voxel::SurrogateParameters p = tests::surrogate_example();
    const std::array slopes{0.0, 1.0, 2.0, 2.0, 2.0, 3.0, 4.0};  // number of walls beside the axis
    for (std::size_t c = 0; c < voxel::wall_class_count; ++c) {
      p.extension[c] = {.slope_per_Pa = 1e-5 * slopes.at(c), .pressure_softening_per_Pa = softening};
      p.bulge[c] = {.slope_per_Pa = 1e-6 * slopes.at(c)};
    }
    return p;
  }

  [[nodiscard]] fs::path file_of(const voxel::SurrogateParameters& parameters) const {
    fs::path file = folder_ / "parameters.toml";
    io::write_whole(file, voxel::surrogate_text(parameters));
    return file;
  }

  [[nodiscard]] static TradeStudy study_of(const meshes::Polycube& body) {
    TradeStudy study;
    study.file = "study.toml";
    study.design.body = body;
    study.design.cell_edge_m = 0.01;
    study.wall_thickness_m = 0.002;
    study.silicone_name = "soft";
    study.law = "neo-hookean";
    return study;
  }

  [[nodiscard]] static TradeStudy bar(const std::string& digits) {
    return study_of(meshes::Polycube::from_digits(static_cast<int>(digits.size()), 1, 1, digits));
  }

  [[nodiscard]] static SettledBody::Voxels upright(const std::vector<voxel::Vector3<double>>& middles) {
    SettledBody::Voxels voxels;
    for (const auto& middle : middles) voxels.push_back({middle, {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}});
    return voxels;
  }

  /// Returns the surrogate's own equilibrium under a pressure, as a frame has it.
  [[nodiscard]] static SettledBody::Voxels equilibrium(const voxel::SurrogateParameters& parameters,
                                                       const meshes::LoadCase& load_case, voxel::LoadCaseResponse& response) {
    SettledBody::Voxels voxels;
    response = voxel::visit_states(parameters, load_case, {}, [&](std::size_t, const voxel::Equilibrium& now) {
      voxels.clear();
      for (std::size_t n = 0; n < now.balance().body().voxel_count(); ++n) {
        const auto turn = voxel::matrix(now.pose(n).orientation);
        const auto along = [&](double x, double y, double z) { return rotate(turn, voxel::Vector3<double>{x, y, z}); };
        voxels.push_back({now.pose(n).position, {along(1, 0, 0), along(0, 1, 0), along(0, 0, 1)}});
      }
    });
    return voxels;
  }

  const tests::TestFolder folder_;
};

meshes::LoadCase inflation_of(const TradeStudy& study, double pressure_Pa) {
  meshes::LoadCase load_case;
  load_case.name = "case";
  load_case.cells = {study.design.body.nx(), study.design.body.ny(), study.design.body.nz()};
  load_case.digits = study.design.body.digits();
  load_case.cell_edge_m = study.design.cell_edge_m;
  load_case.wall_thickness_m = study.wall_thickness_m;
  load_case.pressures_Pa = {pressure_Pa};
  return load_case;
}

TEST_F(SettledBodyTest, WallsBulgeFromVoxelsThatDoNotMove) {
  // one voxel, four walls beside every axis: extension 0.04, bulge 0.004
  const SettledBody body(bar("1"), file_of(driven()));
  const SettledBody::Voxels still = upright({{0.005, 0.005, 0.005}});
  for (const auto extent : {TradeObservable::extent_x, TradeObservable::extent_y, TradeObservable::extent_z})
    EXPECT_NEAR(body.observed(extent, still, 1000.0), 0.01 * (0.04 + 2.0 * 0.004), rounding_m);
  const double growth_m3 = 1e-6 * (1.04 * 1.04 * 1.04 + 6.0 * 0.004 * 1.04 * 1.04 - 1.0);
  EXPECT_NEAR(body.observed(TradeObservable::volume_change, still, 1000.0), growth_m3 / (0.006 * 0.006 * 0.006), 1e-12);
  EXPECT_NEAR(body.observed(TradeObservable::volume_change, still, 0.0), 0.0, 1e-12);
}

TEST_F(SettledBodyTest, AJointInABodyHasNoWall) {
  // two voxels, 13 mm apart: along x four walls beside each, across x three
  voxel::SurrogateParameters parameters = driven();
  parameters.lateral_coupling = 0.0;
  const SettledBody body(bar("11"), file_of(parameters));
  const SettledBody::Voxels settled = upright({{0.004, 0, 0}, {0.017, 0, 0}});
  EXPECT_NEAR(body.observed(TradeObservable::extent_x, settled, 1000.0), 0.013 + 0.01 * (1.04 + 2.0 * 0.004) - 0.02, rounding_m);
  EXPECT_NEAR(body.observed(TradeObservable::extent_y, settled, 1000.0), 0.01 * (0.03 + 2.0 * 0.003), rounding_m);
}

TEST_F(SettledBodyTest, StretchedBodiesBecomeThinByTheirLateralCoupling) {
  // rest length 10.4 mm: a strain of 0.25, half of it on each voxel, and c = 0.5
  const SettledBody body(bar("11"), file_of(driven()));
  const SettledBody::Voxels settled = upright({{0, 0, 0}, {0.013, 0, 0}});
  EXPECT_NEAR(body.observed(TradeObservable::extent_y, settled, 1000.0), 0.01 * (1.03 * (1.0 - 0.5 * 0.125) + 2.0 * 0.003 - 1.0),
              rounding_m);
}

TEST_F(SettledBodyTest, ChambersPerPhaseHaveAWallBetweenThem) {
  TradeStudy study = bar("12");
  study.chambers = "per-phase";
  const SettledBody body(study, file_of(driven()));
  const SettledBody::Voxels settled = upright({{0, 0, 0}, {0.0104, 0, 0}});
  EXPECT_NEAR(body.observed(TradeObservable::extent_y, settled, 1000.0), 0.01 * (0.04 + 2.0 * 0.004), rounding_m);
}

TEST_F(SettledBodyTest, TurnsAndShiftsAreNotObserved) {
  const SettledBody body(study_of(meshes::Polycube::from_digits(3, 2, 1, "111100")), file_of(driven()));
  const SettledBody::Voxels before = upright({{0, 0, 0}, {0.011, 0.001, 0}, {0.022, 0.003, 0.001}, {0, 0.0105, 0}});
  // a third of a turn about (1, 1, 1) turns x into y, y into z and z into x
  const auto turned = [](const voxel::Vector3<double>& v) { return voxel::Vector3<double>{v.z, v.x, v.y}; };
  SettledBody::Voxels after = before;
  for (OrientedVoxel& voxel : after) {
    voxel.middle = turned(voxel.middle) + voxel::Vector3<double>{0.1, -0.2, 0.05};
    for (auto& axis : voxel.axes) axis = turned(axis);
  }
  for (const auto observable :
       {TradeObservable::volume_change, TradeObservable::extent_x, TradeObservable::extent_y, TradeObservable::extent_z}) {
    EXPECT_NEAR(body.observed(observable, after, 1000.0), body.observed(observable, before, 1000.0), 1e-12);
  }
}

TEST_F(SettledBodyTest, EquilibriaAreObservedAsTheFitSawThem) {
  // voxel::respond is what parameters are fitted with: a different evaluation of the same body would count as an error of the fit
  for (const int voxels_per_cell : {1, 2}) {
    voxel::SurrogateParameters parameters = driven();
    parameters.voxels_per_cell = voxels_per_cell;
    const TradeStudy study = study_of(meshes::Polycube::from_digits(3, 2, 1, "111111"));
    voxel::LoadCaseResponse response;
    const SettledBody::Voxels settled = equilibrium(parameters, inflation_of(study, 1500.0), response);
    ASSERT_EQ(response.status, io::RunStatus::completed);
    const SettledBody body(study, file_of(parameters));
    const std::vector<std::pair<std::string, TradeObservable>> columns{{"volume_change", TradeObservable::volume_change},
                                                                       {"extent_x_m", TradeObservable::extent_x},
                                                                       {"extent_y_m", TradeObservable::extent_y},
                                                                       {"extent_z_m", TradeObservable::extent_z}};
    for (const auto& [column, observable] : columns) {
      const auto place = std::ranges::find(response.columns, column) - response.columns.begin();
      const double fitted = response.values.at(static_cast<std::size_t>(place)).front();
      EXPECT_NEAR(body.observed(observable, settled, 1500.0), fitted, 1e-9 * std::abs(fitted)) << column << voxels_per_cell;
    }
  }
}

TEST_F(SettledBodyTest, PressuresBeyondAPoleAreRefused) {
  const SettledBody body(bar("1"), file_of(driven(1.0 / 4000.0)));
  EXPECT_NO_THROW(body.require_sizes(1000.0));
  EXPECT_THROW(body.require_sizes(5000.0), io::InputError);
}

TEST_F(SettledBodyTest, ParametersOfAnotherBodyAreRefusedByKeyAndValue) {
  const auto expect_refused = [&](const TradeStudy& study, const std::vector<std::string>& words) {
    try {
      const SettledBody body(study, file_of(driven()));
      ADD_FAILURE() << "accepted: " << words.front();
    } catch (const io::InputError& error) {
      EXPECT_NE(std::string(error.what()).find("parameters.toml"), std::string::npos) << error.what();
      for (const std::string& word : words) EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
    }
  };
  TradeStudy study = bar("1");
  study.silicone_name = "softer";
  expect_refused(study, {"silicone", "\"soft\"", "\"softer\""});
  study = bar("1");
  study.law = "yeoh";
  expect_refused(study, {"law", "neo-hookean", "yeoh"});
  study = bar("1");
  study.design.cell_edge_m = 0.02;
  expect_refused(study, {"cell_edge_m", "0.01", "0.02"});
  study = bar("1");
  study.wall_thickness_m = 0.003;
  expect_refused(study, {"wall_thickness_m", "0.002", "0.003"});
}

/// A frame of solid voxels of 10 mm whose drawn boxes are not symmetric about the centres.
voxel::Frame frame_of(const std::vector<std::array<double, 3>>& centres_m) {
  const std::size_t count = centres_m.size();
  return {.time_s = 0.0,
          .position_m = centres_m,
          .rest_position_m = centres_m,
          .orientation = std::vector(count, std::array{1.0, 0.0, 0.0, 0.0}),
          .size_m = std::vector(count, 0.01),
          .reach_m = std::vector(count, std::array{0.005, 0.006, 0.007, 0.005, 0.0055, 0.008}),
          .speed_m_s = std::vector(count, 0.0),
          .strain = std::vector(count, 0.0),
          .material = std::vector<std::uint8_t>(count, 1),
          .phase = std::vector(count, 0.0),
          .contact = std::vector<std::uint8_t>(count, 0),
          .cell_edge_m = 0.01};
}

TEST_F(SettledBodyTest, FramesGiveCentresAndDirectionsWhateverBoxesAreDrawn) {
  voxel::Frame frame = frame_of({{0.1, 0.2, 0.3}, {0.7, -0.2, 1.0 / 3.0}});
  frame.orientation[1] = {std::sqrt(0.5), 0.0, 0.0, std::sqrt(0.5)};  // a quarter turn about z: its x axis points along y
  voxel::write_frame(folder_ / "frame.vtu", frame);
  const SettledBody::Voxels voxels = frame_voxels(folder_ / "frame.vtu");
  ASSERT_EQ(voxels.size(), 2U);
  const std::array<std::array<double, 3>, 3> turned{{{0.0, 1.0, 0.0}, {-1.0, 0.0, 0.0}, {0.0, 0.0, 1.0}}};
  const auto numbers = [](const voxel::Vector3<double>& v) { return std::array{v.x, v.y, v.z}; };
  for (std::size_t n = 0; n < 2; ++n) {
    for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(numbers(voxels[n].middle)[i], frame.position_m[n][i] + 0.005);
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (std::size_t along = 0; along < 3; ++along) {
      // corners are float32 numbers below 1 m, exact to 3e-8 m, and the boxes are centimetres long
      EXPECT_NEAR(numbers(voxels[0].axes.at(axis)).at(along), axis == along ? 1.0 : 0.0, 2e-5);
      EXPECT_NEAR(numbers(voxels[1].axes.at(axis)).at(along), turned.at(axis).at(along), 2e-5);
    }
  }
}

TEST_F(SettledBodyTest, FilesWithoutCentresAreNoFrames) {
  const fs::path file = folder_ / "frame.vtu";
  EXPECT_THROW((void)frame_voxels(file), io::InputError) << "there is none";
  voxel::write_frame(file, frame_of({{0.0, 0.0, 0.0}}));
  std::string text = io::read_whole(file);
  text.replace(text.find("centre_m"), 8, "middle_m");
  io::write_whole(file, text);
  try {
    (void)frame_voxels(file);
    ADD_FAILURE() << "accepted";
  } catch (const io::InputError& error) {
    EXPECT_NE(std::string(error.what()).find("frame.vtu: is not a frame of menger simulate: centre_m is missing"),
              std::string::npos)
        << error.what();
  }
}

TEST_F(SettledBodyTest, EveryObservableThatStillMovesIsNamed) {
  TradeStudy study = bar("11");
  const SettledBody body(study, file_of(driven()));
  fs::create_directories(folder_ / "run/result/frames");
  io::write_whole(folder_ / "run/result/result.toml", "status = \"completed\"\nvoxels = 2\nsteps = 100\n");
  const auto write = [&](const std::string& name, double stretch_m) {
    voxel::write_frame(folder_ / "run/result/frames" / name, frame_of({{0.0, 0.0, 0.0}, {0.01 + stretch_m, 0.0, 0.0}}));
  };
  write("frame_0000.vtu", 0.0);
  write("frame_0001.vtu", 0.0);
  write("frame_0002.vtu", 0.001);
  TradeRow row;
  row.values.assign(study.observables.size(), std::nullopt);
  // at pressure 0, where the observables of an unstretched body are zero
  read_settling_result(study, body, 0.0, {.folder = folder_ / "run", .outcome = {}, .message = {}}, row);
  EXPECT_EQ(row.status, "completed");
  EXPECT_NEAR(row.values[1].value(), 1e-3, 1e-9);  // from the distance of the centres, not from the boxes
  for (const char* column : {"volume_change", "extent_change_x_m"})
    EXPECT_NE(row.reason.find(std::string("still moving: ") + column + " changed from "), std::string::npos) << row.reason;
  EXPECT_EQ(row.reason.find("inf"), std::string::npos) << row.reason;
  row.reason.clear();
  write("frame_0001.vtu", 0.001);
  read_settling_result(study, body, 0.0, {.folder = folder_ / "run", .outcome = {}, .message = {}}, row);
  EXPECT_EQ(row.reason, "");
}

TEST_F(SettledBodyTest, OtherFilesAreRefused) {
  io::write_whole(folder_ / "other.toml", "[holds_for]\nvoxels_per_cell = 1\n");
  EXPECT_THROW(SettledBody(bar("1"), folder_ / "other.toml"), io::InputError);
}

}  // namespace
}  // namespace menger::evolution
