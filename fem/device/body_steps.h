#pragma once

// Steps of a body by a block of threads: the same code for the threads of a graphics processor and for a lone one.

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

#include "fem/device/body_arrays.h"
#include "fem/explicit/face_forces.h"
#include "fem/explicit/node_kick.h"
#include "fem/explicit/step_taker.h"
#include "fem/thin_walls/element_forces.h"
#include "io/device/host_device.h"

namespace menger::fem::detail {

/// Steps after which rounded displacements begin anew at the place of the body, as ExplicitDynamics does it.
inline constexpr std::size_t steps_per_origin = 32;

/// StepsOrder without its arrays.
struct BlockOrder {
  double first_kick_s = 0.0;
  double step_s = 0.0;
  std::size_t count = 0;
  double branch_age_s = 0.0;
  double relaxation_interval_s = 0.0;
  Point common_velocity_m_per_s{};
  double free_travel_m = 0.0;
};

/// StepsOutcome without its arrays.
struct BlockOutcome {
  std::size_t steps = 0;
  bool has_failed = false;
  double travel_m = 0.0;
  double branch_age_s = 0.0;
  MotionWork work{};
};

inline BlockOrder block_order(const StepsOrder& order) {
  return {order.first_kick_s,
          order.step_s,
          order.count,
          order.branch_age_s,
          order.relaxation_interval_s,
          order.common_velocity_m_per_s,
          order.free_travel_m};
}

/// @param volumes_m3 as BodySteps::take writes them
inline StepsOutcome outcome_of(const BlockOutcome& outcome, std::span<const double> volumes_m3) {
  StepsOutcome result{outcome.steps, outcome.has_failed, outcome.travel_m, outcome.branch_age_s, outcome.work, {}};
  for (std::size_t n = 0; n < volumes_m3.size(); n += 2) {
    result.volumes.walls_m3.push_back(volumes_m3[n]);
    result.volumes.chambers_m3.push_back(volumes_m3[n + 1]);
  }
  return result;
}

/// A block of threads that takes steps of one body; each thread has one of these.
/// @tparam Law of all materials @tparam T number of a lane: WarpNumber, or a plain number for a lone thread @tparam Thread see
/// io::LoneThread
template <class Law, class T, class Thread>
class BodySteps {
 public:
  using Number = NumberOf<T>;
  static constexpr std::size_t width = Lanes<T>::count;

  MENGER_HOST_DEVICE BodySteps(Thread& thread, const BodyView<Number>& body, const StepsMemory<Number>& memory,
                               const BlockOrder& order)
      : thread_(thread), body_(body), memory_(memory), order_(order) {}

  /// Takes the steps. @param volumes_m3 two per plenum, written: PressedVolumes of walls and of chambers
  MENGER_HOST_DEVICE BlockOutcome take(double* volumes_m3) {
    BlockOutcome outcome;
    outcome.branch_age_s = order_.branch_age_s;
    copy_branches<true>();
    while (outcome.steps < order_.count && !outcome.has_failed) {
      if (outcome.steps % steps_per_origin == 0) follow_all();
      const bool relaxes =
          order_.relaxation_interval_s > 0.0 && outcome.branch_age_s + 0.5 * order_.step_s > order_.relaxation_interval_s;
      relaxed_s_ = relaxes ? outcome.branch_age_s : 0.0;
      outcome.branch_age_s = (relaxes ? 0.0 : outcome.branch_age_s) + order_.step_s;
      kick_ = kick_of(outcome.steps == 0 ? order_.first_kick_s : order_.step_s, body_.mass_damping_per_s);
      kick_s_ = outcome.steps == 0 ? order_.first_kick_s : order_.step_s;
      pressures_ = memory_.pressures_Pa + body_.plenum_count * (outcome.steps + 1);
      outcome.has_failed = thread_.any(compute_forces());
      if (outcome.has_failed) break;
      float fastest_square = 0.0F;
      for (std::size_t node = thread_.index(); node < body_.node_count; node += thread_.count()) {
        const float square = move(node);
        fastest_square = square > fastest_square ? square : fastest_square;
      }
      ++outcome.steps;
      outcome.travel_m += order_.step_s * std::sqrt(static_cast<double>(thread_.largest(fastest_square)));
      if (!(outcome.travel_m < order_.free_travel_m)) break;
    }
    thread_.wait();
    copy_branches<false>();
    sum_up(outcome, volumes_m3);
    return outcome;
  }

