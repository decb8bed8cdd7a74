#pragma once

// The element kernels for one type of packs. Included only by the files element_kernel_<instruction set>.cpp, each compiled for
// its own instruction set. They are instantiated only with pack types of that set, so that files of different sets share no
// function.

#include <memory>
#include <xsimd/xsimd.hpp>

#include "fem/elements/element_condensation.h"
#include "fem/elements/element_kernel_table.h"
#include "fem/elements/element_shape_tables.h"
#include "fem/elements/pack_laws.h"

namespace menger::fem::detail {

using materials::Tangent;

/// The kernels of elements of one degree, for one batch at a time. It holds the values that are needed between the passes over
/// the quadrature points.
template <int degree, class Pack>
class ElementEvaluation {
 public:
  void evaluate(const ElementTask& task, const ElementBatch& batch) {
    compute_kinematics(batch);
    respond_to_volume(task);
    const bool wants_tangent = batch.stiffness != nullptr;
    Pack energy = compute_stress(task, wants_tangent);
    if (wants_tangent) add_pressure_to_tangent(task, batch.predicted_pressure);
    if (batch.residual != nullptr) write_residual(batch.residual);
    if (wants_tangent) write_stiffness(task, batch.stiffness);
    if (batch.energy != nullptr) energy.store_aligned(batch.energy);
    smallest_ratio_.store_aligned(batch.smallest_ratio);
  }

  void predict_pressure(const ElementTask& task, const ElementBatch& batch, const double* step, double* predicted_pressure) {
    compute_kinematics(batch);
    respond_to_volume(task);
    write_predicted_pressure(task, step, predicted_pressure);
  }

  void evaluate_points(const ElementTask& task, const ElementBatch& batch, const PointFields& fields) {
    compute_kinematics(batch);
    respond_to_volume(task);
    compute_stress(task, false);
    for (std::size_t q = 0; q < points; ++q) write_point(q, fields);
  }

 private:
  static constexpr auto shape = element_shape_tables<degree>();
  static constexpr std::size_t nodes = shape.nodes;
  static constexpr std::size_t points = shape.points;
  static constexpr std::size_t modes = shape.modes;
  static constexpr std::size_t width = Pack::size;
  /// The number of rows of blocks that are summed together. Processors with eight lanes have 32 registers, and there the tangents
  /// do not fit the fastest cache.
  static constexpr std::size_t rows_at_once = width >= 8 ? 2 : 1;

  static Pack load(const double* data, std::size_t entry) { return Pack::load_aligned(data + entry * width); }
  static void store(const Pack& value, double* data, std::size_t entry) { value.store_aligned(data + entry * width); }

  /// Computes the deformation gradient, its cofactor and determinant, the gradients of the shape functions and the volume of
  /// every quadrature point.
  void compute_kinematics(const ElementBatch& batch) {
    std::array<Pack, 3 * nodes> X;
    std::array<Pack, 3 * nodes> u;
    for (std::size_t n = 0; n < 3 * nodes; ++n) {
      X[n] = load(batch.positions, n);
      u[n] = load(batch.displacements, n);
    }
    smallest_ratio_ = Pack(1e300);
    for (std::size_t q = 0; q < points; ++q) {
      Tensor<Pack> jacobian;  // dX_i / dxi_j
      for (Pack& component : jacobian.components) component = Pack(0.0);
      for (std::size_t a = 0; a < nodes; ++a) {
        for (std::size_t i = 0; i < 3; ++i) {
          for (std::size_t j = 0; j < 3; ++j)
            jacobian(i, j) = xsimd::fma(X[3 * a + i], Pack(shape.gradient[q][a][j]), jacobian(i, j));
        }
      }
      const Tensor<Pack> cofactor_of_jacobian = materials::cofactor(jacobian);
      const Pack determinant = materials::determinant(jacobian, cofactor_of_jacobian);
      const Pack inverse_determinant = Pack(1.0) / determinant;
      volume_[q] = determinant * Pack(shape.weight[q]);
      Tensor<Pack> F = materials::identity<Pack>();
      for (std::size_t a = 0; a < nodes; ++a) {
        std::array<Pack, 3>& gradient = gradient_[q][a];
        for (std::size_t i = 0; i < 3; ++i) {
          gradient[i] = (cofactor_of_jacobian(i, 0) * Pack(shape.gradient[q][a][0]) +
                         cofactor_of_jacobian(i, 1) * Pack(shape.gradient[q][a][1]) +
                         cofactor_of_jacobian(i, 2) * Pack(shape.gradient[q][a][2])) *
                        inverse_determinant;
        }
        for (std::size_t i = 0; i < 3; ++i) {
          for (std::size_t j = 0; j < 3; ++j) F(i, j) = xsimd::fma(u[3 * a + i], gradient[j], F(i, j));
        }
      }
      deformation_gradient_[q] = F;
      cofactor_[q] = materials::cofactor(F);
      ratio_[q] = materials::determinant(F, cofactor_[q]);
      smallest_ratio_ = xsimd::min(smallest_ratio_, ratio_[q]);
    }
  }

