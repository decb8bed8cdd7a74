#include "fem/inflation/inflation_problem.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>

#include "io/text/input_error.h"
#include "meshes/design/reference_shapes.h"
#include "meshes/files/vtu_mesh.h"
#include "meshes/hexahedra/boundary_labels.h"
#include "meshes/hexahedra/verification_shapes.h"
#include "tests/support/test_folder.h"

namespace menger::fem {
namespace {

/// A hollow cube of 20 mm, 2 mm walls, of a neo-Hookean body with the density of water.
InflationStudy cube_study() {
  InflationStudy study;
  study.file = "study.toml";
  DesignSource source;
  source.file = "cube.toml";
  source.design = {"cube", meshes::full_cube(1), 0.02};
  study.source = source;
  study.material.law = materials::NeoHookean{5e4};
  study.material.volume = materials::SimoTaylorVolume{2.5e6};
  study.material.density_kg_per_m3 = 1000.0;
  study.drives[""] = {.kind = DriveKind::pressure, .values = {0.0, 6000.0}};
  return study;
}

std::string refusal(const InflationStudy& study) {
  try {
    static_cast<void>(make_problem(study));
  } catch (const io::InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(InflationProblem, HoldsTheVerticalMiddleLineOfACubeInPlace) {
  const InflationProblem problem = make_problem(cube_study());
  const std::size_t ground = meshes::label_index(problem.mesh, "ground");
  ASSERT_EQ(problem.body.supports.size(), 1U);
  EXPECT_EQ(problem.body.supports[0].label, ground);
  EXPECT_EQ(problem.body.supports[0].held, (std::array{false, false, true}));
  ASSERT_EQ(problem.body.point_supports.size(), 2U);
  const auto& [first, second] = std::pair(problem.body.point_supports[0], problem.body.point_supports[1]);
  EXPECT_NEAR(norm(difference(first.position, {0.01, 0.01, 0.0})), 0.0, 1e-12);
  EXPECT_EQ(first.held, (std::array{true, true, false}));
  EXPECT_NEAR(second.position[1], 0.01, 1e-12) << "beside the first, so that it holds the turn only";
  EXPECT_NEAR(std::abs(second.position[0] - 0.01), 0.01, 1e-12);
  EXPECT_EQ(second.held, (std::array{false, true, false}));
}

TEST(InflationProblem, HoldsImagesOfOneAnotherWhereNoNodeLiesInTheMiddle) {
  InflationStudy study = cube_study();
  study.degree = 1;
  std::get<DesignSource>(study.source).options.wall_thickness_m = 0.004;  // five elements of 4 mm on a side
  const InflationProblem problem = make_problem(study);
  ASSERT_EQ(problem.body.point_supports.size(), 2U);
  const auto& [first, second] = std::pair(problem.body.point_supports[0], problem.body.point_supports[1]);
  EXPECT_NEAR(norm(difference(first.position, {0.008, 0.008, 0.0})), 0.0, 1e-12);
  EXPECT_NEAR(norm(difference(second.position, {0.012, 0.008, 0.0})), 0.0, 1e-12);
  EXPECT_EQ(second.held, (std::array{false, true, false}));
  study.refinements = 1;  // now there is a node
  EXPECT_NEAR(norm(difference(make_problem(study).body.point_supports[0].position, {0.01, 0.01, 0.0})), 0.0, 1e-12);
}

TEST(InflationProblem, CutsTheWallsAsTheFidelityOfThinWallsSays) {
  InflationStudy study = cube_study();
  EXPECT_FALSE(make_problem(study).body.thin_walls);
  study.elements.kind = ElementKind::thin_wall;
  for (const Fidelity fidelity : {Fidelity::draft, Fidelity::standard, Fidelity::fine}) {
    study.elements.fidelity = fidelity;
    const InflationProblem problem = make_problem(study);
    const std::size_t span = 2 + static_cast<std::size_t>(fidelity);
    ASSERT_TRUE(problem.body.thin_walls);
    const std::vector<ThinWallPlace>& places = problem.body.thin_walls->places;
    EXPECT_EQ(places.size(), problem.mesh.elements.size());
    const auto walls = std::count_if(places.begin(), places.end(),
                                     [](const ThinWallPlace& place) { return place.element == ThinWallElement::wall; });
    EXPECT_EQ(walls, static_cast<std::ptrdiff_t>(6 * span * span)) << "one layer on each side of the chamber";
    EXPECT_EQ(problem.body.thin_walls->constants.block_stiffness_ratio, constants_of_equilibria.block_stiffness_ratio);
  }
}

// Three cells of a square, one of them of the other phase: a partition and an outer wall lie in one plane between cells.
TEST(InflationProblem, TakesPhasesBesideOuterWallsOnThinWallsToo) {
  InflationStudy study = cube_study();
  auto& source = std::get<DesignSource>(study.source);
  source.design.body = meshes::Polycube::from_digits(2, 2, 1, "1210");
  source.options.chambers = meshes::ChamberLayout::per_phase;
  const double solid_m3 = make_problem(study).solid_volume_m3;
  study.elements.kind = ElementKind::thin_wall;
  EXPECT_NEAR(make_problem(study).solid_volume_m3, solid_m3, 1e-12 * solid_m3) << "both kinds have the same body";
}

/// A study of a cube of 1 cm as a mesh file, its side "x min" under another label and at another x.
/// @param file where the mesh is written
InflationStudy block_study(const std::filesystem::path& file, const std::string& label, double shift_m = 0.0) {
  meshes::HexahedralMesh mesh = meshes::box({0.01, 0.01, 0.01}, {1, 1, 1});
  mesh.label_names[0] = label;
  for (Point& point : mesh.points) point[0] += shift_m;
  InflationStudy study = cube_study();
  meshes::write_vtu_mesh(file, mesh);
  study.source = MeshSource{file};
  study.supports.kind = SupportKind::labels;
  return study;
}

TEST(InflationProblem, KnowsThreePlanesOfSymmetryThroughTheOrigin) {
  const tests::TestFolder folder;
  // a block without a chamber is refused in any case: here only where its symmetry is taken
  EXPECT_NE(refusal(block_study(folder / "x.vtu", "symmetry x")).find("no chamber"), std::string::npos);
  const std::string unknown = refusal(block_study(folder / "left.vtu", "symmetry left"));
  for (const char* part : {"study.toml", "\"symmetry left\"", "\"symmetry x\"", "\"symmetry y\"", "\"symmetry z\""})
    EXPECT_NE(unknown.find(part), std::string::npos) << unknown;
  const std::string shifted = refusal(block_study(folder / "shifted.vtu", "symmetry x", 0.25));
  for (const char* part : {"study.toml", "\"symmetry x\"", "0.25"}) EXPECT_NE(shifted.find(part), std::string::npos) << shifted;
  const std::string turned = refusal(block_study(folder / "turned.vtu", "symmetry y"));
  EXPECT_NE(turned.find("y = 0"), std::string::npos) << turned;
}

TEST(InflationProblem, HoldsTheSixRigidMotionsOfAFreeBodyAndNoMore) {
  InflationStudy study = cube_study();
  study.supports.kind = SupportKind::free;
  const InflationProblem problem = make_problem(study);
  EXPECT_TRUE(problem.body.supports.empty());
  ASSERT_EQ(problem.body.point_supports.size(), 3U);
  std::size_t held = 0;
  for (const PointSupport& support : problem.body.point_supports) {
    held += static_cast<std::size_t>(std::count(support.held.begin(), support.held.end(), true));
    EXPECT_NE(std::find(problem.mesh.points.begin(), problem.mesh.points.end(), support.position), problem.mesh.points.end());
  }
  EXPECT_EQ(held, 6U);
  EXPECT_NEAR(norm(difference(problem.high, {0.02, 0.02, 0.02})), 0.0, 1e-12);
  EXPECT_NEAR(norm(problem.low), 0.0, 1e-12);
}

TEST(InflationProblem, RefusesAFreeBodyWithAPlaneOfSymmetry) {
  const tests::TestFolder folder;
  InflationStudy study = block_study(folder / "free.vtu", "symmetry x");
  study.supports.kind = SupportKind::free;
  EXPECT_NE(refusal(study).find("symmetry"), std::string::npos) << refusal(study);
}

TEST(InflationProblem, RefusesToRestOnNothing) {
  const tests::TestFolder folder;
  InflationStudy study = block_study(folder / "resting.vtu", "ground");
  study.supports.kind = SupportKind::resting;
  study.gravity_m_per_s2 = 9.81;
  EXPECT_NE(refusal(study).find("no chamber"), std::string::npos) << "it stands on its left side";
  const auto& file = std::get<MeshSource>(study.source).file;
  meshes::HexahedralMesh mesh = meshes::read_vtu_mesh(file);
  for (meshes::BoundaryFace& face : mesh.faces) {
    if (mesh.label_names[face.label] == "ground") face.label = meshes::label_index(mesh, "x max");
  }
  meshes::write_vtu_mesh(file, mesh);
  EXPECT_NE(refusal(study).find("\"ground\""), std::string::npos) << refusal(study);
}

TEST(InflationProblem, PutsTheAutomaticPointsInTheMiddlesOfTopAndSide) {
  const InflationProblem problem = make_problem(cube_study());
  ASSERT_EQ(problem.points.size(), 2U);
  EXPECT_EQ(problem.points[0].name, "top centre");
  EXPECT_NEAR(norm(difference(problem.points[0].position, {0.01, 0.01, 0.02})), 0.0, 1e-12);
  EXPECT_EQ(problem.points[1].name, "side centre");
  EXPECT_NEAR(norm(difference(problem.points[1].position, {0.02, 0.01, 0.01})), 0.0, 1e-12);
  EXPECT_TRUE(problem.notes.empty());
}

TEST(InflationProblem, MovesAutomaticPointsOntoABodyWithoutMiddleAndSaysSo) {
  InflationStudy study = cube_study();
  auto& source = std::get<DesignSource>(study.source);
  source.design = {"l", meshes::Polycube::from_digits(3, 3, 1, "111100100"), 0.01};
  const InflationProblem problem = make_problem(study);
  ASSERT_EQ(problem.notes.size(), 3U) << "neither the middle of the top nor of the side is there, and walls are coarse";
  for (const NamedPoint& point : problem.points) {
    EXPECT_NE(std::find(problem.mesh.points.begin(), problem.mesh.points.end(), point.position), problem.mesh.points.end());
  }
}

TEST(InflationProblem, LetsTheGroundCarryTheWeightFromTheStart) {
  InflationStudy study = cube_study();
  study.supports.kind = SupportKind::resting;
  study.gravity_m_per_s2 = 9.81;
  const InflationProblem problem = make_problem(study);
  ASSERT_TRUE(problem.body.ground);
  const double weight_N = 1000.0 * 9.81 * (8e-6 - 4.096e-6);
  const double area_m2 = 0.02 * 0.02;
  EXPECT_NEAR(problem.body.ground->height_m * area_m2 * problem.body.ground->stiffness_Pa_per_m, weight_N, 1e-9 * weight_N);
  EXPECT_TRUE(problem.body.supports.empty());
  EXPECT_EQ(problem.body.gravity_m_per_s2, (Point{0.0, 0.0, -9.81}));
}

TEST(InflationProblem, GivesRegionsTheirOwnMaterial) {
  InflationStudy study = cube_study();
  std::get<DesignSource>(study.source).options.lid = meshes::LidPlace::top;
  study.region_materials["lid"] = study.material;
  study.region_materials["lid"].law = materials::NeoHookean{2e5};
  const InflationProblem problem = make_problem(study);
  const std::size_t lid = meshes::region_index(problem.mesh, "lid");
  const std::size_t wall = meshes::region_index(problem.mesh, "wall");
  EXPECT_EQ(materials::shear_modulus_at_rest_Pa(problem.body.regions[lid].law), 2e5);
  EXPECT_EQ(materials::shear_modulus_at_rest_Pa(problem.body.regions[wall].law), 5e4);
}

TEST(InflationProblem, RefusesWhatTheBodyDoesNotHave) {
  InflationStudy study = cube_study();
  study.region_materials["lid"] = study.material;
  EXPECT_NE(refusal(study).find("lid"), std::string::npos) << refusal(study);
  study = cube_study();
  study.supports.labels.push_back({"ceiling", {true, true, true}});
  EXPECT_NE(refusal(study).find("ceiling"), std::string::npos) << refusal(study);
  EXPECT_NE(refusal(study).find("study.toml"), std::string::npos) << refusal(study);
  study = cube_study();
  study.drives["plenum 7"] = study.drives[""];
  EXPECT_NE(refusal(study).find("plenum 7"), std::string::npos) << refusal(study);
  study = cube_study();
  std::get<DesignSource>(study.source).options.wall_thickness_m = 0.01;
  EXPECT_NE(refusal(study).find("wall_thickness_m"), std::string::npos) << refusal(study);
  EXPECT_NE(refusal(study).find("cube.toml"), std::string::npos) << refusal(study);
}

TEST(InflationProblem, PutsPlatesOnSidesAndLabels) {
  InflationStudy study = cube_study();
  StudyPlate tip{.name = "tip", .side = meshes::Side::x_max, .label = "", .slides = true, .drive = {}};
  StudyPlate base{.name = "base", .side = meshes::Side::x_min, .label = "", .slides = false, .drive = {}};
  study.plates = {tip, base};
  const InflationProblem problem = make_problem(study);
  ASSERT_EQ(problem.body.plates.size(), 2U);
  EXPECT_EQ(problem.plate_drives.size(), 2U);
  const Plate& plate = problem.body.plates[0];
  EXPECT_EQ(plate.held, (std::array{true, false, false}));
  ASSERT_TRUE(plate.faces.plane.has_value());
  EXPECT_EQ(plate.faces.plane->axis, 0U);
  EXPECT_NEAR(plate.faces.plane->position_m, 0.02, 1e-15);
  EXPECT_LT(norm(difference(plate.centre, {0.02, 0.01, 0.01})), 1e-12);
  EXPECT_EQ(problem.body.plates[1].held, (std::array{true, true, true}));
}

TEST(InflationProblem, RefusesPlatesThatMeetOrAreNowhere) {
  InflationStudy study = cube_study();
  StudyPlate tip{.name = "tip", .side = meshes::Side::x_max, .label = "", .slides = false, .drive = {}};
  StudyPlate top{.name = "top", .side = meshes::Side::z_max, .label = "", .slides = false, .drive = {}};
  study.plates = {tip, top};
  EXPECT_NE(refusal(study).find("study.toml: plate \"top\" meets another plate"), std::string::npos) << refusal(study);
  top.side.reset();
  top.label = "lid";
  study.plates = {top};
  EXPECT_NE(refusal(study).find("lid"), std::string::npos) << refusal(study);
}

TEST(InflationProblem, WantsADriveForEveryPlenum) {
  InflationStudy study = cube_study();
  study.drives = {{"plenum 1", study.drives[""]}};
  auto& source = std::get<DesignSource>(study.source);
  source.design = {"bar", meshes::Polycube::from_digits(2, 1, 1, "12"), 0.01};
  source.options.chambers = meshes::ChamberLayout::per_phase;
  EXPECT_NE(refusal(study).find("\"plenum 0\""), std::string::npos) << refusal(study);
}

}  // namespace
}  // namespace menger::fem
