#include "io/process/study_command.h"

#include <array>
#include <utility>

#include "io/text/input_error.h"
#include "io/text/is_file.h"
#include "io/text/toml_document.h"

namespace menger::io {
namespace {

// What menger --schema of each command prints at its top; that of modes is the same as that of inflate.
constexpr std::array<std::pair<std::string_view, std::string_view>, 11> top_keys{{
    {"mesh", "design "},
    {"inflate", "design elements loads material mesh output path plates solver supports "},
    {"stall-map", "gas line map mark piston plenum travel "},
    {"locomote", "design drive dynamics elements gas ground loads material output piston pressure schema_version sweep time "},
    {"load-cases",
     "body bulk_modulus_Pa case density_kg_per_m3 elements largest_stretch law law_name law_variant relative_uncertainty "
     "silicone smallest_stretch volumetric "},
    {"calibrate", "bounds cases curves fit frequency_response holds_for silicone weights "},
    {"validate", "actuation_amplitude actuation_pressure_Pa aim curves load_cases parameters "},
    {"tradeoff", "design finite_elements gait observables pressure_Pa search settling silicone target_relative_errors voxels "},
    {"simulate",
     "collisions damping design drive energy_ledger ground integration limits loads materials output surrogate time "},
    {"evolve",
     "body budget check_dt collisions damping drive elements evaluation generations genome ground integration limits loads "
     "map_elites material materials population preset robust seed surrogate time "},
    {"reevaluate", "compare_with elements ground least_body_lengths level sample_seed silicone time time_limit_s variants "},
}};

/// Whether all keys at the top of a file are among these.
bool has_only(const TomlTable& file, std::string_view keys) {
  const TomlTable table = file.unasked();
  while (!keys.empty()) {
    const std::size_t end = keys.find(' ');
    static_cast<void>(table.asks_for(keys.substr(0, end)));
    keys.remove_prefix(end + 1);
  }
  try {
    table.finish();
  } catch (const InputError&) {
    return false;
  }
  return true;
}

}  // namespace

std::string_view top_keys_of(std::string_view command) {
  for (const auto& [name, keys] : top_keys)
    if (name == (command == "modes" ? "inflate" : command)) return keys;
  return {};
}

std::string command_of_study(const std::filesystem::path& file, std::string_view program) {
  constexpr std::string_view prefix = "menger-";
  const std::string_view own = program.starts_with(prefix) ? top_keys_of(program.substr(prefix.size())) : std::string_view();
  if (own.empty() || file.extension() != ".toml" || !is_file(file)) return {};
  std::string found;
  try {
    const TomlTable table = read_toml(file);
    if (has_only(table, own)) return {};
    for (const auto& [command, keys] : top_keys) {
      if (!has_only(table, keys)) continue;
      if (!found.empty()) return {};
      found = command;
    }
  } catch (const InputError&) {  // no TOML: the error that is there says so
    return {};
  }
  return found;
}

}  // namespace menger::io