  /// Computes the pressure (positive in tension) at every quadrature point, and the derivatives of the volumetric energy that the
  /// stiffness needs.
  void respond_to_volume(const ElementTask& task) {
    static constexpr auto laws = PackTables<VolumetricLaw>::volumetric<Pack>();
    const auto respond = [&](const Pack& ratio) { return laws[task.volume.index](task.volume.parameters, ratio); };
    volumetric_energy_ = Pack(0.0);
    if (task.formulation == Formulation::displacement) {
      for (std::size_t q = 0; q < points; ++q) {
        const VolumeResponse<Pack> response = respond(ratio_[q]);
        pressure_[q] = response.derivative;
        bulk_[q] = response.second_derivative;
        volumetric_energy_ = volumetric_energy_ + volume_[q] * response.energy;
      }
      return;
    }
    const ModeProjection<degree, Pack> projection(volume_);
    const std::array<Pack, points> dilatation = projection.project(ratio_);
    std::array<Pack, points> derivative;
    for (std::size_t q = 0; q < points; ++q) {
      smallest_ratio_ = xsimd::min(smallest_ratio_, dilatation[q]);
      const VolumeResponse<Pack> response = respond(dilatation[q]);
      derivative[q] = response.derivative;
      bulk_[q] = response.second_derivative;
      volumetric_energy_ = volumetric_energy_ + volume_[q] * response.energy;
    }
    pressure_ = projection.project(derivative);
    bulk_of_modes_ = projection.sandwiched(bulk_);
  }

  /// Computes the isochoric stress and tangent and adds the stress of the pressure. Both are multiplied by the volume of their
  /// point. Returns the energy.
  Pack compute_stress(const ElementTask& task, bool wants_tangent) {
    static constexpr auto laws = PackTables<materials::HyperelasticLaw>::isochoric<Pack>();
    const PackLaw<Pack>& law = laws[task.law.index];
    Pack energy = volumetric_energy_;
    Pack admissible(1.0);
    for (std::size_t q = 0; q < points; ++q) {
      Pack density;
      if (wants_tangent) {
        StressAndTangent<Pack> response;
        admissible = xsimd::min(admissible, law.tangent(task.law.parameters, deformation_gradient_[q], response, density));
        stress_[q] = response.stress;
        for (std::size_t n = 0; n < 81; ++n) tangent_[q].components[n] = response.tangent.components[n] * volume_[q];
      } else {
        admissible = xsimd::min(admissible, law.stress(task.law.parameters, deformation_gradient_[q], stress_[q], density));
      }
      energy = energy + density * volume_[q];
      for (std::size_t n = 0; n < 9; ++n) {
        stress_[q].components[n] = (stress_[q].components[n] + pressure_[q] * cofactor_[q].components[n]) * volume_[q];
      }
    }
    smallest_ratio_ = xsimd::min(smallest_ratio_, select(admissible > Pack(0.0), smallest_ratio_, Pack(-1.0)));
    return energy;
  }

  /// Adds the derivative of pressure times cofactor at fixed pressure to the tangent; without a pressure field, also the
  /// derivative of the pressure: d cof_iJ / dF_kL = (cof_iJ cof_kL - cof_iL cof_kJ) / J.
  void add_pressure_to_tangent(const ElementTask& task, const double* predicted_pressure) {
    const bool displacement_only = task.formulation == Formulation::displacement;
    for (std::size_t q = 0; q < points; ++q) {
      const Tensor<Pack>& C = cofactor_[q];
      const Pack pressure = predicted_pressure != nullptr ? load(predicted_pressure, q) : pressure_[q];
      const Pack crossed = pressure * volume_[q] / ratio_[q];
      Pack dyad = crossed;
      if (displacement_only) dyad = dyad + bulk_[q] * volume_[q];
      for (std::size_t a = 0; a < 9; ++a) {
        for (std::size_t b = 0; b < 9; ++b) {
          tangent_[q](a, b) =
              tangent_[q](a, b) + dyad * C.components[a] * C.components[b] - crossed * C(a / 3, b % 3) * C(b / 3, a % 3);
        }
      }
    }
  }

