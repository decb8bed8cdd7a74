#pragma once

#include <atomic>
#include <filesystem>
#include <iosfwd>
#include <string>

#include "meshes/robot/robot.h"

namespace menger::evolution {

/// What a user asks of a loop.
struct LoopRequest {
  std::filesystem::path robot;      ///< robot.toml, or the folder that has it
  std::filesystem::path results{};  ///< folder; empty: "results" beside the robot
  std::string until{};              ///< the last stage to run; empty: all
  std::string only{};               ///< the one stage to run; empty: all
  bool fits_anew = false;           ///< fit the voxels although menger comes with parameters for them
  bool only_studies = false;        ///< write the studies, and run nothing
  std::filesystem::path programs;   ///< folder of the programs of menger
  const std::atomic<bool>* stop = nullptr;
  double tell_every_s = 20.0;  ///< without a terminal, time between two lines that say how far a stage is
};

/// Runs the stages that a robot asks for, one after the other, and tells of each in a line.
///
/// At a terminal a bar shows how far a stage is, elsewhere a line now and then, which names its log.
///
/// A stage is left as it is if nothing changed that decides its results: its program, its studies, the files that it reads, and
/// the results of the stages that it follows. loop.json in the folder of the results holds this. Each stage has a log in logs/.
/// A stage that ends with a numerical outcome does not stop those that need none of its results.
/// @param out where the lines go
/// @return exit code: done, numerical, interrupted, or bad_input if a program refused what it was given
/// @throws io::InputError for a wrong robot or request, before anything is written
int run_loop(LoopRequest request, std::ostream& out);

}  // namespace menger::evolution
