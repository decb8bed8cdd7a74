#include "materials/fit/student_quantile.h"

#include <boost/math/distributions/students_t.hpp>
#include <cassert>

namespace menger::materials {

double student_quantile_95(int freedom) {
  assert(freedom >= 1);
  return boost::math::quantile(boost::math::complement(boost::math::students_t(freedom), 0.025));
}

}  // namespace menger::materials
