#include "meshes/load_cases/limit_pressure.h"

#include <set>

namespace menger::meshes {

std::optional<LimitPressure> limit_pressure(const io::TomlTable& inflation) {
  std::optional<LimitPressure> least;
  std::set<std::string> known;
  for (const io::TomlTable& limit : inflation.optional_tables("limit_points")) {
    const LimitPressure found{limit.number("pressure_Pa"), limit.text_or("plenum", "")};
    if (!(found.pressure_Pa > 0.0) || !known.insert(found.plenum).second) continue;
    if (!least || found.pressure_Pa < least->pressure_Pa) least = found;
  }
  return least;
}

}  // namespace menger::meshes
