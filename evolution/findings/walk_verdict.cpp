#include "evolution/findings/walk_verdict.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "evolution/findings/found_walk.h"
#include "evolution/findings/result_files.h"
#include "io/shown/shown_quantity.h"
#include "io/text/formatted.h"
#include "meshes/load_cases/walk_agreement.h"

namespace menger::evolution {

namespace fs = std::filesystem;

using io::millimetres;
using io::percents;

namespace {

meshes::WalkAgreement agreement(const FoundWalk& one, const FoundWalk& other) {
  const auto outcome = [](const FoundWalk& walk) {
    return meshes::WalkOutcome{walk.fell_s ? 0.0 : walk.body_lengths, walk.time_s, walk.direction_deg()};
  };
  return meshes::compare_walks(outcome(one), outcome(other));
}

bool agree(const FoundWalk& one, const FoundWalk& other) {
  return agreement(one, other) <= meshes::WalkAgreement::both_go_nowhere;
}

bool are_as_long(const FoundWalk& one, const FoundWalk& other) { return meshes::last_as_long(one.time_s, other.time_s); }

/// Whether a body got somewhere on its feet.
bool is_walk(const FoundWalk& walk) { return !walk.fell_s && walk.body_lengths >= meshes::walk_limits::least_body_lengths; }

/// "67 mm and 70 mm, 3 degrees apart". @pre not both go nowhere
std::string both(const FoundWalk& one, const FoundWalk& other) {
  const std::string distances = millimetres(one.distance_m()) + " and " + millimetres(other.distance_m());
  if (agreement(one, other) == meshes::WalkAgreement::one_goes_nowhere)
    return distances + ", of which the " + (is_walk(one) ? "second" : "first") +
           (one.fell_s || other.fell_s ? " is a fall" : " is no walk");
  return distances + ", " + io::degrees(meshes::angle_between_directions_deg(one.direction_deg(), other.direction_deg())) +
         " apart";
}

/// Whether a robot, and what drives its cells, is its own mirror image in a plane across one of the axes x and y, so that it has
/// no reason to go one way along this axis rather than the other.
bool is_mirror_image(const meshes::Robot& robot, bool is_across_x) {
  const meshes::Polycube& body = robot.design.body;
  const bool has_phases = robot.drive == meshes::RobotDrive::antiphase;
  const auto same = [&](std::uint8_t a, std::uint8_t b) {
    return has_phases ? a == b : (a == meshes::empty) == (b == meshes::empty);
  };
  const std::vector<meshes::CellIndex> cells = body.occupied();
  if (cells.empty()) return true;
  // About the middle of the body, which may be in a part of its grid.
  int meshes::CellIndex::*const along = is_across_x ? &meshes::CellIndex::x : &meshes::CellIndex::y;
  const auto [first, last] = std::ranges::minmax(cells, {}, along);
  const int ends = first.*along + last.*along;
  for (const meshes::CellIndex& cell : cells) {
    meshes::CellIndex mirrored = cell;
    mirrored.*along = ends - cell.*along;
    if (!same(body.at_or_empty(cell), body.at_or_empty(mirrored))) return false;
  }
  return true;
}

/// Whether walks agree in direction, and not in distance.
bool have_one_direction(const FoundWalk& one, const FoundWalk& other) {
  return agreement(one, other) != meshes::WalkAgreement::one_goes_nowhere &&
         meshes::angle_between_directions_deg(one.direction_deg(), other.direction_deg()) <=
             meshes::walk_limits::same_direction_deg;
}

/// Whether a body is its own mirror image along its walk: chance alone decides then which way it goes.
bool is_symmetric_along(const FoundWalk& walk, const meshes::Robot& robot) {
  return is_mirror_image(robot, std::abs(walk.x_m) >= std::abs(walk.y_m));
}

/// That chance decides where a body goes that is its own mirror image along its walk; empty for others.
std::string chance_text(const FoundWalk& walk, const meshes::Robot& robot) {
  if (!is_symmetric_along(walk, robot)) return "";
  return std::string(" The body is its own mirror image along ") + (std::abs(walk.x_m) >= std::abs(walk.y_m) ? "x" : "y") +
         ": chance decides which way it goes.";
}

/// Whether two walks of different distances tell the direction of a walk.
bool is_direction_known(const FoundWalk& coarser, const FoundWalk& finer, const meshes::Robot& robot) {
  return have_one_direction(coarser, finer) && !is_symmetric_along(finer, robot);
}

std::string mesh_verdict(const FoundWalk& coarser, const FoundWalk& finer, const meshes::Robot& robot) {
  if (!are_as_long(coarser, finer)) return "Its walks on two meshes last differently long and are not compared.";
  if (coarser.fell_s && finer.fell_s) return "It falls over on finite elements of two meshes: it does not walk.";
  if (agreement(coarser, finer) == meshes::WalkAgreement::both_go_nowhere) {
    return "It does not walk on finite elements of two meshes: it ends within " +
           percents(meshes::walk_limits::least_body_lengths) + " of its length from where it began" +
           (robot.evolves ? "; the search has found no walker: give it more generations or mutants ([search])." : ".") +
           chance_text(finer, robot);
  }
  const std::string on_meshes = " on finite elements of two meshes";
  if (agree(coarser, finer)) return "Finite elements of two meshes agree on the walk: " + both(coarser, finer) + ".";
  if (agreement(coarser, finer) == meshes::WalkAgreement::one_goes_nowhere) {
    const FoundWalk& none = is_walk(coarser) ? finer : coarser;
    return "Whether it walks is not known: it moves " + millimetres(coarser.distance_m()) + " and " +
           millimetres(finer.distance_m()) + on_meshes + ", and " + millimetres(none.distance_m()) +
           (none.fell_s ? " is a fall." : " is no walk.") + chance_text(is_walk(coarser) ? coarser : finer, robot);
  }
  if (is_direction_known(coarser, finer, robot))
    return "The direction of its walk is known, its distance is not: " + both(coarser, finer) + on_meshes + ".";
  return "How it walks is not known: " + both(coarser, finer) + on_meshes + ". Chance decides such a walk" +
         (is_symmetric_along(finer, robot) ? "; a body that differs from its mirror image walks more surely." : ".");
}

std::string model_verdict(const FoundWalk& voxels, const FoundWalk& elements) {
  if (!are_as_long(voxels, elements)) return "The walks of both models last differently long and are not compared.";
  if (agreement(voxels, elements) == meshes::WalkAgreement::both_go_nowhere)
    return "It walks in neither model, so that the surrogate cannot be judged by its walk.";
  return (agree(voxels, elements) ? "The surrogate walks as finite elements do: "
                                  : "The surrogate does not walk as finite elements do: ") +
         both(voxels, elements) + " (surrogate and finite elements).";
}

/// What the walk of the surrogate is worth where finite elements of two meshes do not agree on theirs.
std::string unknown_walk_verdict(const FoundWalk& voxels, const FoundWalk& coarser, const FoundWalk& finer,
                                 const meshes::Robot& robot) {
  const std::string distance = millimetres(voxels.distance_m());
  if (voxels.fell_s) return "";  // told already
  if (!is_walk(voxels))
    return "The surrogate does not walk: it ends within " + percents(meshes::walk_limits::least_body_lengths) +
           " of its length from where it began.";
  if (!is_direction_known(coarser, finer, robot) || !are_as_long(voxels, finer))
    return "So the walk of the surrogate, " + distance + ", cannot be judged.";
  if (have_one_direction(voxels, finer))
    return "The surrogate goes that way, too; its distance, " + distance + ", cannot be judged.";
  return model_verdict(voxels, finer);
}

}  // namespace

std::vector<std::string> walk_verdict(const fs::path& results, const meshes::Robot& robot, const std::set<std::string>& stages) {
  std::vector<std::string> lines;
  const auto add = [&](const std::string& line) {
    if (!line.empty()) lines.push_back(line);
  };
  const auto walk_of = [&](const std::string& stage, const std::string& file, const std::string& model) {
    const auto result = stages.contains(stage) ? table_at(results / stage / file) : std::nullopt;
    if (!result) return std::optional<FoundWalk>();
    const std::string end = early_end(*result);
    if (end.empty()) {
      const std::optional<FoundWalk> walk = walk_in(results / stage / file, *result, robot);
      if (walk && walk->fell_s) lines.push_back("The body " + fall_text(*walk) + " in the walk " + model + ": this is no walk.");
      return walk;
    }
    lines.push_back("The walk " + model + " ended early and is not compared (" + end + ").");
    return std::optional<FoundWalk>();
  };
  const auto voxels = walk_of("simulate", "result.toml", "of the surrogate");
  const auto elements = walk_of("locomote", "locomotion.toml", "on finite elements");
  const auto finer = walk_of("locomote_finer", "locomotion.toml", "on finite elements of the finer mesh");
  if (elements && finer) add(mesh_verdict(*elements, *finer, robot));
  const bool is_known = !elements || !finer || agree(*elements, *finer);
  if (voxels && !is_known) add(unknown_walk_verdict(*voxels, *elements, *finer, robot));
  if (const auto& reference = finer ? finer : elements; voxels && reference && is_known) add(model_verdict(*voxels, *reference));
  return lines;
}

}  // namespace menger::evolution
