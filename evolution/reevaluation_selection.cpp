#include "evolution/reevaluation_selection.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <limits>
#include <set>
#include <utility>

#include "evolution/random_stream.h"

namespace menger::evolution {
namespace {

using meshes::CellIndex;
using meshes::Polycube;

/// A cell of a square grid turned by `quarters` of a turn about the vertical, after a reflection in x if asked for.
CellIndex turned(CellIndex cell, int side, int quarters, bool is_mirrored) {
  if (is_mirrored) cell.x = side - 1 - cell.x;
  for (int quarter = 0; quarter < quarters; ++quarter) cell = {side - 1 - cell.y, cell.x, cell.z};
  return cell;
}

/// The body moved to the corner of its grid.
std::string digits_at_corner(const Polycube& body, const std::vector<CellIndex>& cells, bool with_materials,
                             const std::vector<meshes::Material>& materials) {
  CellIndex low{std::numeric_limits<int>::max(), std::numeric_limits<int>::max(), std::numeric_limits<int>::max()};
  for (const CellIndex& cell : cells) low = {std::min(low.x, cell.x), std::min(low.y, cell.y), std::min(low.z, cell.z)};
  Polycube moved(body.nx(), body.ny(), body.nz());
  for (std::size_t n = 0; n < cells.size(); ++n) {
    const CellIndex& cell = cells[n];
    moved.set({cell.x - low.x, cell.y - low.y, cell.z - low.z}, with_materials ? materials[n] : meshes::Material{1});
  }
  return moved.digits();
}

class Chooser {
 public:
  Chooser(const SelectionOptions& options, const std::function<std::string(const Polycube&)>& obstacle)
      : options_(options), obstacle_(obstacle) {}

  Selection choose(std::span<const FitDesign> designs) {
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
  /// The first of every robot.
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
  Selection found_;
};

}  // namespace

Polycube standing(const Polycube& body) {
  const std::vector<CellIndex> cells = body.occupied();
  if (cells.empty()) return body;
  const int lowest = std::ranges::min(cells, {}, &CellIndex::z).z;
  Polycube moved(body.nx(), body.ny(), body.nz());
  for (const CellIndex& cell : cells) moved.set({cell.x, cell.y, cell.z - lowest}, body.at(cell));
  return moved;
}

std::string robot_form(const Polycube& body, const Distinction& distinction) {
  assert(body.nx() == body.ny());
  if (distinction.place) return standing(body).digits();
  const std::vector<CellIndex> cells = body.occupied();
  std::vector<meshes::Material> materials;
  materials.reserve(cells.size());
  for (const CellIndex& cell : cells) materials.push_back(body.at(cell));
  std::string form;
  for (const bool is_mirrored : {false, true}) {
    for (int quarters = 0; quarters < 4; ++quarters) {
      std::vector<CellIndex> now;
      now.reserve(cells.size());
      for (const CellIndex& cell : cells) now.push_back(turned(cell, body.nx(), quarters, is_mirrored));
      std::string digits = digits_at_corner(body, now, distinction.materials, materials);
      if (form.empty() || digits < form) form = std::move(digits);
    }
  }
  return form;
}

Selection choose_designs(std::span<const FitDesign> designs, const SelectionOptions& options,
                         const std::function<std::string(const Polycube&)>& obstacle) {
  assert(options.top >= 1);
  return Chooser(options, obstacle).choose(designs);
}

}  // namespace menger::evolution
