// Limbs that leave a plate off its middle are turned by its slope, and arms of elbows open, in every kernel, without a force from
// nowhere.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>
#include <vector>

#include "tests/support/surrogate_example.h"
#include "voxel/lanes/simulation.h"

namespace menger::voxel {
namespace {

/// A plate of 3 x 3 cells on a leg at an edge and one at a corner. The leg at the edge has a foot, which is an elbow.
const meshes::Polycube table = meshes::Polycube::from_digits(3, 3, 3, "000000011100000010111111111");

/// A body in flight, driven by a pressure that swings.
Physics flying(DampingMode damping) {
  Physics physics;
  physics.surrogate = CalibratedBody{.parameters = tests::surrogate_example(), .pressure_Pa = {0.0, 1500.0}};
  SurrogateParameters& parameters = physics.surrogate->parameters;
  parameters.bulge[walls::none].slope_per_Pa = 5e-5;
  parameters.neck_ratio = 1.5;
  parameters.elbow_ratio = 3.0;
  physics.actuation.frequency_Hz = 8.0;
  physics.floor = false;
  physics.gravity_m_s2 = 0.0;
  physics.damping_ratios.global = 0.0;
  physics.collisions.exclusion_depth.reset();
  physics.integration.damping = damping;
  return physics;
}

std::vector<double> limb_state_after(const Physics& physics, const KernelOptions& options, std::uint64_t steps) {
  Simulation simulation(table, 0.01, physics, {}, options);
  EXPECT_EQ(simulation.advance(steps), io::RunStatus::completed);
  std::vector<double> numbers;
  for (std::size_t i = 0; i < simulation.voxel_count(); ++i) {
    for (const double value : simulation.position_m(i)) numbers.push_back(value);
    for (const double value : simulation.orientation(i)) numbers.push_back(value);
  }
  return numbers;
}

TEST(LimbTilt, IsTheSameInEveryKernel) {
  for (const NumberType number : {NumberType::float64, NumberType::float32}) {
    Physics physics = flying(DampingMode::velocity);
    physics.integration.number = number;
    const std::vector<double> scalar = limb_state_after(physics, {.instruction_set = InstructionSet::scalar}, 2000);
    EXPECT_LT(*std::ranges::min_element(scalar), -1e-3) << "the legs have moved away";
    for (const InstructionSet set : {InstructionSet::sse2, InstructionSet::avx2, InstructionSet::avx512}) {
      std::vector<double> packed = scalar;
      try {
        packed = limb_state_after(physics, {.instruction_set = set}, 2000);
      } catch (const std::invalid_argument&) {  // this machine does not have it
        continue;
      }
      EXPECT_EQ(std::memcmp(scalar.data(), packed.data(), scalar.size() * sizeof(double)), 0) << static_cast<int>(set);
    }
  }
}

TEST(LimbTilt, ClosesTheBooksOfEnergy) {
  for (const DampingMode damping : {DampingMode::increments, DampingMode::velocity}) {
    Simulation simulation(table, 0.01, flying(damping), {}, {.energy_ledger = true});
    ASSERT_EQ(simulation.advance_to(0.5), io::RunStatus::completed);
    const EnergyLedger& energy = *simulation.energy();
    EXPECT_GT(std::abs(energy.actuation_work_J), 0.05 * energy.largest_energy_J);
    EXPECT_LT(std::abs(energy.residual_share()), 0.01) << static_cast<int>(damping);
  }
}

TEST(LimbTilt, PushesTheBodyNowhere) {
  Simulation simulation(table, 0.01, flying(DampingMode::velocity));
  const std::array<double, 3> start = simulation.centre_of_mass_m();
  ASSERT_EQ(simulation.advance_to(0.5), io::RunStatus::completed);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(simulation.centre_of_mass_m()[k], start[k], 1e-12);
}

}  // namespace
}  // namespace menger::voxel
