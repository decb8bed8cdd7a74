#include "fem/load_cases/load_case_run.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <set>
#include <utility>

#include "fem/inflation/inflation_run.h"
#include "fem/load_cases/load_case_body.h"
#include "fem/load_cases/load_case_set.h"
#include "fem/load_cases/pressure_range.h"
#include "io/text/content_hash.h"
#include "io/text/input_error.h"
#include "io/text/whole_file.h"
#include "meshes/design/reference_shapes.h"
#include "tests/support/test_folder.h"

namespace menger::fem {
namespace {

namespace fs = std::filesystem;
using meshes::LoadCaseKind;

StudyMaterial silicone() {
  StudyMaterial material;
  material.law = materials::NeoHookean{86677.0};
  material.volume = materials::SimoTaylorVolume{4.3e6};
  material.density_kg_per_m3 = 1070.0;
  material.silicone = "Dragon Skin 10";
  return material;
}

/// A row of cells of 10 mm with walls of 2 mm, in 26 linear elements for one cell.
CaseRequest row_of_cells(LoadCaseKind kind, int count, std::vector<double> pressures_Pa, std::vector<double> imposed = {}) {
  CaseRequest request;
  request.load_case.name = "case";
  request.load_case.kind = kind;
  request.load_case.cells = {count, 1, 1};
  request.load_case.digits = std::string(static_cast<std::size_t>(count), '1');
  request.load_case.cell_edge_m = 0.01;
  request.load_case.wall_thickness_m = 0.002;
  request.load_case.pressures_Pa = std::move(pressures_Pa);
  request.load_case.imposed = std::move(imposed);
  request.elements = {.degree = 1, .through_wall = 1, .largest_element_m = 0.006, .growth = 4.0};
  return request;
}

/// The same on thin walls.
CaseRequest on_thin_walls(CaseRequest request, Fidelity fidelity = Fidelity::draft) {
  request.elements = {.choice = {.kind = ElementKind::thin_wall, .fidelity = fidelity}};
  return request;
}

CaseResponse completed(const CaseRequest& request) {
  CaseResponse response = run_load_case(request, silicone());
  EXPECT_EQ(response.status, io::RunStatus::completed) << response.reason;
  const std::size_t columns = meshes::response_columns(request.load_case).size();
  const std::size_t inner = std::max<std::size_t>(request.load_case.imposed.size(), 1);
  EXPECT_EQ(response.rows.size(), response.pressures_Pa.size() * inner);
  EXPECT_TRUE(std::is_sorted(response.rows.begin(), response.rows.end()));
  for (const std::vector<double>& row : response.rows) EXPECT_EQ(row.size(), columns);
  return response;
}

TEST(LoadCaseRun, InflationFindsItsRangeAndKeepsTheSymmetryOfACube) {
  CaseRequest request = row_of_cells(LoadCaseKind::inflation, 1, {});
  request.state_count = 6;
  const CaseResponse response = completed(request);
  ASSERT_EQ(response.rows.size(), 6U);
  ASSERT_TRUE(response.limit_pressure_Pa.has_value());
  EXPECT_NEAR(response.rows.back()[0], 0.8 * *response.limit_pressure_Pa, 1e-9 * *response.limit_pressure_Pa);
  EXPECT_LT(response.rows.front()[0], 0.0);
  EXPECT_EQ(response.rows[2][0], 0.0);
  for (std::size_t column = 1; column < 6; ++column) EXPECT_EQ(response.rows[2][column], 0.0);
  for (const std::vector<double>& row : response.rows) {
    EXPECT_NEAR(row[3], row[2], 1e-9) << "extents in x and y";
    EXPECT_NEAR(row[4], row[2], 1e-9) << "extents in x and z";
  }
  for (std::size_t n = 1; n < response.rows.size(); ++n) {
    EXPECT_GT(response.rows[n][1], response.rows[n - 1][1]) << "volume grows with pressure";
    EXPECT_GT(response.rows[n][5], response.rows[n - 1][5]) << "and the top rises";
  }
}

/// An L of five cells, as digits say how it lies.
CaseRequest l_of_cells(const std::string& digits) {
  CaseRequest request = row_of_cells(LoadCaseKind::inflation, 1, {2000.0});
  request.load_case.cells = {3, 3, 1};
  request.load_case.digits = digits;
  return request;
}

// Turned by half a turn about z the body is held at three other points of it. Equilibria agree to the force tolerance, 1e-6 of
// the change; without taking out the rotation the extents of the two differ by a factor of two.
TEST(LoadCaseRun, ExtentsOfAnUnsymmetricBodyDoNotDependOnWhereItIsHeld) {
  const CaseResponse body = completed(l_of_cells("111100100"));
  const CaseResponse turned = completed(l_of_cells("001001111"));
  for (std::size_t column = 1; column < 5; ++column)
    EXPECT_NEAR(turned.rows[0][column] / body.rows[0][column], 1.0, 1e-5) << column;
  // an L is its own mirror image in the plane x = y
  EXPECT_NEAR(body.rows[0][3] / body.rows[0][2], 1.0, 1e-5);
}

TEST(LoadCaseRun, FeetOfATableMoveOutwardsAlike) {
  CaseRequest request = row_of_cells(LoadCaseKind::inflation, 1, {2000.0});
  request.load_case.cells = {3, 1, 2};
  request.load_case.digits = "101111";
  const CaseResponse table = completed(request);
  ASSERT_EQ(table.rows[0].size(), 8U);
  EXPECT_GT(table.rows[0][6], 1e-5);
  EXPECT_NEAR(table.rows[0][7] / table.rows[0][6], 1.0, 1e-5) << "its mirror image";
  const CaseResponse on_thin = completed(on_thin_walls(request));
  EXPECT_NEAR(on_thin.rows[0][6] / table.rows[0][6], 1.0, 0.5) << "other elements of the same body";
}

/// Expects that `menger inflate` gives the numbers of a load case. Both follow a path of their own to the same equilibrium, to
/// the force tolerance.
void expect_as_inflate(const CaseRequest& request, InflationStudy study) {
  const CaseResponse response = completed(request);
  study.file = "study.toml";
  DesignSource source;
  source.design = {"cell", meshes::full_cube(1), 0.01};
  source.options.wall_thickness_m = 0.002;
  source.options.largest_element_m = 0.006;
  source.options.growth = 4.0;
  study.source = source;
  study.material = silicone();
  study.supports.kind = SupportKind::free;
  study.drives[""] = {.kind = DriveKind::pressure, .values = {0.0, 4000.0}};
  study.output.fields = study.output.pictures = false;
  const tests::TestFolder folder;
  const InflationResult result = run_inflation(study, folder / "new");
  ASSERT_EQ(result.path.status, io::RunStatus::completed) << result.path.reason;
  const double volume_change =
      result.path.points.back().plenum_volumes_m3[0] / result.path.points.front().plenum_volumes_m3[0] - 1.0;
  EXPECT_NEAR(volume_change / response.rows[0][1], 1.0, 1e-6);
  ASSERT_TRUE(result.extent_changes_m.back().has_value());
  for (std::size_t axis = 0; axis < 3; ++axis)
    EXPECT_NEAR((*result.extent_changes_m.back())[axis] / response.rows[0][2 + axis], 1.0, 1e-6);
}

TEST(LoadCaseRun, AFreeStudyOfInflateGivesTheVolumeAndExtentsOfALoadCase) {
  InflationStudy study;
  study.degree = 1;
  expect_as_inflate(row_of_cells(LoadCaseKind::inflation, 1, {4000.0}), study);
}

TEST(LoadCaseRun, AFreeStudyOfInflateGivesTheSameOnThinWalls) {
  InflationStudy study;
  study.elements = {.kind = ElementKind::thin_wall, .fidelity = Fidelity::standard};
  expect_as_inflate(on_thin_walls(row_of_cells(LoadCaseKind::inflation, 1, {4000.0}), Fidelity::standard), study);
}

TEST(LoadCaseRun, BlockedForceIsThatOfAStretchByNothing) {
  const CaseResponse blocked = completed(row_of_cells(LoadCaseKind::blocked, 2, {-1000.0, 4000.0}));
  const CaseResponse stretch = completed(row_of_cells(LoadCaseKind::stretch, 2, {-1000.0, 4000.0}, {0.0}));
  for (std::size_t n = 0; n < 2; ++n) EXPECT_EQ(blocked.rows[n][1], stretch.rows[n][2]);
  EXPECT_LT(blocked.rows[1][1], 0.0) << "the body pushes out, the plate back";
  EXPECT_GT(blocked.rows[0][1], 0.0);
}

// A bar is its own image in y and z: a motion and its opposite are computed alike. Equilibria agree to the force tolerance.
TEST(LoadCaseRun, OppositeMotionsAreAnsweredAlike) {
  const CaseResponse shear = completed(row_of_cells(LoadCaseKind::shear, 2, {2000.0}, {-0.001, 0.001}));
  EXPECT_NEAR(shear.rows[0][2], -shear.rows[1][2], 1e-5 * shear.rows[1][2]);
  EXPECT_GT(shear.rows[1][2], 0.0);
  for (const LoadCaseKind kind : {LoadCaseKind::bending, LoadCaseKind::torsion}) {
    const CaseResponse response = completed(row_of_cells(kind, 2, {2000.0}, {-0.3, 0.3}));
    EXPECT_NEAR(response.rows[0][2], -response.rows[1][2], 1e-5 * response.rows[1][2]);
    EXPECT_GT(response.rows[1][2], 0.0);
  }
}

TEST(LoadCaseRun, StretchedBodiesPullBackAndContract) {
  const std::vector<double> imposed{0.0, 0.0005, 0.001};
  const CaseResponse response = completed(row_of_cells(LoadCaseKind::stretch, 1, {0.0}, imposed));
  EXPECT_NEAR(response.rows[0][2], 0.0, 1e-9);
  EXPECT_GT(response.rows[2][2], response.rows[1][2]);
  EXPECT_LT(response.rows[2][4], 0.0) << "lateral contraction";
  EXPECT_NEAR(response.rows[2][4], response.rows[2][5], 1e-9);
}

TEST(LoadCaseRun, PressMeetsTheGroundAtOnce) {
  const CaseResponse response = completed(row_of_cells(LoadCaseKind::press, 1, {0.0, 3000.0}, {0.0, 0.0003, 0.0006}));
  EXPECT_EQ(response.rows[0][2], 0.0);
  EXPECT_GT(response.rows[1][2], 0.0);
  EXPECT_GT(response.rows[2][2], response.rows[1][2]);
  EXPECT_GT(response.rows[3][2], 0.0) << "the bulging wall pushes on the ground";
  // under compression by s the ground takes about what a bonded stretch by -s takes, for the foot may slide and lift at its rim
  const CaseResponse stretch = completed(row_of_cells(LoadCaseKind::stretch, 1, {0.0}, {-0.0006}));
  EXPECT_LT(response.rows[2][2], -stretch.rows[0][2]);
  EXPECT_GT(response.rows[2][2], -0.5 * stretch.rows[0][2]);
}

TEST(LoadCaseRun, SagIsProportionalToSmallGravity) {
  const CaseResponse response = completed(row_of_cells(LoadCaseKind::sag, 3, {0.0}, {0.1, 0.2}));
  EXPECT_LT(response.rows[0][2], 0.0);
  EXPECT_NEAR(response.rows[1][2] / response.rows[0][2], 2.0, 1e-4);
}

TEST(LoadCaseRun, ModesOfASquareBarComeInPairs) {
  const CaseResponse response = completed(row_of_cells(LoadCaseKind::modes, 3, {0.0}));
  EXPECT_GT(response.rows[0][1], 0.0);
  EXPECT_NEAR(response.rows[0][2] / response.rows[0][1], 1.0, 1e-6);
  EXPECT_GT(response.rows[0][3], 1.5 * response.rows[0][1]);
}

TEST(LoadCaseRun, ModulesOfAPairShareTheirPressure) {
  CaseRequest request = row_of_cells(LoadCaseKind::inflation, 2, {2000.0});
  request.load_case.level = 2;
  const CaseResponse pair = completed(request);
  const CaseResponse single = completed(row_of_cells(LoadCaseKind::inflation, 2, {2000.0}));
  // the joint hinders each module at one end: somewhat less than a free module, far from nothing
  EXPECT_LT(pair.rows[0][1], single.rows[0][1]);
  EXPECT_GT(pair.rows[0][1], 0.8 * single.rows[0][1]);
}

TEST(LoadCaseRun, ShowsEveryStateWithItsPlaceAmongThoseAskedFor) {
  const std::vector<double> pressures_Pa{-500.0, 0.0, 2000.0};
  const std::vector<double> imposed_m{-0.0005, 0.0, 0.001};
  const CaseRequest request = row_of_cells(LoadCaseKind::stretch, 1, pressures_Pa, imposed_m);
  const auto far_end_x = [](const Space& space) {
    std::size_t node = 0;
    for (std::size_t n = 0; n < space.positions.size(); ++n)
      if (space.positions[n][0] > space.positions[node][0]) node = n;
    return 3 * node;
  };
  std::vector<int> seen(9, 0);
  CaseOptions options;
  options.observer = [&](std::size_t place, Equilibrium& equilibrium, const PathPoint& point, const BodyState& state) {
    ASSERT_LT(place, seen.size());
    ++seen[place];
    EXPECT_EQ(point.pressures_Pa.front(), pressures_Pa[place / 3]);
    // nodes on the plate move with it, to rounding
    EXPECT_NEAR(state.displacements_m[far_end_x(equilibrium.space())], imposed_m[place % 3], 1e-15);
  };
  ASSERT_EQ(run_load_case(request, silicone(), options).rows.size(), 9U);
  EXPECT_EQ(seen, std::vector<int>(9, 1));
}

TEST(LoadCaseRun, KeepsWhatWasReachedBeforeAPathEnds) {
  const CaseResponse response =
      run_load_case(row_of_cells(LoadCaseKind::stretch, 1, {0.0}, {-0.0099, -0.0005, 0.0005}), silicone());
  EXPECT_NE(response.status, io::RunStatus::completed);
  EXPECT_NE(response.reason.find("displacement_m = -"), std::string::npos) << response.reason;
  ASSERT_EQ(response.rows.size(), 2U);
  EXPECT_EQ(response.rows[0][1], -0.0005);
}

// Answers of the coarsest thin walls to every kind of load are near to those of one quadratic element through the wall: within
// 15 % each, of which `verification_fem_thin_walls` says more.
TEST(LoadCaseRun, ThinWallsAnswerEveryKindOfLoad) {
  struct Load {
    LoadCaseKind kind;
    std::vector<double> imposed;
  };
  const std::vector<Load> loads{{LoadCaseKind::inflation, {}},   {LoadCaseKind::blocked, {}},    {LoadCaseKind::stretch, {0.001}},
                                {LoadCaseKind::shear, {0.001}},  {LoadCaseKind::bending, {0.2}}, {LoadCaseKind::torsion, {0.2}},
                                {LoadCaseKind::press, {0.0003}}, {LoadCaseKind::sag, {1.0}},     {LoadCaseKind::modes, {}}};
  for (const Load& load : loads) {
    CaseRequest request = row_of_cells(load.kind, 2, {2000.0}, load.imposed);
    request.elements = {.largest_element_m = 0.003, .growth = 4.0};
    const CaseResponse solid = completed(request);
    const CaseResponse thin = completed(on_thin_walls(request));
    const std::size_t first = meshes::abscissa_count(load.kind);
    EXPECT_NEAR(thin.rows[0][first] / solid.rows[0][first], 1.0, 0.15) << meshes::to_string(load.kind);
  }
}

// Phases have chambers of their own, which share one pressure: walls between them have it on both sides.
TEST(LoadCaseRun, ThinWallsBetweenChambersOfPhasesAreNotBulged) {
  CaseRequest request = on_thin_walls(row_of_cells(LoadCaseKind::inflation, 2, {3000.0}));
  request.load_case.per_phase = true;
  request.load_case.digits = "12";
  const CaseResponse two = completed(request);
  const CaseResponse one = completed(on_thin_walls(row_of_cells(LoadCaseKind::inflation, 2, {3000.0})));
  EXPECT_GT(two.rows[0][1], 0.5 * one.rows[0][1]);
  EXPECT_LT(two.rows[0][1], one.rows[0][1]) << "the wall in the middle holds the others";
  EXPECT_NEAR(two.rows[0][3], two.rows[0][4], 1e-6 * two.rows[0][3]) << "extents in y and z";
}

TEST(LoadCaseRun, TakesPhasesBesideOuterWallsOnThinWalls) {
  CaseRequest request = on_thin_walls(row_of_cells(LoadCaseKind::inflation, 2, {1000.0}));
  request.load_case.cells = {2, 2, 1};
  request.load_case.digits = "1210";
  request.load_case.per_phase = true;
  EXPECT_NO_THROW(require_meshable(request.load_case, request.elements));
}

TEST(PressureRange, SidesWithoutRangeGiveNoPressureTwice) {
  EXPECT_EQ(pressures_between(-600.0, 3000.0, 6), (std::vector<double>{-600.0, -300.0, 0.0, 1000.0, 2000.0, 3000.0}));
  EXPECT_EQ(pressures_between(0.0, 3000.0, 6), (std::vector<double>{0.0, 1000.0, 2000.0, 3000.0}));
  EXPECT_EQ(pressures_between(-600.0, 0.0, 6), (std::vector<double>{-600.0, -300.0, 0.0}));
  EXPECT_EQ(pressures_between(0.0, 0.0, 6), std::vector<double>{0.0});
  EXPECT_EQ(pressures_between(-600.0, 3000.0, 1), std::vector<double>{0.0});
  EXPECT_EQ(pressures_at({-1.0, -0.5, 0.0, 1.0}, -600.0, 3000.0), (std::vector<double>{-600.0, -300.0, 0.0, 3000.0}));
  EXPECT_EQ(pressures_at({-1.0, -0.5, 0.0, 1.0}, 0.0, 3000.0), (std::vector<double>{0.0, 3000.0}));
  EXPECT_EQ(pressures_at({-1.0, 0.5, 1.0}, -600.0, 0.0), (std::vector<double>{-600.0, 0.0}));
}

class LoadCaseSet : public testing::Test {
 protected:
  LoadCaseSet() {
    study_.file = "set.toml";
    study_.material = silicone();
    study_.cases = {row_of_cells(LoadCaseKind::stretch, 1, {0.0}, {0.0005})};
  }

