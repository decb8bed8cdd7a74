#include "fem/inflation/coarse_walls.h"

#include <gtest/gtest.h>

#include <string>

#include "fem/inflation/inflation_problem.h"
#include "meshes/design/design_file.h"

namespace menger::fem {
namespace {

using meshes::ChamberLayout;
using meshes::Polycube;

TEST(CoarseWalls, CellsWithoutAPlateAreThoseOfBarsAndLegs) {
  EXPECT_EQ(cells_outside_plates(Polycube::from_digits(1, 1, 1, "1"), ChamberLayout::single), 1U);
  EXPECT_EQ(cells_outside_plates(Polycube::from_digits(3, 1, 1, "111"), ChamberLayout::single), 3U);
  EXPECT_EQ(cells_outside_plates(Polycube::from_digits(1, 2, 2, "1111"), ChamberLayout::single), 0U);
  EXPECT_EQ(cells_outside_plates(Polycube::from_digits(2, 2, 1, "1110"), ChamberLayout::single), 3U);
  const std::string designs = MENGER_SOURCE_DIR "/meshes/designs/";
  EXPECT_EQ(cells_outside_plates(meshes::read_design(designs + "plane.toml").body, ChamberLayout::single), 0U);
  EXPECT_EQ(cells_outside_plates(meshes::read_design(designs + "quadruped.toml").body, ChamberLayout::single), 4U) << "its legs";
}

TEST(CoarseWalls, ChambersOfPhasesDivideAPlate) {
  const Polycube checked = Polycube::from_digits(2, 2, 1, "1221");
  EXPECT_EQ(cells_outside_plates(checked, ChamberLayout::single), 0U);
  EXPECT_EQ(cells_outside_plates(checked, ChamberLayout::per_phase), 4U);
  EXPECT_EQ(cells_outside_plates(Polycube::from_digits(3, 2, 1, "112112"), ChamberLayout::per_phase), 2U);
}

InflationStudy study_of(const Polycube& body) {
  InflationStudy study;
  study.file = "study.toml";
  DesignSource source;
  source.design = {"body", body, 0.01};
  study.source = source;
  study.material.law = materials::NeoHookean{5e4};
  study.material.volume = materials::SimoTaylorVolume{2.5e6};
  study.drives[""] = {.kind = DriveKind::pressure, .values = {0.0, 6000.0}};
  return study;
}

TEST(CoarseWalls, OneElementThroughTheWallOfABarHasANoteWithItsErrorAndWhatMendsIt) {
  const InflationStudy bar = study_of(Polycube::from_digits(3, 1, 1, "111"));
  const InflationProblem problem = make_problem(bar);
  ASSERT_FALSE(problem.notes.empty());
  EXPECT_EQ(problem.notes.back(), note_on_coarse_walls(bar));
  for (const char* part : {"3 of 3 cells", "%", "design.elements_through_wall = 2", "elements.kind = \"thin_wall\""})
    EXPECT_NE(problem.notes.back().find(part), std::string::npos) << problem.notes.back();
  InflationStudy linear = bar;
  linear.degree = 1;
  EXPECT_NE(note_on_coarse_walls(bar).find("too large"), std::string::npos) << note_on_coarse_walls(bar);
  EXPECT_NE(note_on_coarse_walls(linear).find("too small"), std::string::npos) << note_on_coarse_walls(linear);
}

TEST(CoarseWalls, OtherWallsHaveNoNote) {
  const InflationStudy bar = study_of(Polycube::from_digits(3, 1, 1, "111"));
  EXPECT_EQ(note_on_coarse_walls(study_of(Polycube::from_digits(2, 2, 1, "1111"))), "");
  InflationStudy two = bar;
  std::get<DesignSource>(two.source).options.elements_through_wall = 2;
  EXPECT_EQ(note_on_coarse_walls(two), "");
  InflationStudy thinner = bar;
  std::get<DesignSource>(thinner.source).options.wall_thickness_m = 0.001;
  EXPECT_EQ(note_on_coarse_walls(thinner), "");
  InflationStudy split = bar;
  split.refinements = 1;
  EXPECT_EQ(note_on_coarse_walls(split), "");
  InflationStudy thin = bar;
  thin.elements.kind = ElementKind::thin_wall;
  EXPECT_EQ(note_on_coarse_walls(thin), "");
  InflationStudy mesh = bar;
  mesh.source = MeshSource{"body.vtu"};
  EXPECT_EQ(note_on_coarse_walls(mesh), "");
}

}  // namespace
}  // namespace menger::fem
