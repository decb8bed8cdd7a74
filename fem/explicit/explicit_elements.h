#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "fem/boxes/aligned_numbers.h"
#include "fem/boxes/explicit_kernel.h"
#include "fem/boxes/node_slots.h"
#include "fem/contact/block_loop.h"
#include "fem/surfaces/point.h"

namespace menger::fem {

/// The material of a region of a body.
struct ExplicitRegion {
  ExplicitMaterial material;
  double density_kg_per_m3 = 0.0;  ///< of the reference configuration, > 0
};

/// The state of the Maxwell branches of all elements of a body, in the precision of its elements. The layout is that of the
/// elements and their kernels; empty without branches.
using BranchNumbers = std::variant<AlignedVector<double>, AlignedVector<float>>;

/// An element that has failed: it is inverted, or its law gives no stress there.
struct FailedElement {
  std::size_t element;    ///< of the mesh
  Point position_m;       ///< its first corner in the reference configuration
  bool is_finite = true;  ///< whether its displacements are finite
};

/// Changes of volume by which the pressures in the plena do work, m^3, per plenum.
struct PressedVolumes {
  std::vector<double> walls_m3;     ///< of the walls, half of it for each face towards the plenum
  std::vector<double> chambers_m3;  ///< of the chambers
};

/// Results of elements other than their forces.
struct ForcesOutcome {
  bool has_failed = false;    ///< an element is inverted, or its law gives no stress
  double dissipated_W = 0.0;  ///< by the viscous stress, >= 0
  double relaxed_J = 0.0;     ///< the decrease of the branches' energy while they relaxed, >= 0 up to rounding
};

/// The forces of the elements of a body at one time. Owns the memory for it; each body in motion has its own.
class ElementForces {
 public:
  ElementForces() = default;
  ElementForces(const ElementForces&) = delete;
  ElementForces& operator=(const ElementForces&) = delete;
  virtual ~ElementForces() = default;

  /// Sets where the nodes are and how they move. The arrays must stay as they are until the forces are computed.
  virtual void place(const NodalMotion& motion, const BlockLoop& loop) = 0;
  /// Takes up what has changed in the arrays of place() since. Thread-safe for ranges apart. Where numbers are rounded they are
  /// so relative to the first node of place(): it should be called anew before the body has moved on by many of its elements.
  virtual void follow(IndexRange nodes) = 0;

  /// Sets the pressure in the plena, Pa. See ExplicitElements::take_pressure.
  virtual void press(std::span<const double> pressures_Pa) = 0;

  [[nodiscard]] virtual std::size_t batch_count() const = 0;

  /// Computes the forces of a range of batches.
  /// @param branches changed where they relax
  /// @param relaxed_s >= 0: the time by which branches relax first, see BranchTensors
  virtual ForcesOutcome compute(IndexRange batches, BranchNumbers& branches, double relaxed_s) = 0;

  /// Adds up the forces on some nodes, N: d(energy)/du plus the viscous force, which are subtracted from the forces that
  /// accelerate the nodes.
  /// @param forces_N three per node of the range
  virtual void sum(IndexRange nodes, double* forces_N) const = 0;

  /// Returns the changes of volume since the reference configuration, at the time of the forces that were computed last. Minus
  /// this times the pressure is the pressure's energy in the elements. Zeros where they take no pressure.
  [[nodiscard]] virtual PressedVolumes pressed_volumes() const = 0;
};

/// The elements of a body for explicit dynamics: of one kind, with lumped masses at the nodes of a mesh of boxes. Arrays of nodal
/// values have component i of node a at 3 a + i.
class ExplicitElements {
 public:
  ExplicitElements() = default;
  ExplicitElements(const ExplicitElements&) = delete;
  ExplicitElements& operator=(const ExplicitElements&) = delete;
  virtual ~ExplicitElements() = default;

  /// Returns the kind of elements, the precision and the instruction set: results differ by rounding between two instruction
  /// sets.
  [[nodiscard]] virtual std::string text() const = 0;

  /// Returns the modulus by which the default stiffness of contact is chosen, Pa: the bulk modulus, or for thin walls, which are
  /// softer across, fem::contact_modulus_Pa.
  [[nodiscard]] virtual double contact_modulus_Pa() const = 0;

  /// Returns whether the pressure in the chambers is among the forces of the elements. Thin walls take it on their faces if all
  /// plena are closed (see has_closed_plena), and always through their thickness.
  [[nodiscard]] virtual bool take_pressure() const = 0;

  /// Returns how many elements the kernels compute at once, on which the layout of the branches depends.
  [[nodiscard]] virtual std::size_t lane_count() const = 0;

  [[nodiscard]] virtual std::unique_ptr<ElementForces> make_forces() const = 0;

  /// Returns branches at rest at these displacements; no element may have failed.
  [[nodiscard]] virtual BranchNumbers branches_at_rest(std::span<const double> displacements_m) const = 0;

  /// Returns the strain energy, without that of the pressures in the thickness of walls.
  /// @param branches empty: without the energy of branches
  [[nodiscard]] virtual double strain_energy_J(std::span<const double> displacements_m, const BranchNumbers& branches) const = 0;

  /// Returns the first element that has failed, if any.
  [[nodiscard]] virtual std::optional<FailedElement> failed_element(std::span<const double> displacements_m) const = 0;
};

}  // namespace menger::fem
