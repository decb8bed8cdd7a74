#include "voxel/calibration/calibration_parameters.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/unit/voxel/calibration/calibration_samples.h"
#include "voxel/calibration/calibration_start.h"

namespace menger::voxel {
namespace {

TEST(CalibrationParameters, UndeterminedClassTakesTheNearest) {
  const CalibrationBounds bounds = default_bounds(samples::truth(), -1e4, 1e4);
  const auto parameters =
      fitted_parameters({CalibrationDetail::stiffness_classes}, {{walls::corner, walls::three}, {walls::one}, {walls::three}},
                        bounds, samples::truth());
  EXPECT_EQ(parameters[0].name, "axial_2a_Pa");
  EXPECT_EQ(parameters[0].classes, (std::vector<std::size_t>{walls::corner, walls::none, walls::one, walls::bend, walls::limb}));
  EXPECT_EQ(parameters[1].name, "axial_3_Pa");
  EXPECT_EQ(parameters[1].classes, (std::vector<std::size_t>{walls::three, walls::closed}));
}

/// Parameters that every set of details can say, but for sections: all wall classes alike, nothing zero.
SurrogateParameters alike() {
  SurrogateParameters p = samples::truth();
  p.axial_Pa.fill(1e5);
  p.bending_Pa.fill(1e5);
  p.torsion_Pa.fill(1e5);
  p.shear_compliance_per_Pa.fill(5e-5);
  p.extension.fill(p.extension[closed_wall_class]);
  p.bulge.fill(p.bulge[closed_wall_class]);
  for (PressureLaw& law : p.bulge) {
    law.fading_share = 0.3;
    law.fading_per_Pa = 2e-4;
  }
  p.bulge_peak_ratio.fill(2.0);
  p.lateral_coupling = 0.1;
  return p;
}

TEST(CalibrationParameters, EachDetailHoldsTheOneBefore) {
  // what a detail can say, the next can: setting the values read from parameters of one detail gives the same parameters
  const SurrogateParameters before = alike();
  const CalibrationBounds bounds = default_bounds(before, -1e4, 1e4);
  const DeterminedClasses classes{{walls::corner, walls::closed}, {walls::corner, walls::closed}, {walls::corner, walls::closed}};
  DetailSet details;
  for (const auto& [word, detail] : detail_words()) {
    if (detail == CalibrationDetail::sections) continue;  // says other things, not more
    details.insert(detail);
    SurrogateParameters after = before;
    for (const FittedParameter& parameter : fitted_parameters(details, classes, bounds, samples::truth())) {
      const double value = value_in(before, parameter);
      EXPECT_NEAR(parameter.value_of(parameter.unknown_of(value)), value, 1e-12 * std::abs(value)) << parameter.name;
      set_value(after, parameter, value);
    }
    EXPECT_EQ(after, before) << word;
  }
}

TEST(CalibrationParameters, SectionsPutStiffnessesInTheProportionsOfTheWalls) {
  // Of a section of edge 1 with walls of 0.2 the air is 1, 0.8, 0.8^2, 0.8^2 - 0.2^2, 0.6, 0.6 * 0.8 and 0.6^2; without walls the
  // rough parameters have a fiftieth of the solid one's stiffness. The pressure on the air stretches the walls, of which no
  // section has fewer than one.
  const ByWallClass<double> wall{0.02, 0.2, 0.36, 0.4, 0.4, 0.52, 0.64};
  const SurrogateParameters rough = rough_parameters(samples::provenance(), 1);
  const CalibrationBounds bounds = default_bounds(rough, -1e4, 1e4);
  for (const bool has_stiffness : {false, true}) {
    DetailSet details{CalibrationDetail::uniform, CalibrationDetail::sections};
    if (has_stiffness) details.insert(CalibrationDetail::stiffness);
    const std::vector<double> found = has_stiffness ? std::vector{64e3, 128e3, 32e3, 1e-6} : std::vector{64e3, 1e-6};
    const auto parameters = fitted_parameters(details, {}, bounds, rough);
    SurrogateParameters p = rough;
    for (std::size_t n = 0; n < found.size(); ++n) {
      set_value(p, parameters[n], found[n]);
      EXPECT_NEAR(value_in(p, parameters[n]), found[n], 1e-12 * found[n]) << parameters[n].name;
    }
    for (std::size_t c = 0; c < wall_class_count; ++c) {
      EXPECT_NEAR(p.axial_Pa[c], 100e3 * wall[c], 1e-6) << c;
      EXPECT_NEAR(p.bending_Pa[c], (has_stiffness ? 200e3 : 100e3) * wall[c], 1e-6) << c;
      EXPECT_NEAR(p.torsion_Pa[c], (has_stiffness ? 50e3 : 100e3) * wall[c], 1e-6) << c;
      const double stretch = (1.0 - wall[c]) / std::max(wall[c], 0.2);
      EXPECT_NEAR(p.extension[c].slope_per_Pa, 1e-6 * stretch / (0.36 / 0.64), 1e-17) << c;
    }
  }
}

TEST(CalibrationParameters, ClassesOfTheirOwnTakeThePlaceOfSections) {
  const SurrogateParameters rough = rough_parameters(samples::provenance(), 1);
  DetailSet details = samples::by_class;
  details.insert(CalibrationDetail::sections);
  for (const FittedParameter& parameter : fitted_parameters(details, {}, default_bounds(rough, -1e4, 1e4), rough))
    EXPECT_TRUE(parameter.proportions.empty()) << parameter.name;
}

TEST(CalibrationParameters, BulgesComeApartInTheirRoughProportions) {
  const SurrogateParameters rough = rough_parameters(samples::provenance(), 1);
  SurrogateParameters fitted = alike();
  SurrogateParameters begin = with_detail(fitted, CalibrationDetail::bulge_classes, rough, 1e4);
  const double closed = rough.bulge[closed_wall_class].slope_per_Pa;
  for (std::size_t c = 0; c < wall_class_count; ++c) {
    const double expected = fitted.bulge[c].slope_per_Pa * rough.bulge[c].slope_per_Pa / closed;
    EXPECT_NEAR(begin.bulge[c].slope_per_Pa, expected, 1e-12 * expected) << c;
  }
  begin.bulge = fitted.bulge;
  EXPECT_EQ(begin, fitted) << "and nothing else is touched";
  // a plan may begin with this detail, from the rough parameters, which have their proportions already
  const SurrogateParameters first = with_detail(rough, CalibrationDetail::bulge_classes, rough, 1e4);
  for (std::size_t c = 0; c < wall_class_count; ++c)
    EXPECT_NEAR(first.bulge[c].slope_per_Pa, rough.bulge[c].slope_per_Pa, 1e-12 * rough.bulge[c].slope_per_Pa) << c;
}

// A closed cell has walls on all four sides of a voxel, on two of half a cell, on none of what lies inside of three.
TEST(CalibrationParameters, WallsOfACellBeginToBulgeAlikeHoweverManyVoxelsItHas) {
  const SurrogateParameters whole = rough_parameters(samples::provenance(), 1);
  const double bulge_m_per_Pa = whole.voxel_edge_m() * whole.bulge[walls::closed].slope_per_Pa;
  const auto expect_alike = [&](int voxels_per_cell, const std::vector<std::size_t>& classes) {
    const SurrogateParameters parts = rough_parameters(samples::provenance(), voxels_per_cell);
    for (const std::size_t c : classes)
      EXPECT_NEAR(parts.voxel_edge_m() * parts.bulge[c].slope_per_Pa, bulge_m_per_Pa, 1e-12 * bulge_m_per_Pa) << c;
  };
  expect_alike(2, {walls::corner});
  expect_alike(3, {walls::corner, walls::one, walls::none});
  // beside one wall half a cell is part of two, beside none of two by two
  const SurrogateParameters halves = rough_parameters(samples::provenance(), 2);
  EXPECT_GT(halves.bulge[walls::one].slope_per_Pa, halves.bulge[walls::corner].slope_per_Pa);
  EXPECT_GT(halves.bulge[walls::none].slope_per_Pa, halves.bulge[walls::one].slope_per_Pa);
}

TEST(CalibrationParameters, WhatHasNoEffectAtZeroBeginsAwayFromIt) {
  const SurrogateParameters rough = rough_parameters(samples::provenance(), 1);
  const SurrogateParameters fading = with_detail(rough, CalibrationDetail::fading, rough, 1e4);
  const SurrogateParameters shear = with_detail(rough, CalibrationDetail::shear, rough, 1e4);
  for (std::size_t c = 0; c < wall_class_count; ++c) {
    EXPECT_EQ(fading.bulge[c].fading_share, 0.5);
    EXPECT_NEAR(fading.bulge[c].fading_per_Pa * 1e4, 3.0, 1e-12) << "within the range of pressures";
    // 1 / (G A_s) of E = 3 G and about half of the section, by 1 / (E A): 6, and 5 is of that order
    EXPECT_NEAR(shear.shear_compliance_per_Pa[c] * rough.axial_Pa[c], 5.0, 1e-12);
  }
  EXPECT_EQ(with_detail(rough, CalibrationDetail::lateral, rough, 1e4).lateral_coupling, 0.2);
  EXPECT_EQ(starts_with_detail(rough, CalibrationDetail::lateral, rough, 1e4).size(), 1U);
  const std::vector<SurrogateParameters> starts = starts_with_detail(rough, CalibrationDetail::fading, rough, 1e4);
  ASSERT_EQ(starts.size(), 3U);
  EXPECT_EQ(starts[0], fading);
  for (std::size_t c = 0; c < wall_class_count; ++c) EXPECT_NEAR(starts[2].bulge[c].fading_per_Pa * 1e4, 30.0, 1e-11);
}

TEST(CalibrationParameters, SofteningByClassBeginsWithNone) {
  SurrogateParameters fitted = samples::truth();
  const SurrogateParameters begin = with_detail(fitted, CalibrationDetail::softening, fitted, 1e4);
  for (std::size_t c = 0; c < wall_class_count; ++c) {
    EXPECT_EQ(begin.extension[c], PressureLaw{.slope_per_Pa = fitted.extension[c].slope_per_Pa});
    EXPECT_EQ(begin.bulge[c], PressureLaw{.slope_per_Pa = fitted.bulge[c].slope_per_Pa});
  }
}

TEST(CalibrationParameters, WhatADetailAddsBeginsInsideItsBounds) {
  const SurrogateParameters rough = rough_parameters(samples::provenance(), 1);
  const CalibrationBounds bounds = default_bounds(rough, -1e4, 1e4);
  SurrogateParameters begin = alike();
  DetailSet details;
  for (const auto& [word, detail] : detail_words()) {
    details.insert(detail);
    begin = with_detail(begin, detail, rough, 1e4);
    for (const FittedParameter& parameter : fitted_parameters(details, {}, bounds, rough)) {
      const double value = value_in(begin, parameter);
      EXPECT_GT(value, parameter.bounds.lowest) << word << ": " << parameter.name;
      EXPECT_LT(value, parameter.bounds.highest) << word << ": " << parameter.name;
    }
  }
}

}  // namespace
}  // namespace menger::voxel
