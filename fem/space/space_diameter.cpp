#include "fem/space/space_diameter.h"

#include <algorithm>
#include <limits>

#include "fem/surfaces/point.h"

namespace menger::fem {

double diameter_m(const Space& space) {
  Point low;
  Point high;
  low.fill(std::numeric_limits<double>::max());
  high.fill(std::numeric_limits<double>::lowest());
  for (const Point& X : space.positions) {
    for (std::size_t i = 0; i < 3; ++i) {
      low[i] = std::min(low[i], X[i]);
      high[i] = std::max(high[i], X[i]);
    }
  }
  MPI_Allreduce(MPI_IN_PLACE, low.data(), 3, MPI_DOUBLE, MPI_MIN, space.communicator);
  MPI_Allreduce(MPI_IN_PLACE, high.data(), 3, MPI_DOUBLE, MPI_MAX, space.communicator);
  return norm(difference(high, low));
}

}  // namespace menger::fem
