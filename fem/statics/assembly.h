#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "fem/space/node_exchange.h"
#include "fem/space/petsc_handle.h"
#include "fem/space/space.h"
#include "fem/statics/body.h"
#include "fem/statics/element_groups.h"
#include "fem/statics/grips.h"
#include "fem/statics/pressed_walls.h"

namespace menger::fem {

/// The loads on a body in one state.
struct Loads {
  std::span<const double> plenum_pressures_Pa;  ///< gauge
  double dead_load_factor = 1.0;                ///< factor on gravity and tractions
  std::span<const PlateMotion> plates{};  ///< positions of the plates, about whose centres moments are taken; empty: at rest
};

/// A change of held components, and the forces that it causes on the other components: K times the change.
struct HeldChange {
  std::span<const double> change_m;  ///< per local component, zero where not held, ghosts up to date
  std::span<double> force_N;         ///< per local component, ghosts not up to date; zero where held
};

/// Totals of a body, the same on all ranks.
struct BodyTotals {
  double strain_energy_J = 0.0;
  /// Smallest volume ratio at the quadrature points. Not positive: an element is inverted, or its law is not defined there.
  double smallest_ratio = 0.0;
  std::vector<double> chamber_volumes_m3;  ///< of the modelled part of the chambers
  /// Of the plena: what pressure times its change is work. The sum of their chambers' volumes; for thin walls see PressedWalls.
  std::vector<double> work_volumes_m3;
  double ground_force_N = 0.0;  ///< force of the ground on the body, upwards
  double ground_energy_J = 0.0;
  double dead_load_work_J = 0.0;      ///< work of gravity and tractions at factor 1, since the reference configuration
  std::vector<PlateReaction> plates;  ///< on the body; only where the residual was asked for
  double plate_force_norm_N = 0.0;    ///< norm of the nodal forces of all plates
};

/// Sums the terms of elements, chambers and the ground of a body into global vectors and a matrix.
///
/// The potential energy is E(u) + E_ground(u) - sum_plena p V(u) - f . u, where V is the volume that p does work on. The residual
/// is its gradient, the matrix its Hessian. Held components have residual 0, and their row and column are those of the identity.
class Assembly {
 public:
  Assembly(const Space& space, const Body& body);

  [[nodiscard]] const Space& space() const { return space_; }
  [[nodiscard]] const Body& body() const { return body_; }
  [[nodiscard]] const NodeExchange& exchange() const { return exchange_; }
  /// Whether a support or a plate holds each local component, 1 or 0.
  [[nodiscard]] const std::vector<std::uint8_t>& held() const { return held_; }
  /// The nodes on a plate that this rank owns.
  [[nodiscard]] const std::vector<Index>& plate_nodes(std::size_t plate) const { return plate_nodes_[plate]; }

  /// Creates an empty matrix with the structure of the stiffness, in blocks of 3. @param symmetric_storage true: one triangle
  /// only; false: both
  [[nodiscard]] MatrixHandle make_matrix(bool symmetric_storage) const;

  /// Computes the totals of a state and, where wanted, the residual, the gradients of the volumes and the stiffness.
  /// @param displacements 3 per local node, ghosts up to date
  /// @param residual per local component, ghosts not up to date; empty if not wanted
  /// @param volume_gradients dV/du of each plenum's work volume in the same layout, zero at held components; empty if not wanted
  /// @param stiffness the matrix to fill, or nullptr
  /// @param held_change or nullptr; its forces are computed together with the stiffness
  BodyTotals assemble(std::span<const double> displacements, const Loads& loads, std::span<double> residual,
                      std::span<std::vector<double>> volume_gradients, Mat stiffness, const HeldChange* held_change = nullptr);

  /// Turns gradients of work volumes, as assemble returns them, into those of the volumes of the plena's chambers. They differ
  /// for thin walls only. Collective.
  void read_volume_gradients(std::span<const double> displacements, std::span<std::vector<double>> gradients) const;
  [[nodiscard]] const PressedWalls& walls() const { return walls_; }

  /// Adds a block of some local nodes, row by row, to a matrix from make_matrix, which the caller assembles (MatAssemblyEnd)
  /// afterwards.
  /// @param block its rows and columns of held components are set to zero
  /// @param held_change receives the forces that those columns cause, or nullptr
  void add_to_matrix(Mat stiffness, std::span<const Index> nodes, std::span<double> block,
                     const HeldChange* held_change = nullptr) const;

  ElementGroups& elements() { return elements_; }

 private:
  template <std::size_t n>
  void add_faces(std::span<const double> displacements, const Loads& loads, std::span<double> residual,
                 std::span<std::vector<double>> volume_gradients, Mat stiffness, const HeldChange* held_change,
                 BodyTotals& totals) const;
  template <std::size_t k>
  void add_caps(std::span<const double> displacements, const Loads& loads, std::span<double> residual,
                std::span<std::vector<double>> volume_gradients, Mat stiffness, const HeldChange* held_change,
                BodyTotals& totals) const;
  void add_walls(std::span<const double> displacements, const Loads& loads, std::span<double> residual,
                 std::span<std::vector<double>> volume_gradients, Mat stiffness, const HeldChange* held_change,
                 BodyTotals& totals) const;
  void let_go(std::span<double> field) const;
  [[nodiscard]] std::array<bool, 3> mirrored_directions(const SpaceCap& cap) const;
  void add_dead_loads(std::span<const double> displacements, double factor, std::span<double> residual, BodyTotals& totals) const;
  void add_plates(std::span<const double> displacements, const Loads& loads, std::span<const double> residual,
                  BodyTotals& totals) const;
  void add_held_change(std::span<const Index> nodes, std::span<const double> block, const HeldChange& held_change) const;
  void hold_diagonal(Mat stiffness) const;
  void sum_over_ranks(BodyTotals& totals) const;

  const Space& space_;
  const Body& body_;
  ElementGroups elements_;
  PressedWalls walls_;
  NodeExchange exchange_;
  std::vector<std::uint8_t> held_;
  std::vector<std::vector<Index>> plate_nodes_;  ///< owned
  std::vector<double> dead_load_;  ///< force per local component at factor 1; only the shares of this rank's elements
  std::vector<std::vector<std::size_t>> chambers_of_label_;
  std::vector<bool> is_ground_label_;
};

}  // namespace menger::fem
