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

/// A line as a study gives it: by its resistance and volume, or as a round tube.
struct StudyLine {
  struct Tube {
    double length_m = 0.0;  ///< > 0
    RoundBore bore{};
  };
  double resistance_Pa_s_per_m3 = 0.0;  ///< >= 0
  double volume_m3 = 0.0;               ///< >= 0
  std::optional<Tube> tube{};           ///< in place of the two

  [[nodiscard]] PneumaticLine line() const;
};

/// What drives a plenum.
enum class SupplyKind {
  schedule,  ///< it has the pressure of its schedule
  line,      ///< the schedule is that of a source behind a line
  piston     ///< a piston behind a line
};

/// What drives one plenum, as a study gives it.
struct StudyPlenum {
  std::string plenum{};  ///< name
  SupplyKind supply = SupplyKind::schedule;
  std::string piston{};                         ///< name; of a plenum behind a piston
  PlenumSchedule schedule{};                    ///< of all others
  std::optional<std::filesystem::path> file{};  ///< that a table of pressures was read from
  StudyLine line{};                             ///< of those behind one
};

/// What drives the plena of a body, as a study gives it. A plenum that is not named stays at 0 Pa.
struct StudySupply {
  PneumaticGas gas{};
  std::vector<Piston> pistons{};
  std::vector<StudyPlenum> plena{};
};

/// The keys of a gas, in a table of its own.
void describe(io::StudyVisitor& visitor, PneumaticGas& gas);

/// The tables [gas], [[piston]] and [[pressure]]. A reader refuses plena and pistons that are named twice, strokes beyond the
/// cylinder or that leave its air no room, pressures at or below vacuum, and pistons that supply no plenum.
void describe(io::StudyVisitor& visitor, StudySupply& supply);

/// What was given, for the plena of a body.
/// @param study that it was read from @throws io::InputError with file, key and value for plena that the body has not
PneumaticSupply supply_of(const StudySupply& given, std::span<const std::string> plenum_names, const io::TomlTable& study);

}  // namespace menger::fem
