#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "fem/pneumatics/pneumatic_supply.h"
#include "io/study/study_visitor.h"
#include "io/text/toml_document.h"

namespace menger::fem {

/// A line as a study describes it: by its resistance and volume, or as a round tube.
struct StudyLine {
  struct Tube {
    double length_m = 0.0;  ///< > 0
    RoundBore bore{};
  };
  double resistance_Pa_s_per_m3 = 0.0;  ///< >= 0
  double volume_m3 = 0.0;               ///< >= 0
  std::optional<Tube> tube{};           ///< replaces resistance and volume

  [[nodiscard]] PneumaticLine line() const;
};

/// The kind of supply of a plenum.
enum class SupplyKind {
  schedule,  ///< the plenum has the pressure of its schedule
  line,      ///< the schedule is that of a source behind a line
  piston     ///< a piston behind a line
};

/// The supply of one plenum, as a study describes it.
struct StudyPlenum {
  std::string plenum{};  ///< name
  SupplyKind supply = SupplyKind::schedule;
  std::string piston{};                         ///< name of the piston, for a plenum behind one
  PlenumSchedule schedule{};                    ///< for plena that are not behind a piston
  std::optional<std::filesystem::path> file{};  ///< file from which a table of pressures was read
  StudyLine line{};                             ///< for plena behind a line
};

/// The supplies of the plena of a body, as a study describes them. A plenum that is not named stays at 0 Pa.
struct StudySupply {
  PneumaticGas gas{};
  std::vector<Piston> pistons{};
  std::vector<StudyPlenum> plena{};
};

/// Names the keys of a gas, in a table of its own.
void describe(io::StudyVisitor& visitor, PneumaticGas& gas);

/// Names the tables [gas], [[piston]] and [[pressure]] with their keys. A reader rejects plena and pistons that are named twice,
/// strokes longer than the cylinder or that leave its air no volume, pressures at or below vacuum, and pistons that supply no
/// plenum.
void describe(io::StudyVisitor& visitor, StudySupply& supply);

/// Returns the supplies of the plena of a body as the study describes them.
/// @param study from which they were read @throws io::InputError with file, key and value if the body does not have a named
/// plenum
PneumaticSupply supply_of(const StudySupply& given, std::span<const std::string> plenum_names, const io::TomlTable& study);

}  // namespace menger::fem
