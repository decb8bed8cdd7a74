#include "voxel/statics/load_case_response.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <stdexcept>

#include "tests/unit/voxel/statics/static_samples.h"
#include "voxel/model/surrogate_file.h"
#include "voxel/statics/body_shape.h"

namespace menger::voxel {
namespace {

using meshes::LoadCase;
using meshes::LoadCaseKind;

LoadCase case_of_length(LoadCaseKind kind, int length, std::vector<double> pressures, std::vector<double> imposed = {}) {
  LoadCase result;
  result.name = "case";
  result.kind = kind;
  result.cells = {length, 1, 1};
  result.digits = std::string(static_cast<std::size_t>(length), '1');
  result.cell_edge_m = sample_edge;
  result.wall_thickness_m = 0.002;
  result.pressures_Pa = std::move(pressures);
  result.imposed = std::move(imposed);
  return result;
}

SurrogateParameters response_parameters() {
  SurrogateParameters parameters = sample_parameters();
  parameters.extension.fill({2e-5, 1e-5, -3e-5});
  parameters.bulge.fill({1e-5, 2e-5, -1e-5});
  parameters.bulge_peak_ratio.fill(2.0);
  return parameters;
}

double value(const LoadCaseResponse& response, const std::string& column, std::size_t row) {
  for (std::size_t i = 0; i < response.columns.size(); ++i) {
    if (response.columns[i] == column) return response.values[i].at(row);
  }
  ADD_FAILURE() << "no column " << column;
  return 0.0;
}

TEST(LoadCaseResponse, OfInflationIsTheLawOfOneCell) {
  const SurrogateParameters parameters = response_parameters();
  const LoadCaseResponse response = respond(parameters, case_of_length(LoadCaseKind::inflation, 1, {-3000.0, 0.0, 4000.0}));
  ASSERT_EQ(response.status, io::RunStatus::completed);
  ASSERT_EQ(response.values[0].size(), 3U);
  const double chamber = std::pow(sample_edge - 2.0 * 0.002, 3);
  for (std::size_t row = 0; row < 3; ++row) {
    const double pressure = response.values[0][row];
    const double x = parameters.extension[walls::closed].value(pressure);
    const double b = parameters.bulge[walls::closed].value(pressure);
    EXPECT_NEAR(value(response, "extent_x_m", row), sample_edge * (x + 2.0 * b), 1e-15);
    EXPECT_NEAR(value(response, "extent_z_m", row), sample_edge * (x + 2.0 * b), 1e-15);
    EXPECT_NEAR(value(response, "top_m", row), sample_edge * (x + 3.0 * b), 1e-15);
    const double growth = std::pow(sample_edge, 3) * (std::pow(1.0 + x, 3) + 6.0 * b * std::pow(1.0 + x, 2) - 1.0);
    EXPECT_NEAR(value(response, "volume_change", row), growth / chamber, 1e-12);
  }
}

TEST(LoadCaseResponse, HasTheTopAtTheCrownOfAWallOrAtTheRimOfOne) {
  const SurrogateParameters parameters = response_parameters();
  constexpr double pressure = 2000.0;
  const double x = parameters.extension[0].value(pressure);
  const double b = parameters.bulge[0].value(pressure);  // of the bottom in the mean; twice that at a crown
  const auto top = [&](const std::array<int, 3>& cells, const std::string& digits, int level) {
    LoadCase of = case_of_length(LoadCaseKind::inflation, 1, {pressure});
    of.cells = cells;
    of.digits = digits;
    of.level = level;
    return value(respond(parameters, of), "top_m", 0);
  };
  EXPECT_NEAR(top({2, 1, 1}, "11", 1), sample_edge * (x + 3.0 * b), 1e-12) << "in the middle of one wall";
  EXPECT_NEAR(top({2, 1, 1}, "11", 2), sample_edge * (x + b), 1e-12) << "where two modules meet";
  EXPECT_NEAR(top({2, 2, 1}, "1111", 1), sample_edge * (x + 3.0 * b), 1e-12) << "the crown of a plate";
  EXPECT_NEAR(top({2, 2, 1}, "1111", 2), sample_edge * (x + b), 1e-12) << "where four modules meet";
  EXPECT_NEAR(top({2, 2, 1}, "1110", 1), sample_edge * (x + b), 1e-12) << "the inner corner of an L";
}

// The middle of the top of a square with an arm lies between two faces, beside the crown of the square. The wall spans 16 mm of a
// square of 20 mm with walls of 2 mm, and the middles of these faces lie 3 mm inside: a parabola has 4 (3/16) (13/16) = 39/64 of
// its crown there. By finite elements (Q2/P1, Dragon Skin 10) it is 0.61 of the crown at 6 kPa, and 0.59 without the arm.
TEST(LoadCaseResponse, HasTheTopBesideTheCrownOfASquare) {
  const SurrogateParameters parameters = response_parameters();
  LoadCase of = case_of_length(LoadCaseKind::inflation, 1, {2000.0});
  of.cells = {3, 2, 1};
  of.digits = "111110";
  const double x = parameters.extension[0].value(2000.0);
  const double b = parameters.bulge[0].value(2000.0);
  EXPECT_NEAR(value(respond(parameters, of), "top_m", 0), sample_edge * (x + b + 2.0 * b * 39.0 / 64.0), 1e-12);
  // Here the middle of the top is where the square ends and an arm begins: it has the mean of the square and the crown of the
  // arm.
  for (const char* const digits : {"110011110001", "001111111000"}) {
    of.cells = {4, 3, 1};
    of.digits = digits;
    EXPECT_NEAR(value(respond(parameters, of), "top_m", 0), sample_edge * (x + b + 0.5 * (b + 2.0 * b)), 1e-12) << digits;
  }
}

TEST(LoadCaseResponse, OfInflationHasMoreVolumeBelowWideWalls) {
  SurrogateParameters parameters = response_parameters();
  LoadCase of = case_of_length(LoadCaseKind::inflation, 1, {2000.0});
  of.cells = {2, 2, 1};
  of.digits = "1111";
  const double before = value(respond(parameters, of), "volume_change", 0);
  parameters.wide_volume_ratio = 1.1;
  const double x = parameters.extension[0].value(2000.0);
  const double b = parameters.bulge[0].value(2000.0);
  const double more = 0.1 * 8.0 * std::pow(sample_edge, 3) * b * std::pow(1.0 + x, 2);  // eight faces, at top and bottom
  EXPECT_NEAR(value(respond(parameters, of), "volume_change", 0), before + more / (0.016 * 0.016 * 0.006), 1e-12);
}

TEST(LoadCaseResponse, OfInflationCountsFacesOfLongBodies) {
  const SurrogateParameters parameters = response_parameters();
  const double pressure = 2000.0;
  const LoadCaseResponse response = respond(parameters, case_of_length(LoadCaseKind::inflation, 3, {pressure}));
  const double x = parameters.extension[0].value(pressure);
  const double b = parameters.bulge[0].value(pressure);
  EXPECT_NEAR(value(response, "extent_x_m", 0), sample_edge * (3.0 * x + 2.0 * b), 1e-12);
  EXPECT_NEAR(value(response, "extent_y_m", 0), sample_edge * (x + 2.0 * b), 1e-12);
  const double chamber = std::pow(0.006, 2) * 0.026;
  const double growth = std::pow(sample_edge, 3) * (3.0 * std::pow(1.0 + x, 3) + 14.0 * b * std::pow(1.0 + x, 2) - 3.0);
  EXPECT_NEAR(value(response, "volume_change", 0), growth / chamber, 1e-11);
}

TEST(LoadCaseResponse, OfInflationBulgesATeeNoWiderThanItsArms) {
  SurrogateParameters parameters = sample_parameters();
  for (std::size_t c = 0; c < wall_class_count; ++c) parameters.bulge[c].slope_per_Pa = 1e-6 * (1.0 + static_cast<double>(c * c));
  LoadCase of = case_of_length(LoadCaseKind::inflation, 1, {1000.0});
  of.cells = {3, 2, 1};
  of.digits = "111010";
  const auto b = [&](std::size_t c) { return parameters.bulge[c].value(1000.0); };
  // Top and bottom, the sides of the arms, their ends, and the side of the cell in the middle.
  const double faces =
      2.0 * (3.0 * b(walls::three) + b(walls::bend)) + 6.0 * b(walls::three) + 3.0 * b(walls::closed) + b(walls::limb);
  const LoadCaseResponse response = respond(parameters, of);
  const double chamber = 0.006 * 0.006 * (0.026 + 0.01);
  EXPECT_NEAR(value(response, "volume_change", 0), std::pow(sample_edge, 3) * faces / chamber, 1e-11);
}

// Sizes at 6 kPa by finite elements (Q2/P1, one through the wall, Dragon Skin 10) of bodies in which arms and squares of cells
// meet, none of which is in a fit; they were seen while the laws of plates were chosen. Volumes are known to 5 %, as all curves
// of the fit. Straight arms bulge too little in the fit itself, so the T has a wider tolerance; where four arms meet a wall also
// spans more than in the bend that stands in for it. Widths are small sums of lengths that grow and of edges that are drawn in:
// 0.13 mm is a twentieth of what plates of this size stand out by. With one law for all walls those of the last four are 0.22 to
// 0.67 mm off.
TEST(LoadCaseResponse, OfFeetHasTheSizeThatFiniteElementsFind) {
  struct Foot {
    const char* digits;
    double volume_change;
    double tolerance;
    double extent_x_m, extent_y_m;
  };
  constexpr double plane_tolerance_m = 0.13e-3;
  constexpr std::array feet{
      Foot{"111010000", 0.2240, 0.07, 0.2049e-3, 0.3572e-3}, Foot{"010111010", 0.2433, 0.20, 0.3023e-3, 0.3023e-3},
      Foot{"111110100", 0.4057, 0.05, 0.1469e-3, 0.1469e-3}, Foot{"011111011", 0.5962, 0.05, -0.2842e-3, -0.0342e-3},
      Foot{"110111011", 0.5330, 0.05, 0.0081e-3, 0.0081e-3}, Foot{"110110111", 0.5631, 0.05, -0.2300e-3, 0.0164e-3}};
  const SurrogateParameters parameters =
      read_surrogate(std::filesystem::path(MENGER_SOURCE_DIR) / "voxel/parameters/dragon_skin_10_1cm.toml");
  for (const Foot& foot : feet) {
    SCOPED_TRACE(foot.digits);
    LoadCase of = case_of_length(LoadCaseKind::inflation, 1, {6000.0});
    of.cells = {3, 3, 1};
    of.digits = foot.digits;
    const LoadCaseResponse found = respond(parameters, of);
    EXPECT_NEAR(value(found, "volume_change", 0), foot.volume_change, foot.tolerance * foot.volume_change);
    EXPECT_NEAR(value(found, "extent_x_m", 0), foot.extent_x_m, plane_tolerance_m);
    EXPECT_NEAR(value(found, "extent_y_m", 0), foot.extent_y_m, plane_tolerance_m);
  }
}

TEST(LoadCaseResponse, TakesTheRimForTheTopOfABodyWithAHole) {
  const SurrogateParameters parameters = response_parameters();
  LoadCase of = case_of_length(LoadCaseKind::inflation, 1, {2000.0});
  of.cells = {3, 3, 3};
  of.digits = meshes::menger_sponge().digits();
  const double x = parameters.extension[0].value(2000.0);
  const double b = parameters.bulge[0].value(2000.0);
  EXPECT_NEAR(value(respond(parameters, of), "top_m", 0), sample_edge * (3.0 * x + b), 1e-12);
}

TEST(LoadCaseResponse, OfABlockedBodyIsTheBlockedForce) {
  const SurrogateParameters parameters = response_parameters();
  const LoadCaseResponse response = respond(parameters, case_of_length(LoadCaseKind::blocked, 2, {0.0, 5000.0}));
  const double x = parameters.extension[4].value(5000.0);
  EXPECT_NEAR(value(response, "force_N", 0), 0.0, 1e-9 * sample_axial());
  EXPECT_NEAR(value(response, "force_N", 1), -sample_axial() * x / (1.0 + x), 1e-9 * sample_axial());
  // Plates hold the length and flatten the end walls: each voxel grows across, and on its four free sides.
  const double b = parameters.bulge[4].value(5000.0);
  const double growth = 2.0 * std::pow(sample_edge, 3) * (std::pow(1.0 + x, 2) + 4.0 * b * (1.0 + x) - 1.0);
  EXPECT_NEAR(value(response, "volume_change", 1), growth / (0.006 * 0.006 * 0.016), 1e-10);
  EXPECT_NEAR(response.smallest_strain, 1.0 / (1.0 + x) - 1.0, 1e-9);
}

TEST(LoadCaseResponse, OfStretchIsHookesLawAndTheCoupling) {
  SurrogateParameters parameters = sample_parameters();
  parameters.lateral_coupling = 0.5;
  const LoadCaseResponse response = respond(parameters, case_of_length(LoadCaseKind::stretch, 2, {0.0}, {0.0, 0.001, 0.002}));
  ASSERT_EQ(response.values[0].size(), 3U);
  for (std::size_t row = 0; row < 3; ++row) {
    const double strain = response.values[1][row] / 0.02;
    EXPECT_NEAR(value(response, "force_N", row), sample_axial() * strain, 1e-9 * sample_axial());
    EXPECT_NEAR(value(response, "extent_y_m", row), -0.5 * strain * sample_edge, 1e-12);
    EXPECT_NEAR(value(response, "extent_z_m", row), -0.5 * strain * sample_edge, 1e-12);
  }
  EXPECT_NEAR(response.largest_strain, 0.1, 1e-9);
}

TEST(LoadCaseResponse, OfShearBendingAndTorsionIsThatOfABar) {
  const double length = 4.0 * sample_edge;
  const double small = 1e-4;
  const SurrogateParameters parameters = sample_parameters();
  const double shear = value(respond(parameters, case_of_length(LoadCaseKind::shear, 4, {0.0}, {small * length})), "force_N", 0);
  const double moment = value(respond(parameters, case_of_length(LoadCaseKind::bending, 4, {0.0}, {small})), "moment_N_m", 0);
  const double torque = value(respond(parameters, case_of_length(LoadCaseKind::torsion, 4, {0.0}, {small})), "moment_N_m", 0);
  EXPECT_NEAR(shear, 12.0 * sample_bending() * small / (length * length), 1e-5 * shear);
  EXPECT_NEAR(moment, sample_bending() * small / length, 1e-5 * moment);
  EXPECT_NEAR(torque, sample_bending() * small / length, 1e-5 * torque);
}

TEST(LoadCaseResponse, OfPressIsTheGroundBehindTheHalfBeam) {
  const LoadCaseResponse response =
      respond(sample_parameters(), case_of_length(LoadCaseKind::press, 2, {0.0}, {0.0, 0.0005, 0.001}));
  const double compliance = 1.0 / 500.0 + 0.5 * sample_edge / sample_axial();
  for (std::size_t row = 0; row < 3; ++row)
    EXPECT_NEAR(value(response, "force_N", row), 2.0 * response.values[1][row] / compliance, 1e-8 * sample_axial());
}

TEST(LoadCaseResponse, OfSagIsThatOfPointMasses) {
  SurrogateParameters parameters = sample_parameters();
  parameters.density_kg_m3 = 10.0;
  const LoadCaseResponse response = respond(parameters, case_of_length(LoadCaseKind::sag, 2, {0.0}, {0.5, 1.0}));
  const double wall = (std::pow(0.01, 3) * 2.0 - 0.006 * 0.006 * 0.016) * 0.5;  // of each of the two voxels
  const double weight = 10.0 * wall * 9.80665;
  const double tip = 2.0 * sample_edge;
  double expected = 0.0;
  for (const double x : {0.5 * sample_edge, 1.5 * sample_edge})
    expected -= weight * x * x * (3.0 * tip - x) / (6.0 * sample_bending());
  EXPECT_NEAR(value(response, "tip_m", 1), expected, 1e-5 * std::abs(expected));
  EXPECT_NEAR(value(response, "tip_m", 0), 0.5 * expected, 1e-5 * std::abs(expected));
}

TEST(LoadCaseResponse, OfModesOfOneCellIsThatOfAMassOnAHalfBeam) {
  const SurrogateParameters parameters = sample_parameters();
  const LoadCaseResponse response = respond(parameters, case_of_length(LoadCaseKind::modes, 1, {0.0}));
  ASSERT_EQ(response.status, io::RunStatus::completed);
  const double mass = parameters.density_kg_m3 * (1e-6 - std::pow(0.006, 3));
  const double factor = (std::pow(0.01, 5) - std::pow(0.006, 5)) / ((1e-6 - std::pow(0.006, 3)) * 1e-4);
  const double inertia = mass * 1e-4 / 6.0 * factor;
  // Bending: 12 EI / h^3 and 4 EI / h coupled by 6 EI / h^2, at h = L / 2.
  const double h = 0.5 * sample_edge;
  const double a = 12.0 * sample_bending() / (h * h * h * mass);
  const double b = 4.0 * sample_bending() / (h * inertia);
  const double coupling = 6.0 * sample_bending() / (h * h * std::sqrt(mass * inertia));
  const double lowest = 0.5 * (a + b) - std::sqrt(0.25 * (a - b) * (a - b) + coupling * coupling);
  EXPECT_NEAR(value(response, "frequency_1_Hz", 0), std::sqrt(lowest) / (2.0 * std::numbers::pi), 1e-4);
  EXPECT_NEAR(value(response, "frequency_2_Hz", 0), value(response, "frequency_1_Hz", 0), 1e-4);
}

TEST(LoadCaseResponse, HasARowForEveryStateInOrder) {
  const LoadCase of = case_of_length(LoadCaseKind::stretch, 1, {0.0, 1000.0}, {0.0, 0.001, 0.002});
  const LoadCaseResponse response = respond(response_parameters(), of);
  EXPECT_EQ(response.columns, meshes::response_columns(LoadCaseKind::stretch));
  EXPECT_EQ(response.values[0], (std::vector<double>{0.0, 0.0, 0.0, 1000.0, 1000.0, 1000.0}));
  EXPECT_EQ(response.values[1], (std::vector<double>{0.0, 0.001, 0.002, 0.0, 0.001, 0.002}));
  const LoadCaseResponse one = respond(response_parameters(), of, {{1000.0, 0.001}});
  ASSERT_EQ(one.values[0].size(), 1U);
  EXPECT_NEAR(one.values[2][0], response.values[2][4], 1e-9 * sample_axial());
}

TEST(LoadCaseResponse, EndsWithAStatusWhereThereIsNoEquilibrium) {
  const LoadCaseResponse response =
      respond(response_parameters(), case_of_length(LoadCaseKind::inflation, 1, {1000.0, 1.2e5, 2000.0}));
  EXPECT_EQ(response.status, io::RunStatus::limit_point);
  EXPECT_EQ(response.values[0], (std::vector<double>{1000.0}));
  EXPECT_EQ(response.reason, "voxels with walls on all four sides (wall class 4) have no equilibrium at pressure_Pa = 120000");
}

TEST(LoadCaseResponse, IgnoresPolesOfWallsThatTheBodyDoesNotHave) {
  SurrogateParameters parameters = response_parameters();
  parameters.bulge[0].pressure_softening_per_Pa = 1e-2;  // a single cell has walls on four sides along every axis
  EXPECT_EQ(respond(parameters, case_of_length(LoadCaseKind::inflation, 1, {4000.0})).status, io::RunStatus::completed);
}

TEST(LoadCaseResponse, EndsWhereWallsMeet) {
  // A cell whose walls bulge only: they leave 10 mm - 2 * 2 mm - 2 * 10 mm * 1e-5/Pa p of air, none from -30 kPa on.
  SurrogateParameters parameters = sample_parameters();
  parameters.bulge.fill({.slope_per_Pa = 1e-5});
  LoadCase of = case_of_length(LoadCaseKind::inflation, 1, {-29.9e3, -30.1e3, -40e3});
  const LoadCaseResponse response = respond(parameters, of);
  EXPECT_EQ(response.status, io::RunStatus::wall_contact);
  EXPECT_EQ(response.values[0], (std::vector<double>{-29.9e3}));
  EXPECT_EQ(response.reason, "chamber walls across x meet at voxel 0, 0, 0");
  // Along a bar of three the chamber is 26 mm deep, so that the long walls meet first.
  of = case_of_length(LoadCaseKind::inflation, 3, {-30.1e3});
  EXPECT_EQ(respond(parameters, of).reason, "chamber walls across y meet at voxel 0, 0, 0");
  parameters.bulge[walls::limb] = parameters.bulge[walls::three] = {};  // sides of the bar: only its ends bulge, class 4 along x
  EXPECT_EQ(respond(parameters, of).status, io::RunStatus::completed);
}

TEST(LoadCaseResponse, EndsWhereTheWallBetweenTwoPhasesIsMet) {
  // Two cells of one phase end at half of the wall that they share with the next chamber, which does not bulge: between it and
  // their own wall are 2 * 10 mm - 2 mm - 1 mm of air, which the other takes up at 10 mm * 1e-4/Pa p, from -17 kPa on.
  SurrogateParameters parameters = sample_parameters();
  parameters.bulge[walls::closed] = {.slope_per_Pa = 1e-4};  // ends of the bar; its sides stand still
  LoadCase of = case_of_length(LoadCaseKind::inflation, 4, {-16.9e3, -17.1e3});
  of.digits = "1122";
  of.per_phase = true;
  const LoadCaseResponse response = respond(parameters, of);
  EXPECT_EQ(response.status, io::RunStatus::wall_contact);
  EXPECT_EQ(response.values[0], (std::vector<double>{-16.9e3}));
  EXPECT_EQ(response.reason, "chamber walls across x meet at voxel 0, 0, 0");
  // Modules have a wall of their own each: 16 mm of air.
  of = case_of_length(LoadCaseKind::inflation, 2, {-15.9e3, -16.1e3});
  of.level = 2;
  const LoadCaseResponse bonded = respond(parameters, of);
  EXPECT_EQ(bonded.status, io::RunStatus::wall_contact);
  EXPECT_EQ(bonded.values[0], (std::vector<double>{-15.9e3}));
}

TEST(LoadCaseResponse, OfAnUnsymmetricBodyDoesNotDependOnWhatHoldsIt) {
  // An L whose thick part is wide enough to warp.
  const meshes::Polycube ell = meshes::Polycube::from_digits(3, 2, 1, "111110");
  SurrogateParameters parameters = response_parameters();
  for (std::size_t c = 0; c < wall_class_count; ++c) parameters.extension[c].slope_per_Pa = 1e-5 * static_cast<double>(1 + c);
  parameters.lateral_coupling = 0.3;
  const StaticBody body = sample_body(ell, {}, parameters);
  std::vector<BodyShape::FreeSize> sizes;
  std::vector<double> lengths;
  for (const std::size_t held : {0UL, 2UL, 3UL}) {
    Equilibrium equilibrium(body, {.fixed_voxels = {held}});
    ASSERT_EQ(equilibrium.load(under_pressure(4000.0)), io::RunStatus::completed);
    sizes.push_back(BodyShape(equilibrium).free_size());
    lengths.push_back(BodyShape(equilibrium).extent(0));
  }
  // Beams in the small-angle state see rotations to first order only, so that the equilibria themselves differ by 1e-7 edges.
  for (const BodyShape::FreeSize& size : sizes) {
    for (std::size_t axis = 0; axis < 3; ++axis) EXPECT_NEAR(size.extents[axis], sizes[0].extents[axis], 1e-6 * sample_edge);
    EXPECT_NEAR(size.top_height, sizes[0].top_height, 1e-6 * sample_edge);
  }
  EXPECT_GT(std::abs(lengths[1] - lengths[0]), 1e-5 * sample_edge) << "the body turns about what holds it";
}

TEST(LoadCaseResponse, RefusesParametersOfOtherCells) {
  LoadCase other = case_of_length(LoadCaseKind::inflation, 1, {0.0});
  other.wall_thickness_m = 0.0015;
  EXPECT_THROW(static_cast<void>(respond(sample_parameters(), other)), std::invalid_argument);
}

/// Every kind on a body with holes, per phase and refined: finite numbers, and the symmetry of the body.
TEST(LoadCaseResponse, OfSymmetricBodiesIsSymmetric) {
  LoadCase of = case_of_length(LoadCaseKind::inflation, 1, {3000.0});
  of.cells = {3, 3, 3};
  of.digits = meshes::menger_sponge().digits();
  SurrogateParameters parameters = response_parameters();
  parameters.axial_Pa = {0.5e5, 0.6e5, 0.8e5, 0.9e5, 1e5};
  parameters.lateral_coupling = 0.3;
  for (std::size_t c = 0; c < wall_class_count; ++c) parameters.extension[c].slope_per_Pa = 1e-5 * static_cast<double>(1 + c);
  const LoadCaseResponse response = respond(parameters, of);
  ASSERT_EQ(response.status, io::RunStatus::completed);
  EXPECT_NEAR(value(response, "extent_x_m", 0), value(response, "extent_y_m", 0), 1e-6 * sample_edge);
  EXPECT_NEAR(value(response, "extent_x_m", 0), value(response, "extent_z_m", 0), 1e-6 * sample_edge);
  EXPECT_GT(value(response, "extent_x_m", 0), 0.0);
}

TEST(LoadCaseResponse, SaysHowFarFeetMoveOutwards) {
  // Two legs below the ends of a bar: the bar grows by its two beams and takes them along.
  const SurrogateParameters parameters = response_parameters();
  LoadCase of = case_of_length(LoadCaseKind::inflation, 3, {4000.0});
  of.cells = {3, 1, 2};
  of.digits = "101111";
  const LoadCaseResponse response = respond(parameters, of);
  ASSERT_EQ(response.status, io::RunStatus::completed) << response.reason;
  ASSERT_EQ(response.columns, meshes::response_columns(of));
  const double growth = sample_edge * parameters.extension[0].value(4000.0);
  for (const std::size_t foot : {std::size_t{6}, std::size_t{7}})
    EXPECT_NEAR(response.values[foot][0], growth, 1e-9 * sample_edge);
}

TEST(LoadCaseResponse, SplaysTheLegsOfTablesAsFiniteElementsDo) {
  // Numbers of the held-out load cases, near 5 kPa. Upright legs would move by 0.1 to 0.2 mm.
  struct Table {
    const char* digits;
    int layers;
    double pressure_Pa;
    double foot_m;
  };
  constexpr std::array tables{Table{"000101000111111111", 2, 5206.9, 5.266e-3},
                              Table{"000101000000101000111111111", 3, 5201.5, 10.086e-3},
                              Table{"100000001111111111", 2, 5285.9, 3.923e-3}};
  const SurrogateParameters parameters =
      read_surrogate(std::filesystem::path(MENGER_SOURCE_DIR) / "voxel/parameters/dragon_skin_10_1cm.toml");
  for (const Table& table : tables) {
    LoadCase of = case_of_length(LoadCaseKind::inflation, 1, {table.pressure_Pa});
    of.cells = {3, 3, table.layers};
    of.digits = table.digits;
    EXPECT_NEAR(value(respond(parameters, of), "foot_1_out_m", 0), table.foot_m, 0.2 * table.foot_m) << table.digits;
  }
}

TEST(LoadCaseResponse, OpensAnElbowByTheStrainOfItsBeams) {
  // No load acts on free arms, so both beams turn by their whole angle: the arm along x away from y, and the other way round.
  SurrogateParameters parameters = response_parameters();
  parameters.elbow_ratio = 3.0;
  for (const double pressure : {4000.0, -4000.0}) {
    LoadCase of = case_of_length(LoadCaseKind::inflation, 1, {pressure});
    of.cells = {2, 2, 1};
    of.digits = "1110";
    bool visited = false;
    const LoadCaseResponse response = visit_states(parameters, of, {}, [&](std::size_t, const Equilibrium& equilibrium) {
      visited = true;
      const double angle = 3.0 * parameters.extension[0].value(pressure);
      ASSERT_GT(std::abs(angle), 0.005);
      const auto turn_of = [&](std::size_t arm) {
        return rotation_vector(seen_from(equilibrium.pose(0).orientation, equilibrium.pose(arm).orientation));
      };
      EXPECT_NEAR(turn_of(1).z, -angle, 1e-9);
      EXPECT_NEAR(turn_of(2).z, angle, 1e-9);
      EXPECT_NEAR(turn_of(1).x, 0.0, 1e-9);
      EXPECT_NEAR(turn_of(1).y, 0.0, 1e-9);
    });
    ASSERT_EQ(response.status, io::RunStatus::completed) << response.reason;
    EXPECT_TRUE(visited);
  }
}

TEST(LoadCaseResponse, TiltsALegByTheSlopeOfItsPlate) {
  // No load acts on a free leg, so it stands on the plane through the corners of its opening: two at the rim, two at crowns.
  SurrogateParameters parameters = response_parameters();
  for (std::size_t c = 0; c < wall_class_count; ++c)
    parameters.bulge[c] = {.slope_per_Pa = (7.0 - static_cast<double>(c)) * 2e-6};
  parameters.neck_ratio = 1.3;
  constexpr double pressure = 3000.0;
  LoadCase of = case_of_length(LoadCaseKind::inflation, 3, {pressure});
  of.cells = {3, 3, 2};
  of.digits = "000101000111111111";
  constexpr std::size_t leg = 0;
  constexpr std::size_t above_leg = 5;
  bool visited = false;
  const LoadCaseResponse response = visit_states(parameters, of, {}, [&](std::size_t, const Equilibrium& equilibrium) {
    visited = true;
    const auto peak = [&](std::size_t c) { return parameters.bulge_peak_ratio[c] * parameters.bulge[c].value(pressure); };
    const double crown = parameters.neck_ratio * (peak(walls::none) + 2.0 * peak(walls::one) + peak(walls::corner)) / 4.0;
    ASSERT_GT(crown, 0.05);
    const Pose& plate = equilibrium.pose(above_leg);
    const Pose& limb = equilibrium.pose(leg);
    // The leg at the end with the least x leans outwards, to -x below: it is turned about +y.
    const Vector3<double> turn = rotation_vector(seen_from(plate.orientation, limb.orientation));
    EXPECT_NEAR(turn.y, crown, 1e-9);
    EXPECT_NEAR(turn.x, 0.0, 1e-9);
    const double length = sample_edge * (1.0 + parameters.extension[0].value(pressure) + 0.5 * crown);
    const Vector3<double> from = rotate_back(matrix(plate.orientation), limb.position - plate.position);
    EXPECT_NEAR(from.x, -length * std::sin(0.5 * crown), 1e-9 * sample_edge);
    EXPECT_NEAR(from.z, -length * std::cos(0.5 * crown), 1e-9 * sample_edge);
  });
  ASSERT_EQ(response.status, io::RunStatus::completed) << response.reason;
  EXPECT_TRUE(visited);
  EXPECT_GT(value(response, "foot_1_out_m", 0), 0.05 * sample_edge);
}

}  // namespace
}  // namespace menger::voxel
