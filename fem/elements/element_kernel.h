#pragma once

#include <array>
#include <cstddef>
#include <string_view>
#include <vector>

#include "fem/elements/volumetric_law.h"
#include "materials/laws/hyperelastic_law.h"

namespace menger::fem {

/// The way in which the change of volume enters the energy of an element.
enum class Formulation {
  /// Dilatation and pressure are fields of their own: constant (Q1) or linear (Q2) in an element, and not continuous.
  three_field,
  displacement  ///< uses the volume ratio of the displacement itself, at every quadrature point
};

/// The shape of hexahedral Lagrange elements of degree 1 or 2. Nodes and quadrature points (Gauss, degree + 1 in each direction)
/// are numbered lexicographically, x fastest.
struct ElementShape {
  int degree = 1;
  [[nodiscard]] constexpr std::size_t nodes() const { return degree == 1 ? 8 : 27; }
  [[nodiscard]] constexpr std::size_t points() const { return nodes(); }
  /// The number of functions of an element for pressure and dilatation: 1, and for degree 2 also the three reference coordinates
  /// in [-1, 1].
  [[nodiscard]] constexpr std::size_t modes() const { return degree == 1 ? 1 : 4; }
  /// The number of pairs of nodes (a, b) with b <= a.
  [[nodiscard]] constexpr std::size_t pairs() const { return nodes() * (nodes() + 1) / 2; }
};

/// One batch of elements of equal shape and material. All arrays are interleaved: entry n of lane l is at n * width + l. They are
/// aligned to 64 bytes. Lanes without an element repeat another one.
struct ElementBatch {
  const double* positions;      ///< 3 nodes: reference positions X, m
  const double* displacements;  ///< 3 nodes: u, m
  /// points: pressure (positive in tension) that replaces that of the displacements in the stiffness; nullptr: the exact
  /// stiffness. The residual never depends on it.
  const double* predicted_pressure = nullptr;
  double* residual = nullptr;   ///< 3 nodes: d(energy)/du, N; nullptr if not wanted
  double* stiffness = nullptr;  ///< 9 pairs: d2(energy)/du du, N/m, pair (a, b <= a) at a (a + 1)/2 + b, row by row; or nullptr
  double* energy = nullptr;     ///< 1: J; or nullptr
  /// 1: smallest volume ratio of the quadrature points; not positive or NaN where the law is not defined.
  double* smallest_ratio = nullptr;
};

/// Fields at the quadrature points of a batch, for output; interleaved as in ElementBatch.
struct PointFields {
  double* deformation_gradient;  ///< 9 points: F
  double* cauchy_stress;         ///< 9 points: sigma, Pa, with the pressure of the formulation
  double* volume_ratio;          ///< points: J
  double* pressure;              ///< points: hydrostatic pressure -tr(sigma)/3, Pa
};

/// Degree, formulation and laws that the elements of a batch have in common.
struct ElementMaterial {
  int degree = 2;  ///< 1 or 2
  Formulation formulation = Formulation::three_field;
  materials::HyperelasticLaw law;
  VolumetricLaw volume;
};

namespace detail {
struct KernelTable;
}

/// Element kernels of one instruction set. Results of two instruction sets differ by rounding.
class ElementKernels {
 public:
  explicit ElementKernels(const detail::KernelTable& table);

  std::string_view instruction_set;  ///< "baseline", "avx2", "avx512"
  std::size_t width;                 ///< lanes: elements computed at once

  /// Computes energy, residual and stiffness of a batch. Dilatation and pressure are eliminated element by element.
  ///
  /// The energy is E(u) = integral psi_iso(F) + U(theta) dV over the reference element. In the three-field form theta is the L2
  /// projection of J = det F onto the modes. This is the stationary point of integral psi_iso + U(theta) + p (J - theta) with
  /// respect to p and theta. Residual and stiffness are therefore those of the three fields after condensation, and the stiffness
  /// is exactly symmetric.
  void evaluate(const ElementMaterial& material, const ElementBatch& batch) const;

  /// Computes the pressure that the linearisation at the displacements predicts after a step. Newton's method with this pressure
  /// in the stiffness is that of the three fields, each of which is an unknown of its own. It takes far larger steps than the
  /// method in displacements alone, in which nearly incompressible elements respond to a bent wall with a huge pressure. The
  /// solution is the same.
  /// @param step 3 nodes: change of the displacements, m, interleaved @param predicted_pressure points, Pa
  void predict_pressure(const ElementMaterial& material, const ElementBatch& batch, const double* step,
                        double* predicted_pressure) const;

  /// Computes the fields at the quadrature points. It reads only positions and displacements of the batch, and does not write
  /// smallest_ratio.
  void evaluate_points(const ElementMaterial& material, const ElementBatch& batch, const PointFields& fields) const;

 private:
  const detail::KernelTable* table_;
};

/// Returns the kernels of the widest instruction set that this machine has.
ElementKernels best_element_kernels();

/// Returns all kernels that this machine can run, the portable ones first.
std::vector<ElementKernels> available_element_kernels();

}  // namespace menger::fem
