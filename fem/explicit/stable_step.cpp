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
  Eigen::VectorXd vector;
};

RitzPair largest_ritz_pair(const std::vector<double>& diagonal, const std::vector<double>& off_diagonal) {
  const auto size = static_cast<Eigen::Index>(diagonal.size());
  const Eigen::VectorXd alpha = Eigen::Map<const Eigen::VectorXd>(diagonal.data(), size);
  const Eigen::VectorXd beta = Eigen::Map<const Eigen::VectorXd>(off_diagonal.data(), size - 1);
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver;
  solver.computeFromTridiagonal(alpha, beta);
  return {solver.eigenvalues()[size - 1], solver.eigenvectors().col(size - 1)};
}

void scale(double factor, std::vector<double>& values) {
  for (double& value : values) value *= factor;
}

}  // namespace

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
  const State state{rest, branches, forces, {}};
  stiffness_mode_ = largest(Matrix::stiffness, state, unpatterned_).mode;
  if (is_viscous_) damping_mode_ = largest(Matrix::damping, state, unpatterned_).mode;
}

LargestEigenvalues EigenvalueEstimate::at(std::span<const double> displacements_m, BranchNumbers& branches, ElementForces& forces,
                                          std::span<const double> springs_N_per_m) {
  const State state{displacements_m, branches, forces, springs_N_per_m};
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
  if (!(size > 0.0)) return {0.0, std::move(start)};  // every component is held
  scale(1.0 / size, start);
  std::vector<std::vector<double>> basis{std::move(start)};
  std::vector<double> diagonal;
  std::vector<double> off_diagonal;
  std::vector<double> product(moved_.size());
  RitzPair ritz;
  double residual = 0.0;
  while (diagonal.size() < most_iterations) {
    const std::vector<double>& now = basis.back();
    apply(matrix, state, now, product);
    diagonal.push_back(product_sum(now, product));
    if (!std::isfinite(diagonal.back())) return {std::numeric_limits<double>::infinity(), {}};
    for (std::size_t n = 0; n < product.size(); ++n) product[n] -= diagonal.back() * now[n];
    if (basis.size() > 1) {
      const std::vector<double>& before = basis[basis.size() - 2];
      for (std::size_t n = 0; n < product.size(); ++n) product[n] -= off_diagonal.back() * before[n];
    }
    ritz = largest_ritz_pair(diagonal, off_diagonal);
    const double next = std::sqrt(product_sum(product, product));
    residual = next * std::abs(ritz.vector[ritz.vector.size() - 1]);
    if ((diagonal.size() >= least_iterations && residual <= tolerance * ritz.value) || !(next > 1e-9 * std::abs(ritz.value)))
      break;
    off_diagonal.push_back(next);
    basis.push_back(product);
    scale(1.0 / next, basis.back());
  }
  Estimate estimate{std::max(ritz.value, 0.0) + residual, std::vector<double>(moved_.size(), 0.0)};
  for (std::size_t k = 0; k < diagonal.size(); ++k)
    for (std::size_t n = 0; n < estimate.mode.size(); ++n)
      estimate.mode[n] += ritz.vector[static_cast<Eigen::Index>(k)] * basis[k][n];
  return estimate;
}

void EigenvalueEstimate::apply(Matrix matrix, const State& state, const std::vector<double>& mode, std::vector<double>& product) {
  double largest = 0.0;
  for (std::size_t n = 0; n < mode.size(); ++n) largest = std::max(largest, std::abs(roots_[n] * mode[n]));
  const bool of_stiffness = matrix == Matrix::stiffness;
  const double step = (of_stiffness ? displacement_share * smallest_edge_m_ : speed_m_per_s) / largest;
  for (std::size_t n = 0; n < mode.size(); ++n)
    moved_[n] = step * roots_[n] * mode[n] + (of_stiffness ? state.displacements_m[n] : 0.0);
  const NodalMotion motion = of_stiffness ? NodalMotion{moved_.data()} : NodalMotion{state.displacements_m.data(), moved_.data()};
  const double changed = set_forces(state, motion, product) ? 1.0 / step : std::numeric_limits<double>::infinity();
  for (std::size_t n = 0; n < product.size(); ++n) product[n] = changed * roots_[n] * (product[n] - forces_at_state_[n]);
  if (!of_stiffness || state.springs_N_per_m.empty()) return;
  for (std::size_t n = 0; n < product.size(); ++n) product[n] += state.springs_N_per_m[n] * roots_[n] * roots_[n] * mode[n];
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
