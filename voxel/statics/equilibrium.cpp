#include "voxel/statics/equilibrium.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace menger::voxel {
namespace {

Vector3<double> between(const Vector3<double>& a, const Vector3<double>& b, double share) { return a + share * (b - a); }

/// An entry of a list that may be shorter than another: the rest is zero.
template <class Value>
Value entry(const std::vector<Value>& values, std::size_t i) {
  return i < values.size() ? values[i] : Value{};
}

/// Loads on the straight way from one set to another.
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

double size_of(const Eigen::VectorXd& residual) {
  // maxCoeff passes over NaN; a sum does not.
  const double sum = residual.cwiseAbs().sum();
  return std::isfinite(sum) ? residual.lpNorm<Eigen::Infinity>() : std::numeric_limits<double>::infinity();
}

}  // namespace

Equilibrium::Equilibrium(const StaticBody& body, const Supports& supports, const EquilibriumOptions& options)
    : body_(&body), options_(options), balance_(body, supports), state_(balance_.state_at_rest()) {
  loads_.pressures_Pa.assign(body.voxels.chamber_count, 0.0);
  static_cast<void>(balance_.set_loads(loads_));  // no pressure is always in range
}

io::RunStatus Equilibrium::load(const StaticLoads& target) {
  iteration_limit_ = iterations_ + static_cast<std::size_t>(options_.largest_total_count);
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
    factorised_ = false;
    static_cast<void>(balance_.set_loads(loads_));
    step *= 0.5;
    if (step < options_.smallest_load_step || iterations_ >= iteration_limit_) return failure;
  }
  return io::RunStatus::completed;
}

bool Equilibrium::place(const StaticLoads& loads, const StaticState& state) {
  if (!balance_.set_loads(loads)) return false;
  loads_ = loads;
  state_ = state;
  factorised_ = false;
  return true;
}

bool Equilibrium::solve() {
  constexpr int free_rounds = 4;
  balance_.place_plates(state_);
  for (int round = 0;; ++round) {
    if (!newton()) return false;
    if (!balance_.update_beam_states(state_, round >= free_rounds)) return true;
    factorised_ = false;
  }
}

bool Equilibrium::newton() {
  // Near rounding the residual stops falling; what it has reached by then is good enough if it is this small.
  const double good_enough = 1e3 * options_.tolerance;
  constexpr double rounding = 1e-13;
  constexpr double fast = 0.2;
  Eigen::VectorXd residual = balance_.residual(state_);
  double size = size_of(residual);
  // A slender body moves far under small loads: these must be balanced to six digits, too.
  const double tolerance = std::clamp(1e-6 * size, rounding, std::max(rounding, options_.tolerance));
  for (int i = 0; i < options_.largest_iteration_count; ++i) {
    if (size <= tolerance) return true;
    if (iterations_ >= iteration_limit_ || !std::isfinite(size)) return false;
    ++iterations_;
    const bool fresh = !factorised_;
    if (fresh && !factorise()) return false;
    const bool falls = search(factors_.solve(residual), residual);
    const double now = size_of(residual);
    if (!falls && fresh) return size <= good_enough;
    factorised_ = falls && now <= fast * size;
    size = now;
  }
  return size <= good_enough;
}

bool Equilibrium::factorise() {
  static_cast<void>(balance_.linearise(state_));
  factorised_ = factors_.factorise(balance_.stiffness());
  return factorised_;
}

bool Equilibrium::search(const Eigen::VectorXd& step, Eigen::VectorXd& residual) {
  constexpr double largest_step = 0.5;  // voxel edges or radians, beyond which a tangent says nothing
  constexpr int cuts = 6;
  const double length = size_of(step);
  if (!std::isfinite(length)) return false;
  const double before = residual.norm();
  const StaticState start = state_;
  double share = std::min(1.0, largest_step / std::max(length, largest_step));
  for (int cut = 0; cut < cuts; ++cut) {
    balance_.move(state_, share * step);
    Eigen::VectorXd tried = balance_.residual(state_);
    if (tried.norm() < before) {
      residual = std::move(tried);
      return true;
    }
    state_ = start;
    share *= 0.5;
  }
  return false;
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
  factorised_ = false;
  return balance_.stiffness();
}

}  // namespace menger::voxel
