#include "evolution/archive/pool_member.h"

namespace menger::evolution {

std::string_view to_string(Knowledge knowledge) {
  switch (knowledge) {
    case Knowledge::evaluated:
      return "evaluated";
    case Knowledge::failed:
      return "failed";
    case Knowledge::bounded:
      return "bounded";
    case Knowledge::duplicate:
      return "duplicate";
    case Knowledge::penalised:
      return "penalised";
    case Knowledge::screened:
      return "screened";
  }
  return {};
}

bool is_fitter(const PoolMember& a, const PoolMember& b) {
  if (a.fitness != b.fitness) return a.fitness > b.fitness;
  return a.age != b.age ? a.age < b.age : a.id > b.id;
}

}  // namespace menger::evolution
