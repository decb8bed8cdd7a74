// Poisson's ratios up to one half: no locking.

#include <cmath>
#include <string>

#include "meshes/hexahedra/boundary_labels.h"
#include "meshes/hexahedra/verification_shapes.h"
#include "tests/extremes/fem_rows.h"
#include "tests/verification/fem_cooks_membrane.h"
#include "tests/verification/fem_pressure_vessels.h"

namespace menger::extremes {

namespace {

using fem::Formulation;

/// Returns the tip deflection (mm) of Cook's membrane of tests/verification, for any Poisson's ratio and one shear modulus.
double cook_tip_mm(double poissons_ratio, int degree, Formulation formulation, std::size_t elements) {
  constexpr double modulus_Pa = 240.565e6 / (2.0 * 1.4999);
  const meshes::HexahedralMesh mesh = meshes::cooks_membrane(1e-3, 1e-3, {elements, elements, 1});
  fem::Body body = fem::body_of(materials::NeoHookean{modulus_Pa},
                                materials::SimoTaylorVolume{bulk_ratio(poissons_ratio) * modulus_Pa}, formulation);
  fem::hold(body, mesh, "x min", {true, true, true});
  fem::hold(body, mesh, "z min", {false, false, true});
  fem::hold(body, mesh, "z max", {false, false, true});
  body.tractions = {{meshes::label_index(mesh, "x max"), {0.0, 100.0 / 16.0 * 1e6, 0.0}}};
  fem::Model model(mesh, degree, body);
  model.report = fem::follow_path(
      model.equilibrium, std::vector<fem::PlenumDrive>{}, {},
      [&](const fem::PathPoint&, const fem::BodyState& reached, const fem::PathRestart&) { model.state = reached; });
  if (model.report.status != io::RunStatus::completed) return std::nan("");
  return 1e3 * model.displacement_at({48e-3, 60e-3, 0.0})[1];
}

/// To first order the deflection is linear in 1 - 2 nu, down to zero.
void run_cook(Outcome& outcome, int degree, std::size_t elements, double tolerance) {
  const auto tip_mm = [&](double poissons_ratio) {
    return cook_tip_mm(poissons_ratio, degree, Formulation::three_field, elements);
  };
  const double stiffest_mm = tip_mm(0.49999);
  outcome.expect_near("tip at 0.4999 mm", tip_mm(0.4999), fem::published_cook_tip_mm, tolerance);
  outcome.expect_near("tip at 0.49999 mm", stiffest_mm, fem::published_cook_tip_mm, tolerance);
  outcome.expect_near("loss from 0.499 to 0.49999 by that from 0.49",
                      (tip_mm(0.499) - stiffest_mm) / (tip_mm(0.49) - stiffest_mm), (0.002 - 0.00002) / (0.02 - 0.00002), 0.1);
}

/// Shows that the rows above can fail: elements without a pressure field lock.
void run_locking(Outcome& outcome) {
  const double locked_mm = cook_tip_mm(0.49999, 1, Formulation::displacement, 8);
  outcome.expect_between("tip mm", locked_mm, 0.0, 0.6 * fem::published_cook_tip_mm);
}

/// Checks the inner pressure at a stretch of 1.2. To first order, the decrease by compression is linear in mu / kappa. At kappa =
/// 50 mu it is known from the radial boundary-value problem (see tests/verification/fem_pressure_vessels_test.cpp).
void run_sphere(Outcome& outcome, int degree, std::size_t fineness, double tolerance) {
  constexpr double stretch = 1.2, known_ratio = 50.0, known_pressure_Pa = 10808.720;
  const double incompressible_Pa = sphere_pressure_Pa(stretch, fem::outer_radius_m / fem::inner_radius_m);
  for (const double poissons_ratio : {0.49, 0.499, 0.4999, 0.49999}) {
    const double ratio = bulk_ratio(poissons_ratio);
    const fem::VesselCase vessel{fem::Vessel::sphere, materials::NeoHookean{shear_modulus_Pa}, ratio * shear_modulus_Pa, degree};
    fem::Model model(fem::vessel_mesh(vessel.vessel, fineness), degree, fem::vessel_body(vessel));
    const fem::PathReport report = follow(model, volume_drive(std::pow(stretch, 3)), {});
    outcome.expect(report.status == io::RunStatus::completed, std::string(to_string(report.status)));
    const double loss = (incompressible_Pa - known_pressure_Pa) * known_ratio / ratio;
    outcome.expect_near("pressure at " + shown(poissons_ratio, 5) + " Pa", report.points.back().pressures_Pa[0],
                        incompressible_Pa - loss, tolerance);
  }
}

}  // namespace

std::vector<Row> fem_incompressibility_rows() {
  std::vector<Row> rows;
  for (const int degree : {1, 2}) {
    const std::string element = degree == 1 ? "Q1P0" : "Q2P1";
    const std::size_t elements = degree == 1 ? 16 : 8;
    rows.push_back({.name = "nu to 0.49999 in Cooks membrane with " + element,
                    .done = std::to_string(elements) + " x " + std::to_string(elements) +
                            " elements, nu = 0.49, 0.499, 0.4999, 0.49999 at one shear modulus",
                    .expected =
                        "the published deflection, 6.9083 mm at 0.4999, to 2 %, what the mesh allows; what nu costs is linear in "
                        "1 - 2 nu to 10 %, the second order at 0.49. Locking would let the tip fall to zero",
                    .run = [degree, elements](Outcome& outcome) { run_cook(outcome, degree, elements, 0.02); }});
  }
  rows.push_back({.name = "nu of 0.49999 in Cooks membrane with Q1",
                  .done = "8 x 8 elements of displacements alone, which must lock",
                  .expected = "less than 0.6 of the published deflection: the rows above tell locking from its absence",
                  .run = run_locking});
  rows.push_back({.name = "nu to 0.49999 in a thick sphere with Q2P1",
                  .done = "radii 8 and 10 mm, two elements through the wall, inner stretch 1.2, nu = 0.49 to 0.49999",
                  .expected =
                      "the closed form without volume change less the known loss by compression, which is linear in mu/kappa; to "
                      "1e-4, its second order at 0.499",
                  .run = [](Outcome& outcome) { run_sphere(outcome, 2, 2, 1e-4); }});
  rows.push_back({.name = "nu to 0.49999 in a thick sphere with Q1P0",
                  .done = "as above with linear elements",
                  .expected = "the pressure of the row above to 2 %, what the mesh allows at every nu alike",
                  .run = [](Outcome& outcome) { run_sphere(outcome, 1, 2, 0.02); }});
  return rows;
}

}  // namespace menger::extremes
