#pragma once

#include <string>
#include <string_view>

#include "io/study/study_visitor.h"

namespace menger::io {

/// The unit at the end of the name of a key: "Pa" of "pressure_Pa", "m/s2" of "gravity_m_per_s2"; empty if there is none.
std::string unit_of(std::string_view name);

/// What values a key takes, for people: `> 0`, `"explicit" | "implicit"`, `2 numbers, each > 0`; empty if any of its kind.
std::string values_of(const StudyEntry& entry);

/// What kind of value a key takes: "number", "list of texts".
std::string_view kind_of(const StudyEntry& entry);

}  // namespace menger::io
