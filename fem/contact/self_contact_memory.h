#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "fem/contact/self_contact_surface.h"
#include "fem/surfaces/point.h"

namespace menger::fem {

/// What the contact of a node carries from one step to the next.
///
/// The depth of a node usually changes only as the node and its surface move. The exceptions are nodes that slip over an edge of
/// the body, or in from beside it: they are deep at once, or no longer deep at all. Therefore the compression of a node's spring
/// follows only those changes of depth that motion explains. After a jump, the spring may be compressed only as far as its energy
/// has been paid for before, by work on a spring that slipped out. So springs never give more energy than they took.
struct ContactMemory {
  std::uint32_t node = 0;  ///< of the contact surfaces
  std::uint32_t face = 0;  ///< the face that the node was behind last
  double depth_m = 0.0;    ///< 0: the node was behind no face
  double pressed_m = 0.0;  ///< compression of the spring, at most the depth
  /// The square of the compression whose energy was put into the spring and not taken out again, >= 0.
  double paid_m2 = 0.0;
  double spring_N_per_m = 0.0;  ///< stiffness of the spring; 0: none yet
  Point slip_m{};               ///< elongation of the friction spring along the face
  bool is_sliding = false;      ///< false: it sticks

  bool operator==(const ContactMemory&) const = default;
};

/// The step that led to a state.
struct ContactPast {
  std::span<const ContactMemory> memories;       ///< at the start of the step, ascending by node
  std::span<const double> velocities_m_per_s{};  ///< during the step, 3 per node of the mesh
  double step_s = 0.0;
};

/// Returns the memory of a node, or nullptr if it has none.
const ContactMemory* memory_of(std::span<const ContactMemory> memories, std::size_t node);

/// An upper bound of how much a node's distance from a face changed in a step, m: the largest displacement of the node relative
/// to a corner of the face.
double path_past_face_m(const ContactSurfaces& surfaces, std::size_t node, std::size_t face, const ContactPast& past);

/// Returns a memory whose spring has become another one, as where a node slides to lighter or heavier nodes (see TouchLimit). No
/// energy grows: a spring that stiffens is compressed less, one that softens keeps its compression.
/// @param spring_N_per_m > 0
ContactMemory with_spring(const ContactMemory& before, double spring_N_per_m);

/// Returns the memory of a node after a step, without its slip.
/// @param before at the start of the step; an empty one if there was none @param depth_m present depth behind a face; 0: behind
/// none
/// @param path_m largest change of depth that motion can explain
ContactMemory memory_after(const ContactMemory& before, double depth_m, double path_m);

}  // namespace menger::fem
