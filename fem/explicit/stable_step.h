#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "fem/contact/block_loop.h"
#include "fem/contact/self_contact.h"
#include "fem/explicit/explicit_body.h"
#include "fem/explicit/explicit_elements.h"

namespace menger::fem {

/// The largest eigenvalues of a body about a state: of M^-1 K, 1/s^2, and of M^-1 C, 1/s. K is the tangent stiffness, C the
/// viscous matrix and M the lumped mass.
struct LargestEigenvalues {
  double stiffness_per_s2 = 0.0;
  double damping_per_s = 0.0;
};

/// Estimates the largest eigenvalues of the elements of a body by Lanczos' method: products with K and C are differences of the
/// elements' forces.
///
/// Every estimate is the largest Ritz value plus its residual, which is at most 1 % of it unless the method has not converged
/// after `most_iterations`. So an eigenvalue is within 1 %, which changes the stable step by half as much. It is the largest one
/// unless this is a local mode a few per cent above the others, which the distance of the step to the stable one covers. The
/// iteration starts from the largest mode at rest and, as large, numbers without a pattern, so that it also finds a mode that has
/// overtaken it. An estimate depends on the state only, not on earlier estimates, and not on the number of threads.
class EigenvalueEstimate {
 public:
  static constexpr std::size_t most_iterations = 60;

  /// Computes the modes at rest. Keeps references.
  /// @param forces memory for the elements' forces
  EigenvalueEstimate(const ExplicitBody& body, const BlockLoop& loop, ElementForces& forces);

  /// Returns the largest eigenvalues at a state: with the given branches as springs, and the pressures that `forces` was given.
  /// Infinite if an element fails near the state.
  /// @param springs_N_per_m further springs, one per component: those of the ground; empty: none
  /// @param touches of the body with itself: each is a spring between its node and the point of its face, as stiff along the face
  /// as across it, as friction is while it holds
  [[nodiscard]] LargestEigenvalues at(std::span<const double> displacements_m, BranchNumbers& branches, ElementForces& forces,
                                      std::span<const double> springs_N_per_m = {}, std::span<const SelfTouch> touches = {});

 private:
  enum class Matrix { stiffness, damping };
  struct Estimate {
    double value = 0.0;
    std::vector<std::vector<double>> basis{};  ///< of M^-1/2 A M^-1/2; empty where there is no mode
    std::vector<double> weights{};             ///< of the basis in the mode
  };
  struct State {
    std::span<const double> displacements_m;
    BranchNumbers& branches;
    ElementForces& forces;
    std::span<const double> springs_N_per_m{};
    std::span<const SelfTouch> touches{};
  };
  [[nodiscard]] Estimate largest(Matrix matrix, const State& state, std::vector<double> start);
  [[nodiscard]] std::vector<double> mode_of(const Estimate& estimate) const;
  /// Computes the change of the forces, over sqrt(m), along a mode.
  void apply(Matrix matrix, const State& state, const std::vector<double>& mode, std::vector<double>& product);
  void add_touches(std::span<const SelfTouch> touches, const std::vector<double>& mode, std::vector<double>& product) const;
  /// Returns whether no element has failed.
  bool set_forces(const State& state, const NodalMotion& motion, std::vector<double>& forces_N) const;
  [[nodiscard]] double product_sum(const std::vector<double>& a, const std::vector<double>& b) const;
  [[nodiscard]] double largest_change(const std::vector<double>& mode) const;
  /// Calls change(n) for every component, in several threads.
  template <class Change>
  void for_components(const Change& change) const;

  const ExplicitBody& body_;
  const BlockLoop& loop_;
  bool is_viscous_;
  double smallest_edge_m_;
  std::vector<double> roots_;  ///< 1/sqrt(m) per component; 0 where it is held
  std::vector<double> unpatterned_;
  std::vector<double> stiffness_mode_;
  std::vector<double> damping_mode_;
  std::vector<double> moved_;
  std::vector<double> forces_at_state_;
};

/// Returns the largest step at which central differences, with the damping force of the last half step, are stable: dt^2 k / 4 +
/// dt c / 2 = 1 for the eigenvalues k and c.
double stable_step_s(const LargestEigenvalues& eigenvalues);

}  // namespace menger::fem
