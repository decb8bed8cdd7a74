#pragma once

#include "fem_model.h"

namespace menger::fem {

// A sphere and a cylinder (plane strain) of radii 8 and 10 mm, shear modulus 50 kPa.
inline constexpr double inner_radius_m = 8e-3;
inline constexpr double outer_radius_m = 10e-3;
inline constexpr double vessel_shear_modulus_Pa = 50e3;

enum class Vessel { sphere, cylinder };

/// What a vessel is made of and how its elements are.
struct VesselCase {
  Vessel vessel;
  materials::HyperelasticLaw law;
  double bulk_modulus_Pa;
  int degree;
  Formulation formulation = Formulation::three_field;
};

/// A state of a vessel.
struct VesselState {
  double pressure_Pa;
  double outer_stretch;  ///< of the outer radius, where the x axis meets it
};

/// An octant of the sphere or a quarter of the cylinder, with `fineness` elements through the wall and in proportion along it.
meshes::HexahedralMesh vessel_mesh(Vessel vessel, std::size_t fineness);

/// Its supports and chamber.
Body vessel_body(const VesselCase& vessel);

/// The states at inner stretches, each prescribed through the volume of the chamber, which is that of the reference mesh times
/// the stretch to the third power (second for the cylinder).
std::vector<VesselState> inflate(const VesselCase& vessel, std::size_t fineness, const std::vector<double>& inner_stretches);

/// The pressure without volume change, from those at a bulk modulus of ten and of twenty thousand shear moduli: the terms in
/// 1/kappa cancel, and those in 1/kappa^2 are below 1e-5 (at a thousand moduli compression changes the pressure by up to 1 %).
std::vector<double> incompressible_pressures_Pa(VesselCase vessel, std::size_t fineness,
                                                const std::vector<double>& inner_stretches);

}  // namespace menger::fem
