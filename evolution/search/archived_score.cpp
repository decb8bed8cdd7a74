#include "evolution/search/archived_score.h"

namespace menger::evolution {

std::string simulated_design(const SearchPlan& plan, const Phenotype& phenotype) {
  return design_hash(as_simulated(plan, phenotype), plan.first_level());
}

std::optional<double> archived_score(const SearchPlan& plan, const RunArchive& archive, const std::string& design,
                                     const std::string& physics_hash, std::optional<int> latest) {
  const int level = plan.first_level();
  const auto found = archive.evaluation({design, level, physics_hash});
  if (!found || !found->result.displacement_m || (latest && found->generation > *latest)) return std::nullopt;
  return level_score(plan, *found->result.displacement_m, level);
}

}  // namespace menger::evolution
