#include "meshes/load_cases/shape_agreement.h"

#include "io/text/formatted.h"

namespace menger::meshes {

std::string thin_wall_bend_deficit_text() {
  return io::formatted("%.0f to ", 100.0 * least_thin_wall_bend_deficit) +
         io::formatted("%.0f %%", 100.0 * largest_thin_wall_bend_deficit);
}

}  // namespace menger::meshes
