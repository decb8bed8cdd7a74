#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "fem/contact/self_contact_surface.h"
#include "fem/surfaces/point.h"

namespace menger::fem {

/// What the contact of a node keeps from one step to the next.
///
/// The depth of a node behind its surface follows the motion of both, but for nodes that slip over an edge of the body or in from
/// beside it: these are deep at once, or not at all. The spring of a node is therefore pressed by changes of its depth that
/// motion explains. What a jump would put into it, it may hold only as far as the body has paid for before, in springs that
/// slipped out. So springs never give more than they took.
struct ContactMemory {
  std::uint32_t node = 0;   ///< of the contact surfaces
  std::uint32_t face = 0;   ///< that it was behind last
  double depth_m = 0.0;     ///< 0: it was behind none
  double pressed_m = 0.0;   ///< length by which its spring is pressed, at most the depth
  double paid_m2 = 0.0;     ///< square of the length that energy was put into the spring for and not taken out again, >= 0
  Point slip_m{};           ///< of the spring along the face that holds by friction
  bool is_sliding = false;  ///< else it sticks

  bool operator==(const ContactMemory&) const = default;
};

/// The step that has led to a state.
struct ContactPast {
  std::span<const ContactMemory> memories;       ///< at its start, ascending by node
  std::span<const double> velocities_m_per_s{};  ///< in it, 3 per node of the mesh
  double step_s = 0.0;
};

/// The memory of a node, if it has one.
const ContactMemory* memory_of(std::span<const ContactMemory> memories, std::size_t node);

/// A bound of the change of a node's distance from a face in a step: the longest way of the node as the corners see it, m.
double way_past_face_m(const ContactSurfaces& surfaces, std::size_t node, std::size_t face, const ContactPast& past);

/// The memory of a node after a step, without its slip.
/// @param before at its start; none: an empty one @param depth_m behind a face now; 0: behind none @param way_m by which motion
/// can have changed the depth
ContactMemory memory_after(const ContactMemory& before, double depth_m, double way_m);

}  // namespace menger::fem
