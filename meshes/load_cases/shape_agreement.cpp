#include "meshes/load_cases/shape_agreement.h"

namespace menger::meshes {

std::string thin_wall_bend_deficit_text(std::string_view fidelity) {
  if (fidelity == "draft") return "23 to 33 %";
  if (fidelity == "standard") return "17 to 26 %";
  if (fidelity == "fine") return "14 to 22 %";
  return "14 to 33 %";
}

}  // namespace menger::meshes
