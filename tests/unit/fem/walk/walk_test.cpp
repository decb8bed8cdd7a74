#include "fem/walk/walk.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <string>
#include <thread>
#include <vector>

#include "fem/walk/walk_input_error.h"
#include "tests/support/input_error_message.h"

namespace menger::fem {
namespace {

using tests::message_of;

/// A body in an assumed silicone, coarse, driven at 20 Hz for a short time.
WalkInput input_of(const std::string& digits, int columns, int layers) {
  WalkInput input;
  input.design = {"body", meshes::Polycube::from_digits(columns, 1, layers, digits), 0.01};
  input.hollow.wall_thickness_m = 2e-3;
  input.elements.fidelity = Fidelity::draft;
  input.silicone.law.law = materials::NeoHookean{5e4};
  input.silicone.density_kg_per_m3 = 1070.0;
  input.stated_ground.friction = {.static_coefficient = 1.0, .kinetic_coefficient = 0.5};
  input.drive = SurrogateDrive{.pressure_Pa = {0.0, 4e3}, .frequency_Hz = 20.0};
  input.duration_s = 0.06;
  input.record_interval_s = 0.01;
  return input;
}

/// An L of three cells, which no mirror turns into itself along x.
WalkInput hook() { return input_of("1110", 2, 2); }
WalkInput bar() { return input_of("11", 2, 1); }

/// All numbers of a walk.
std::vector<double> numbers_of(const WalkResult& result) {
  std::vector<double> numbers{result.time_s, static_cast<double>(result.steps)};
  for (const WalkRecord& record : result.records) {
    numbers.push_back(record.time_s);
    numbers.insert(numbers.end(), record.centre_of_mass_m.begin(), record.centre_of_mass_m.end());
    numbers.insert(numbers.end(), record.plenum_pressures_Pa.begin(), record.plenum_pressures_Pa.end());
    numbers.insert(numbers.end(), record.chamber_volumes_m3.begin(), record.chamber_volumes_m3.end());
    numbers.insert(numbers.end(), {record.energies.kinetic_J, record.energies.strain_J, record.energies.imbalance_J(),
                                   record.energies.turnover_J(), record.ground_force_N});
  }
  return numbers;
}

TEST(Walk, GoesFromADesignToADisplacement) {
  WalkInput input = hook();
  input.elements.precision = Precision::double_precision;
  const WalkResult result = walk(input);
  ASSERT_EQ(result.status, io::RunStatus::completed) << result.reason;
  EXPECT_TRUE(result.reason.empty());
  ASSERT_EQ(result.records.size(), 7U);
  for (std::size_t n = 0; n < 7; ++n) EXPECT_NEAR(result.records[n].time_s, 0.01 * static_cast<double>(n), 1e-15);
  EXPECT_EQ(result.time_s, 0.06);
  EXPECT_DOUBLE_EQ(result.body_length_m, 0.02);
  EXPECT_GT(result.steps, 100U);
  EXPECT_GT(result.elements, 50U);
  EXPECT_EQ(result.element_steps(), result.steps * result.elements);
  const auto travel = travel_of(result);
  ASSERT_TRUE(travel);
  EXPECT_GT(travel->displacement_m[0] * travel->displacement_m[0], 1e-14) << "no mirror keeps it in its place";
  EXPECT_NEAR(travel->displacement_m[1], 0.0, 1e-15) << "it is its own mirror image along y";
  EXPECT_GT(result.records[6].chamber_volumes_m3[0], 1.05 * result.records[0].chamber_volumes_m3[0]) << "it is inflated";
}

TEST(Walk, CellsOfTwoPhasesAreDrivenApart) {
  WalkInput input = input_of("12", 2, 1);
  input.hollow.chambers = meshes::ChamberLayout::per_phase;
  input.drive->mode = DriveMode::antiphase;
  input.drive->ramp_s = 0.0;
  const WalkResult result = walk(input);
  ASSERT_EQ(result.status, io::RunStatus::completed) << result.reason;
  for (const WalkRecord& record : result.records) {
    ASSERT_EQ(record.plenum_pressures_Pa.size(), 2U);
    EXPECT_NEAR(record.plenum_pressures_Pa[0] + record.plenum_pressures_Pa[1], 4e3, 1e-6) << record.time_s;
  }
  EXPECT_GT(result.records[1].plenum_pressures_Pa[0], 3e3);
}

// A plate on four feet, whose partition across y lies in the row of the hind feet.
TEST(Walk, PhasesBesideOuterWallsWalkOnThinWalls) {
  WalkInput input = input_of("1", 1, 1);
  input.design.body = meshes::Polycube::from_digits(4, 3, 2, "100200002001112211222211");
  input.hollow.chambers = meshes::ChamberLayout::per_phase;
  input.drive->mode = DriveMode::antiphase;
  input.duration_s = 0.2;
  const WalkResult result = walk(input);
  ASSERT_EQ(result.status, io::RunStatus::completed) << result.reason;
  const WalkRecord& last = result.records.back();
  ASSERT_EQ(last.plenum_pressures_Pa.size(), 4U);
  EXPECT_NEAR(last.plenum_pressures_Pa[0] + last.plenum_pressures_Pa[1], 4e3, 1e-6);
  EXPECT_NEAR(last.plenum_pressures_Pa[0], last.plenum_pressures_Pa[3], 1e-6) << "of one phase";
  EXPECT_LT(std::abs(last.energies.imbalance_J()), 0.01 * last.energies.turnover_J());
  ASSERT_TRUE(travel_of(result));
}

TEST(Walk, IsTheSameBesideAnotherAndForAnyThreads) {
  const std::vector<double> hook_alone = numbers_of(walk(hook()));
  const std::vector<double> bar_alone = numbers_of(walk(bar()));
  EXPECT_NE(hook_alone, bar_alone);
  for (const auto& [hook_threads, bar_threads] : std::vector<std::pair<int, int>>{{1, 1}, {2, 1}, {2, 3}}) {
    std::vector<double> first;
    std::vector<double> second;
    {
      const std::jthread one([&] {
        WalkInput input = hook();
        input.threads = hook_threads;
        first = numbers_of(walk(input));
      });
      const std::jthread two([&] {
        WalkInput input = bar();
        input.threads = bar_threads;
        second = numbers_of(walk(input));
      });
    }
    EXPECT_EQ(first, hook_alone) << hook_threads << " and " << bar_threads << " threads";
    EXPECT_EQ(second, bar_alone) << hook_threads << " and " << bar_threads << " threads";
  }
}

TEST(Walk, StopsWhenItIsTold) {
  std::atomic<bool> stop{true};
  const WalkResult at_once = walk(hook(), &stop);
  EXPECT_EQ(at_once.status, io::RunStatus::stopped);
  EXPECT_FALSE(at_once.reason.empty());
  EXPECT_EQ(at_once.steps, 0U);
  ASSERT_EQ(at_once.records.size(), 1U) << "that of the start";
  EXPECT_FALSE(travel_of(at_once));

  stop = false;
  WalkInput long_walk = hook();
  long_walk.duration_s = 3600.0;
  WalkResult result;
  {
    const std::jthread walker([&] { result = walk(long_walk, &stop); });
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    stop = true;
  }
  EXPECT_EQ(result.status, io::RunStatus::stopped);
  EXPECT_LT(result.time_s, 3600.0);
}

TEST(Walk, AResumedWalkIsTheUninterruptedOne) {
  PreparedWalk prepared;
  static_cast<WalkInput&>(prepared) = hook();
  prepare(prepared);
  std::atomic<bool> stop{false};
  const auto first = explicit_walk_dynamics(prepared, &stop);
  Walk begun(prepared, *first);
  EXPECT_TRUE(begun.start());
  EXPECT_FALSE(begun.start()) << "only once";
  for (int n = 0; n < 3; ++n) EXPECT_TRUE(begun.go_on());
  stop = true;
  EXPECT_FALSE(begun.go_on());
  EXPECT_TRUE(begun.is_stopped());
  EXPECT_FALSE(begun.is_under_way());
  EXPECT_FALSE(begun.outcome());

  const auto second = explicit_walk_dynamics(prepared, nullptr);
  Walk resumed(prepared, *second);
  resumed.resume(begun.progress());
  EXPECT_EQ(resumed.records().size(), 4U);
  EXPECT_FALSE(resumed.start());
  while (resumed.is_under_way()) resumed.go_on();
  EXPECT_EQ(numbers_of(resumed.result()), numbers_of(walk(hook())));

  const auto third = explicit_walk_dynamics(prepared, nullptr);
  Walk ended(prepared, *third);
  ended.resume(resumed.progress());
  EXPECT_FALSE(ended.is_under_way());
  EXPECT_EQ(ended.result().status, io::RunStatus::completed);
}

TEST(Walk, WhatFailsSaysWhy) {
  WalkInput input = hook();
  input.drive->pressure_Pa = {0.0, 2e6};
  input.drive->ramp_s = 0.0;
  const WalkResult result = walk(input);
  EXPECT_NE(result.status, io::RunStatus::completed);
  EXPECT_NE(result.status, io::RunStatus::stopped);
  EXPECT_FALSE(result.reason.empty());
  EXPECT_LT(result.time_s, input.duration_s);
  EXPECT_EQ(result.records.back().time_s, result.time_s);
  EXPECT_FALSE(travel_of(result));
}

TEST(Walk, BadInputNamesItsKey) {
  const auto refusal = [](const auto& change) {
    WalkInput input = hook();
    change(input);
    return message_of([&] { (void)walk(input); });
  };
  EXPECT_EQ(refusal([](WalkInput& i) { i.duration_s = -1.0; }), "time.duration_s: -1: must be > 0");
  EXPECT_EQ(refusal([](WalkInput& i) { i.record_interval_s = 1.0; }),
            "time.record_interval_s: 1: must be > 0 and at most the duration");
  EXPECT_EQ(refusal([](WalkInput& i) {
              i.drive->pressure_Pa = {2.0, 1.0};
            }),
            "drive.pressure_Pa: 1: must ascend: lowest, then highest");
  EXPECT_EQ(refusal([](WalkInput& i) { i.silicone.density_kg_per_m3.reset(); }),
            "material.density_kg_per_m3: is missing: a law without a record has no density");
  EXPECT_EQ(refusal([](WalkInput& i) { i.stated_ground.friction.static_coefficient = 0.1; }),
            "ground.static_friction: 0.1: must be at least the kinetic one");
  EXPECT_EQ(refusal([](WalkInput& i) { i.stated_ground.friction.regularisation_speed_m_per_s = -1.0; }),
            "ground.regularisation_speed_m_per_s: -1: must be >= 0");
  const auto along_x = [](double backward, double sideways) {
    return DirectionalFriction{.forward = {1.0, 0.0}, .backward_factor = backward, .sideways_factor = sideways};
  };
  EXPECT_EQ(refusal([&](WalkInput& i) { i.stated_ground.friction.directional = along_x(-2.0, 1.0); }),
            "ground.directional.backward_factor: -2: must be >= 0");
  EXPECT_EQ(refusal([&](WalkInput& i) { i.stated_ground.friction.directional = along_x(1.0, -2.0); }),
            "ground.directional.sideways_factor: -2: must be >= 0");
  EXPECT_NE(refusal([](WalkInput& i) { i.stated_ground.height_m = 1.0; }).find("ground.height_m: is above"), std::string::npos);
  EXPECT_NE(refusal([](WalkInput& i) { i.hollow.wall_thickness_m = 6e-3; }).find("design: "), std::string::npos);
  EXPECT_NE(refusal([](WalkInput& i) { i.step_safety = 2.0; }).find("step_safety = 2"), std::string::npos);
  EXPECT_NE(refusal([](WalkInput& i) { i.supply.emplace(std::vector<PlenumSupply>{PlenumSchedule{}}); }).find("keep one of them"),
            std::string::npos);
  EXPECT_THROW((void)walk([] {
                 WalkInput input = input_of("12", 2, 1);
                 input.drive->mode = DriveMode::antiphase;
                 return input;
               }()),
               WalkInputError)
      << "one chamber cannot have two phases";
}

TEST(WalkResult, TellsTheDisplacementOfEveryPeriod) {
  WalkResult result;
  for (int n = 0; n <= 10; ++n) {
    const double time_s = 0.01 * n;
    result.records.push_back({.time_s = time_s, .centre_of_mass_m = {n * n * 1e-3, -1e-3 * n, 0.0}});
  }
  const std::vector<Point> moved = period_displacements_m(result, 0.03);
  ASSERT_EQ(moved.size(), 3U) << "the fourth period is not whole";
  EXPECT_NEAR(moved[0][0], 9e-3, 1e-15);
  EXPECT_NEAR(moved[1][0], 27e-3, 1e-15);
  EXPECT_NEAR(moved[2][0], 45e-3, 1e-15);
  EXPECT_NEAR(moved[2][1], -3e-3, 1e-15);
  EXPECT_EQ(period_displacements_m(result, 0.1).size(), 1U) << "rounding takes no period away";
  EXPECT_NEAR(period_displacements_m(result, 0.025)[0][0], 6.5e-3, 1e-15) << "between two records";
  EXPECT_EQ(centre_of_mass_at(result, -1.0)[0], 0.0);
  EXPECT_NEAR(centre_of_mass_at(result, 1.0)[0], 0.1, 1e-15);
  EXPECT_TRUE(period_displacements_m({}, 0.1).empty());
}

}  // namespace
}  // namespace menger::fem
