#include "evolution/study/fallen.h"

#include <cmath>
#include <string>

#include "io/text/formatted.h"

namespace menger::evolution {

void set_fallen(const meshes::Lean& lean, const std::array<double, 3>& whole_m, Evaluation& result) {
  const std::string period = std::to_string(lean.period);
  result.displacement_m.reset();
  if (std::isinf(lean.angle_deg)) {
    result.status = io::RunStatus::diverged;
    result.period_displacements_m.clear();
    result.reason = "the upright axis of the body is not a number at the end of period " + period + " or of the first";
    return;
  }
  result.status = io::RunStatus::fell;
  result.left_out_m = whole_m;
  result.reason = "the body has fallen: at the end of period " + period + " it leans by " +
                  io::formatted("%.0f", lean.angle_deg) + " degrees from where it was at the end of the first";
}

}  // namespace menger::evolution
