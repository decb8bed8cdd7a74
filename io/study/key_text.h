#pragma once

#include <string>
#include <string_view>

#include "io/study/study_visitor.h"

namespace menger::io {

/// Returns the unit at the end of the name of a key: "Pa" for "pressure_Pa", "m/s2" for "gravity_m_per_s2"; empty if there is
/// none.
std::string unit_of(std::string_view name);

/// Returns the values that a key accepts, for people: `> 0`, `"explicit" | "implicit"`, `2 numbers, each > 0`. Empty if every
/// value of its kind is accepted.
std::string values_of(const StudyEntry& entry);

/// Returns the kind of value that a key takes: "number", "list of texts".
std::string_view kind_of(const StudyEntry& entry);

}  // namespace menger::io
