#include "voxel/statics/load_case_slopes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "tests/unit/voxel/statics/static_samples.h"
#include "voxel/statics/load_case_response.h"

namespace menger::voxel {
namespace {

using meshes::LoadCase;
using meshes::LoadCaseKind;

LoadCase load_case(LoadCaseKind kind, std::array<int, 3> cells, std::vector<double> pressures, std::vector<double> imposed = {}) {
  LoadCase result;
  result.name = "case";
  result.kind = kind;
  result.cells = cells;
  result.digits = std::string(static_cast<std::size_t>(cells[0] * cells[1] * cells[2]), '1');
  result.cell_edge_m = sample_edge;
  result.wall_thickness_m = 0.002;
  result.pressures_Pa = std::move(pressures);
  result.imposed = std::move(imposed);
  return result;
}

/// Every class has stiffnesses and laws of its own, so that a body is nowhere without load.
SurrogateParameters driven_parameters(int voxels_per_cell = 1) {
  SurrogateParameters p = sample_parameters();
  p.voxels_per_cell = voxels_per_cell;
  p.lateral_coupling = 0.3;
  for (std::size_t c = 0; c < wall_class_count; ++c) {
    const double rank = 1.0 + 0.2 * static_cast<double>(c);
    p.axial_Pa[c] *= rank;
    p.bending_Pa[c] *= rank * rank;
    p.shear_compliance_per_Pa[c] = 3.0 / p.axial_Pa[c];
    p.extension[c] = {.slope_per_Pa = 2e-5 / rank, .pressure_softening_per_Pa = 1e-5, .vacuum_softening_per_Pa = -3e-5};
    p.bulge[c] = {.slope_per_Pa = 1e-5 / rank, .pressure_softening_per_Pa = 2e-5, .vacuum_softening_per_Pa = -1e-5};
  }
  p.bulge_peak_ratio.fill(2.0);
  return p;
}

/// A span of relative half width `by` about a value of parameters.
template <class ValueIn>
ParameterSpan span_about(const SurrogateParameters& p, double by, ValueIn value_in) {
  ParameterSpan span{.below = p, .above = p, .below_by = by, .above_by = by};
  value_in(span.below) *= 1.0 - by;
  value_in(span.above) *= 1.0 + by;
  return span;
}

std::vector<ParameterSpan> spans_about(const SurrogateParameters& p, double by) {
  std::vector<ParameterSpan> spans;
  for (const std::size_t c : {walls::closed, walls::corner, walls::three}) {
    spans.push_back(span_about(p, by, [c](SurrogateParameters& of) -> double& { return of.axial_Pa.at(c); }));
    spans.push_back(span_about(p, by, [c](SurrogateParameters& of) -> double& { return of.bending_Pa.at(c); }));
    spans.push_back(span_about(p, by, [c](SurrogateParameters& of) -> double& { return of.torsion_Pa.at(c); }));
    spans.push_back(span_about(p, by, [c](SurrogateParameters& of) -> double& { return of.extension.at(c).slope_per_Pa; }));
    spans.push_back(span_about(p, by, [c](SurrogateParameters& of) -> double& { return of.bulge.at(c).slope_per_Pa; }));
  }
  spans.push_back(span_about(p, by, [](SurrogateParameters& of) -> double& { return of.lateral_coupling; }));
  spans.push_back(span_about(p, by, [](SurrogateParameters& of) -> double& { return of.ground_stiffness_N_per_m; }));
  return spans;
}

const Responder whole_responses = [](const SurrogateParameters& parameters, const LoadCase& of, const Responder::States& states) {
  return respond(parameters, of, states);
};

/// Largest difference of the slopes of an ordinate by the largest of its slopes.
void expect_slopes_of_whole_responses(const SurrogateParameters& parameters, const LoadCase& of) {
  const std::vector<ParameterSpan> spans = spans_about(parameters, 1e-4);
  const ResponseSlopes found = equilibrium_responder().slopes(parameters, of, {}, spans);
  const ResponseSlopes expected = whole_responses.slopes(parameters, of, {}, spans);
  ASSERT_EQ(found.response.status, io::RunStatus::completed);
  EXPECT_EQ(found.response.values, expected.response.values);
  for (std::size_t c = meshes::abscissa_count(of.kind); c < found.response.columns.size(); ++c) {
    double largest = 0.0;
    double error = 0.0;
    for (std::size_t n = 0; n < spans.size(); ++n) {
      ASSERT_TRUE(found.slopes[n] && expected.slopes[n]);
      for (std::size_t row = 0; row < found.response.values.front().size(); ++row) {
        largest = std::max(largest, std::abs((*expected.slopes[n])[c][row]));
        error = std::max(error, std::abs((*found.slopes[n])[c][row] - (*expected.slopes[n])[c][row]));
      }
    }
    // What equilibria leave of their tolerance by the width of the span, 1e-11 / 1e-4, and times ten for a body that is soft.
    EXPECT_LE(error, 1e-6 * largest) << meshes::to_string(of.kind) << " " << found.response.columns[c];
    EXPECT_GT(largest, 0.0) << found.response.columns[c];
  }
}

TEST(LoadCaseSlopes, AreThoseOfWholeAnswers) {
  const std::vector<double> pressures{-600.0, 900.0};
  const SurrogateParameters parameters = driven_parameters();
  expect_slopes_of_whole_responses(parameters, load_case(LoadCaseKind::inflation, {3, 2, 1}, pressures));
  expect_slopes_of_whole_responses(parameters, load_case(LoadCaseKind::blocked, {3, 2, 1}, pressures));
  expect_slopes_of_whole_responses(parameters, load_case(LoadCaseKind::stretch, {3, 2, 1}, pressures, {0.002}));
  expect_slopes_of_whole_responses(parameters, load_case(LoadCaseKind::shear, {3, 2, 1}, pressures, {0.002}));
  expect_slopes_of_whole_responses(parameters, load_case(LoadCaseKind::bending, {3, 2, 1}, pressures, {0.3}));
  expect_slopes_of_whole_responses(parameters, load_case(LoadCaseKind::torsion, {3, 2, 1}, pressures, {0.3}));
  expect_slopes_of_whole_responses(parameters, load_case(LoadCaseKind::press, {3, 2, 1}, {0.0, 900.0}, {0.0005}));
  expect_slopes_of_whole_responses(parameters, load_case(LoadCaseKind::sag, {3, 2, 1}, pressures, {1.0}));
  expect_slopes_of_whole_responses(parameters, load_case(LoadCaseKind::modes, {3, 1, 1}, pressures));
}

TEST(LoadCaseSlopes, AreThoseOfWholeAnswersWithTwoVoxelsAlongACell) {
  expect_slopes_of_whole_responses(driven_parameters(2), load_case(LoadCaseKind::inflation, {2, 2, 1}, {-300.0, 600.0}));
}

// One voxel does not move: its slopes are those of its laws.
TEST(LoadCaseSlopes, OfOneCellAreThoseOfItsLaws) {
  const SurrogateParameters p = driven_parameters();
  const LoadCase of = load_case(LoadCaseKind::inflation, {1, 1, 1}, {4000.0});
  const auto slope_in = [](SurrogateParameters& q) -> double& { return q.bulge[walls::closed].slope_per_Pa; };
  const ResponseSlopes found = respond_with_slopes(p, of, {}, {span_about(p, 1e-4, slope_in)});
  ASSERT_TRUE(found.slopes[0]);
  const std::size_t column = 2;
  ASSERT_EQ(found.response.columns[column], "extent_x_m");
  const double expected = 2.0 * sample_edge * p.bulge[walls::closed].value(4000.0);  // the law is in proportion to its slope
  EXPECT_NEAR((*found.slopes[0])[column][0], expected, 1e-9 * expected);
}

TEST(LoadCaseSlopes, AreTakenFromTheSideThatHasAnAnswer) {
  const SurrogateParameters p = driven_parameters();
  const double pressure = 4000.0;
  const LoadCase of = load_case(LoadCaseKind::inflation, {2, 1, 1}, {1000.0, pressure});
  ParameterSpan span = span_about(p, 1e-4, [](SurrogateParameters& q) -> double& { return q.axial_Pa[walls::closed]; });
  const ResponseSlope both = *respond_with_slopes(p, of, {}, {span}).slopes[0];
  span.above.extension[walls::closed].pressure_softening_per_Pa = 1.0 / pressure;  // its pole
  const auto below = respond_with_slopes(p, of, {}, {span}).slopes[0];
  ASSERT_TRUE(below);
  for (std::size_t c = 1; c < both.size(); ++c) EXPECT_NEAR((*below)[c][1], both[c][1], 2e-4 * std::abs(both[c][1]));
  span.below_by = 0.0;
  EXPECT_FALSE(respond_with_slopes(p, of, {}, {span}).slopes[0]);
}

TEST(LoadCaseSlopes, StopWhereTheAnswerDoes) {
  const SurrogateParameters p = driven_parameters();
  const LoadCase of = load_case(LoadCaseKind::inflation, {2, 1, 1}, {1000.0, 1.2e5});  // beyond the pole of the laws
  const auto value_in = [](SurrogateParameters& q) -> double& { return q.axial_Pa[walls::closed]; };
  const ResponseSlopes found = respond_with_slopes(p, of, {}, {span_about(p, 1e-4, value_in)});
  EXPECT_EQ(found.response.status, io::RunStatus::limit_point);
  EXPECT_EQ(found.response.values.front().size(), 1U);
}

}  // namespace
}  // namespace menger::voxel
