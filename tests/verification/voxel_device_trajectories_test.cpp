// The reference trajectories of the voxel engine, by blocks of threads: on a graphics processor all of them, with a lone thread
// in place of a block the short ones.

#include <gtest/gtest.h>

#include <map>

#include "io/device/graphics_processor.h"
#include "tests/verification/voxel_trajectories.h"
#include "voxel/device/device_steps.h"
#include "voxel/device/robot_runner.h"

namespace menger::voxel {
namespace {

/// Runs the cases that `wanted` picks side by side, in double with damping from increments as the reference has it, and compares
/// them with it.
template <class Wanted>
void expect_reference_on(Stepper stepper, const Wanted& wanted) {
  std::map<double, std::vector<TrajectoryCase>> by_time;
  for (const TrajectoryCase& c : cases()) {
    if (wanted(c)) by_time[c.time_s].push_back(c);
  }
  EXPECT_FALSE(by_time.empty());
  for (const auto& [time_s, together] : by_time) {
    std::vector<Simulation> robots;
    std::vector<std::array<double, 3>> start_m;
    for (const TrajectoryCase& c : together) {
      Physics physics = reference_physics(c, DampingMode::increments);
      physics.integration.single_precision_rest_lengths = slips_by_rounding(c);
      robots.emplace_back(meshes::fractal(meshes::Polycube::from_digits(3, 3, 3, c.digits), c.level), 0.01, physics);
      start_m.push_back(robots.back().centre_of_mass_m());
    }
    const DeviceAdvance advance = advance_on_device_to(robots, time_s, nullptr, stepper);
    for (std::size_t i = 0; i < robots.size(); ++i) {
      const TrajectoryCase& c = together[i];
      EXPECT_EQ(advance.statuses[i], io::RunStatus::completed) << c.id;
      EXPECT_FALSE(advance.on_processor[i]) << c.id;
      const std::array<double, 3> end_m = robots[i].centre_of_mass_m();
      std::array<double, 3> displacement_m{};
      for (std::size_t k = 0; k < 3; ++k) displacement_m[k] = end_m[k] - start_m[i][k];
      const double off = distance(displacement_m, c.displacement_m);
      std::cout << "  " << c.id << ": " << off << " m of " << c.tolerance_m << " m allowed\n";
      EXPECT_LE(off, c.tolerance_m) << c.id;
    }
  }
}

TEST(VoxelDeviceTrajectories, LoneThreadsMatchThePublicEngine) { expect_reference_on(Stepper::lone_thread, is_short); }

TEST(VoxelDeviceTrajectories, GraphicsProcessorMatchesThePublicEngine) {
  if (const std::string obstacle = io::obstacle_to_device(); !obstacle.empty()) GTEST_SKIP() << obstacle;
  expect_reference_on(Stepper::graphics_processor, [](const TrajectoryCase&) { return true; });
}

}  // namespace
}  // namespace menger::voxel
