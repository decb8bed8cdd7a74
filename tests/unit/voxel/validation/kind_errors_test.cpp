#include "voxel/validation/kind_errors.h"

#include <gtest/gtest.h>

#include "tests/unit/voxel/validation/validation_samples.h"

namespace menger::voxel {
namespace {

using meshes::LoadCaseKind;

/// Pressures, change of volume, extents in x, y and z, top.
const std::vector<std::vector<double>> inflation{{1e3, 2e3}, {0.1, 0.2}, {1e-3, 2e-3}, {5e-4, 1e-3}, {5e-4, 1e-3}, {5e-4, 1e-3}};

/// Compares a surrogate whose extents in x are too large by `share` of the largest with a body of cells.
CurveComparison comparison_of(const std::string& body, const std::array<int, 3>& cells, const std::string& digits, double share,
                              double largest_pressure_Pa = 2e3) {
  meshes::ResponseCurve curve = samples::bar_curve(body + "_inflation", LoadCaseKind::inflation, inflation);
  curve.provenance.load_case.cells = cells;
  curve.provenance.load_case.digits = digits;
  SurrogateParameters parameters = samples::validation_parameters();
  parameters.validity.set_pressures(0.0, largest_pressure_Pa);
  std::vector<std::vector<double>> response = inflation;
  for (double& value : response[2]) value += share * 2e-3;
  return compare(curve, body, parameters, samples::responding(response));
}

const KindErrors& errors_of(const ExpectedErrors& errors, BodyKind kind) { return errors.of(kind).value(); }

TEST(KindErrors, AreThoseOfTheBodiesOfAKind) {
  const std::vector<CurveComparison> comparisons{comparison_of("bar", {3, 1, 1}, "111", 0.0),
                                                 comparison_of("l", {2, 2, 1}, "1101", 0.0),
                                                 comparison_of("plane", {2, 2, 1}, "1111", -2.0)};
  const ExpectedErrors errors = expected_errors(comparisons, samples::validation_parameters());
  EXPECT_EQ(errors.parameters_hash, hash_of(samples::validation_parameters()));
  const KindErrors& limbs = errors_of(errors, BodyKind::limbs);
  EXPECT_EQ(limbs.bodies, (std::vector<std::string>{"bar", "l"}));
  EXPECT_EQ(limbs.displacements, 16U) << "four of both bodies at both pressures";
  EXPECT_EQ(limbs.volumes, 4U);
  EXPECT_EQ(limbs.displacement_median, 0.0);
  EXPECT_EQ(limbs.wrong_signs, 0U);
  const KindErrors& plates = errors_of(errors, BodyKind::flat_plate);
  EXPECT_EQ(plates.bodies, std::vector<std::string>{"plane"});
  EXPECT_NEAR(plates.displacement_ninth_decile.value(), 2.0, 1e-12) << "two of eight are off by twice the largest";
  EXPECT_EQ(plates.displacement_median, 0.0);
  EXPECT_EQ(plates.volume_median, 0.0);
  EXPECT_EQ(plates.signs, 8U);
  EXPECT_EQ(plates.wrong_signs, 2U);
  for (const BodyKind kind : body_kinds)
    EXPECT_EQ(errors.of(kind).has_value(), kind == BodyKind::limbs || kind == BodyKind::flat_plate) << to_string(kind);
}

TEST(KindErrors, LeaveOutWhatIsOutsideTheRangeOfValidity) {
  const std::vector<CurveComparison> comparisons{comparison_of("bar", {3, 1, 1}, "111", 0.5, 1e3),
                                                 comparison_of("plane", {2, 2, 1}, "1111", 0.5, 500.0)};
  const ExpectedErrors errors = expected_errors(comparisons, samples::validation_parameters());
  EXPECT_EQ(errors_of(errors, BodyKind::limbs).displacements, 4U) << "one of two pressures is inside";
  EXPECT_FALSE(errors.of(BodyKind::flat_plate)) << "no pressure is inside";
}

TEST(KindErrors, TellAggregatesFromTheirModules) {
  meshes::ResponseCurve curve = samples::bar_curve("joint_inflation", LoadCaseKind::inflation, inflation);
  curve.provenance.load_case.level = 2;
  SurrogateParameters parameters = samples::validation_parameters();
  const ExpectedErrors errors =
      expected_errors({compare(curve, "joint", parameters, samples::responding(inflation))}, parameters);
  EXPECT_TRUE(errors.of(BodyKind::aggregate_of_limbs));
  EXPECT_FALSE(errors.of(BodyKind::limbs));
}

}  // namespace
}  // namespace menger::voxel
