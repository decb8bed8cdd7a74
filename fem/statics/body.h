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
#include "fem/thin_walls/element_choice.h"
#include "fem/thin_walls/thin_wall_mesh.h"

namespace menger::fem {

/// The material of a region of a body: isochoric law, volumetric law and density.
struct RegionMaterial {
  materials::HyperelasticLaw law;
  VolumetricLaw volume;
  double density_kg_per_m3 = 0.0;  ///< of the reference configuration, >= 0
};

/// An air space: the labels of the surfaces that bound it, and the plenum it belongs to.
struct ChamberSurface {
  std::vector<std::size_t> labels;
  std::size_t plenum = 0;
};

/// A plane normal to an axis.
struct AxisPlane {
  std::size_t axis = 0;
  double position_m = 0.0;
};

/// A set of boundary faces in the reference configuration: the faces with a label, the faces in a plane, or, if both are given,
/// those that have the label and lie in the plane.
struct FaceSet {
  std::optional<std::size_t> label{};
  std::optional<AxisPlane> plane{};
  /// Opposite corners of boxes: only faces whose middle lies in one of them. Without boxes, faces anywhere.
  std::vector<std::array<Point, 2>> boxes{};
};

/// A rigid plate on faces of a body. It moves as PlateMotion (see grips.h) states. It carries the nodes of the faces along
/// exactly, in the components that it holds.
struct Plate {
  FaceSet faces{};
  Point centre{};  ///< centre of rotation, in the reference configuration
  /// All three: bonded. Only one: the faces slide on the plate, and it must not rotate.
  std::array<bool, 3> held{true, true, true};
};

/// A load of fixed direction on the faces with a label: force per reference area, Pa.
struct Traction {
  std::size_t label;
  Point traction_Pa;
};

/// What says that the elements of a body are walls and blocks. The space must have degree 1 and no refinements (asserted).
struct ThinWallBody {
  ThinWallConstants constants = constants_of_equilibria;
  std::vector<ThinWallPlace> places;  ///< of each element of the mesh; plena as in Body::chambers
};

/// A body and everything that acts on it, except the pressures of its chambers.
struct Body {
  Formulation formulation = Formulation::three_field;
  std::optional<ThinWallBody> thin_walls{};  ///< takes the place of the formulation
  std::vector<RegionMaterial> regions;       ///< by region of the mesh
  std::vector<ChamberSurface> chambers;
  std::size_t plenum_count = 0;
  std::vector<Support> supports;
  std::vector<PointSupport> point_supports;
  std::vector<Plate> plates;  ///< no two plates share a node
  std::vector<Traction> tractions;
  Point gravity_m_per_s2{};
  std::optional<GroundPlane> ground;
  std::vector<std::size_t> ground_labels;  ///< faces that may touch the ground
};

}  // namespace menger::fem
