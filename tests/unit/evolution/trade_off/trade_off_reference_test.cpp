#include "evolution/trade_off/trade_off_reference.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace menger::evolution {
namespace {

constexpr double rounding = 1e-12;

/// Rows whose one value is known in closed form.
std::vector<TradeRow> rows_of(const std::vector<ElementFidelity>& fidelities,
                              const std::function<double(const ElementFidelity&)>& value) {
  std::vector<TradeRow> rows;
  for (const ElementFidelity& fidelity : fidelities) {
    rows.push_back(element_row(fidelity));
    rows.back().values = {value(fidelity)};
  }
  return rows;
}

TEST(ReferenceError, FidelitiesAscendInFineness) {
  const auto all = element_fidelities({.thin_walls = {},
                                       .degrees = {2, 1},
                                       .elements_through_wall = {1, 2},
                                       .bulk_ratios = {250, 50},
                                       .force_tolerances = {1e-8, 1e-4}});
  ASSERT_EQ(all.size(), 16U);
  EXPECT_EQ(all.front(), (ElementFidelity{1, 1, 50, 1e-4}));
  EXPECT_EQ(all[4], (ElementFidelity{1, 2, 50, 1e-4}));
  EXPECT_EQ(all.back(), (ElementFidelity{2, 2, 250, 1e-8}));
}

TEST(ReferenceError, ThreeMeshesGiveTheExactErrorOfAPureOrder) {
  const auto all = element_fidelities({.thin_walls = {}, .degrees = {1}, .elements_through_wall = {1, 2, 4}});
  for (const double order : {1.0, 2.0, 3.0}) {
    const auto rows = rows_of(all, [&](const ElementFidelity& f) { return 1.0 + std::pow(f.elements_through_wall, -order); });
    const double exact = std::pow(4.0, -order) / rows.back().values[0].value();
    EXPECT_NEAR(element_reference_errors(all, rows, 2)[0].value(), exact, rounding) << order;
  }
}

TEST(ReferenceError, TwoMeshesGiveTheirDifference) {
  const auto all = element_fidelities({.thin_walls = {}, .degrees = {1}, .elements_through_wall = {1, 2}});
  const auto rows = rows_of(all, [](const ElementFidelity& f) { return 1.0 + 1.0 / f.elements_through_wall; });
  EXPECT_NEAR(element_reference_errors(all, rows, 1)[0].value(), 0.5 / 1.5, rounding);
}

TEST(ReferenceError, AnOtherDegreeServesWhereThereIsNoOtherMesh) {
  const auto all = element_fidelities({.thin_walls = {}, .degrees = {1, 2}, .elements_through_wall = {1}});
  const auto rows = rows_of(all, [](const ElementFidelity& f) { return f.degree; });
  EXPECT_NEAR(element_reference_errors(all, rows, 1)[0].value(), 0.5, rounding);
}

TEST(ReferenceError, CompressibilityIsExtrapolatedToTheIncompressible) {
  const auto all = element_fidelities({.thin_walls = {}, .degrees = {1}, .elements_through_wall = {1}, .bulk_ratios = {50, 250}});
  const auto rows = rows_of(all, [](const ElementFidelity& f) { return 1.0 + 5.0 / f.bulk_ratio; });
  EXPECT_NEAR(element_reference_errors(all, rows, 1)[0].value(), 0.02 / 1.02, rounding);
}

TEST(ReferenceError, ThinWallsAreCoarserAndSayNothingOfTheReference) {
  const auto all = element_fidelities(
      {.thin_walls = {fem::Fidelity::fine, fem::Fidelity::draft}, .degrees = {1}, .elements_through_wall = {1, 2}});
  ASSERT_EQ(all.size(), 4U);
  EXPECT_EQ(all[0].thin_walls, fem::Fidelity::draft);
  EXPECT_EQ(all[1].thin_walls, fem::Fidelity::fine);
  EXPECT_FALSE(all[2].thin_walls || all[3].thin_walls);
  const auto rows =
      rows_of(all, [](const ElementFidelity& f) { return f.thin_walls ? 7.0 : 1.0 + 1.0 / f.elements_through_wall; });
  EXPECT_NEAR(element_reference_errors(all, rows, 3)[0].value(), 0.5 / 1.5, rounding);
}

TEST(ReferenceError, OfThinWallsTheNextFidelityTells) {
  const auto all = element_fidelities({.thin_walls = {fem::Fidelity::standard, fem::Fidelity::fine}, .degrees = {1}});
  const auto rows = rows_of(all, [](const ElementFidelity& f) { return f.thin_walls == fem::Fidelity::fine ? 2.0 : 3.0; });
  EXPECT_NEAR(element_reference_errors(all, rows, 1)[0].value(), 0.5, rounding);
}

TEST(ReferenceError, NothingTellsWithoutASecondRun) {
  const auto all = element_fidelities({.thin_walls = {}, .degrees = {1}, .elements_through_wall = {1, 2}});
  auto rows = rows_of(all, [](const ElementFidelity&) { return 1.0; });
  rows[0].values = {std::nullopt};
  EXPECT_FALSE(element_reference_errors(all, rows, 1)[0]);
}

TEST(ReferenceError, OfAGaitIsProportionalToTheTimeStep) {
  const auto all = voxel_fidelities({.numbers = {"float64"}, .dampings = {"increments"}}, {});
  std::vector<TradeRow> rows;
  for (const VoxelFidelity& fidelity : all) {
    rows.push_back(voxel_row(fidelity, std::nullopt));
    rows.back().values = {1.0 + 0.1 * fidelity.time_step_fraction};
  }
  EXPECT_NEAR(gait_reference_error(all, rows, rows.size() - 1).value(), 0.009 / 1.009, rounding);
}

TEST(VoxelFidelities, LeaveOutWhatFloatCannotCarryAndEndWithTheFinest) {
  const auto all = voxel_fidelities({}, {});
  EXPECT_EQ(all.size(), 3U * 3U * 3U);  // three pairs of number and damping, three steps, three rules
  for (const VoxelFidelity& fidelity : all) EXPECT_FALSE(fidelity.number == "float32" && fidelity.damping == "increments");
  EXPECT_EQ(all.back(), (VoxelFidelity{"float64", "increments", 0.09, "1", {}}));
  EXPECT_EQ(all.front(), (VoxelFidelity{"float32", "velocity", 0.9, "off", {}}));
}

}  // namespace
}  // namespace menger::evolution
