#include "fem/explicit/stable_step.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <utility>

namespace menger::fem {
namespace {

constexpr std::size_t nodes_per_part = 1024;  ///< parts are shared among threads
constexpr std::size_t components_per_part = 3 * nodes_per_part;
constexpr std::size_t batches_per_part = 16;

/// Largest residual of an estimate over its value.
constexpr double tolerance = 0.01;

/// A start that is near one mode has a small residual at once, whatever other modes there are.
constexpr std::size_t least_iterations = 10;

/// Iterations between two looks at the residual: the eigenvalues of the tridiagonal matrix cost as much as an iteration.
constexpr std::size_t iterations_per_look = 4;

/// Size of the numbers without a pattern in the start of an iteration, over that of the mode at rest.
constexpr double unpatterned_share = 1.0;

/// Displacements for differences of forces, over the smallest edge: large against rounding in single precision, small enough for
/// the tangent.
constexpr double displacement_share = 1e-3;
constexpr double speed_m_per_s = 1.0;

std::vector<double> numbers_without_pattern(const std::vector<double>& roots) {
  std::minstd_rand generator(1);
  std::vector<double> result;
  result.reserve(roots.size());
  for (const double root : roots) {
    const double number = static_cast<double>(generator()) / static_cast<double>(std::minstd_rand::max());
    result.push_back(root > 0.0 ? 2.0 * number - 1.0 : 0.0);
  }
  return result;
}

/// The largest eigenvalue of a symmetric tridiagonal matrix and its eigenvector.
struct RitzPair {
  double value = 0.0;
  std::vector<double> vector;
};

RitzPair largest_ritz_pair(const std::vector<double>& diagonal, const std::vector<double>& off_diagonal) {
  const auto size = static_cast<Eigen::Index>(diagonal.size());
  const Eigen::VectorXd alpha = Eigen::Map<const Eigen::VectorXd>(diagonal.data(), size);
  const Eigen::VectorXd beta = Eigen::Map<const Eigen::VectorXd>(off_diagonal.data(), size - 1);
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver;
  solver.computeFromTridiagonal(alpha, beta);
  const auto vector = solver.eigenvectors().col(size - 1);
  return {solver.eigenvalues()[size - 1], {vector.begin(), vector.end()}};
}

void scale(double factor, std::vector<double>& values) {
  for (double& value : values) value *= factor;
}

}  // namespace

template <class Change>
void EigenvalueEstimate::for_components(const Change& change) const {
  loop_.run(moved_.size(), components_per_part, [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t n = begin; n < end; ++n) change(n);
  });
}

EigenvalueEstimate::EigenvalueEstimate(const ExplicitBody& body, const BlockLoop& loop, ElementForces& forces)
    : body_(body),
      loop_(loop),
      is_viscous_(body.is_viscous()),
      smallest_edge_m_(body.smallest_edge_m()),
      moved_(3 * body.node_count()),
      forces_at_state_(3 * body.node_count()) {
  for (std::size_t n = 0; n < 3 * body.node_count(); ++n) roots_.push_back(std::sqrt(body.inverse_masses_per_kg()[n]));
  unpatterned_ = numbers_without_pattern(roots_);
  const double size = std::sqrt(product_sum(unpatterned_, unpatterned_));
  if (size > 0.0) scale(1.0 / size, unpatterned_);
  const std::vector<double> rest(3 * body.node_count(), 0.0);
  BranchNumbers branches = body.elements().branches_at_rest(rest);
  const State state{rest, branches, forces};
  stiffness_mode_ = mode_of(largest(Matrix::stiffness, state, unpatterned_));
  if (is_viscous_) damping_mode_ = mode_of(largest(Matrix::damping, state, unpatterned_));
}

LargestEigenvalues EigenvalueEstimate::at(std::span<const double> displacements_m, BranchNumbers& branches, ElementForces& forces,
                                          std::span<const double> springs_N_per_m, std::span<const SelfTouch> touches) {
  const State state{displacements_m, branches, forces, springs_N_per_m, touches};
  const auto start_at = [&](const std::vector<double>& mode) {
    std::vector<double> start(mode.size());
    for (std::size_t n = 0; n < start.size(); ++n) start[n] = mode[n] + unpatterned_share * unpatterned_[n];
    return start;
  };
  LargestEigenvalues result;
  result.stiffness_per_s2 = largest(Matrix::stiffness, state, start_at(stiffness_mode_)).value;
  if (is_viscous_) result.damping_per_s = largest(Matrix::damping, state, start_at(damping_mode_)).value;
  return result;
}

EigenvalueEstimate::Estimate EigenvalueEstimate::largest(Matrix matrix, const State& state, std::vector<double> start) {
  set_forces(state, {state.displacements_m.data()}, forces_at_state_);
  const double size = std::sqrt(product_sum(start, start));
  if (!(size > 0.0)) return {};  // every component is held
  scale(1.0 / size, start);
  Estimate estimate;
  estimate.basis.push_back(std::move(start));
  std::vector<double> diagonal;
  std::vector<double> off_diagonal;
  std::vector<double> product(moved_.size());
  double largest_diagonal = 0.0;
  for (;;) {
    const std::vector<double>& now = estimate.basis.back();
    apply(matrix, state, now, product);
    diagonal.push_back(product_sum(now, product));
    if (!std::isfinite(diagonal.back())) return {std::numeric_limits<double>::infinity(), {}, {}};
    largest_diagonal = std::max(largest_diagonal, std::abs(diagonal.back()));
    const std::vector<double>& before = off_diagonal.empty() ? now : estimate.basis[estimate.basis.size() - 2];
    const double beta = off_diagonal.empty() ? 0.0 : off_diagonal.back();
    for_components([&](std::size_t n) { product[n] -= diagonal.back() * now[n] + beta * before[n]; });
    const double next = std::sqrt(product_sum(product, product));
    const bool is_complete = !(next > 1e-9 * largest_diagonal);  // the basis spans all that the start can reach
    const bool is_last = is_complete || diagonal.size() == most_iterations;
    if (is_last || (diagonal.size() >= least_iterations && (diagonal.size() - least_iterations) % iterations_per_look == 0)) {
      RitzPair ritz = largest_ritz_pair(diagonal, off_diagonal);
      const double residual = next * std::abs(ritz.vector.back());
      if (is_last || residual <= tolerance * ritz.value) {
        estimate.value = std::max(ritz.value, 0.0) + residual;
        estimate.weights = std::move(ritz.vector);
        return estimate;
      }
    }
    off_diagonal.push_back(next);
    std::vector<double> following(product.size());
    for_components([&](std::size_t n) { following[n] = product[n] / next; });
    estimate.basis.push_back(std::move(following));
  }
}

