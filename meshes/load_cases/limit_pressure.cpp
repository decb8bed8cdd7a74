#include "meshes/load_cases/limit_pressure.h"

#include <set>

#include "io/shown/shown_quantity.h"
#include "io/text/formatted.h"

namespace menger::meshes {

std::string safe_margin_text() { return io::percents(1.0 - largest_safe_share); }

std::string thin_wall_excess_text() {
  return io::formatted("%.0f to ", 100.0 * least_thin_wall_excess) + io::formatted("%.0f %%", 100.0 * largest_thin_wall_excess);
}

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
