#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "fem/elements/element_kernel.h"
#include "fem/surfaces/ground.h"
#include "fem/surfaces/point.h"
#include "fem/surfaces/support.h"

namespace menger::fem {

/// What a region of a body is made of.
struct RegionMaterial {
  materials::HyperelasticLaw law;
  VolumetricLaw volume;
  double density_kg_per_m3 = 0.0;  ///< of the reference configuration, >= 0
};

/// An air space: the surfaces that bound it, and the plenum it belongs to.
struct ChamberSurface {
  std::vector<std::size_t> labels;
  std::size_t plenum = 0;
};

/// A plane across an axis.
struct AxisPlane {
  std::size_t axis = 0;
  double position_m = 0.0;
};

/// Boundary faces in the reference configuration: those with a label, those that lie in a plane, or, with both, those that do
/// both.
struct FaceSet {
  std::optional<std::size_t> label{};
  std::optional<AxisPlane> plane{};
};

/// A rigid plate on faces of a body. It moves as PlateMotion (see grips.h) says, and carries the components of their nodes that
/// it holds exactly along.
struct Plate {
  FaceSet faces{};
  Point centre{};                              ///< about which it turns, in the reference configuration
  std::array<bool, 3> held{true, true, true};  ///< all three: bonded; one alone: the faces slide on it, and it must not turn
};

/// A pressure of fixed direction on the faces with a label: force per reference area, Pa.
struct Traction {
  std::size_t label;
  Point traction_Pa;
};

/// A body and everything that acts on it but the pressures of its chambers.
struct Body {
  Formulation formulation = Formulation::three_field;
  std::vector<RegionMaterial> regions;  ///< by region of the mesh
  std::vector<ChamberSurface> chambers;
  std::size_t plenum_count = 0;
  std::vector<Support> supports;
  std::vector<PointSupport> point_supports;
  std::vector<Plate> plates;  ///< no two on one node
  std::vector<Traction> tractions;
  Point gravity_m_per_s2{};
  std::optional<GroundPlane> ground;
  std::vector<std::size_t> ground_labels;  ///< faces that may touch the ground
};

}  // namespace menger::fem
