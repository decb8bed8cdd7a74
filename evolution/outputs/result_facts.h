#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "evolution/outputs/command_outputs.h"
#include "evolution/posture/bend.h"
#include "io/text/run_status.h"
#include "meshes/load_cases/limit_pressure.h"

namespace menger::evolution {

/// What an inflation says.
struct InflationFacts {
  std::string name{};    ///< of the body
  std::string place{};   ///< where the results are, relative to the folder of the report
  std::string source{};  ///< files, likewise
  io::RunStatus status = io::RunStatus::stopped;
  std::string reason{};
  std::optional<double> highest_pressure_Pa{};  ///< of an equilibrium that was found
  std::optional<double> lowest_pressure_Pa{};   ///< likewise
  std::optional<double> last_pressure_Pa{};     ///< of the last equilibrium, see the function of this name
  std::optional<meshes::LimitPressure> limit{};
  std::optional<double> volume_growth{};  ///< of the plenum that grows most, at the highest pressure or the strongest vacuum if
                                          ///< there is no other, as a fraction
  std::size_t plena = 0;
  std::optional<double> sideways_m{};  ///< how far the middle of the far end of a body that is free moves across it
  StatedRun stated{};
};

/// What a calibration says.
struct CalibrationFacts {
  std::string source{};
  io::RunStatus status = io::RunStatus::stopped;
  std::string reason{};
  bool explained = true;                 ///< whether the uncertainties of the curves explain the residuals
  std::size_t cases = 0;                 ///< load cases with fitted quantities
  std::size_t quantities = 0;            ///< that were fitted and have an error
  std::optional<double> median_error{};  ///< of these, as fractions of the largest value of each
  std::optional<double> worst_error{};
  std::string worst_case{};
};

/// The errors of one kind of numbers inside the range of validity.
struct ErrorFact {
  std::size_t count = 0;
  std::size_t without_equilibrium = 0;
  std::optional<double> median{};
  std::optional<double> percentile_90{};
  std::optional<double> worst{};
  std::string worst_body{};
  std::string worst_observable{};  ///< for people: "extent y"
  // Of displacements, as lengths; nothing in results of earlier versions.
  std::optional<double> median_m{};
  std::optional<double> worst_m{};         ///< of the number with the worst error
  std::optional<double> furthest_m{};      ///< the largest over the length of its body
  std::optional<double> furthest_error{};  ///< the same as an error
  std::string furthest_body{};
  std::string furthest_observable{};
};

/// What a validation says.
struct ValidationFacts {
  std::string source{};
  std::size_t bodies = 0;
  std::string early_end{};  ///< of the finite elements of a loop's robot: status and reason; empty if they reached all states
  ErrorFact displacement{};
  ErrorFact volume{};
  std::size_t outside = 0;                       ///< numbers outside the range of validity
  std::optional<double> displacement_outside{};  ///< median error of the displacements there
  std::optional<double> volume_outside{};        ///< likewise of the chamber volumes
  std::vector<std::string> outside_why{};        ///< for people, why: "it is longer than the bodies of the fit"; each once
  std::size_t signs = 0;                         ///< displacements that are large enough to have a direction
  std::size_t wrong_signs = 0;                   ///< of these, those that go the other way in the surrogate
  std::vector<std::string> wrong_ways{};         ///< "extent y (5 of 5)": displacements of one kind that go the wrong way
};

enum class WalkModel { elements, surrogate, voxels };

/// Returns the words for a model: "finite elements", "the surrogate", "voxels".
const char* to_string(WalkModel model);

/// What a walk says.
struct WalkFacts {
  std::string name{};   ///< of the body
  std::string place{};  ///< where the results are, relative to the folder of the report
  std::string source{};
  WalkModel model = WalkModel::elements;
  io::RunStatus status = io::RunStatus::stopped;
  std::string reason{};
  double time_s = 0.0;
  std::optional<double> body_lengths{};  ///< horizontal displacement; exists if completed
  std::optional<double> per_minute{};    ///< body lengths per minute
  std::optional<double> direction_deg{};
  std::optional<double> lowest_lengths{};       ///< along the line from start to end, body lengths: how far back it comes
  std::optional<double> highest_lengths{};      ///< likewise: how far it goes
  std::optional<double> retreat_lengths{};      ///< likewise: how far it comes back at most from the furthest that it has been
  std::optional<double> farthest_lengths{};     ///< the largest horizontal distance from the start, in whatever direction
  std::optional<double> farthest_m{};           ///< the same
  std::optional<double> end_m{};                ///< the horizontal distance at the end
  std::optional<double> fell_s{};               ///< when the body fell over, if it did
  std::vector<std::string> expected_error{};    ///< of a surrogate
  std::vector<std::string> outside_validity{};  ///< of a surrogate
  StatedRun stated{};
};

/// A number with its 95 % interval.
struct IntervalFact {
  double value = 0.0;
  std::optional<double> low{};
  std::optional<double> high{};
};

/// What a re-evaluation says.
struct RankingFacts {
  std::string source{};
  std::string compared_with = "the surrogate";  ///< or "the search", if finite elements decided it
  std::size_t designs = 0;                      ///< re-evaluated
  std::size_t compared = 0;                     ///< completed in both models
  std::optional<IntervalFact> spearman{};
  std::optional<std::size_t> within_45_deg{};
  std::optional<std::size_t> with_direction{};
  std::optional<double> median_error{};  ///< of the displacement of the surrogate, as a fraction
  std::optional<double> best_per_minute{};
  std::string best_design{};  ///< "rank 2 of the search"
};

/// A walk of one of the best robots of a search on finer elements.
struct ConfirmedWalk {
  std::string rank{};                 ///< of the robot, among the different robots of the search, from 1
  std::string individual{};           ///< its number in the search
  std::optional<double> fitness{};    ///< in the search
  std::string elements{};             ///< "standard"
  std::optional<double> score{};      ///< in the unit of the fitness; none if the walk failed
  std::optional<double> angle_deg{};  ///< between the ways in the search and here
  std::string reason{};               ///< why it failed
};

/// What a search says.
struct SearchFacts {
  std::string source{};
  std::size_t generations = 0;            ///< finished, generation 0 included
  std::string first_generation{};         ///< number of the first one with a fitness
  std::optional<double> first_fitness{};  ///< the best in it
  std::string last_generation{};          ///< number of the last one with a fitness
  std::optional<double> last_fitness{};   ///< the best in it
  std::string unit{};                     ///< of the fitness, for people
  std::optional<double> evaluations{};
  std::vector<ConfirmedWalk> confirmed{};  ///< robot by robot, the best first; empty if none walked on finer elements
  bool is_walk = true;  ///< whether the last fitness is that of a walk, see meshes::walk_limits; true where it is not known
};

/// What natural frequencies say.
struct ModesFacts {
  std::string source{};
  io::RunStatus status = io::RunStatus::stopped;
  std::optional<double> first_frequency_Hz{};  ///< the lowest at the first pressure
};

/// Parameters of a surrogate that were not fitted here.
struct ShippedParameters {
  std::string file{};    ///< the name of those that come with menger
  std::string source{};  ///< the manifest that says so
};

/// What all outputs in a folder say.
struct ReportFacts {
  std::vector<InflationFacts> inflations{};
  std::vector<CalibrationFacts> calibrations{};
  std::vector<ValidationFacts> validations{};
  std::vector<WalkFacts> walks{};
  std::vector<RankingFacts> rankings{};
  std::vector<SearchFacts> searches{};
  std::vector<ModesFacts> modes{};
  std::vector<ShippedParameters> shipped{};  ///< each file once
  bool robot_walks = true;                   ///< false if the results are of a loop's robot that is only inflated
  /// At which the body of a loop balloons by the softest law of its silicone, where that is softer than the law it has.
  std::optional<double> softest_limit_Pa{};
};

/// Returns how a body that floats free bends in its inflation; nothing for others, or if its states cannot be read, which is told
/// where they are shown in 3-D.
std::optional<Bend> bend_of(const CommandOutput& inflation);

/// Reads what the outputs say. @param notes gets a sentence for every file that is missing or cannot be read
ReportFacts read_facts(const std::vector<CommandOutput>& outputs, std::vector<std::string>& notes);

}  // namespace menger::evolution