 private:
  /// Copies branches from where the processor keeps them, or back.
  template <bool from_given>
  MENGER_HOST_DEVICE void copy_branches() const {
    if (body_.branch_number_count == 0) return;
    for (std::size_t g = 0; g < body_.group_count; ++g) {
      const GroupView<Number>& group = body_.groups[g];
      const std::size_t count = thin_wall_branch_numbers(group.task.batches.element);
      for (std::size_t b = thread_.batch(); b < group.batch_count; b += thread_.batch_count()) {
        const std::size_t lane = (group.first_batch + b) * width + thread_.lane();
        Number* own = memory_.branches + group.branch_position + count * width * b + thread_.lane();
        Number* given = memory_.given_branches + body_.given_branches[lane];
        if (!from_given && body_.is_repeated[lane] != 0) continue;
        for (std::size_t set = 0; set < body_.branch_set_count; ++set) {
          for (std::size_t n = 0; n < count; ++n) {
            Number& here = own[set * body_.sets_apart + n * width];
            Number& there = given[set * body_.given_sets_apart + n * body_.given_apart];
            if constexpr (from_given) {
              here = there;
            } else {
              there = here;
            }
          }
        }
      }
    }
  }

  /// Sets the rounded displacements and velocities of all nodes anew, relative to those of the first one.
  MENGER_HOST_DEVICE void follow_all() {
    thread_.wait();
    for (std::size_t i = 0; i < 3; ++i) {
      origin_m_[i] = memory_.displacements_m[i];
      origin_m_per_s_[i] = memory_.velocities_m_per_s[i];
    }
    thread_.wait();
    for (std::size_t node = thread_.index(); node < body_.node_count; node += thread_.count()) follow(node);
    thread_.wait();
  }

  MENGER_HOST_DEVICE void follow(std::size_t node) {
    for (std::size_t i = 0; i < 3; ++i) {
      memory_.values_m[3 * node + i] = static_cast<Number>(memory_.displacements_m[3 * node + i] - origin_m_[i]);
      if (body_.is_viscous)
        memory_.rates_m_per_s[3 * node + i] = static_cast<Number>(memory_.velocities_m_per_s[3 * node + i] - origin_m_per_s_[i]);
    }
  }

  /// @return whether one of this thread's elements has failed
  MENGER_HOST_DEVICE bool compute_forces() {
    bool fails = false;
    const GroupView<Number>* group = body_.groups;
    for (std::size_t batch = thread_.batch(); batch < body_.batch_count; batch += thread_.batch_count()) {
      while (batch >= group->first_batch + group->batch_count) ++group;
      const bool fail = group->task.batches.element == ThinWallElement::wall ? compute_elements<WallElement<T>>(*group, batch)
                                                                             : compute_elements<BlockElement<T>>(*group, batch);
      fails = fails || fail;
    }
    for (std::size_t batch = thread_.batch(); batch < body_.face_batch_count; batch += thread_.batch_count()) press_faces(batch);
    return fails;
  }

  MENGER_HOST_DEVICE double pressure_Pa(int plenum) const { return plenum < 0 ? 0.0 : pressures_[plenum]; }

  /// What a change of volume of a plenum adds to the work of changing pressures, see ExplicitDynamics: the mean of both changes
  /// beside this step.
  MENGER_HOST_DEVICE double pressure_change_Pa(int plenum) const {
    const auto count = static_cast<std::ptrdiff_t>(body_.plenum_count);
    return plenum < 0 ? 0.0 : 0.5 * (pressures_[plenum + count] - pressures_[plenum - count]);
  }

