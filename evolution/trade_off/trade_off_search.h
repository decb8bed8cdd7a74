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

/// A search at one fidelity of the surrogate from one seed, and its champion as others judge it.
struct SearchRow {
  VoxelFidelity fidelity;
  int seed = 0;
  int generations = 0;
  std::uint64_t voxel_steps = 0;                ///< steps by voxels over all evaluations, that the archive holds
  double seconds = 0.0;                         ///< of all generations
  std::string champion{};                       ///< digits of its basal body; empty if there is none
  std::optional<double> own_body_lengths{};     ///< walked, by the surrogate that it was searched with
  std::optional<double> finest_body_lengths{};  ///< by the finest surrogate of the study
  std::string element_status = "skipped";       ///< of inflating it: a word of io::RunStatus, "failed", or "skipped" where it
                                                ///< has more unknowns than the study allows
  std::string element_reason{};
  std::optional<double> volume_change{};      ///< at the pressure, by finite elements
  std::optional<double> extent_change_x_m{};  ///< the same, see TradeObservable::extent_x
  std::string status = "skipped";             ///< of the search: "completed", or "failed" with the reason
  std::string reason{};                       ///< why it failed, or why its champion was not judged by the finest surrogate
  bool is_refused = false;                    ///< failed because a program called its input wrong
};

/// Searches of equal cost at several fidelities.
struct SearchTrade {
  double voxel_steps = 0.0;  ///< the budget; a search stops after the generation in which it was reached
  VoxelFidelity finest{};    ///< that judges all champions
  std::vector<SearchRow> rows{};
};

/// Runs all searches of a study and judges their champions. A search that fails or is refused stands in its row, and so does a
/// champion that cannot be judged; the others go on.
/// @param pressure_Pa that champions are inflated to, by the coarsest elements of the study
/// @throws io::InputError if [voxels] leaves no fidelity, or with the first message if all searches are refused
SearchTrade run_search_trade(const TradeStudy& study, double pressure_Pa, TradeRunner& runner);

/// Inflates the design of a study by its coarsest elements, with the outcome in the `element_` entries of a row, its volume and
/// its extent; a design that cannot be cast is "failed", one with too many unknowns "skipped".
void inflate_champion(TradeStudy study, double pressure_Pa, TradeRunner& runner, SearchRow& row);

/// Searches that found a champion.
std::size_t found_count(const SearchTrade& trade);

/// Steps by voxels over all evaluations of an archive of `menger evolve`. @throws io::InputError if it is none
std::uint64_t archived_voxel_steps(const std::filesystem::path& archive_file);

io::CsvTable search_csv(const SearchTrade& trade);

/// What the searches tell and what they do not, given the spread over seeds: mean and standard deviation for each fidelity, and
/// for each but the finest whether it differs from the finest one (Welch's test at 5 %); at the end how many searches and
/// inflations failed, and why.
std::string search_text(const SearchTrade& trade);

/// Two panels over the fidelity of the search: how far its champions walk by the finest surrogate, and how much they lengthen
/// along x on finite elements. A point for each seed, and one for the mean.
io::Chart search_chart(const SearchTrade& trade);

}  // namespace menger::evolution
