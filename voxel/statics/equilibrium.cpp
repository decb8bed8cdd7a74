#include "voxel/statics/equilibrium.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace menger::voxel {
namespace {

Vector3<double> between(const Vector3<double>& a, const Vector3<double>& b, double share) { return a + share * (b - a); }

/// An entry of a list that may be shorter than another; missing entries are zero.
template <class Value>
Value entry(const std::vector<Value>& values, std::size_t i) {
  return i < values.size() ? values[i] : Value{};
}

/// Loads on the straight path between two sets of loads.
StaticLoads between(const StaticLoads& a, const StaticLoads& b, double share) {
  if (share >= 1.0) return b;
  StaticLoads loads;
  for (std::size_t i = 0; i < b.pressures_Pa.size(); ++i)
    loads.pressures_Pa.push_back(entry(a.pressures_Pa, i) + share * (b.pressures_Pa[i] - entry(a.pressures_Pa, i)));
  loads.gravity_m_s2 = a.gravity_m_s2 + share * (b.gravity_m_s2 - a.gravity_m_s2);
  for (std::size_t i = 0; i < std::max(a.plates.size(), b.plates.size()); ++i) {
    const PlateMotion from = entry(a.plates, i);
    const PlateMotion to = entry(b.plates, i);
    loads.plates.push_back({between(from.displacement, to.displacement, share), between(from.rotation, to.rotation, share)});
  }
  const auto add_points = [&loads](const std::vector<PointLoad>& points, double factor) {
    for (const PointLoad& point : points) loads.points.push_back({point.voxel, factor * point.force, factor * point.moment});
  };
  add_points(a.points, 1.0 - share);
  add_points(b.points, share);
  return loads;
}

}  // namespace

Equilibrium::Equilibrium(const StaticBody& body, const Supports& supports, const EquilibriumOptions& options)
    : body_(&body), options_(options), balance_(body, supports), state_(balance_.state_at_rest()) {
  loads_.pressures_Pa.assign(body.voxels.chamber_count, 0.0);
  static_cast<void>(balance_.set_loads(loads_));  // zero pressure is always in range
}

io::RunStatus Equilibrium::load(const StaticLoads& target) {
  iteration_limit_ = newton_.iteration_count() + static_cast<std::size_t>(options_.largest_total_count);
  const StaticLoads start = loads_;
  const io::RunStatus failure =
      driven_sizes(*body_, target.pressures_Pa) ? io::RunStatus::not_converged : io::RunStatus::limit_point;
  double reached = 0.0;
  double step = 1.0;
  while (reached < 1.0) {
    const double next = std::min(1.0, reached + step);
    const StaticState before = state_;
    StaticLoads loads = between(start, target, next);
    if (balance_.set_loads(loads) && solve()) {
      loads_ = std::move(loads);
      reached = next;
      step *= 2.0;
      continue;
    }
    state_ = before;
    newton_.forget_tangent();
    static_cast<void>(balance_.set_loads(loads_));
    step *= 0.5;
    if (step < options_.smallest_load_step || newton_.iteration_count() >= iteration_limit_) return failure;
  }
  return io::RunStatus::completed;
}

bool Equilibrium::place(const StaticLoads& loads, const StaticState& state) {
  if (!balance_.set_loads(loads)) return false;
  loads_ = loads;
  state_ = state;
  newton_.forget_tangent();
  return true;
}

bool Equilibrium::solve() {
  constexpr int free_rounds = 4;
  balance_.place_plates(state_);
  for (int round = 0;; ++round) {
    if (!find_balance()) return false;
    if (!balance_.update_beam_states(state_, round >= free_rounds)) return true;
    newton_.forget_tangent();
  }
}

bool Equilibrium::find_balance() {
  // Rotations cannot be added. The unknowns are therefore steps from an origin, and a tangent is that of steps from the state
  // where it is formed. The origin moves to that state.
  StaticState origin = state_;
  StaticState moved = state_;
  Eigen::VectorXd unknowns = Eigen::VectorXd::Zero(balance_.unknown_count());
  Eigen::VectorXd at_origin = unknowns;
  const auto move_to = [&](const Equations::Values& x) {
    moved.poses = origin.poses;
    balance_.move(moved, x - at_origin);
  };
  Equations equations;
  equations.residual = [&](const Equations::Values& x, Eigen::Ref<Eigen::VectorXd> residual) {
    move_to(x);
    residual = -balance_.residual(moved);
  };
  equations.tangent = [&](const Equations::Values& x) -> const Eigen::SparseMatrix<double>& {
    move_to(x);
    std::swap(origin.poses, moved.poses);
    at_origin = x;
    static_cast<void>(balance_.linearise(origin));
    return balance_.stiffness();
  };
  NewtonOptions options;
  options.tolerance = options_.tolerance;
  const std::size_t left = iteration_limit_ - std::min(iteration_limit_, newton_.iteration_count());
  options.largest_iteration_count = std::min<long>(options_.largest_iteration_count, static_cast<long>(left));
  const bool found = newton_.find_root(equations, unknowns, options);
  move_to(unknowns);
  state_.poses = moved.poses;
  return found;
}

PlateLoad Equilibrium::plate_load(std::size_t plate) const {
  const std::vector<NodeLoad> loads = balance_.node_loads(state_);
  const Vector3<double> motion = entry(loads_.plates, plate).displacement;
  const Vector3<double> centre = body_->plates[plate].centre + motion;
  PlateLoad sum;
  for (std::size_t place = 0; place < body_->places.size(); ++place) {
    if (body_->places[place].plate != plate) continue;
    const std::size_t node = body_->voxel_count() + place;
    const NodeLoad& load = loads[node];
    const Vector3<double> force{load[0], load[1], load[2]};
    const Vector3<double> moment{load[3], load[4], load[5]};
    sum.force = sum.force - force;
    sum.moment = sum.moment - moment - cross(state_.poses[node].position - centre, force);
  }
  return sum;
}

double Equilibrium::ground_force_N() const {
  double sum = 0.0;
  for (std::size_t voxel = 0; voxel < body_->voxel_count(); ++voxel) sum += balance_.ground_force(state_, voxel);
  return sum;
}

double Equilibrium::axial_strain(std::size_t beam) const {
  const StaticBeam& ends = body_->beams[beam];
  const Vector3<double> separation = state_.poses[ends.upper].position - state_.poses[ends.lower].position;
  return std::sqrt(dot(separation, separation)) / balance_.rest_length(beam) - 1.0;
}

const Eigen::SparseMatrix<double>& Equilibrium::linearise() {
  static_cast<void>(balance_.linearise(state_));
  newton_.forget_tangent();
  return balance_.stiffness();
}

}  // namespace menger::voxel
