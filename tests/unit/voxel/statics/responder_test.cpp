#include "voxel/statics/responder.h"

#include <gtest/gtest.h>

namespace menger::voxel {
namespace {

/// y = axial^3 p, with an response up to axial = 2.
LoadCaseResponse cubic(const SurrogateParameters& parameters, const meshes::LoadCase&, const Responder::States& states) {
  LoadCaseResponse response;
  const double a = parameters.axial_Pa[0];
  if (a > 2.0) response.status = io::RunStatus::limit_point;
  response.columns = {"pressure_Pa", "extent_x_m"};
  response.values.resize(2);
  for (const std::vector<double>& state : states) {
    response.values[0].push_back(state[0]);
    response.values[1].push_back(a * a * a * state[0]);
  }
  return response;
}

SurrogateParameters of_axial(double axial_Pa) {
  SurrogateParameters parameters;
  parameters.axial_Pa.fill(axial_Pa);
  return parameters;
}

ParameterSpan span(double axial_Pa, double by) { return {of_axial(axial_Pa - by), of_axial(axial_Pa + by), by, by}; }

double slope_at(double axial_Pa, const ParameterSpan& of) {
  const Responder responder = cubic;
  const ResponseSlopes found = responder.slopes(of_axial(axial_Pa), {}, {{5.0}}, {of});
  EXPECT_EQ((*found.slopes[0])[0][0], 0.0);
  return (*found.slopes[0])[1][0];
}

TEST(Responder, TakesSlopesFromDifferencesOfAnswers) {
  // central: 3 a^2 + h^2, from one side: 3 a^2 - 3 a h + h^2
  EXPECT_NEAR(slope_at(1.0, span(1.0, 0.01)), 5.0 * (3.0 + 1e-4), 1e-12);
  EXPECT_NEAR(slope_at(2.0, span(2.0, 0.01)), 5.0 * (12.0 - 0.06 + 1e-4), 1e-11);
  ParameterSpan above = span(1.0, 0.01);
  above.below_by = 0.0;
  EXPECT_NEAR(slope_at(1.0, above), 5.0 * (3.0 + 0.03 + 1e-4), 1e-12);
}

TEST(Responder, HasNoSlopeWhereNeitherSideAnswers) {
  const Responder responder = cubic;
  ParameterSpan none = span(2.0, 0.01);
  none.below_by = 0.0;
  EXPECT_FALSE(responder.slopes(of_axial(2.0), {}, {{5.0}}, {none}).slopes[0]);
  EXPECT_FALSE(responder.slopes(of_axial(3.0), {}, {{5.0}}, {span(3.0, 0.01)}).slopes[0]);
}

}  // namespace
}  // namespace menger::voxel
