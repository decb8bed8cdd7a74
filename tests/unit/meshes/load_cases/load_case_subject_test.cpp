#include "meshes/load_cases/load_case_subject.h"

#include <gtest/gtest.h>

namespace menger::meshes {
namespace {

LoadCase stretched_bar() { return {.name = "bar", .kind = LoadCaseKind::stretch, .cells = {3, 1, 1}, .digits = "112"}; }

TEST(LoadCaseSubject, IsKindAndBody) { EXPECT_EQ(subject_of(stretched_bar()), "stretch of 3x1x1:111, level 1"); }

TEST(LoadCaseSubject, DoesNotDependOnNamesAndAmounts) {
  LoadCase other = stretched_bar();
  other.name = "another";
  other.pressures_Pa = {1e3};
  other.imposed = {1e-3};
  EXPECT_EQ(subject_of(other), subject_of(stretched_bar()));
}

TEST(LoadCaseSubject, SeesTheSameBodyInALargerGrid) {
  LoadCase wide = stretched_bar();
  wide.cells = {3, 3, 2};
  wide.digits = "000000000000111000";  // the row at y = 1, z = 1
  EXPECT_EQ(subject_of(wide), subject_of(stretched_bar()));
  wide.level = 2;
  LoadCase aggregate = stretched_bar();
  aggregate.level = 2;
  EXPECT_NE(subject_of(wide), subject_of(aggregate)) << "modules of other gaps";
}

TEST(LoadCaseSubject, TellsPhasesApartOnlyWhereTheyAreChambers) {
  LoadCase phases = stretched_bar();
  phases.per_phase = true;
  EXPECT_EQ(subject_of(phases), "stretch of 3x1x1:112, level 1, chambers per phase");
  LoadCase renamed = phases;
  renamed.digits = "221";
  EXPECT_EQ(subject_of(renamed), subject_of(phases));
  LoadCase turned = phases;
  turned.digits = "122";
  EXPECT_NE(subject_of(turned), subject_of(phases));
  LoadCase one = phases;
  one.digits = "222";
  EXPECT_EQ(subject_of(one), subject_of(stretched_bar())) << "a single phase is a single chamber";
}

TEST(LoadCaseSubject, SeesTheSameBodyTurnedAsFarAsTheLoadAllows) {
  // An L of four cells, lying and standing. The second is the first turned about its long side.
  LoadCase lying{.name = "l", .kind = LoadCaseKind::inflation, .cells = {3, 2, 1}, .digits = "111100"};
  LoadCase standing{.name = "l", .kind = LoadCaseKind::inflation, .cells = {3, 1, 2}, .digits = "111100"};
  LoadCase upright{.name = "l", .kind = LoadCaseKind::inflation, .cells = {1, 2, 3}, .digits = "111010"};
  LoadCase mirrored{.name = "l", .kind = LoadCaseKind::inflation, .cells = {3, 2, 1}, .digits = "111001"};
  for (LoadCase* of : {&standing, &upright, &mirrored}) EXPECT_EQ(subject_of(*of), subject_of(lying));  // flat: two-sided
  for (LoadCase* of : {&lying, &standing, &upright, &mirrored}) of->kind = LoadCaseKind::stretch;
  EXPECT_EQ(subject_of(standing), subject_of(lying));
  EXPECT_NE(subject_of(upright), subject_of(lying)) << "pulled along another axis";
  EXPECT_NE(subject_of(mirrored), subject_of(lying)) << "its other end is held";
  standing.kind = lying.kind = LoadCaseKind::sag;
  EXPECT_NE(subject_of(standing), subject_of(lying)) << "another side is up";
  // A screw of four cells and its mirror image cannot be turned into each other.
  LoadCase screw{.name = "s", .kind = LoadCaseKind::inflation, .cells = {2, 2, 2}, .digits = "11010001"};
  LoadCase other = screw;
  other.digits = "11100010";
  EXPECT_NE(subject_of(screw), subject_of(other));
}

TEST(LoadCaseSubject, TellsOtherLoadsAndLevelsApart) {
  LoadCase other = stretched_bar();
  other.kind = LoadCaseKind::bending;
  EXPECT_NE(subject_of(other), subject_of(stretched_bar()));
  other = stretched_bar();
  other.level = 2;
  EXPECT_NE(subject_of(other), subject_of(stretched_bar()));
  other = stretched_bar();
  other.digits = "110";
  EXPECT_EQ(subject_of(other), "stretch of 2x1x1:11, level 1");
}

}  // namespace
}  // namespace menger::meshes
