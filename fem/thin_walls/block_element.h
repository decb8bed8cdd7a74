#pragma once

// One batch of blocks.

#include "fem/thin_walls/block_law.h"
#include "fem/thin_walls/box_modes.h"
#include "fem/thin_walls/element_branch.h"
#include "fem/thin_walls/thin_wall_kernel_table.h"

namespace menger::fem::detail {

/// Assumed strains of a block: x, y and g of the gradients along the three axes, then those of the last pattern.
template <class T>
using BlockStrains = std::array<T, 12>;

template <class T>
class BlockElement {
 public:
  static constexpr ThinWallElement kind = ThinWallElement::block;
  static constexpr std::size_t width = Lanes<T>::count;
  using Lane = T;
  using Number = NumberOf<T>;

  MENGER_HOST_DEVICE BlockElement(const ThinWallTask<Number>& task, std::size_t batch)
      : task_(task),
        first_axis_((task.batches.normals[batch] + 1U) % 3U),
        nodes_(task.batches.first_components + 8 * width * batch),
        mu_(T(task.shear_modulus_Pa)) {
    const Number* shape = task.batches.shapes + shape_numbers_per_lane * width * batch;
    for (std::size_t i = 0; i < 3; ++i) c_[i] = Lanes<T>::load(shape + i * width);
    volume_ = Lanes<T>::load(shape + 3 * width);
  }

  MENGER_HOST_DEVICE void place() {
    u_ = BoxMemory<T>::modes(nodes_, first_axis_, task_.motion.displacements_m);
    std::array<Vector3<T>, 3> g;
    T square(0.0);
    for (std::size_t j = 0; j < 3; ++j) {
      g[j] = scaled(c_[j], u_.linear[j]);
      gradient_.columns[j] = g[j];
      gradient_.columns[j][j] = g[j][j] + T(1.0);
      square = square + dot(g[j], g[j]);
    }
    const auto& f = gradient_.columns;
    gradient_.cofactors = {cross(f[1], f[2]), cross(f[2], f[0]), cross(f[0], f[1])};
    // J - 1 without cancellation
    const T normal_excess = (g[0][0] + g[1][1]) + fms(g[0][0], g[1][1], g[0][1] * g[1][0]);
    const T ratio = fma(normal_excess, g[2][2], normal_excess + g[2][2]);
    gradient_.ratio_excess = fma(gradient_.cofactors[2][0], f[2][0], fma(gradient_.cofactors[2][1], f[2][1], ratio));
    gradient_.ratio = T(1.0) + gradient_.ratio_excess;
    gradient_.square_excess = fma(T(2.0), (g[0][0] + g[1][1]) + (g[2][2] - gradient_.ratio_excess), square);
    strains_ = strains_of(f, u_.hourglass);
  }

  [[nodiscard]] MENGER_HOST_DEVICE T smallest_ratio() const {
    return select(admissible_ > T(0.0), select(gradient_.ratio > T(0.0), gradient_.ratio, T(-1.0)), T(-1.0));
  }

  /// The square of the ratio, or -1.
  [[nodiscard]] MENGER_HOST_DEVICE T smallest_square() const {
    const T ratio = smallest_ratio();
    return ratio * abs(ratio);
  }

  template <bool is_damped, class Law>
  MENGER_HOST_DEVICE void compute_forces(const Law& law, const BlockBranch<T>& branch) {
    BlockResponse<T> response = law(gradient_);
    admissible_ = min(admissible_, response.admissible);
    BlockStrains<T> strains = strains_;
    std::array<Vector3<T>, 3> viscous{};
    if constexpr (is_damped) {
      if (branch.is_there) {
        const T modulus = T(task_.branch_modulus_Pa);
        for (std::size_t c = 0; c < 6; ++c) response.stress[c] = fma(modulus, branch.tensor[c], response.stress[c]);
        response.by_cofactor = response.by_cofactor - modulus / gradient_.ratio;
        const T ratio = T(task_.branch_ratio);
        for (std::size_t n = 0; n < 12; ++n) strains[n] = fma(ratio, strains_[n] - branch.strains[n], strains[n]);
      }
      if (task_.viscosity_Pa_s > 0.0) viscous = viscous_forces(strains);
    }
    const T pressure = fma(T(task_.block_stiffness_Pa), gradient_.ratio_excess, response.by_cofactor);
    const auto& S = response.stress;
    const std::array<std::array<std::size_t, 3>, 3> places{{{0, 5, 4}, {5, 1, 3}, {4, 3, 2}}};
    for (std::size_t j = 0; j < 3; ++j) {
      column_forces_[j] = scaled(pressure, gradient_.cofactors[j]);
      for (std::size_t k = 0; k < 3; ++k) add(column_forces_[j], S[places[j][k]], gradient_.columns[k]);
      if constexpr (is_damped) add(column_forces_[j], T(1.0), viscous[j]);
    }
    add_hourglass_forces(strains);
  }

