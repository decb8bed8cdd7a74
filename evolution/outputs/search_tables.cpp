#include "evolution/outputs/search_tables.h"

#include <algorithm>
#include <filesystem>
#include <set>

#include "evolution/archive/archive_files.h"
#include "evolution/archive/run_archive.h"
#include "evolution/report/confirmation.h"
#include "evolution/report/generation_summary.h"
#include "evolution/report/study_view.h"
#include "evolution/study/study_file.h"
#include "io/text/content_hash.h"
#include "io/text/input_error.h"
#include "io/text/is_file.h"

namespace menger::evolution {
namespace {

namespace fs = std::filesystem;

fs::path archive_of(const CommandOutput& evolved) { return archive_beside(evolved.manifest, ".manifest.json"); }

/// A table of an export, if it has it.
std::optional<io::CsvContents> exported_table(const CommandOutput& exported, const char* name) {
  const fs::path table = exported.folder / name;
  if (!io::is_file(table)) return std::nullopt;
  return io::read_csv(table);
}

bool reads_study(const CommandOutput& output, const std::string& hash) {
  return std::ranges::any_of(output.inputs, [&](const auto& input) { return input.second == hash; });
}

/// Sets the lineage to that in an export of an archive, if there is one of as many generations that can be read.
void take_exported_lineage(SearchTables& tables, const std::string& study_hash, const std::vector<CommandOutput>& outputs) {
  for (const CommandOutput& output : outputs) {
    if (command_of(output) != "export" || !reads_study(output, study_hash)) continue;
    const fs::path table = output.folder / "generations.csv";
    try {
      if (!io::is_file(table) || io::read_csv(table).row_count() != tables.generations.row_count()) continue;
      tables.lineage = exported_table(output, "lineage.csv");
    } catch (const io::InputError&) {
      continue;  // a damaged export says nothing of its archive
    }
    if (!tables.lineage) continue;
    tables.lineage_source = file_of(output, "lineage.csv");
    return;
  }
}

SearchTables tables_of_archive(const CommandOutput& evolved, const std::vector<CommandOutput>& outputs) {
  const fs::path file = archive_of(evolved);
  const RunArchive archive = RunArchive::open_to_read(file);
  const Study study = archived_study(archive);
  const RunView run = view_of(archive, study);
  const auto last = archive.last_generation();
  if (!last) throw io::InputError(file.string() + ": has no finished generation");
  SearchTables tables{.source = file_of(evolved, file.filename().string()),
                      .generations = io::parse_csv(generations_table(run).text(), file),
                      .lineage = std::nullopt};
  tables.is_of_period = measured_periods(study).has_value();
  tables.walk_over_fitness = walked_body_lengths(study, 1.0);
  if (const std::vector<Confirmation> confirmed = confirmations(study, archive); !confirmed.empty())
    tables.confirmed = io::parse_csv(confirmation_table(study, confirmed).text(), file);
  take_exported_lineage(tables, io::content_hash(archive.study()), outputs);
  if (tables.lineage) return tables;
  tables.lineage_of = "the fittest robot";
  tables.lineage_source = tables.source;
  if (const auto fittest = summarise_generation(run, *last).champion)
    tables.lineage = io::parse_csv(lineage_table(run, fittest->individual.id).text(), file);
  return tables;
}

SearchTables exported_tables(const CommandOutput& exported) {
  return {.source = file_of(exported, "generations.csv"),
          .generations = io::read_csv(exported.folder / "generations.csv"),
          .lineage = exported_table(exported, "lineage.csv"),
          .lineage_source = file_of(exported, "lineage.csv"),
          .confirmed = exported_table(exported, "confirmed.csv")};
}

/// The hash of the study in an archive, by which exports name it; empty if it cannot be read.
std::string study_hash(const CommandOutput& evolved) {
  try {
    return io::content_hash(RunArchive::open_to_read(archive_of(evolved)).study());
  } catch (const io::InputError&) {
    return {};
  }
}

}  // namespace

SearchTables read_search_tables(const CommandOutput& output, const std::vector<CommandOutput>& outputs) {
  return command_of(output) == "evolve" ? tables_of_archive(output, outputs) : exported_tables(output);
}

std::vector<const CommandOutput*> searches_in(const std::vector<CommandOutput>& outputs) {
  std::set<std::string> archived;
  for (const CommandOutput& output : outputs)
    if (command_of(output) == "evolve") archived.insert(study_hash(output));
  archived.erase("");
  const auto is_archived = [&](const CommandOutput& output) {
    return std::ranges::any_of(output.inputs, [&](const auto& input) { return archived.contains(input.second); });
  };
  std::vector<const CommandOutput*> searches;
  for (const CommandOutput& output : outputs)
    if (command_of(output) == "evolve" || (command_of(output) == "export" && !is_archived(output))) searches.push_back(&output);
  return searches;
}

std::string fitness_unit(const SearchTables& tables) {
  const std::string unit = fitness_column(tables.generations).ends_with("_body_lengths") ? "body lengths" : "m\u00b2";
  return unit + (tables.is_of_period ? " in a period of the drive" : "");
}

std::string fitness_column(const io::CsvContents& generations) {
  for (const std::string& column : generations.columns())
    if (column.starts_with("best_fitness_")) return column;
  return {};
}

}  // namespace menger::evolution
