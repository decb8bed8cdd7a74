#pragma once

// One batch of boxes for one type of packs. Included only by the kernels of an instruction set.

#include "fem/boxes/box_gradient.h"
#include "fem/boxes/explicit_kernel_table.h"
#include "fem/boxes/explicit_stress.h"

namespace menger::fem::detail {

/// Gathers the nodal values of one batch into lanes.
template <class Pack>
void gather(const std::uint32_t* first_components, const double* values, std::array<Pack, 24>& lanes) {
  alignas(64) std::array<double, 24 * Pack::size> buffer;
  for (std::size_t lane = 0; lane < Pack::size; ++lane) {
    for (std::size_t corner = 0; corner < 8; ++corner) {
      const double* value = values + first_components[8 * lane + corner];
      for (std::size_t i = 0; i < 3; ++i) buffer[(3 * corner + i) * Pack::size + lane] = value[i];
    }
  }
  for (std::size_t n = 0; n < 24; ++n) lanes[n] = Pack::load_aligned(buffer.data() + n * Pack::size);
}

/// The elements of one batch: their deformation, forces and energy.
template <class Pack>
class BoxElements {
 public:
  BoxElements(const BoxBatches& batches, std::size_t batch)
      : nodes_(batches.first_components + 8 * Pack::size * batch),
        volume_(Pack::load_aligned(batches.volumes_m3 + Pack::size * batch)) {
    for (std::size_t j = 0; j < 3; ++j)
      inverse_edges_[j] = Pack::load_aligned(batches.inverse_edges_per_m + (3 * batch + j) * Pack::size);
  }

  /// Computes F and the volume ratio at every point, and the mean dilatation.
  void place(const double* displacements) {
    std::array<Pack, 24> u;
    gather(nodes_, displacements, u);
    const BoxFactors<Pack> factors(inverse_edges_, Pack(0.25));
    compute_gradient(u, factors, 1.0, gradient_);
    Pack sum(0.0);
    smallest_ratio_ = Pack(1e300);
    for (std::size_t q = 0; q < 8; ++q) {
      PointVolume<Pack>& point = points_[q];
      for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t i1 = (i + 1) % 3;
        const std::size_t i2 = (i + 2) % 3;
        for (std::size_t j = 0; j < 3; ++j) {
          const std::size_t j1 = (j + 1) % 3;
          const std::size_t j2 = (j + 2) % 3;
          point.cofactor[3 * i + j] =
              xsimd::fms(gradient_.at(i1, j1, q), gradient_.at(i2, j2, q), gradient_.at(i1, j2, q) * gradient_.at(i2, j1, q));
        }
      }
      point.ratio = xsimd::fma(gradient_.at(0, 0, q), point.cofactor[0],
                               xsimd::fma(gradient_.at(0, 1, q), point.cofactor[1], gradient_.at(0, 2, q) * point.cofactor[2]));
      sum = sum + point.ratio;
      // the comparison is false for NaN
      smallest_ratio_ = xsimd::min(smallest_ratio_, xsimd::select(point.ratio > Pack(0.0), point.ratio, Pack(-1.0)));
    }
    dilatation_ = sum * Pack(0.125);
  }

  /// Relaxes the branches by their shares of the distance to rest.
  /// @param tensors of this batch in the first set, changed as all sets are
  /// @return the means of the tensors before and after, over all branches by their moduli
  const double* relax(const BranchTask& branch, double* tensors) {
    relaxed_ = Pack(0.0);
    if (branch.count == 1) {
      relax_one(branch, 0, tensors, mean_tensors_.data());
      return mean_tensors_.data();
    }
    alignas(64) std::array<double, branch_numbers_per_lane * Pack::size> own_mean;
    std::array<Symmetric<Pack>, 8> after{};
    std::array<Symmetric<Pack>, 8> mean{};
    for (std::size_t n = 0; n < branch.count; ++n) {
      double* own = tensors + (n + 1) * branch.sets_apart;
      relax_one(branch, n, own, own_mean.data());
      const Pack weight(branch.shear_moduli_Pa[n] / branch.shear_modulus_Pa);
      for (std::size_t q = 0; q < 8; ++q) {
        add_share(after[q], weight, own + 6 * Pack::size * q);
        add_share(mean[q], weight, own_mean.data() + 6 * Pack::size * q);
      }
    }
    for (std::size_t q = 0; q < 8; ++q) {
      store_symmetric(after[q], tensors + 6 * Pack::size * q);
      store_symmetric(mean[q], mean_tensors_.data() + 6 * Pack::size * q);
    }
    return mean_tensors_.data();
  }