  MENGER_HOST_DEVICE void store(Number* forces) const {
    BoxModes<T> modes;
    for (std::size_t j = 0; j < 3; ++j) modes.linear[j] = scaled(c_[j] * volume_, column_forces_[j]);
    for (std::size_t a = 0; a < 4; ++a) modes.hourglass[a] = scaled(volume_, pattern_forces_[a]);
    BoxMemory<T>::template store<false>(modes, first_axis_, forces);
  }

  template <class Law>
  [[nodiscard]] MENGER_HOST_DEVICE T energy(const Law& law, const Number* branch) {
    const BlockResponse<T> response = law(gradient_);
    admissible_ = min(admissible_, response.admissible);
    T sum = fma(T(0.5 * task_.block_stiffness_Pa) * gradient_.ratio_excess, gradient_.ratio_excess, response.energy);
    sum = sum + quadratic_energy(strains_);
    if (branch == nullptr) return volume_ * sum;
    for_each_branch(task_, branch, [&](std::size_t n, const Number* own) {
      BlockBranch<T> state;
      state.load(own);
      const T ratios = determinant(state.tensor, cofactor(state.tensor)) * gradient_.ratio * gradient_.ratio;
      const T change = (contraction(state.tensor, metric()) - T(3.0)) - log(ratios);
      const T stored = fma(T(0.5) * mu_, change, quadratic_energy(difference(strains_, state.strains)));
      sum = fma(T(task_.branch_ratios[n]), stored, sum);
    });
    return volume_ * sum;
  }

  [[nodiscard]] MENGER_HOST_DEVICE BlockBranch<T> rest() const {
    const T inverse = T(1.0) / gradient_.ratio;
    std::array<Vector3<T>, 3> n;
    for (std::size_t j = 0; j < 3; ++j) n[j] = scaled(inverse, gradient_.cofactors[j]);
    return {
        true, {dot(n[0], n[0]), dot(n[1], n[1]), dot(n[2], n[2]), dot(n[1], n[2]), dot(n[0], n[2]), dot(n[0], n[1])}, strains_};
  }

  [[nodiscard]] MENGER_HOST_DEVICE BlockBranch<T> load_branch(const Number* values) const {
    BlockBranch<T> branch;
    branch.load(values);
    return branch;
  }

  MENGER_HOST_DEVICE BlockBranch<T> relax(Number* values) {
    return relax_all<BlockBranch<T>, T>(task_, values, rest(), [&](std::size_t n, Number* own, const BlockBranch<T>& rest) {
      BlockBranch<T> before;
      before.load(own);
      const BlockBranch<T> after = before.moved_to(rest, T(task_.shares[n]));
      after.store(own);
      const T fall = energy_fall(before.tensor, after.tensor, metric());
      T released = fma(T(0.5) * mu_, fall, quadratic_energy(difference(strains_, before.strains)));
      released = released - quadratic_energy(difference(strains_, after.strains));
      relaxed_ = fma(volume_ * T(task_.branch_ratios[n]), released, relaxed_);
      return before.moved_to(after, T(0.5));
    });
  }

  MENGER_HOST_DEVICE void press_faces(std::size_t) {}

  [[nodiscard]] MENGER_HOST_DEVICE T volume_change() const { return T(0.0); }
  [[nodiscard]] MENGER_HOST_DEVICE T dissipation() const { return dissipation_; }
  [[nodiscard]] MENGER_HOST_DEVICE T relaxed() const { return relaxed_; }

 private:
  static constexpr double poisson_ratio = 0.49;
  static constexpr double youngs_modulus = 2.0 * (1.0 + poisson_ratio);                              // by mu
  static constexpr double bending = youngs_modulus / (3.0 * (1.0 - poisson_ratio * poisson_ratio));  // by mu

  [[nodiscard]] MENGER_HOST_DEVICE BlockStrains<T> strains_of(const std::array<Vector3<T>, 3>& f,
                                                              const std::array<Vector3<T>, 4>& H) const {
    BlockStrains<T> s;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3;
      s[3 * i] = c_[i] * dot(f[i], H[j]);
      s[3 * i + 1] = c_[j] * dot(f[j], H[i]);
      s[3 * i + 2] = fma(c_[j], dot(f[i], H[i]), c_[i] * dot(f[j], H[j]));
      s[9 + i] = c_[i] * dot(f[i], H[3]);
    }
    return s;
  }

  /// Moduli times strains.
  [[nodiscard]] MENGER_HOST_DEVICE BlockStrains<T> hourglass_stress(const BlockStrains<T>& s) const {
    const T direct = T(bending) * mu_;
    const T mixed = T(bending * poisson_ratio) * mu_;
    const T shear = T(1.0 / 3.0) * mu_;
    const T twist = T(youngs_modulus / 9.0) * mu_;
    BlockStrains<T> result;
    for (std::size_t i = 0; i < 3; ++i) {
      result[3 * i] = fma(direct, s[3 * i], mixed * s[3 * i + 1]);
      result[3 * i + 1] = fma(direct, s[3 * i + 1], mixed * s[3 * i]);
      result[3 * i + 2] = shear * s[3 * i + 2];
      result[9 + i] = twist * s[9 + i];
    }
    return result;
  }