  /// Writes the pressure of every point after a step of the displacements, to first order: p + U''(theta) projected dJ/du . step.
  void write_predicted_pressure(const ElementTask& task, const double* step, double* predicted_pressure) const {
    std::array<Pack, points> change;
    for (std::size_t q = 0; q < points; ++q) {
      change[q] = Pack(0.0);
      for (std::size_t a = 0; a < nodes; ++a) {
        for (std::size_t i = 0; i < 3; ++i) {
          Pack slope(0.0);
          for (std::size_t j = 0; j < 3; ++j) slope = xsimd::fma(cofactor_[q](i, j), gradient_[q][a][j], slope);
          change[q] = xsimd::fma(slope, load(step, 3 * a + i), change[q]);
        }
      }
    }
    const ModeProjection<degree, Pack> projection(volume_);
    const bool projected = task.formulation == Formulation::three_field;
    if (projected) change = projection.project(change);
    for (std::size_t q = 0; q < points; ++q) change[q] = change[q] * bulk_[q];
    if (projected) change = projection.project(change);
    for (std::size_t q = 0; q < points; ++q) store(pressure_[q] + change[q], predicted_pressure, q);
  }

  /// Writes the residual r_ai = sum over points of P_iJ dN_a/dX_J.
  void write_residual(double* residual) const {
    for (std::size_t a = 0; a < nodes; ++a) {
      for (std::size_t i = 0; i < 3; ++i) {
        Pack sum(0.0);
        for (std::size_t q = 0; q < points; ++q) {
          for (std::size_t j = 0; j < 3; ++j) sum = xsimd::fma(stress_[q](i, j), gradient_[q][a][j], sum);
        }
        store(sum, residual, 3 * a + i);
      }
    }
  }

  /// Writes the blocks of all pairs of nodes. For one node b the tangent is contracted with its gradient once, and then used for
  /// all a >= b. Sums over the quadrature points stay in registers.
  void write_stiffness(const ElementTask& task, double* stiffness) {
    if (task.formulation == Formulation::three_field) compute_mode_gradients();
    for (std::size_t b = 0; b < nodes; ++b) {
      for (std::size_t q = 0; q < points; ++q) {
        const std::array<Pack, 3>& gradient = gradient_[q][b];
        for (std::size_t ij = 0; ij < 9; ++ij) {
          for (std::size_t k = 0; k < 3; ++k) {
            const Pack* row = &tangent_[q](ij, 3 * k);
            contracted_[q][ij][k] = xsimd::fma(row[0], gradient[0], xsimd::fma(row[1], gradient[1], row[2] * gradient[2]));
          }
        }
      }
      std::size_t a = b;
      for (; a + rows_at_once <= nodes; a += rows_at_once) write_blocks<rows_at_once>(task, a, b, stiffness);
      for (; a < nodes; ++a) write_blocks<1>(task, a, b, stiffness);
    }
  }

  /// Writes the blocks of the pairs (a, b), (a + 1, b), ..., as many at once as there are registers for their sums.
  template <std::size_t count>
  void write_blocks(const ElementTask& task, std::size_t a, std::size_t b, double* stiffness) const {
    std::array<std::array<Pack, 9>, count> blocks;
    for (auto& block : blocks) block.fill(Pack(0.0));
    for (std::size_t q = 0; q < points; ++q) {
      for (std::size_t j = 0; j < 3; ++j) {
        for (std::size_t r = 0; r < count; ++r) {
          const Pack g = gradient_[q][a + r][j];
          for (std::size_t i = 0; i < 3; ++i) {
            for (std::size_t k = 0; k < 3; ++k)
              blocks[r][3 * i + k] = xsimd::fma(g, contracted_[q][3 * i + j][k], blocks[r][3 * i + k]);
          }
        }
      }
    }
    for (std::size_t r = 0; r < count; ++r) {
      if (task.formulation == Formulation::three_field) add_modes(a + r, b, blocks[r]);
      const std::size_t pair = (a + r) * (a + r + 1) / 2 + b;
      for (std::size_t n = 0; n < 9; ++n) store(blocks[r][n], stiffness, 9 * pair + n);
    }
  }

