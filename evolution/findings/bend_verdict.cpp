#include "evolution/findings/bend_verdict.h"

#include <cmath>
#include <optional>

#include "evolution/findings/compared_inflation.h"
#include "evolution/findings/elements_verdict.h"
#include "evolution/findings/inflation_result.h"
#include "evolution/findings/result_files.h"
#include "evolution/posture/bend.h"
#include "io/shown/shown_quantity.h"
#include "io/text/input_error.h"
#include "meshes/load_cases/shape_agreement.h"

namespace menger::evolution {

namespace fs = std::filesystem;

using io::millimetres;

namespace {

/// Both models of the stage validate at a pressure.
std::optional<ComparedBend> compared_bend_at(const fs::path& results, double pressure_Pa, double cell_edge_m) {
  const auto compared = compared_inflation(results);
  const auto state = compared ? state_at(compared->compared_Pa, pressure_Pa) : std::nullopt;
  return state ? bend_in_validation(results / "validate", *state, cell_edge_m) : std::nullopt;
}

/// What the difference of both models means.
std::string error_text(const ComparedBend& compared) {
  const double elements_m = compared.elements.sideways_m;
  const double difference_m = compared.voxels.sideways_m - elements_m;
  if (elements_m < meshes::smallest_signed_m) return ".";
  return std::string(": the surrogate bends ") + io::percents(std::abs(difference_m) / elements_m) +
         (difference_m < 0.0 ? " too little." : " too much.");
}

}  // namespace

std::string bend_verdict(const fs::path& results, const meshes::Robot& robot) {
  if (robot.walks) return "";
  const auto inflation = table_at(results / "inflate/result.toml");
  if (!inflation || !early_end(*inflation).empty()) return "";
  const double pressure_Pa = strongest_pressure_Pa(robot);
  const double cell_edge_m = robot.design.cell_edge_m;
  try {
    const auto thin = bend_in_inflation(results / "inflate", cell_edge_m);
    const auto compared = compared_bend_at(results, pressure_Pa, cell_edge_m);
    if (!thin || !compared) return "";
    return "At " + io::kilopascals(pressure_Pa) + " the middle of its far end moves " +
           millimetres(compared->elements.sideways_m) + " sideways by quadratic elements" + validate_supports(robot) +
           ", which bend fingers up to " + io::percents(meshes::largest_quadratic_bend_excess) + " too much, and " +
           millimetres(compared->voxels.sideways_m) + " in the surrogate" + error_text(*compared) + " Thin walls" +
           inflate_supports(robot) + " give " + millimetres(thin->sideways_m) + "; they bend fingers " +
           meshes::thin_wall_bend_deficit_text(meshes::to_string(robot.fidelity)) + " too little.";
  } catch (const io::InputError&) {
    return "";  // the fields are for ParaView; without them the rest is known
  }
}

}  // namespace menger::evolution
