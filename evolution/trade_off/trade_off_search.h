#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "evolution/trade_off/trade_off_runner.h"
#include "evolution/trade_off/trade_off_study.h"
#include "evolution/trade_off/trade_off_voxels.h"
#include "io/picture/chart.h"
#include "io/text/csv_table.h"

namespace menger::evolution {

/// Result of a search with one fidelity of the surrogate and one seed. Its champion, the best design that it found, is
/// evaluated by the surrogate of the search and by the finest one of the study, and is inflated by finite elements.
struct SearchRow {
  VoxelFidelity fidelity;
  int seed = 0;
  int generations = 0;
  std::uint64_t voxel_steps = 0;                ///< see archived_voxel_steps
  double seconds = 0.0;                         ///< of all generations
  std::string champion{};                       ///< digits of its basal body; empty if there is none
  std::optional<double> own_body_lengths{};     ///< displacement on the surrogate of the search
  std::optional<double> finest_body_lengths{};  ///< displacement on the finest surrogate of the study
  /// Status of inflating the champion: a word of io::RunStatus, "failed", or "skipped" if it has more unknowns than the study
  /// allows.
  std::string element_status = "skipped";
  std::string element_reason{};
  std::optional<double> volume_change{};      ///< at the pressure, by finite elements
  std::optional<double> extent_change_x_m{};  ///< likewise, see TradeObservable::extent_x
  std::string status = "skipped";             ///< of the search: "completed", or "failed" with the reason
  std::string reason{};                       ///< why it failed, or why its champion was not evaluated by the finest surrogate
  bool is_refused = false;                    ///< failed because a program refused its input
};

/// Searches of equal cost at several fidelities.
struct SearchTrade {
  double voxel_steps = 0.0;  ///< budget; a search ends after the generation that reaches it
  VoxelFidelity finest{};    ///< evaluates all champions
  std::vector<SearchRow> rows{};
};

/// Runs all searches of a study and evaluates their champions. If a search fails or is refused, or a champion cannot be
/// evaluated, its row says so, and the others go on.
/// @param pressure_Pa to which champions are inflated, by the coarsest elements of the study
/// @throws io::InputError if [voxels] leaves no fidelity, or with the first message if all searches are refused
SearchTrade run_search_trade(const TradeStudy& study, double pressure_Pa, TradeRunner& runner);

/// Inflates the design of a study by its coarsest elements. Writes the `element_` entries of a row, the change of volume and that
/// of the extent. The status is "failed" if the design cannot be cast, and "skipped" if it has too many unknowns.
void inflate_champion(TradeStudy study, double pressure_Pa, TradeRunner& runner, SearchRow& row);

/// Returns the number of searches that found a champion.
std::size_t found_count(const SearchTrade& trade);

/// Returns the steps times voxels over all evaluations of the finished generations in an archive of `menger evolve`, see
/// generation_cost. @throws io::InputError if it is not one
std::uint64_t archived_voxel_steps(const std::filesystem::path& archive_file);

/// Makes a table with a row per search.
io::CsvTable search_csv(const SearchTrade& trade);

/// Describes for people what the searches show and what remains open, given the spread over seeds: mean and standard deviation
/// for each fidelity; whether each fidelity differs from the finest one (Welch's test at 5 %); and how many searches and
/// inflations failed, and why.
std::string search_text(const SearchTrade& trade);

/// Draws two panels against the fidelity of the search: the displacement of its champions on the finest surrogate, and their
/// elongation along x on finite elements. There is a point for each seed, and one for the mean.
io::Chart search_chart(const SearchTrade& trade);

}  // namespace menger::evolution