  template <class Element>
  MENGER_HOST_DEVICE bool compute_elements(const GroupView<Number>& group, std::size_t batch) {
    ThinWallTask<Number> task = group.task;
    const std::size_t own = batch - group.first_batch;
    task.motion.displacements_m = memory_.values_m;
    if (task.viscosity_Pa_s > 0.0) task.motion.velocities_m_per_s = memory_.rates_m_per_s;
    if (task.branch_count > 0) {
      task.branch = memory_.branches + group.branch_position;
      if (relaxed_s_ > 0.0) {
        task.relaxing = memory_.branches + group.branch_position;
        for (std::size_t n = 0; n < task.branch_count; ++n)
          task.shares[n] = -std::expm1(-relaxed_s_ / group.relaxation_times_s[n]);
      }
    }
    Element element(task, own);
    const std::size_t first = 2 * width * batch + thread_.lane();
    const std::array<int, 2> plena{body_.plena[first], body_.plena[first + width]};
    if constexpr (Element::kind == ThinWallElement::wall)
      element.set_mean_pressure(T(0.5 * (pressure_Pa(plena[0]) + pressure_Pa(plena[1]))));
    compute_element_forces<true>(task, own, InlineLaw<Law>(task), element);
    if constexpr (Element::kind == ThinWallElement::wall) {
      for (std::size_t face = 0; face < 2; ++face) {
        if (plena[face] < 0) continue;
        T side = Lanes<T>::load(body_.sides + width * batch);
        if (face == 1) side = -side;
        const T swept = element.press_face(side, T(pressure_Pa(plena[face])));
        Lanes<T>::store(swept, memory_.side_volumes_m3 + (2 * batch + face) * width);
        pressure_J_ -= Lanes<T>::own(swept) * pressure_change_Pa(plena[face]);
      }
      const T change = element.volume_change();
      Lanes<T>::store(change, memory_.wall_volumes_m3 + width * batch);
      wall_pressure_J_ -= 0.5 * Lanes<T>::own(change) * (pressure_change_Pa(plena[0]) + pressure_change_Pa(plena[1]));
    }
    element.store(memory_.forces_N + body_.numbers_per_batch * batch);
    if (task.viscosity_Pa_s > 0.0) viscous_J_ += kick_s_ * Lanes<T>::own(element.dissipation());
    if (task.relaxing != nullptr) viscous_J_ += Lanes<T>::own(element.relaxed());
    constexpr double smallest = ThinWallOutcome::smallest_allowed_ratio * ThinWallOutcome::smallest_allowed_ratio;
    return !(Lanes<T>::own(element.smallest_square()) >= smallest);
  }

  MENGER_HOST_DEVICE void press_faces(std::size_t batch) {
    const int plenum = body_.face_plena[width * batch + thread_.lane()];
    std::array<Vector3<T>, 4> values;
    for (std::size_t c = 0; c < 4; ++c) {
      const std::uint32_t first = body_.face_components[(4 * batch + c) * width + thread_.lane()];
      for (std::size_t i = 0; i < 3; ++i) values[c][i] = T(memory_.values_m[first + i]);
    }
    const Number* edges = body_.half_edges_m + 6 * width * batch;
    Vector3<T> A0;
    Vector3<T> C0;
    for (std::size_t i = 0; i < 3; ++i) {
      A0[i] = Lanes<T>::load(edges + i * width);
      C0[i] = Lanes<T>::load(edges + (3 + i) * width);
    }
    // Forces of elements are subtracted from what accelerates the nodes.
    const double pressure = -pressure_Pa(plenum);
    const FaceForces<T> forces = face_forces(values, A0, C0, T(-pressure), T(-pressure / 3.0));
    for (std::size_t c = 0; c < 4; ++c)
      for (std::size_t i = 0; i < 3; ++i)
        Lanes<T>::store(forces.corners[c][i], memory_.forces_N + body_.first_face_number + ((4 * batch + c) * 3 + i) * width);
    Lanes<T>::store(forces.swept, memory_.face_volumes_m3 + width * batch);
    pressure_J_ -= Lanes<T>::own(forces.swept) * pressure_change_Pa(plenum);
  }

  /// Adds up the slots of a node, some at once, since memory answers late.
  MENGER_HOST_DEVICE std::array<Number, 3> force_on(std::size_t node) const {
    constexpr std::size_t at_once = 4;
    std::array<Number, 3> force{Number(0), Number(0), Number(0)};
    const std::size_t count = body_.slot_counts[node];
    for (std::size_t first = 0; first < count; first += at_once) {
      std::array<const Number*, at_once> slots{};
      for (std::size_t n = 0; n < at_once; ++n)
        if (first + n < count) slots[n] = memory_.forces_N + body_.slots[(first + n) * body_.node_count + node];
      for (std::size_t n = 0; n < at_once; ++n)
        for (std::size_t i = 0; i < 3; ++i)
          if (first + n < count) force[i] += slots[n][i * body_.component_apart];
    }
    return force;
  }

