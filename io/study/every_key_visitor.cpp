#include "io/study/every_key_visitor.h"

namespace menger::io {

void EveryKeyVisitor::under(std::string_view, const std::function<void()>& describe) { describe(); }

void EveryKeyVisitor::visit_table(const Key& key, const std::function<void()>& describe) { inside(key, false, describe); }

void EveryKeyVisitor::visit_optional_table(const Key& key, bool has, const std::function<void(bool)>& set,
                                           const std::function<void()>& describe) {
  set(true);
  inside(key, false, describe);
  set(has);
}

void EveryKeyVisitor::visit_tables(const Key& key, const Count&, std::size_t size, const std::function<void(std::size_t)>& resize,
                                   const std::function<void(std::size_t)>& describe) {
  if (size == 0) resize(1);
  inside(key, true, [&] { describe(0); });
  if (size == 0) resize(0);
}

void EveryKeyVisitor::visit_choice(const std::vector<Alternative>& alternatives, std::string_view) {
  const Alternative* chosen = nullptr;
  for (const Alternative& alternative : alternatives) {
    if (alternative.is_chosen) chosen = &alternative;
    if (for_people_ && alternative.is_for_programs) continue;
    alternative.choose();
    alternative.describe();
  }
  if (chosen != nullptr) chosen->choose();
}

void EveryKeyVisitor::visit_branch(bool holds, std::string_view condition, const std::function<void()>& describe) {
  if (holds) return describe();
  under(condition, describe);
}

}  // namespace menger::io
