#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "evolution/archive/run_archive.h"
#include "evolution/genome/robot_form.h"
#include "meshes/design/polycube.h"

namespace menger::evolution {

/// A design that was chosen for re-evaluation.
struct ChosenDesign {
  std::uint64_t individual = 0;
  Phenotype phenotype;    ///< as in the archive
  meshes::Polycube body;  ///< basal, standing
  double fitness = 0.0;
  std::size_t rank = 1;  ///< by fitness among the distinct designs
  bool is_top = true;    ///< one of the best; false: of the sample
};

/// A design that would have been chosen but cannot be evaluated.
struct RefusedDesign {
  std::uint64_t individual = 0;
  std::string phenotype;  ///< its key
  double fitness = 0.0;
  std::size_t rank = 1;
  std::string reason;
};

/// The designs that are evaluated, and those that cannot be.
struct DesignSelection {
  std::vector<ChosenDesign> chosen;  ///< by rank: the best first
  std::vector<RefusedDesign> refused;
  std::size_t distinct = 0;  ///< robots with a fitness
};

/// How many designs are chosen, and how.
struct SelectionOptions {
  std::size_t top = 1;     ///< number of best designs, >= 1
  std::size_t sample = 0;  ///< number of designs drawn from the others
  std::uint64_t seed = 1;  ///< of the sample
  Distinction distinction{};
};

/// Chooses the best distinct designs that can be evaluated, and a sample of the others. The others are divided by fitness into
/// `sample` strata of equal size, and one design is drawn at random from each. A stratum in which no design can be evaluated
/// gives none.
/// @param designs the best first
/// @param obstacle returns why a standing basal body cannot be evaluated, or an empty text if it can; called only for designs
/// that would be chosen
DesignSelection choose_designs(std::span<const FitDesign> designs, const SelectionOptions& options,
                               const std::function<std::string(const meshes::Polycube&)>& obstacle);

}  // namespace menger::evolution