  /// Kicks and moves a node. @return the square of its speed relative to the common velocity, rounded up, m^2/s^2
  MENGER_HOST_DEVICE float move(std::size_t node) {
    const std::array<Number, 3> force = force_on(node);
    double* displacement = memory_.displacements_m + 3 * node;
    double* velocity = memory_.velocities_m_per_s + 3 * node;
    const double* inverse_mass = body_.inverse_masses_per_kg + 3 * node;
    std::array<double, 3> after;
    for (std::size_t i = 0; i < 3; ++i) {
      after[i] = kick_.kept * velocity[i] - kick_.time_s * inverse_mass[i] * static_cast<double>(force[i]);
      if (inverse_mass[i] > 0.0) after[i] += kick_.time_s * body_.gravity_m_per_s2[i];
    }
    const double depth = body_.has_ground ? body_.ground.height_m - (body_.heights_m[node] + displacement[2]) : 0.0;
    if (depth > 0.0) {
      const double normal_N = body_.ground.stiffness_Pa_per_m * body_.outer_areas_m2[node] * depth;
      after[2] += kick_.time_s * inverse_mass[2] * normal_N;
      if (inverse_mass[0] > 0.0 && inverse_mass[1] > 0.0)
        friction_J_ += apply_friction(body_.ground.friction, kick_, normal_N, body_.masses_kg[node], velocity, after.data());
      contact_J_ += kick_s_ * normal_N * 0.5 * (velocity[2] + after[2]);
    }
    double speed_square = 0.0;
    double mean_square = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
      const double mean = 0.5 * (velocity[i] + after[i]);
      mean_square += mean * mean;
      const double apart = after[i] - order_.common_velocity_m_per_s[i];
      speed_square += apart * apart;
      velocity[i] = after[i];
      displacement[i] += order_.step_s * after[i];
    }
    if (body_.mass_damping_per_s > 0.0)
      mass_damping_J_ += body_.mass_damping_per_s * kick_s_ * body_.masses_kg[node] * mean_square;
    follow(node);
    return static_cast<float>(speed_square * (1.0 + 1e-6));
  }

  /// Adds up what all threads have found.
  MENGER_HOST_DEVICE void sum_up(BlockOutcome& outcome, double* volumes_m3) {
    outcome.work.contact_J = thread_.sum(contact_J_);
    outcome.work.friction_J = thread_.sum(friction_J_);
    outcome.work.viscous_J = thread_.sum(viscous_J_);
    outcome.work.mass_damping_J = thread_.sum(mass_damping_J_);
    outcome.work.pressure_J = thread_.sum(pressure_J_);
    outcome.work.wall_pressure_J = thread_.sum(wall_pressure_J_);
    const double* last = memory_.pressures_Pa + body_.plenum_count * outcome.steps;
    for (std::size_t p = 0; p < body_.plenum_count; ++p) {
      double walls = 0.0;
      double chambers = 0.0;
      for (std::size_t batch = thread_.batch(); batch < body_.batch_count; batch += thread_.batch_count()) {
        for (std::size_t face = 0; face < 2; ++face) {
          if (body_.plena[(2 * batch + face) * width + thread_.lane()] != static_cast<int>(p)) continue;
          walls += 0.5 * static_cast<double>(memory_.wall_volumes_m3[width * batch + thread_.lane()]);
          chambers += static_cast<double>(memory_.side_volumes_m3[(2 * batch + face) * width + thread_.lane()]);
        }
      }
      for (std::size_t batch = thread_.batch(); batch < body_.face_batch_count; batch += thread_.batch_count())
        if (body_.face_plena[width * batch + thread_.lane()] == static_cast<int>(p))
          chambers += static_cast<double>(memory_.face_volumes_m3[width * batch + thread_.lane()]);
      walls = thread_.sum(walls);
      chambers = thread_.sum(chambers);
      // The pressure that would follow the last step has done no work yet.
      const double change_Pa = outcome.steps > 0 ? 0.5 * (last[body_.plenum_count + p] - last[p]) : 0.0;
      outcome.work.wall_pressure_J += walls * change_Pa;
      outcome.work.pressure_J += chambers * change_Pa;
      if (thread_.index() == 0) {
        volumes_m3[2 * p] = walls;
        volumes_m3[2 * p + 1] = chambers;
      }
    }
  }

  Thread& thread_;
  const BodyView<Number>& body_;
  const StepsMemory<Number>& memory_;
  const BlockOrder& order_;
  Point origin_m_{};
  Point origin_m_per_s_{};
  double relaxed_s_ = 0.0;
  double kick_s_ = 0.0;
  Kick kick_{};
  const double* pressures_ = nullptr;
  double contact_J_ = 0.0;
  double friction_J_ = 0.0;
  double viscous_J_ = 0.0;
  double mass_damping_J_ = 0.0;
  double pressure_J_ = 0.0;
  double wall_pressure_J_ = 0.0;
};

}  // namespace menger::fem::detail
