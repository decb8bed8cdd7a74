#include "materials/laws/record_law.h"

#include <string>
#include <string_view>
#include <vector>

#include "io/text/input_error.h"
#include "materials/laws/hyperelastic_law.h"

namespace menger::materials {
namespace {

constexpr std::string_view recommended = "recommended";

}  // namespace

bool has_inline_law(const io::TomlTable& table) {
  if (!table.has("law")) return false;
  try {
    (void)table.table("law");
    return true;
  } catch (const io::InputError&) {
    return false;
  }
}

RecordLaw choose_law(const io::TomlTable& table, const SiliconeRecord& record) {
  const std::string name = table.text_or("law", recommended);
  const auto variant = table.integer_or<std::size_t>("law_variant", 1, io::at_least(1));
  if (name == recommended) {
    if (variant != 1) throw table.error("law_variant", "there is one recommended law");
    return {.law = record.recommended};
  }
  std::vector<const SourcedLaw*> matches;
  std::string known(recommended);
  for (const SourcedLaw& law : record.others) {
    if (name_of(law.law) == name) matches.push_back(&law);
    known.append(", ").append(name_of(law.law));
  }
  if (matches.empty()) throw table.error("law", "the record has " + known);
  if (variant > matches.size())
    throw table.error("law_variant", "the record has " + std::to_string(matches.size()) + " of " + name);
  return {.law = *matches[variant - 1], .variant = variant, .count = matches.size()};
}

}  // namespace menger::materials
