#include "fem/contact/self_contact_memory.h"

#include <algorithm>
#include <cmath>

namespace menger::fem {

const ContactMemory* memory_of(std::span<const ContactMemory> memories, std::size_t node) {
  const auto found = std::lower_bound(memories.begin(), memories.end(), node,
                                      [](const ContactMemory& memory, std::size_t wanted) { return memory.node < wanted; });
  return found != memories.end() && found->node == node ? &*found : nullptr;
}

double path_past_face_m(const ContactSurfaces& surfaces, std::size_t node, std::size_t face, const ContactPast& past) {
  const auto displacement_of = [&](std::size_t of) { return scaled(past.step_s, surfaces.point(of, past.velocities_m_per_s)); };
  const Point moved = displacement_of(node);
  double longest = 0.0;
  for (const std::uint32_t corner : surfaces.face(face))
    longest = std::max(longest, norm(difference(moved, displacement_of(corner))));
  return longest;
}

ContactMemory with_spring(const ContactMemory& before, double spring_N_per_m) {
  ContactMemory after = before;
  after.spring_N_per_m = spring_N_per_m;
  if (!(before.spring_N_per_m > 0.0) || before.spring_N_per_m == spring_N_per_m) return after;
  const double share = before.spring_N_per_m / spring_N_per_m;
  after.paid_m2 *= share;
  after.pressed_m = std::min(after.pressed_m, std::sqrt(after.paid_m2));
  if (share < 1.0) after.slip_m = scaled(std::sqrt(share), after.slip_m);
  return after;
}

ContactMemory memory_after(const ContactMemory& before, double depth_m, double path_m) {
  ContactMemory after = before;
  after.depth_m = depth_m;
  const double rise = depth_m - before.depth_m;
  if (std::abs(rise) <= path_m) {
    after.pressed_m = std::clamp(before.pressed_m + rise, 0.0, depth_m);
    after.paid_m2 = std::max(0.0, before.paid_m2 + after.pressed_m * after.pressed_m - before.pressed_m * before.pressed_m);
  } else {
    after.pressed_m = std::min(depth_m, std::sqrt(before.paid_m2));
  }
  return after;
}

}  // namespace menger::fem
