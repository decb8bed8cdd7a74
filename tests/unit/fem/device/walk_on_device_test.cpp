// Whole walks with steps of another taker. A walk switches between sticking and sliding, so that rounding grows: what is compared
// is how far walks end apart, with how far those of half the step do.

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <string>
#include <thread>
#include <vector>

#include "fem/walk/walk.h"
#include "io/device/graphics_processor.h"

namespace menger::fem {
namespace {

/// Twelve bodies of 4 to 13 cells whose two phases share no air: bars, an L, plates, tables.
std::vector<meshes::Design> bodies() {
  const auto body = [](const std::string& name, int nx, int ny, int nz, const std::string& digits) {
    return meshes::Design{name, meshes::Polycube::from_digits(nx, ny, nz, digits), 10e-3};
  };
  return {body("bar", 3, 1, 1, "112"),
          body("long_bar", 3, 1, 1, "122"),
          body("l", 3, 2, 1, "111001"),
          body("plate", 3, 2, 1, "112112"),
          body("square", 2, 2, 1, "1122"),
          body("table_on_two_legs", 3, 1, 2, "101111"),
          body("one_leg", 3, 1, 2, "100111"),
          body("table", 3, 3, 2, "101000101111111111"),
          body("foot", 3, 3, 2, "100000001111111111"),
          body("three_legs", 3, 3, 2, "101000010111111111"),
          body("heel", 3, 2, 2, "110000111111"),
          body("arch", 3, 1, 3, "101111010")};
}

WalkInput input_of(const meshes::Design& design) {
  WalkInput input;
  input.design = design;
  input.hollow.wall_thickness_m = 2e-3;
  input.hollow.chambers = meshes::ChamberLayout::per_phase;
  input.elements.fidelity = Fidelity::draft;
  input.silicone.law.law = materials::NeoHookean{86.7e3};
  input.silicone.density_kg_per_m3 = 1070.0;
  input.stated_ground.friction = {.static_coefficient = 0.6, .kinetic_coefficient = 0.5};
  input.drive = SurrogateDrive{.mode = DriveMode::antiphase, .pressure_Pa = {0.0, 5e3}, .frequency_Hz = 3.0};
  input.duration_s = 2.0;
  return input;
}

/// Walks of all inputs, each in a thread of its own.
std::vector<WalkResult> walks_of(const std::vector<WalkInput>& inputs, std::size_t threads) {
  std::vector<WalkResult> results(inputs.size());
  std::atomic<std::size_t> next = 0;
  std::vector<std::jthread> walkers;
  for (std::size_t n = 0; n < threads; ++n)
    walkers.emplace_back([&] {
      for (std::size_t one = next++; one < inputs.size(); one = next++) results[one] = walk(inputs[one]);
    });
  walkers.clear();
  return results;
}

double apart_m(const WalkResult& a, const WalkResult& b) {
  const Point& p = a.records.back().centre_of_mass_m;
  const Point& q = b.records.back().centre_of_mass_m;
  return std::hypot(p[0] - q[0], p[1] - q[1]);
}

/// The geometric mean of distances, which go from micrometres, below which none counts, to millimetres.
double typical_m(const std::vector<double>& distances_m) {
  double sum = 0.0;
  for (const double distance : distances_m) sum += std::log(std::max(distance, 1e-6));
  return std::exp(sum / static_cast<double>(distances_m.size()));
}

// Rounding and the step are both small changes that friction's switching lets grow. Of twelve walks the ratio of their typical
// effects is known to a factor of 1.4: distances of one body differ by a factor of about three from one change to the other.
TEST(WalksOnAGraphicsProcessor, EndNoFurtherApartThanThoseOfHalfTheStep) {
  if (const std::string obstacle = io::obstacle_to_device(); !obstacle.empty()) GTEST_SKIP() << obstacle;
  std::vector<WalkInput> inputs;
  for (const meshes::Design& design : bodies()) inputs.push_back(input_of(design));
  const auto changed = [&](const auto& change) {
    std::vector<WalkInput> result = inputs;
    for (WalkInput& input : result) change(input);
    return result;
  };
  const std::size_t cores = std::max(1U, std::thread::hardware_concurrency());
  const auto expected = walks_of(inputs, cores);
  const auto half = walks_of(changed([](WalkInput& input) { input.step_safety = 0.4; }), cores);
  const auto on_device = walks_of(changed([](WalkInput& input) { input.device = io::Device::cuda; }), inputs.size());
  const auto again = walks_of(changed([](WalkInput& input) { input.device = io::Device::cuda; }), inputs.size());
  std::vector<double> by_device;
  std::vector<double> by_step;
  for (std::size_t n = 0; n < inputs.size(); ++n) {
    const std::string& name = inputs[n].design.name;
    ASSERT_EQ(expected[n].status, io::RunStatus::completed) << name << ": " << expected[n].reason;
    ASSERT_EQ(on_device[n].status, io::RunStatus::completed) << name << ": " << on_device[n].reason;
    ASSERT_EQ(half[n].status, io::RunStatus::completed) << name << ": " << half[n].reason;
    EXPECT_EQ(on_device[n].records.back().centre_of_mass_m, again[n].records.back().centre_of_mass_m) << name;
    by_device.push_back(apart_m(expected[n], on_device[n]));
    by_step.push_back(apart_m(expected[n], half[n]));
    const auto travel = travel_of(expected[n]);
    std::printf("%-18s goes %7.3f mm; on the device %.3f mm apart, with half the step %.3f mm\n", name.c_str(),
                1e3 * travel->horizontal_displacement_m, 1e3 * by_device.back(), 1e3 * by_step.back());
  }
  EXPECT_LT(typical_m(by_device), 2.0 * typical_m(by_step));
}

}  // namespace
}  // namespace menger::fem
