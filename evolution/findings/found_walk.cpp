#include "evolution/findings/found_walk.h"

#include <vector>

#include "evolution/findings/result_files.h"
#include "evolution/posture/fall.h"
#include "io/shown/shown_quantity.h"
#include "io/text/formatted.h"
#include "io/text/input_error.h"

namespace menger::evolution {

namespace fs = std::filesystem;

using io::millimetres;

std::optional<FoundWalk> walk_in(const fs::path& file, const io::TomlTable& result, const meshes::Robot& robot) {
  if (!result.has("displacement_m")) return std::nullopt;
  const std::vector<double> moved_m = result.numbers("displacement_m");
  if (moved_m.size() != 3) return std::nullopt;
  FoundWalk walk{moved_m[0], moved_m[1], result.number("horizontal_displacement_body_lengths"), result.number("time_s")};
  try {
    if (const auto fall = fall_in_walk(file.parent_path(), 1.0 / robot.frequency_Hz)) walk.fell_s = fall->time_s;
  } catch (const io::InputError&) {
    // Frames that cannot be read tell of no fall, and the walk is known without them.
  }
  return walk;
}

std::string fall_text(const FoundWalk& walk) { return walk.fell_s ? "fell over at " + io::shown(*walk.fell_s, 2) + " s" : ""; }

std::string walk_text(const fs::path& file, const meshes::Robot& robot) {
  const auto result = table_at(file);
  if (!result) return "";
  const std::optional<FoundWalk> walk = walk_in(file, *result, robot);
  if (!walk) return early_end(*result);
  std::string text = "it moves " + millimetres(walk->distance_m()) + " (" + io::body_lengths(walk->body_lengths) + ") in " +
                     io::shown(walk->time_s, 3) + " s";
  if (walk->fell_s) text += ", but " + fall_text(*walk) + ": this is no walk";
  if (const std::string end = early_end(*result); !end.empty()) text += "; " + end;
  return text;
}

}  // namespace menger::evolution
