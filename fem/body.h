#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "fem/element_kernel.h"
#include "fem/ground.h"
#include "fem/point.h"

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

/// Displacement components held at zero on all nodes of the faces with a label.
struct Support {
  std::size_t label;
  std::array<bool, 3> held;
};

/// A displacement component held at zero at the node nearest to a point of the reference configuration.
struct PointSupport {
  Point position;
  std::array<bool, 3> held;
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
  std::vector<Traction> tractions;
  Point gravity_m_per_s2{};
  std::optional<GroundPlane> ground;
  std::vector<std::size_t> ground_labels;  ///< faces that may touch the ground
};

}  // namespace menger::fem
