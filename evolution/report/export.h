#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "evolution/report/generation_summary.h"
#include "evolution/study/study.h"
#include "voxel/simulate/simulation_run.h"

namespace menger::evolution {

/// The highest level that a champion is exported at.
inline constexpr int largest_exported_level = 5;

/// What is exported besides the tables.
struct ExportOptions {
  std::vector<int> levels{1, 2, 3};  ///< at which the champion is simulated, whatever levels the study evaluated
  double record_interval_s = 0.02;   ///< > 0; limited to the duration
  bool frames = true;                ///< VTK
  bool pictures = true;              ///< PNG
  bool individuals = false;          ///< individuals.csv
  bool timings = false;              ///< timings.csv and schedule.csv, whose content depends on how fast the machine was
  std::vector<std::size_t> workers{2, 8, 64};  ///< of schedule.csv, each >= 1
  const std::atomic<bool>* stop = nullptr;
  std::function<void(int level, const voxel::RunProgress&)> progress;
  std::function<void()> begins{};  ///< called when everything is checked, before the first file is written
};

/// The champion's simulation at one level.
struct LevelResult {
  int level = 1;
  std::size_t cells = 0;     ///< of the whole body
  voxel::SceneResult scene;  ///< of a walk on finite elements its status, reason and displacement
};

/// The result of an export.
struct ExportResult {
  io::RunStatus status = io::RunStatus::completed;  ///< completed, stopped, or that of the first simulation that did not complete
  std::optional<DesignSummary> champion;            ///< see export_run; none if no design has a fitness
  std::string champion_line{};                      ///< which robot this is, and why (champion_text); empty if there is none
  std::vector<LevelResult> levels;
  std::vector<std::string> notes;  ///< pictures that could not be made; a simulation that differs from the archive
};

/// Writes the tables and the champion of an archive into a folder. The champion is the robot of the best fitness. If robots were
/// confirmed on finer elements, it is the best of those that walk there (best_confirmed), if any do.
/// - generations.csv, lineage.csv and costs.csv (see generations_table, lineage_table, cost_table);
/// - if the time step was checked, check_dt.csv (step_check_table);
/// - if robots were confirmed on finer elements, confirmed.csv (confirmation_table);
/// - of a search on finite elements, refused.csv (refusal_table);
/// - if bodies survived by niches, niches.csv (niche_table);
/// - if there are scenarios, scenarios.csv (scenario_table);
/// - if the archive has displacements by period, periods.csv with those of the champion, in the scenario that decided;
/// - champion.toml, the basal body; if arrangements are evolved too, champion_level_<n>.toml with the whole bodies;
/// - level_<n>/ with scene.toml and the files of voxel::run_scene, and champion.png with all levels side by side;
/// - of a search on finite elements instead: level_1/ with the files of fem::run_locomotion, and champion_walk.toml, a study of
///   menger locomote for the same walk;
/// - with ExportOptions::individuals, individuals.csv (individual_table);
/// - with ExportOptions::timings, timings.csv and schedule.csv (timing_table, schedule_table).
///
/// Everything except the manifest, pictures and timings depends on the content of the archive alone.
/// @throws io::InputError if the archive has no finished generation, the champion has no such level or one that does not fit into
/// memory, or the folder cannot be written
ExportResult export_run(const RunArchive& archive, const std::filesystem::path& folder, const ExportOptions& options = {});

/// Returns the table that the program prints: level, cells, displacement, speed.
std::string export_text(const Study& study, const ExportResult& result);

}  // namespace menger::evolution
