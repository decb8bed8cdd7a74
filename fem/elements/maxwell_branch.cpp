#include "fem/elements/maxwell_branch.h"

#include <algorithm>
#include <iterator>

namespace menger::fem {

std::vector<MaxwellBranch> acting(const std::vector<MaxwellBranch>& branches) {
  std::vector<MaxwellBranch> result;
  std::ranges::copy_if(branches, std::back_inserter(result), &MaxwellBranch::is_there);
  return result;
}

}  // namespace menger::fem
