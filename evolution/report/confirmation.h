#pragma once

#include <cstddef>
#include <memory>
#include <optional>
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
  std::string reason{};           ///< of the first scenario that failed
  /// The largest angle between the displacements in the search and here, over the scenarios.
  std::optional<double> angle_deg{};
};

/// Returns what an archive has of these walks, robot by robot, as far as robots have all of them.
std::vector<Confirmation> confirmations(const Study& study, const RunArchive& archive);

/// Returns the robot that a search is shown by: of those that walk on all finer elements, the one with the best score on the
/// finest. None if none of them does.
/// @param confirmed robot by robot, as confirmations() returns them
std::optional<Confirmation> best_confirmed(const Study& study, const std::vector<Confirmation>& confirmed);

/// The robot that a search is shown by.
struct Champion {
  DesignSummary design;
  std::string note{};  ///< what confirmation has to say about the choice; may be empty
};

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
