#include "evolution/reevaluation/reevaluation_selection.h"

#include <algorithm>
#include <cassert>
#include <set>
#include <utility>

#include "evolution/genome/random_stream.h"

namespace menger::evolution {
namespace {

using meshes::Polycube;

class Chooser {
 public:
  Chooser(const SelectionOptions& options, const std::function<std::string(const Polycube&)>& obstacle)
      : options_(options), obstacle_(obstacle) {}

  DesignSelection choose(std::span<const FitDesign> designs) {
    collect(designs);
    found_.distinct = line_.size();
    std::size_t next = 0;
    while (next < line_.size() && found_.chosen.size() < options_.top) take(line_[next++], true);
    std::vector<ChosenDesign> rest(line_.begin() + static_cast<std::ptrdiff_t>(next), line_.end());
    sample(std::move(rest));
    std::ranges::sort(found_.chosen, {}, &ChosenDesign::rank);
    std::ranges::sort(found_.refused, {}, &RefusedDesign::rank);
    return std::move(found_);
  }

 private:
  /// Collects the first design of every robot.
  void collect(std::span<const FitDesign> designs) {
    std::set<std::string> known;
    for (const FitDesign& design : designs) {
      const Polycube body = standing(design.phenotype.body);
      if (!known.insert(robot_form(body, options_.distinction)).second) continue;
      line_.push_back({.individual = design.individual,
                       .phenotype = design.phenotype,
                       .body = body,
                       .fitness = design.fitness,
                       .rank = line_.size() + 1,
                       .is_top = true});
    }
  }

  bool take(ChosenDesign design, bool is_top) {
    if (const std::string reason = obstacle_(design.body); !reason.empty()) {
      found_.refused.push_back({design.individual, phenotype_key(design.phenotype), design.fitness, design.rank, reason});
      return false;
    }
    design.is_top = is_top;
    found_.chosen.push_back(std::move(design));
    return true;
  }

  void sample(std::vector<ChosenDesign> rest) {
    RandomStream random(options_.seed, "re-evaluation");
    const std::size_t strata = std::min(options_.sample, rest.size());
    for (std::size_t n = 0; n < strata; ++n) {
      const auto place = [&](std::size_t stratum) {
        return rest.begin() + static_cast<std::ptrdiff_t>(stratum * rest.size() / strata);
      };
      std::vector<ChosenDesign> stratum(place(n), place(n + 1));
      random.shuffle(stratum);
      for (ChosenDesign& design : stratum) {
        if (take(std::move(design), false)) break;
      }
    }
  }

  const SelectionOptions& options_;
  const std::function<std::string(const Polycube&)>& obstacle_;
  std::vector<ChosenDesign> line_;
  DesignSelection found_;
};

}  // namespace

DesignSelection choose_designs(std::span<const FitDesign> designs, const SelectionOptions& options,
                               const std::function<std::string(const Polycube&)>& obstacle) {
  assert(options.top >= 1);
  return Chooser(options, obstacle).choose(designs);
}

}  // namespace menger::evolution