/// Returns the mode of an estimate, of length 1.
std::vector<double> EigenvalueEstimate::mode_of(const Estimate& estimate) const {
  std::vector<double> mode(moved_.size(), 0.0);
  for (std::size_t k = 0; k < estimate.basis.size(); ++k)
    for_components([&](std::size_t n) { mode[n] += estimate.weights[k] * estimate.basis[k][n]; });
  return mode;
}

void EigenvalueEstimate::apply(Matrix matrix, const State& state, const std::vector<double>& mode, std::vector<double>& product) {
  const double largest = largest_change(mode);
  const bool of_stiffness = matrix == Matrix::stiffness;
  const double step = (of_stiffness ? displacement_share * smallest_edge_m_ : speed_m_per_s) / largest;
  const std::span<const double> state_m = state.displacements_m;
  for_components([&](std::size_t n) { moved_[n] = step * roots_[n] * mode[n] + (of_stiffness ? state_m[n] : 0.0); });
  const NodalMotion motion = of_stiffness ? NodalMotion{moved_.data()} : NodalMotion{state_m.data(), moved_.data()};
  const double changed = set_forces(state, motion, product) ? 1.0 / step : std::numeric_limits<double>::infinity();
  const std::span<const double> springs = of_stiffness ? state.springs_N_per_m : std::span<const double>{};
  for_components([&](std::size_t n) {
    product[n] = changed * roots_[n] * (product[n] - forces_at_state_[n]);
    if (!springs.empty()) product[n] += springs[n] * roots_[n] * roots_[n] * mode[n];
  });
  if (of_stiffness) add_touches(state.touches, mode, product);
}

void EigenvalueEstimate::add_touches(std::span<const SelfTouch> touches, const std::vector<double>& mode,
                                     std::vector<double>& product) const {
  for (const SelfTouch& touch : touches) {
    for (std::size_t i = 0; i < 3; ++i) {
      const auto at = [&](std::uint32_t node) { return 3 * std::size_t{node} + i; };
      double apart = roots_[at(touch.node)] * mode[at(touch.node)];
      for (std::size_t c = 0; c < 4; ++c)
        apart -= touch.weights[c] * roots_[at(touch.face_nodes[c])] * mode[at(touch.face_nodes[c])];
      const double force = touch.spring_N_per_m * apart;
      product[at(touch.node)] += roots_[at(touch.node)] * force;
      for (std::size_t c = 0; c < 4; ++c)
        product[at(touch.face_nodes[c])] -= roots_[at(touch.face_nodes[c])] * touch.weights[c] * force;
    }
  }
}

/// Returns the largest change of a component where the body moves along a mode.
double EigenvalueEstimate::largest_change(const std::vector<double>& mode) const {
  std::vector<double> parts(BlockLoop::block_count(mode.size(), components_per_part), 0.0);
  loop_.run(mode.size(), components_per_part, [&](std::size_t block, std::size_t begin, std::size_t end) {
    double largest = 0.0;
    for (std::size_t n = begin; n < end; ++n) largest = std::max(largest, std::abs(roots_[n] * mode[n]));
    parts[block] = largest;
  });
  return *std::max_element(parts.begin(), parts.end());
}

bool EigenvalueEstimate::set_forces(const State& state, const NodalMotion& motion, std::vector<double>& forces_N) const {
  state.forces.place(motion, loop_);
  const std::size_t batches = state.forces.batch_count();
  std::vector<char> failed(BlockLoop::block_count(batches, batches_per_part), 0);
  loop_.run(batches, batches_per_part, [&](std::size_t block, std::size_t begin, std::size_t end) {
    failed[block] = state.forces.compute({begin, end}, state.branches, 0.0).has_failed ? 1 : 0;
  });
  loop_.run(body_.node_count(), nodes_per_part, [&](std::size_t, std::size_t begin, std::size_t end) {
    state.forces.sum({begin, end}, forces_N.data() + 3 * begin);
  });
  return std::none_of(failed.begin(), failed.end(), [](char one) { return one != 0; });
}

double EigenvalueEstimate::product_sum(const std::vector<double>& a, const std::vector<double>& b) const {
  std::vector<double> sums(BlockLoop::block_count(a.size(), components_per_part), 0.0);
  loop_.run(a.size(), components_per_part, [&](std::size_t block, std::size_t begin, std::size_t end) {
    double sum = 0.0;
    for (std::size_t n = begin; n < end; ++n) sum += a[n] * b[n];
    sums[block] = sum;
  });
  return std::accumulate(sums.begin(), sums.end(), 0.0);
}

double stable_step_s(const LargestEigenvalues& eigenvalues) {
  const double half = 0.5 * eigenvalues.damping_per_s;
  return 2.0 / (half + std::sqrt(half * half + eigenvalues.stiffness_per_s2));
}

}  // namespace menger::fem
