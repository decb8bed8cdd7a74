#include "io/study/key_text.h"

#include <array>
#include <utility>

namespace menger::io {
namespace {

/// Longer ones first: "_m_per_s2" ends with "_s2", and "_Pa_s_per_m3" with "_m3".
constexpr std::array<std::pair<std::string_view, std::string_view>, 22> units{{{"_Pa_s_per_m3", "Pa s/m3"},
                                                                               {"_N_per_m", "N/m"},
                                                                               {"_kg_per_m3", "kg/m3"},
                                                                               {"_Pa_per_m", "Pa/m"},
                                                                               {"_m_per_s2", "m/s2"},
                                                                               {"_m_per_s", "m/s"},
                                                                               {"_kg_m3", "kg/m3"},
                                                                               {"_m_s2", "m/s2"},
                                                                               {"_per_s", "1/s"},
                                                                               {"_per_Pa", "1/Pa"},
                                                                               {"_Pa_s", "Pa s"},
                                                                               {"_rad", "rad"},
                                                                               {"_deg", "degrees"},
                                                                               {"_m3", "m3"},
                                                                               {"_m2", "m2"},
                                                                               {"_Hz", "Hz"},
                                                                               {"_Pa", "Pa"},
                                                                               {"_kg", "kg"},
                                                                               {"_m", "m"},
                                                                               {"_s", "s"},
                                                                               {"_J", "J"},
                                                                               {"_N", "N"}}};

std::string count_text(const Count& count) {
  constexpr std::size_t any = Count{}.most;
  if (count.fewest == count.most) return std::to_string(count.fewest);
  if (count.most == any) return count.fewest == 0 ? "" : std::to_string(count.fewest) + " or more";
  return std::to_string(count.fewest) + " to " + std::to_string(count.most);
}

bool is_list(ValueKind kind) { return kind == ValueKind::integers || kind == ValueKind::numbers || kind == ValueKind::texts; }

}  // namespace

std::string unit_of(std::string_view name) {
  for (const auto& [suffix, unit] : units) {
    if (name.ends_with(suffix)) return std::string(unit);
  }
  return "";
}

std::string values_of(const StudyEntry& entry) {
  std::string each = list_of_words(entry.words);
  std::string range = entry.range.demand();
  if (constexpr std::string_view must_be = "must be "; range.starts_with(must_be)) range.erase(0, must_be.size());
  if (!range.empty()) each = range + (each.empty() ? "" : " | ") + each;
  if (!is_list(entry.kind)) return each;
  const std::string count = count_text(entry.count);
  if (count.empty()) return each.empty() ? "" : "each " + each;
  return count + (count == "1" ? " value" : " values") + (each.empty() ? "" : ", each " + each);
}

std::string_view kind_of(const StudyEntry& entry) {
  switch (entry.kind) {
    case ValueKind::boolean:
      return "true or false";
    case ValueKind::integer:
      return "integer";
    case ValueKind::number:
      return "number";
    case ValueKind::text:
      return entry.words.empty() ? "text" : "word";
    case ValueKind::path:
      return "file";
    case ValueKind::integers:
      return "list of integers";
    case ValueKind::numbers:
      return "list of numbers";
    case ValueKind::texts:
      return entry.words.empty() ? "list of texts" : "list of words";
    case ValueKind::text_rows:
      return "list of lists of texts";
  }
  return "";
}

}  // namespace menger::io
