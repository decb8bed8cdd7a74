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
  std::array<double, 4> weights{};  ///< of the corners at the point nearest to the node
  Point behind_m{};                 ///< from the nearest point to the node, longer than 0
};

/// The displacement of a node along a face in a step, relative to the face. The face moves as a rigid body, and its rotation is
/// included at the node's place. The part normal to the face is left out.
/// @param node_displacement_m, corner_displacements_m displacements in the step
Point path_along_face_m(const PressedNode& pressed, const Point& node_displacement_m,
                        const std::array<Point, 4>& corner_displacements_m);

/// The friction force on a node, N. It is that of a spring along the face, as stiff as the one normal to it. The spring breaks
/// away at the static coefficient times the normal force. Then it slides with the kinetic coefficient until it can hold again.
/// While it does not slide, the node does not creep: under a steady load it moves by the length of the spring, at most mu times
/// the depth. The spring rotates with the face.
/// @param memory in: slip and is_sliding at the start of the step; out: at its end; pressed_m gives the normal force
/// @param path_m as path_along_face_m returns it @param turn_rad rotation of the face in the step
/// @param spring_N_per_m stiffness, also of the spring normal to the face
Point friction_force_N(const SurfaceFriction& friction, const PressedNode& pressed, const Point& path_m, const Point& turn_rad,
                       double spring_N_per_m, ContactMemory& memory);

/// The rotation of a face in a step, rad, as a least-squares fit to the displacements of its corners.
Point face_turn_rad(const FaceCorners& corners, const std::array<Point, 4>& corner_displacements_m);

/// The forces on the corners of the face that balance a force on the node and its moment, N.
std::array<Point, 4> face_reactions_N(const PressedNode& pressed, const Point& force_N);

}  // namespace menger::fem
