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

namespace menger::fem {

/// Loads at a moment.
struct Loads {
  std::span<const double> plenum_pressures_Pa;  ///< gauge
  double dead_load_factor = 1.0;                ///< on gravity and tractions
  std::span<const PlateMotion> plates{};        ///< where moments of plates are taken about; empty: at rest
};

/// A change of held components, and the forces K times it on the others.
struct HeldChange {
  std::span<const double> change_m;  ///< per local component, zero where not held, ghosts up to date
  std::span<double> force_N;         ///< per local component, ghosts not up to date; zero where held
};

/// Sums over the body, the same on all ranks.
struct BodyTotals {
  double strain_energy_J = 0.0;
  double smallest_ratio = 0.0;             ///< of volume, at the quadrature points; not positive: the state has no answer
  std::vector<double> chamber_volumes_m3;  ///< of the modelled part
  double ground_force_N = 0.0;             ///< of the ground on the body, upwards
  double ground_energy_J = 0.0;
  double dead_load_work_J = 0.0;      ///< of gravity and tractions at factor 1, since the reference configuration
  std::vector<PlateReaction> plates;  ///< on the body, where the residual was asked for
  double plate_force_norm_N = 0.0;    ///< of the nodal forces of all plates
};

/// Sums element, chamber and ground terms of a body into global vectors and a matrix.
///
/// The potential energy is E(u) + E_ground(u) - sum_plena p V(u) - f . u; the residual is its gradient, the matrix its Hessian.
/// Held components have residual 0 and a row and column of the identity.
class Assembly {
 public:
  Assembly(const Space& space, const Body& body);

  [[nodiscard]] const Space& space() const { return space_; }
  [[nodiscard]] const NodeExchange& exchange() const { return exchange_; }
  /// Per local component, whether it is held by a support or a plate.
  [[nodiscard]] const std::vector<std::uint8_t>& held() const { return held_; }
  /// The owned nodes on a plate.
  [[nodiscard]] const std::vector<Index>& plate_nodes(std::size_t plate) const { return plate_nodes_[plate]; }

  /// An empty matrix with the structure of the stiffness: symmetric, blocks of 3, or with both triangles.
  [[nodiscard]] MatrixHandle make_matrix(bool symmetric_storage) const;

  /// @param displacements 3 per local node, ghosts up to date
  /// @param residual per local component, ghosts not up to date; empty if not wanted
  /// @param volume_gradients dV/du of each plenum in the same form, with held components zero; empty if not wanted
  /// @param stiffness or nullptr
  /// @param held_change or nullptr; its forces are computed together with the stiffness
  BodyTotals assemble(std::span<const double> displacements, const Loads& loads, std::span<double> residual,
                      std::span<std::vector<double>> volume_gradients, Mat stiffness, const HeldChange* held_change = nullptr);

  /// Adds a block of some local nodes, row by row, to a matrix of make_matrix that has yet to be assembled.
  /// @param block its rows and columns of held components become zero @param held_change takes what those columns would do, or
  /// nullptr
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
  NodeExchange exchange_;
  std::vector<std::uint8_t> held_;
  std::vector<std::vector<Index>> plate_nodes_;  ///< owned
  std::vector<double> dead_load_;                ///< force per local component at factor 1, shares of this rank's elements
  std::vector<std::vector<std::size_t>> chambers_of_label_;
  std::vector<bool> is_ground_label_;
};

}  // namespace menger::fem
