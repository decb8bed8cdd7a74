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

/// A design that is to be judged.
struct ChosenDesign {
  std::uint64_t individual = 0;
  Phenotype phenotype;    ///< as the search knows it
  meshes::Polycube body;  ///< basal, standing
  double fitness = 0.0;
  std::size_t rank = 1;  ///< by fitness among the distinct designs
  bool is_top = true;    ///< else of the sample
};

/// A design that was in line and cannot be judged.
struct RefusedDesign {
  std::uint64_t individual = 0;
  std::string phenotype;  ///< its key
  double fitness = 0.0;
  std::size_t rank = 1;
  std::string reason;
};

struct Selection {
  std::vector<ChosenDesign> chosen;  ///< by rank: the best first
  std::vector<RefusedDesign> refused;
  std::size_t distinct = 0;  ///< robots with a fitness
};

/// How many are chosen, and how.
struct SelectionOptions {
  std::size_t top = 1;     ///< >= 1
  std::size_t sample = 0;  ///< of the others
  std::uint64_t seed = 1;  ///< of the sample
  Distinction distinction{};
};

/// Takes the best distinct designs that nothing stands against, and of the others one from each of `sample` strata of equal
/// numbers by fitness, drawn at random; a stratum all of which is refused gives none.
/// @param designs the best first @param obstacle why a standing basal body cannot be judged; empty if it can. Asked only of
/// designs that are in line
Selection choose_designs(std::span<const FitDesign> designs, const SelectionOptions& options,
                         const std::function<std::string(const meshes::Polycube&)>& obstacle);

}  // namespace menger::evolution
