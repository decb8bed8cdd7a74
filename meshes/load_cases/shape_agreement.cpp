#include "meshes/load_cases/shape_agreement.h"

namespace menger::meshes {

std::string thin_wall_bend_deficit_text(std::string_view fidelity) {
  if (fidelity == "draft") return "23 to 32 %";
  if (fidelity == "standard") return "17 to 23 %";
  if (fidelity == "fine") return "14 to 19 %";
  return "14 to 32 %";
}

}  // namespace menger::meshes
