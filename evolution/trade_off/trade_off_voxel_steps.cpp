#include <SQLiteCpp/SQLiteCpp.h>

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "evolution/archive/run_archive.h"
#include "evolution/genome/decoder.h"
#include "evolution/trade_off/trade_off_search.h"
#include "io/text/input_error.h"

namespace menger::evolution {

std::uint64_t archived_voxel_steps(const std::filesystem::path& archive_file) {
  struct Evaluated {
    std::string design_hash;
    int level;
    std::uint64_t steps;
  };
  std::vector<Evaluated> evaluations;
  std::set<int> levels;
  const RunArchive archive = RunArchive::open_to_read(archive_file);  // says what is wrong with a file that is none
  try {
    const SQLite::Database database(archive_file.string(), SQLite::OPEN_READONLY);
    SQLite::Statement rows(database, "SELECT design_hash, level, steps FROM evaluation");
    while (rows.executeStep()) {
      evaluations.push_back(
          {rows.getColumn(0).getString(), rows.getColumn(1).getInt(), static_cast<std::uint64_t>(rows.getColumn(2).getInt64())});
      levels.insert(evaluations.back().level);
    }
  } catch (const SQLite::Exception& error) {
    throw io::InputError(archive_file.string() + ": cannot be read: " + error.what());
  }
  std::map<std::pair<std::string, int>, std::uint64_t> cells;
  for (std::uint64_t id = 0; id < archive.next_id(); ++id) {
    const Phenotype phenotype = archive.individual(id).phenotype;
    for (const int level : levels) cells[{design_hash(phenotype, level), level}] = aggregate_cell_count(phenotype, level);
  }
  std::uint64_t sum = 0;
  for (const Evaluated& evaluated : evaluations) sum += evaluated.steps * cells[{evaluated.design_hash, evaluated.level}];
  return sum;
}

}  // namespace menger::evolution