  /// Computes D_m = integral mode_m dJ/du for every mode, and the same times the condensed bulk stiffness of the modes.
  void compute_mode_gradients() {
    for (std::size_t a = 0; a < nodes; ++a) {
      for (std::size_t i = 0; i < 3; ++i) {
        std::array<Pack, modes> sum;
        sum.fill(Pack(0.0));
        for (std::size_t q = 0; q < points; ++q) {
          Pack slope(0.0);
          for (std::size_t j = 0; j < 3; ++j) slope = xsimd::fma(cofactor_[q](i, j), gradient_[q][a][j], slope);
          slope = slope * volume_[q];
          for (std::size_t m = 0; m < modes; ++m) sum[m] = xsimd::fma(slope, Pack(shape.mode[q][m]), sum[m]);
        }
        mode_gradient_[3 * a + i] = sum;
        for (std::size_t m = 0; m < modes; ++m) {
          Pack stiff(0.0);
          for (std::size_t n = 0; n < modes; ++n) stiff = xsimd::fma(bulk_of_modes_[m][n], sum[n], stiff);
          stiff_mode_gradient_[3 * a + i][m] = stiff;
        }
      }
    }
  }

  void add_modes(std::size_t a, std::size_t b, std::array<Pack, 9>& block) const {
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t k = 0; k < 3; ++k) {
        Pack& entry = block[3 * i + k];
        for (std::size_t m = 0; m < modes; ++m)
          entry = xsimd::fma(mode_gradient_[3 * a + i][m], stiff_mode_gradient_[3 * b + k][m], entry);
      }
    }
  }

  void write_point(std::size_t q, const PointFields& fields) const {
    const Pack inverse_ratio = Pack(1.0) / (ratio_[q] * volume_[q]);
    Tensor<Pack> sigma = materials::product(stress_[q], materials::transpose(deformation_gradient_[q]));
    for (std::size_t n = 0; n < 9; ++n) {
      sigma.components[n] = sigma.components[n] * inverse_ratio;
      store(deformation_gradient_[q].components[n], fields.deformation_gradient, 9 * q + n);
      store(sigma.components[n], fields.cauchy_stress, 9 * q + n);
    }
    store(ratio_[q], fields.volume_ratio, q);
    store((sigma(0, 0) + sigma(1, 1) + sigma(2, 2)) * Pack(-1.0 / 3.0), fields.pressure, q);
  }

  Pack smallest_ratio_;
  Pack volumetric_energy_;
  std::array<Pack, points> volume_;  ///< reference volume of each point
  std::array<Pack, points> ratio_;
  std::array<Pack, points> pressure_;
  std::array<Pack, points> bulk_;
  std::array<std::array<Pack, modes>, modes> bulk_of_modes_;
  std::array<Tensor<Pack>, points> deformation_gradient_;
  std::array<Tensor<Pack>, points> cofactor_;
  std::array<Tensor<Pack>, points> stress_;
  std::array<Tangent<Pack>, points> tangent_;
  std::array<std::array<std::array<Pack, 3>, nodes>, points> gradient_;
  std::array<std::array<std::array<Pack, 3>, 9>, points> contracted_;
  std::array<std::array<Pack, modes>, 3 * nodes> mode_gradient_;
  std::array<std::array<Pack, modes>, 3 * nodes> stiff_mode_gradient_;
};

/// Returns the evaluation of a degree for this thread. The objects are too large for the stack.
template <int degree, class Pack>
ElementEvaluation<degree, Pack>& element_evaluation() {
  thread_local const auto evaluation = std::make_unique<ElementEvaluation<degree, Pack>>();
  return *evaluation;
}

template <class Pack>
void evaluate(const ElementTask& task, const ElementBatch& batch) {
  if (task.degree == 1) {
    element_evaluation<1, Pack>().evaluate(task, batch);
  } else {
    element_evaluation<2, Pack>().evaluate(task, batch);
  }
}

template <class Pack>
void predict_pressure(const ElementTask& task, const ElementBatch& batch, const double* step, double* predicted_pressure) {
  if (task.degree == 1) {
    element_evaluation<1, Pack>().predict_pressure(task, batch, step, predicted_pressure);
  } else {
    element_evaluation<2, Pack>().predict_pressure(task, batch, step, predicted_pressure);
  }
}

template <class Pack>
void evaluate_points(const ElementTask& task, const ElementBatch& batch, const PointFields& fields) {
  if (task.degree == 1) {
    element_evaluation<1, Pack>().evaluate_points(task, batch, fields);
  } else {
    element_evaluation<2, Pack>().evaluate_points(task, batch, fields);
  }
}

template <class Pack>
const KernelTable& kernel_table(const char* instruction_set) {
  static const KernelTable table{instruction_set, Pack::size, evaluate<Pack>, predict_pressure<Pack>, evaluate_points<Pack>};
  return table;
}

}  // namespace menger::fem::detail
