#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "evolution/archive/run_archive.h"
#include "evolution/evaluation/evaluator.h"
#include "evolution/report/generation_summary.h"
#include "evolution/report/walks_again.h"
#include "evolution/study/study.h"
#include "fem/thin_walls/element_choice.h"
#include "io/text/csv_table.h"
#include "io/text/run_status.h"

namespace menger::evolution {

/// Lets the best robots of a finished search on finite elements walk on finer elements: `standard` and `fine`, in all scenarios
/// of the study, measured as in the search. Of robots that differ by their pose alone the first walks. Results are re-evaluations
/// of the archive; those that it has are not made again.
/// @param study of the archive, with thin walls; as many robots as its `confirm`
/// @return completed or stopped
io::RunStatus confirm(const Study& study, RunArchive& archive, const WalksAgainOptions& options);

/// Returns the evaluators of these walks, of all fidelities and scenarios; none for a study that confirms nothing.
std::vector<std::unique_ptr<DesignEvaluator>> confirmation_evaluators_of(const Study& study);

/// A robot of a search and its score on finer elements.
struct Confirmation {
  std::size_t rank = 0;  ///< among the different robots of the search, from 1
  FitDesign design;
  fem::Fidelity fidelity = fem::Fidelity::standard;
  std::optional<double> score{};  ///< in the unit of the objective; none if it failed
  /// The displacement along that in the search, in the unit of the objective, of the scenario that counts (see known_score):
  /// negative where the robot goes back, 0 where it fell. None if the walk failed otherwise.
  std::optional<double> along{};
  std::string reason{};  ///< of the first scenario that failed
  /// The largest angle between the displacements in the search and here, over the scenarios.
  std::optional<double> angle_deg{};
};

/// Returns what an archive has of these walks, robot by robot, as far as robots have all of them.
std::vector<Confirmation> confirmations(const Study& study, const RunArchive& archive);

/// Returns what a robot is ranked by: the smallest displacement along that in the search (Confirmation::along). A fidelity on
/// which the walk failed has none. Where it is positive, it is multiplied by the share of walks that did not fail: so a robot
/// with a failed walk comes before one without only if it is that much better.
/// @param walks of one robot, on all fidelities @return in the unit of the objective; none if no walk has a score
std::optional<double> confirmed_value(std::span<const Confirmation> walks);

/// Returns the walks of the robot that a search is shown by: the one of the largest confirmed_value, of equals the one that was
/// better in the search. Empty if no robot has a walk with a score.
/// @param confirmed robot by robot, as confirmations() returns them; outlives the result
std::span<const Confirmation> best_confirmed(std::span<const Confirmation> confirmed);

/// The robot that a search is shown by.
struct Champion {
  DesignSummary design;
  std::string note{};  ///< its walks on finer elements, and why it comes before the best of the search; may be empty
};

/// Says for people, in one line, which robot is the champion, and why.
std::string champion_text(const Champion& champion);

/// Chooses the champion of a search up to a generation: the robot of the best fitness, or the best confirmed one, if there is
/// one.
/// @param confirmed may be empty @return none if no design has a fitness
std::optional<Champion> champion_of(const RunView& run, const Study& study, int generation,
                                    const std::vector<Confirmation>& confirmed);

/// Makes a table with a row per robot and fidelity.
io::CsvTable confirmation_table(const Study& study, const std::vector<Confirmation>& confirmed);

/// Describes them for people, a line per robot; empty if there are none.
std::string confirmation_text(const Study& study, const std::vector<Confirmation>& confirmed);

}  // namespace menger::evolution
