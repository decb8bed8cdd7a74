// Voxel-steps per second of whole batches of robots on a graphics processor, with the copies there and back, under the paper's
// physics; and of one core of the processor beside it.
//
//   bench-voxel-device [voxel-steps of a case, default 2e9] [voxel-steps of the processor's, default 2e7]

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <random>
#include <string>
#include <vector>

#include "io/device/graphics_processor.h"
#include "meshes/design/fractal.h"
#include "voxel/device/device_steps.h"
#include "voxel/device/robot_runner.h"
#include "voxel/lanes/simulation.h"

namespace {

using menger::meshes::Polycube;
using namespace menger::voxel;
using Clock = std::chrono::steady_clock;

struct Case {
  std::string shape;  ///< digits of the module; m stands for either material
  int level;
  std::size_t robots;
};

const std::string sponge = "mmmm0mmmmm0m000m0mmmmm0mmmm";   // 20 voxels, 400, 8000
const std::string sixteen = "m0m000m0mmmmmmmmmm0m00m00m0";  // 16 voxels, 4096
const std::string full(27, 'm');                            // 27 voxels, 19683
const std::vector<Case> cases{{sponge, 1, 256}, {sponge, 2, 256}, {sixteen, 3, 256}, {sponge, 3, 12}, {full, 3, 64}};

struct Mode {
  NumberType number;
  DampingMode damping;
};
const std::vector<Mode> modes{{NumberType::float64, DampingMode::increments},
                              {NumberType::float64, DampingMode::velocity},
                              {NumberType::float32, DampingMode::velocity}};

std::vector<Polycube> bodies_of(const Case& c) {
  std::mt19937 generator(1);
  std::vector<Polycube> bodies;
  while (bodies.size() < c.robots) {
    std::string digits = c.shape;
    for (char& digit : digits) {
      if (digit == 'm') digit = static_cast<char>('1' + generator() % 2);
    }
    bodies.push_back(menger::meshes::fractal(Polycube::from_digits(3, 3, 3, digits), c.level));
  }
  return bodies;
}

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

void run(const Case& c, const Mode& mode, double voxel_steps, double steps_of_processor) {
  Physics physics;
  physics.integration.number = mode.number;
  physics.integration.damping = mode.damping;
  const std::vector<Polycube> bodies = bodies_of(c);
  const auto voxels = static_cast<double>(bodies.front().count());
  std::vector<Simulation> robots;
  const auto built = Clock::now();
  for (const Polycube& body : bodies) robots.emplace_back(body, 0.01, physics);
  const double build_s = seconds_since(built);

  const double steps = std::max(200.0, voxel_steps / voxels / static_cast<double>(c.robots));
  const auto start = Clock::now();
  const DeviceAdvance advance =
      advance_on_device_to(robots, steps * robots.front().time_step_s(), nullptr, Stepper::graphics_processor);
  const double device_s = seconds_since(start);
  double made = 0.0;
  std::size_t diverged = 0;
  for (const Simulation& robot : robots) {
    made += voxels * static_cast<double>(robot.steps());
    diverged += robot.divergence() ? 1U : 0U;
  }

  Simulation alone(bodies.front(), 0.01, physics);
  const auto alone_start = Clock::now();
  const auto alone_steps = static_cast<std::uint64_t>(std::max(20.0, steps_of_processor / voxels));
  static_cast<void>(alone.advance(alone_steps));
  const double alone_rate = voxels * static_cast<double>(alone.steps()) / seconds_since(alone_start);

  std::printf("%6.0f %6zu  %s %-10s %8.0f  %8.3f %8.3f  %9.1f %9.1f  %6zu %6zu\n", voxels, c.robots,
              std::string(to_string(mode.number)).c_str(), std::string(to_string(mode.damping)).c_str(), steps, build_s, device_s,
              made / device_s * 1e-6, alone_rate * 1e-6, static_cast<std::size_t>(std::ranges::count(advance.on_processor, true)),
              diverged);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  const double voxel_steps = argc > 1 ? std::atof(argv[1]) : 2e9;
  const double steps_of_processor = argc > 2 ? std::atof(argv[2]) : 2e7;
  if (const std::string obstacle = menger::io::obstacle_to_device(); !obstacle.empty()) {
    std::cout << obstacle << "\n";
    return 0;
  }
  std::cout << menger::io::graphics_processor()->name << ", million voxel-steps per second\n"
            << "voxels robots  number  damping       steps   build s device s     device  one core    left diverged\n";
  for (const Case& c : cases) {
    for (const Mode& mode : modes) run(c, mode, voxel_steps, steps_of_processor);
  }
  return 0;
}
