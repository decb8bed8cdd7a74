// Solid bars: with a Poisson's ratio near one half, as a reference for the surrogate's lateral coupling; and with two moduli.

#include <cmath>
#include <string>

#include "meshes/hexahedra/boundary_labels.h"
#include "meshes/hexahedra/verification_shapes.h"
#include "tests/extremes/fem_rows.h"
#include "tests/extremes/solid_bar.h"

namespace menger::extremes {

namespace {

constexpr double width_m = 0.01;
constexpr double half_length_m = 1.5 * width_m;

/// Returns the displacement of the face y max at the middle section, averaged from the axis to the side by Simpson's rule.
double mean_side_m(const fem::Model& model, std::size_t elements) {
  double sum_m = 0.0;
  const std::size_t intervals = 2 * elements;
  for (std::size_t n = 0; n <= intervals; ++n) {
    const double weight = n == 0 || n == intervals ? 1.0 : (n % 2 == 1 ? 4.0 : 2.0);
    const double z_m = 0.5 * width_m * static_cast<double>(n) / static_cast<double>(intervals);
    sum_m += weight * model.displacement_at({0.0, 0.5 * width_m, z_m})[1];
  }
  return sum_m / (3.0 * static_cast<double>(intervals));
}

/// Computes an eighth of the bar. @param is_bonded whether it is bonded to the plates; otherwise it slides on them
SolidBar pulled_bar(Outcome& outcome, double poissons_ratio, bool is_bonded) {
  constexpr std::size_t elements = 4;
  const meshes::HexahedralMesh mesh =
      meshes::box({half_length_m, 0.5 * width_m, 0.5 * width_m}, {3 * elements, elements, elements});
  fem::Body body = fem::body_of(materials::NeoHookean{shear_modulus_Pa},
                                materials::SimoTaylorVolume{bulk_ratio(poissons_ratio) * shear_modulus_Pa});
  fem::hold(body, mesh, "x min", {true, false, false});
  fem::hold(body, mesh, "y min", {false, true, false});
  fem::hold(body, mesh, "z min", {false, false, true});
  body.plates.push_back({.faces = {.label = meshes::label_index(mesh, "x max")},
                         .centre = {half_length_m, 0.0, 0.0},
                         .held = {true, is_bonded, is_bonded}});
  fem::Model model(mesh, 2, body);
  fem::PathDrives drives;
  drives.plates = {{.values = {{}, {.displacement_m = {solid_bar_strain * half_length_m, 0.0, 0.0}}}}};
  fem::PathOptions options;
  options.first_step = options.largest_step = 1.0;
  const fem::PathReport report = fem::follow_path(
      model.equilibrium, drives, options,
      [&](const fem::PathPoint&, const fem::BodyState& reached, const fem::PathRestart&) { model.state = reached; });
  outcome.expect(report.status == io::RunStatus::completed, std::string(to_string(report.status)));
  const double force_N = 4.0 * report.points.back().plates[0].force_N[0];
  const double youngs_modulus_Pa = 2.0 * (1.0 + poissons_ratio) * shear_modulus_Pa;
  return {.poissons_ratio = poissons_ratio,
          .stiffness = force_N / (youngs_modulus_Pa * width_m * width_m * solid_bar_strain),
          .contraction = -mean_side_m(model, elements) / (0.5 * width_m * solid_bar_strain)};
}

/// Strains of 1e-4 give relative deviations from linearity of the same size.
void run_bar(Outcome& outcome, const SolidBar& stated) {
  const SolidBar sliding = pulled_bar(outcome, stated.poissons_ratio, false);
  outcome.expect_near("stiffness between smooth plates", sliding.stiffness, 1.0, 3e-4);
  outcome.expect_near("contraction", sliding.contraction, stated.poissons_ratio, 3e-4);
  const SolidBar bonded = pulled_bar(outcome, stated.poissons_ratio, true);
  outcome.expect_near("stiffness between bonded plates", bonded.stiffness, stated.stiffness, 1.5e-3);
  outcome.expect_near("contraction", bonded.contraction, stated.contraction, 1.5e-3);
}

/// Two halves, the outer one a million times as stiff. Their sides cannot move, so both are stretched only along the bar. With J
/// = stretch the nominal stress is mu J^(-2/3) (J - (J^2 + 2) / (3 J)) + kappa/2 (J - 1/J).
void run_contrast(Outcome& outcome) {
  constexpr double ratio = 1e6, stretch = 1.1;
  const double bulk_modulus_Pa = bulk_ratio(0.49) * shear_modulus_Pa;
  const double stress_Pa =
      shear_modulus_Pa * std::pow(stretch, -2.0 / 3.0) * (stretch - (stretch * stretch + 2.0) / (3.0 * stretch)) +
      0.5 * bulk_modulus_Pa * (stretch - 1.0 / stretch);
  meshes::HexahedralMesh mesh = meshes::box({2.0 * width_m, width_m, width_m}, {8, 2, 2});
  mesh.region_names.emplace_back("stiff");
  for (std::size_t n = 0; n < mesh.elements.size(); ++n)
    mesh.regions[n] = mesh.points[mesh.elements[n][0]][0] < 0.99 * width_m ? 0 : 1;
  fem::Body body = fem::body_of(materials::NeoHookean{shear_modulus_Pa}, materials::SimoTaylorVolume{bulk_modulus_Pa});
  body.regions.push_back(
      {materials::NeoHookean{ratio * shear_modulus_Pa}, materials::SimoTaylorVolume{ratio * bulk_modulus_Pa}, 0.0});
  fem::hold(body, mesh, "x min", {true, false, false});
  for (const char* side : {"y min", "y max"}) fem::hold(body, mesh, side, {false, true, false});
  for (const char* side : {"z min", "z max"}) fem::hold(body, mesh, side, {false, false, true});
  body.tractions = {{meshes::label_index(mesh, "x max"), {stress_Pa, 0.0, 0.0}}};
  fem::Model model(mesh, 2, body);
  const fem::PathReport report = fem::follow_path(
      model.equilibrium, std::vector<fem::PlenumDrive>{}, {},
      [&](const fem::PathPoint&, const fem::BodyState& reached, const fem::PathRestart&) { model.state = reached; });
  outcome.expect_status(report.status, io::RunStatus::completed, report.reason);
  const double soft_m = model.displacement_at({width_m, 0.0, 0.0})[0];
  const double stiff_m = model.displacement_at({2.0 * width_m, 0.0, 0.0})[0] - soft_m;
  const double stiff_strain = stress_Pa / (ratio * (bulk_modulus_Pa + 4.0 / 3.0 * shear_modulus_Pa));
  outcome.expect_near("soft half m", soft_m, (stretch - 1.0) * width_m, 1e-4);
  outcome.expect_near("stiff half m", stiff_m, stiff_strain * width_m, 1e-4);
}

}  // namespace

std::vector<Row> fem_solid_bar_rows() {
  std::vector<Row> rows;
  rows.reserve(solid_bars.size() + 1);
  for (const SolidBar& stated : solid_bars) {
    rows.push_back(
        {.name = "solid bar of nu " + shown(stated.poissons_ratio),
         .done = "bar of 1 x 1 x 3 cells, 8 x 8 x 24 Q2/P1 elements, pulled by 1e-4 by smooth and by bonded plates",
         .expected = "between smooth plates the homogeneous state, Young's modulus and nu, to 3e-4, the strain; between "
                     "bonded ones what finer meshes give, " +
                     shown(stated.stiffness) + " E and " + shown(stated.contraction) +
                     ", to 1.5e-3, the singularity at the rim of a plate. The rows of the voxels are held against this",
         .run = [stated](Outcome& outcome) { run_bar(outcome, stated); }});
  }
  rows.push_back({.name = "modulus ratio 1e6 between regions",
                  .done = "bar of two halves of 50 kPa and 50 GPa shear modulus between fixed sides, pulled by a traction",
                  .expected =
                      "the closed form: the soft half is stretched by 10 %, the stiff one by 1e-7, to 1e-4, what the search "
                      "for the equilibrium may leave of a load that is small for the stiff half",
                  .run = run_contrast});
  return rows;
}

}  // namespace menger::extremes