  [[nodiscard]] MENGER_HOST_DEVICE T quadratic_energy(const BlockStrains<T>& strains) const {
    const BlockStrains<T> stress = hourglass_stress(strains);
    T sum = stress[0] * strains[0];
    for (std::size_t n = 1; n < 12; ++n) sum = fma(stress[n], strains[n], sum);
    return T(0.5) * sum;
  }

  MENGER_HOST_DEVICE void add_hourglass_forces(const BlockStrains<T>& strains) {
    const BlockStrains<T> s = hourglass_stress(strains);
    const auto& f = gradient_.columns;
    const auto& H = u_.hourglass;
    for (Vector3<T>& force : pattern_forces_) force = {T(0.0), T(0.0), T(0.0)};
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3;
      const T x = c_[i] * s[3 * i];
      const T y = c_[j] * s[3 * i + 1];
      const T first = c_[j] * s[3 * i + 2];
      const T second = c_[i] * s[3 * i + 2];
      const T last = c_[i] * s[9 + i];
      add(column_forces_[i], x, H[j]);
      add(column_forces_[j], y, H[i]);
      add(column_forces_[i], first, H[i]);
      add(column_forces_[j], second, H[j]);
      add(column_forces_[i], last, H[3]);
      add(pattern_forces_[j], x, f[i]);
      add(pattern_forces_[i], y, f[j]);
      add(pattern_forces_[i], first, f[i]);
      add(pattern_forces_[j], second, f[j]);
      add(pattern_forces_[3], last, f[i]);
    }
  }

  /// 2 eta dev(d) F^-T, d = sym(dF/dt F^-1), by columns; adds the rates of the hourglass strains.
  MENGER_HOST_DEVICE std::array<Vector3<T>, 3> viscous_forces(BlockStrains<T>& strains) {
    const BoxModes<T> v = BoxMemory<T>::modes(nodes_, first_axis_, task_.motion.velocities_m_per_s);
    std::array<Vector3<T>, 3> rate;
    for (std::size_t j = 0; j < 3; ++j) rate[j] = scaled(c_[j], v.linear[j]);
    const T inverse = T(1.0) / gradient_.ratio;
    const auto& n = gradient_.cofactors;
    const auto entry = [&](std::size_t i, std::size_t j) {  // of J dF/dt F^-1
      return fma(rate[0][i], n[0][j], fma(rate[1][i], n[1][j], rate[2][i] * n[2][j]));
    };
    std::array<Vector3<T>, 3> d;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) d[i][j] = T(0.5) * inverse * (entry(i, j) + entry(j, i));
    const T mean = T(1.0 / 3.0) * (d[0][0] + d[1][1] + d[2][2]);
    for (std::size_t i = 0; i < 3; ++i) d[i][i] = d[i][i] - mean;
    const T factor = T(2.0 * task_.viscosity_Pa_s) * inverse;
    std::array<Vector3<T>, 3> forces;
    for (std::size_t j = 0; j < 3; ++j)
      for (std::size_t i = 0; i < 3; ++i) forces[j][i] = factor * dot(d[i], n[j]);
    const T power = T(2.0 * task_.viscosity_Pa_s) * (dot(d[0], d[0]) + dot(d[1], d[1]) + dot(d[2], d[2]));
    BlockStrains<T> rates = strains_of(gradient_.columns, v.hourglass);
    const BlockStrains<T> turning = strains_of(rate, u_.hourglass);
    const T time = T(task_.viscous_time_s);
    for (std::size_t k = 0; k < 12; ++k) {
      rates[k] = rates[k] + turning[k];
      strains[k] = fma(time, rates[k], strains[k]);
    }
    dissipation_ = volume_ * fma(T(2.0) * time, quadratic_energy(rates), power);
    return forces;
  }

  /// C = F^T F
  [[nodiscard]] MENGER_HOST_DEVICE SymmetricTensor<T> metric() const {
    const auto& f = gradient_.columns;
    return {dot(f[0], f[0]), dot(f[1], f[1]), dot(f[2], f[2]), dot(f[1], f[2]), dot(f[0], f[2]), dot(f[0], f[1])};
  }

  const ThinWallTask<Number>& task_;
  std::size_t first_axis_;
  const std::uint32_t* nodes_;
  T mu_;
  std::array<T, 3> c_;
  T volume_;
  BoxModes<T> u_;
  BlockGradient<T> gradient_;
  BlockStrains<T> strains_;
  std::array<Vector3<T>, 3> column_forces_;
  std::array<Vector3<T>, 4> pattern_forces_;
  T admissible_ = T(1.0);
  T dissipation_ = T(0.0);
  T relaxed_ = T(0.0);
};

}  // namespace menger::fem::detail