  [[nodiscard]] CaseOutcome run() const { return run_load_case_set(study_, folder_, {.pictures = false}).front(); }

  LoadCaseStudy study_;
  const tests::TestFolder scratch_;
  const fs::path folder_ = scratch_ / "new";  ///< not there before a test writes
};

TEST_F(LoadCaseSet, AnswersAnUnchangedCaseFromTheCache) {
  EXPECT_FALSE(run().from_cache);
  const std::string table = io::read_whole(folder_ / "case.csv");
  const std::string provenance = io::read_whole(folder_ / "case.toml");
  EXPECT_TRUE(run().from_cache);
  EXPECT_EQ(io::read_whole(folder_ / "case.csv"), table);
  EXPECT_EQ(io::read_whole(folder_ / "case.toml"), provenance);
  study_.cases.front().load_case.name = "renamed";
  study_.relative_uncertainty = 0.1;
  EXPECT_TRUE(run().from_cache);
  const meshes::ResponseCurve curve = meshes::read_response_curve(folder_ / "renamed.toml");
  EXPECT_EQ(curve.provenance.load_case, study_.cases.front().load_case);
  EXPECT_EQ(curve.provenance.relative_uncertainty, 0.1);
}

TEST_F(LoadCaseSet, UsesNoCurveOfOtherElements) {
  std::set<std::string> tables;
  const auto compute = [&](const LoadCaseElements& elements) {
    study_.cases.front().elements = elements;
    EXPECT_FALSE(run().from_cache);
    EXPECT_TRUE(run().from_cache);
    tables.insert(io::read_whole(folder_ / "case.csv"));
    return meshes::read_response_curve(folder_ / "case.toml").provenance.model;
  };
  EXPECT_NE(compute(study_.cases.front().elements).find("Q1/P0"), std::string::npos);
  for (const auto& [fidelity, word] : {std::pair{Fidelity::draft, "draft"}, {Fidelity::standard, "standard"}}) {
    const std::string model = compute({.choice = {.kind = ElementKind::thin_wall, .fidelity = fidelity}});
    EXPECT_NE(model.find(std::string("thin walls, ") + word), std::string::npos) << model;
    const std::string manifest = io::read_whole(folder_ / "manifest.json");
    EXPECT_NE(manifest.find("thin_wall"), std::string::npos);
    EXPECT_NE(manifest.find(word), std::string::npos);
  }
  EXPECT_EQ(tables.size(), 3U);
}

TEST_F(LoadCaseSet, ComputesAgainWhatChangedOrWasDamaged) {
  (void)run();
  study_.material.law = materials::NeoHookean{80e3};
  EXPECT_FALSE(run().from_cache);
  for (const auto& entry : fs::directory_iterator(folder_ / "cache"))
    if (entry.path().extension() == ".csv") io::write_whole(entry.path(), "pressure_Pa\n0\n");
  EXPECT_FALSE(run().from_cache);
  EXPECT_TRUE(run().from_cache);
}

TEST_F(LoadCaseSet, FindsFractionsOfTheRangeOnceForABody) {
  study_.cases = {row_of_cells(LoadCaseKind::inflation, 1, {}), row_of_cells(LoadCaseKind::blocked, 1, {})};
  study_.cases[1].load_case.name = "blocked";
  study_.cases[1].pressure_fractions = {-0.5, 1.0};
  const auto outcomes = run_load_case_set(study_, folder_, {.pictures = false});
  ASSERT_EQ(outcomes.size(), 2U);
  const meshes::ResponseCurve free = meshes::read_response_curve(folder_ / "case.toml");
  const meshes::ResponseCurve blocked = meshes::read_response_curve(folder_ / "blocked.toml");
  ASSERT_TRUE(free.provenance.limit_pressure_Pa && free.provenance.contact_pressure_Pa);
  EXPECT_DOUBLE_EQ(blocked.values[0][0], 0.5 * *free.provenance.contact_pressure_Pa);
  EXPECT_DOUBLE_EQ(blocked.values[0][1], 0.8 * *free.provenance.limit_pressure_Pa);
}

TEST_F(LoadCaseSet, SaysThatTheInflationOfItsRangeEndedEarly) {
  study_.cases = {row_of_cells(LoadCaseKind::inflation, 1, {})};
  ASSERT_EQ(run().status, io::RunStatus::completed);
  for (const auto& entry : fs::directory_iterator(folder_ / "cache")) {
    if (entry.path().extension() != ".toml") continue;
    std::string text = io::read_whole(entry.path());
    const std::string completed = "status = \"completed\"";
    ASSERT_NE(text.find(completed), std::string::npos);
    io::write_whole(entry.path(), text.replace(text.find(completed), completed.size(), "status = \"not_converged\""));
  }
  study_.cases = {row_of_cells(LoadCaseKind::blocked, 1, {})};
  study_.cases[0].pressure_fractions = {-0.5, 1.0};
  for (const bool from_cache : {false, true}) {
    const CaseOutcome outcome = run();
    EXPECT_EQ(outcome.from_cache, from_cache);
    EXPECT_EQ(outcome.status, io::RunStatus::not_converged);
    EXPECT_NE(outcome.reason.find("the inflation that gives its pressures ended early (not_converged)"), std::string::npos)
        << outcome.reason;
    EXPECT_EQ(outcome.states, 2U);
    const meshes::CurveProvenance written = meshes::read_response_curve(folder_ / "case.toml").provenance;
    EXPECT_EQ(written.status, outcome.status);
    EXPECT_EQ(written.reason, outcome.reason);
  }
}

TEST_F(LoadCaseSet, RemovesFieldsThatBelongToAnotherCurve) {
  const fs::path fields = folder_ / "fields/case";
  const auto run_with_fields = [&] { return run_load_case_set(study_, folder_, {.pictures = false, .fields = true}).front(); };
  study_.cases = {row_of_cells(LoadCaseKind::stretch, 1, {0.0, 1000.0}, {-0.0099, 0.0005})};
  EXPECT_EQ(run_with_fields().states, 2U) << "a cell is not pressed flat: its first imposed value is not reached";
  EXPECT_FALSE(fs::exists(fields / "fields/step_0000.vtu"));
  EXPECT_TRUE(fs::exists(fields / "fields/step_0001.vtu"));
  EXPECT_TRUE(fs::exists(fields / "fields/step_0003.vtu"));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_ / "cache"), fs::directory_iterator()), 2)
      << "a table and its provenance";
  study_.cases = {row_of_cells(LoadCaseKind::stretch, 1, {0.0}, {0.0005})};
  EXPECT_FALSE(run_with_fields().from_cache);
  EXPECT_TRUE(fs::exists(fields / "fields/step_0000.vtu"));
  EXPECT_FALSE(fs::exists(fields / "fields/step_0003.vtu")) << "of the case as it was before";
  EXPECT_TRUE(run().from_cache);
  EXPECT_TRUE(fs::exists(fields / "fields.pvd")) << "they belong to the curve that is still there";
  io::write_whole(fields / "notes.txt", "not of menger");
  study_.material.law = materials::NeoHookean{80e3};
  EXPECT_FALSE(run().from_cache);
  EXPECT_FALSE(fs::exists(fields / "fields.pvd"));
  EXPECT_FALSE(fs::exists(fields / "fields"));
  EXPECT_TRUE(fs::exists(fields / "notes.txt"));
}

TEST_F(LoadCaseSet, KeepsNothingOfACaseThatTheUserStops) {
  study_.cases = {row_of_cells(LoadCaseKind::stretch, 1, {0.0, 1000.0}, {0.0, 0.0005})};
  std::atomic<bool> stop = false;
  SetOptions options{.stop = &stop, .pictures = false, .fields = true};
  options.progress = [&](std::size_t, double, const std::string&) { stop = true; };  // after the first state
  const CaseOutcome outcome = run_load_case_set(study_, folder_, options).front();
  EXPECT_EQ(outcome.status, io::RunStatus::stopped);
  EXPECT_EQ(outcome.states, 0U);
  EXPECT_TRUE(fs::is_empty(folder_ / "cache"));
  EXPECT_FALSE(fs::exists(folder_ / "fields"));
  EXPECT_FALSE(run().from_cache);
}

}  // namespace
}  // namespace menger::fem
