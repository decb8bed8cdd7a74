#pragma once

#include <vector>

#include "tests/extremes/row.h"
#include "tests/verification/fem_model.h"

namespace menger::extremes {

inline constexpr double shear_modulus_Pa = 50e3;

/// A bulk modulus so large that compression changes a pressure by at most 1e-4.
inline constexpr double nearly_incompressible = 1e4;  ///< bulk modulus divided by shear modulus

/// Returns the bulk modulus divided by the shear modulus at Poisson's ratio nu: 2 (1 + nu) / (3 (1 - 2 nu)).
double bulk_ratio(double poissons_ratio);

/// Returns the inner pressure of an incompressible neo-Hookean sphere at an inner stretch: mu/2 (4/b + b^-4 - 4/a - a^-4), with
/// the inner stretch a and the outer stretch b. @param radius_ratio outer radius divided by inner radius
double sphere_pressure_Pa(double inner_stretch, double radius_ratio);

/// Follows the drive of the only plenum and stores the state in the model. A path of more than `most_points` states ends as
/// stopped.
fem::PathReport follow(fem::Model& model, const fem::PlenumDrive& drive, const fem::PathOptions& options,
                       std::size_t most_points = 200);

/// Checks the energy error at the end of a path: the work of the pressures minus the strain energy, divided by the largest strain
/// energy.
void expect_energy_error(Outcome& outcome, const fem::PathReport& report, double bound);

fem::PlenumDrive pressure_drive(double pressure_Pa);
fem::PlenumDrive volume_drive(double volume_ratio);

/// Returns the plenum's volume at the end of a path divided by that at its start.
double volume_ratio(const fem::PathReport& report);

/// A whole hollow cube of silicone. Three corners prevent rigid motions. Elements grow away from the walls.
/// @param wall_by_edge wall thickness divided by edge
struct HollowCube {
  explicit HollowCube(double wall_by_edge, int elements_through_wall = 1, double modulus_Pa = shear_modulus_Pa);

  static constexpr double edge_m = 0.02;
  meshes::HexahedralMesh mesh;
  fem::Body body;
};

std::vector<Row> fem_incompressibility_rows();
std::vector<Row> fem_wall_rows();
std::vector<Row> fem_path_rows();
std::vector<Row> fem_input_rows();
std::vector<Row> fem_solid_bar_rows();

}  // namespace menger::extremes
