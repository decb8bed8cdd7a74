#include "io/study/study_keys.h"

#include <algorithm>
#include <array>
#include <utility>

#include "io/study/key_text.h"
#include "io/study/study_text.h"

namespace menger::io {

std::string StudyKeyTable::text() const {
  const std::array columns{&KeyRow::name, &KeyRow::kind, &KeyRow::unit, &KeyRow::standard, &KeyRow::values};
  const std::array<std::string_view, 5> titles{"key", "kind", "unit", "default", "values"};
  std::array<std::size_t, 5> widths{};
  for (std::size_t c = 0; c < columns.size(); ++c) {
    widths.at(c) = titles.at(c).size();
    for (const KeyRow& row : rows_) widths.at(c) = std::max(widths.at(c), (row.*columns.at(c)).size());
  }
  std::string all;
  const auto add = [&](std::size_t c, std::string_view cell) { all.append(cell).append(widths.at(c) - cell.size() + 2, ' '); };
  for (std::size_t c = 0; c < columns.size(); ++c) add(c, titles.at(c));
  all += "meaning\n";
  for (const KeyRow& row : rows_) {
    for (std::size_t c = 0; c < columns.size(); ++c) add(c, row.*columns.at(c));
    all += row.help + (row.condition.empty() ? "" : " Only with " + row.condition + ".") + "\n";
  }
  return all;
}

void StudyKeyTable::inside(const Key& key, bool is_entry, const std::function<void()>& describe) {
  const std::string outer = prefix_;
  prefix_.append(key.name).append(is_entry ? "[]." : ".");
  describe();
  prefix_ = outer;
}

void StudyKeyTable::under(std::string_view condition, const std::function<void()>& describe) {
  const std::string outer = std::exchange(condition_, std::string(condition));
  describe();
  condition_ = outer;
}

void StudyKeyTable::visit_choice(const std::vector<Alternative>& alternatives, std::string_view missing) {
  const auto forms = std::ranges::count(alternatives, false, &Alternative::is_for_programs);
  const std::size_t outer = std::exchange(forms_, static_cast<std::size_t>(forms));
  EveryKeyVisitor::visit_choice(alternatives, missing);
  forms_ = outer;
}

void StudyKeyTable::visit(const StudyEntry& entry, std::optional<StudyValue>& value) {
  KeyRow row{.name = prefix_ + std::string(entry.key.name),
             .kind = std::string(kind_of(entry)),
             .unit = unit_of(entry.key.name),
             .standard = value ? study_value_text(*value) : "none",
             .values = values_of(entry),
             .help = std::string(entry.key.help),
             .condition = condition_};
  if (entry.is_required()) row.standard = forms_ > 1 ? "one of several" : "must be given";
  // a key that means the same under several conditions has one row
  const auto is_same = [&](const KeyRow& other) { return other.name == row.name && other.help == row.help; };
  const auto same = std::ranges::find_if(rows_, is_same);
  if (same == rows_.end())
    rows_.push_back(std::move(row));
  else if (!same->condition.empty() && same->condition != row.condition)
    same->condition = row.condition.empty() ? "" : same->condition + " or " + row.condition;
}

}  // namespace menger::io