  /// Computes the stress at every point and sums it up for the nodal forces. Marks elements for which the law gives no stress
  /// with a negative volume ratio.
  /// @param tensors of the branches of this batch, or nullptr
  template <class Stress>
  void compute_forces(const Stress& stress, const ExplicitTask& task, const double* tensors) {
    const Pack pressure = volume_derivative(task.volume, dilatation_);
    const Pack twice_viscosity(2.0 * task.viscosity_Pa_s);
    const bool viscous = task.viscosity_Pa_s > 0.0 && task.motion.velocities_m_per_s != nullptr;
    if (viscous) {
      std::array<Pack, 24> v;
      gather(nodes_, task.motion.velocities_m_per_s, v);
      compute_gradient(v, BoxFactors<Pack>(inverse_edges_, Pack(0.25)), 0.0, rate_);
    }
    Pack admissible(1.0);
    dissipation_ = Pack(0.0);
    for (std::size_t q = 0; q < 8; ++q) {
      std::array<Pack, 9> P = tensor_at(gradient_, q);
      const double* tensor = tensors == nullptr ? nullptr : tensors + 6 * Pack::size * q;
      const Pack inverse_ratio = stress(points_[q], tensor, pressure, P, admissible);
      if (viscous) {
        const Pack power = add_viscous_stress(twice_viscosity, points_[q], inverse_ratio, tensor_at(rate_, q), P);
        dissipation_ = dissipation_ + power;
      }
      add_stress(P, q);
    }
    dissipation_ = dissipation_ * volume_ * Pack(0.125);
    smallest_ratio_ = xsimd::select(admissible > Pack(0.0), smallest_ratio_, Pack(-1.0));
  }

  void store_forces(double* forces) const {
    std::array<Pack, 24> f;
    // 1/8 of the volume per point, and the factor 1/8 * 2/h of the gradients
    compute_nodal_forces(stress_sums_, BoxFactors<Pack>(inverse_edges_, volume_ * Pack(0.03125)), f);
    for (std::size_t n = 0; n < 24; ++n) f[n].store_aligned(forces + n * Pack::size);
  }

  /// Returns the strain energy of the elements. Marks elements for which the law gives no stress with a negative volume ratio.
  /// @param tensors of the branches of this batch, or nullptr
  [[nodiscard]] Pack energy(const ExplicitTask& task, const double* tensors) {
    static constexpr auto laws = PackTables<materials::HyperelasticLaw>::template isochoric<Pack>();
    static constexpr auto volume_laws = PackTables<VolumetricLaw>::template volumetric<Pack>();
    Pack admissible(1.0);
    Pack sum(0.0);
    for (std::size_t q = 0; q < 8; ++q) {
      Tensor<Pack> stress;
      Pack density;
      const Tensor<Pack> F{tensor_at(gradient_, q)};
      admissible = xsimd::min(admissible, laws[task.law.index].stress(task.law.parameters, F, stress, density));
      sum = sum + density;
    }
    smallest_ratio_ = xsimd::select(admissible > Pack(0.0), smallest_ratio_, Pack(-1.0));
    for (std::size_t n = 0; tensors != nullptr && n < task.branch.count; ++n) {
      const double* own = task.branch.count == 1 ? tensors : tensors + (n + 1) * task.branch.sets_apart;
      BranchSums<Pack> branch;
      for (std::size_t q = 0; q < 8; ++q) add_branch_point(tensor_at(gradient_, q), points_[q], own + 6 * Pack::size * q, branch);
      sum = xsimd::fma(branch.contractions - xsimd::log(branch.determinants), Pack(0.5 * task.branch.shear_moduli_Pa[n]), sum);
    }
    return volume_ * xsimd::fma(sum, Pack(0.125), volume_laws[task.volume.index](task.volume.parameters, dilatation_).energy);
  }

  [[nodiscard]] const Pack& smallest_ratio() const { return smallest_ratio_; }
  [[nodiscard]] const Pack& dissipation() const { return dissipation_; }
  [[nodiscard]] const Pack& relaxed() const { return relaxed_; }

 private:
  /// @param tensors of the branch, changed @param mean written: the means of before and after
  void relax_one(const BranchTask& branch, std::size_t n, double* tensors, double* mean) {
    BranchSums<Pack> sums;
    for (std::size_t q = 0; q < 8; ++q) {
      const std::size_t first = 6 * Pack::size * q;
      relax_point(Pack(branch.shares[n]), tensor_at(gradient_, q), points_[q], tensors + first, mean + first, sums);
    }
    const Pack fall = xsimd::log(sums.determinants / sums.determinants_before) - sums.contractions;
    relaxed_ = relaxed_ + fall * volume_ * Pack(branch.shear_moduli_Pa[n] / 16.0);  // m/2 and 1/8 of the volume
  }

  static std::array<Pack, 9> tensor_at(const BoxGradient<Pack>& gradient, std::size_t q) {
    std::array<Pack, 9> result;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) result[3 * i + j] = gradient.at(i, j, q);
    return result;
  }

  /// Adds the stress of point q. Two points share each place of a column; the one with the smaller number must come first.
  void add_stress(const std::array<Pack, 9>& P, std::size_t q) {
    for (std::size_t j = 0; j < 3; ++j) {
      const bool is_first = (q >> j & 1U) == 0;
      for (std::size_t i = 0; i < 3; ++i) {
        Pack& sum = stress_sums_.at(i, j, q);
        sum = is_first ? P[3 * i + j] : sum + P[3 * i + j];
      }
    }
  }

  const std::uint32_t* nodes_;
  std::array<Pack, 3> inverse_edges_;
  Pack volume_;
  Pack dilatation_;
  Pack smallest_ratio_;
  Pack dissipation_;
  Pack relaxed_ = Pack(0.0);
  std::array<PointVolume<Pack>, 8> points_;
  BoxGradient<Pack> gradient_;
  BoxGradient<Pack> rate_;
  BoxGradient<Pack> stress_sums_;
  alignas(64) std::array<double, branch_numbers_per_lane * Pack::size> mean_tensors_;
};

}  // namespace menger::fem::detail
