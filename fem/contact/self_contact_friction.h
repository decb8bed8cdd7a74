#pragma once

#include <array>

#include "fem/contact/self_contact_face.h"
#include "fem/contact/self_contact_memory.h"

namespace menger::fem {

/// Coulomb's friction between parts of a body's surface.
struct SurfaceFriction {
  double static_coefficient = 0.0;   ///< >= kinetic
  double kinetic_coefficient = 0.0;  ///< >= 0
};

/// A node that is behind a face.
struct PressedNode {
  FaceCorners corners{};
  std::array<double, 4> weights{};  ///< of the corners in the point that is nearest to the node
  Point behind_m{};                 ///< from that point to the node, longer than 0
};

/// Where a step has moved a node along a face that moves as a rigid body: without what is normal to it, and without the turn of
/// the face, as it moves points at the node's place.
/// @param node_way_m, corner_ways_m displacements in the step
Point way_along_face_m(const PressedNode& pressed, const Point& node_way_m, const std::array<Point, 4>& corner_ways_m);

/// The force on the node, N, of a spring along the face as stiff as that normal to it, which breaks away at the static
/// coefficient times the normal force and then slides with the kinetic one until it would hold again.
/// Not sliding, a node creeps nowhere: under a steady load it moves by the length of the spring, which is mu times the depth at
/// most. The spring turns with the face.
/// @param memory slip and whether it slides: those of the start of the step, changed
/// @param way_m see above @param turn_rad of the face in the step @param spring_N_per_m of pressed_m of the memory
Point friction_force_N(const SurfaceFriction& friction, const PressedNode& pressed, const Point& way_m, const Point& turn_rad,
                       double spring_N_per_m, ContactMemory& memory);

/// The least-squares turn of the corners of a face in a step, rad.
Point face_turn_rad(const FaceCorners& corners, const std::array<Point, 4>& corner_ways_m);

/// Forces on the corners that balance a force on the node, with its moment, N.
std::array<Point, 4> face_reactions_N(const PressedNode& pressed, const Point& force_N);

}  // namespace menger::fem
