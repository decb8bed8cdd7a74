#pragma once

// One batch of walls.

#include "fem/thin_walls/box_modes.h"
#include "fem/thin_walls/element_branch.h"
#include "fem/thin_walls/membrane_law.h"
#include "fem/thin_walls/thin_wall_kernel_table.h"

namespace menger::fem::detail {

/// A field on a wall: columns of its gradient at the centre, their change across the wall, hourglass patterns.
template <class T>
struct WallField {
  Vector3<T> sum;               ///< over the corners
  std::array<Vector3<T>, 3> g;  ///< of displacements: f_i - e_i
  Vector3<T> q1;
  Vector3<T> q2;
  std::array<Vector3<T>, 4> H;
};

/// The hourglass strains e11, e22, s13, s23, t1, t2, k1, k2, k3.
template <class T>
using WallStrains = std::array<T, 9>;

template <class T>
class WallElement {
 public:
  static constexpr ThinWallElement kind = ThinWallElement::wall;
  static constexpr std::size_t width = Lanes<T>::count;
  using Lane = T;
  using Number = NumberOf<T>;

  MENGER_HOST_DEVICE WallElement(const ThinWallTask<Number>& task, std::size_t batch)
      : task_(task),
        first_axis_((task.batches.normals[batch] + 1U) % 3U),
        nodes_(task.batches.first_components + 8 * width * batch),
        mu_(T(task.shear_modulus_Pa)) {
    const Number* shape = task.batches.shapes + shape_numbers_per_lane * width * batch;
    for (std::size_t i = 0; i < 3; ++i) c_[i] = Lanes<T>::load(shape + i * width);
    volume_ = Lanes<T>::load(shape + 3 * width);
    for (std::size_t i = 0; i < 2; ++i) roots_[i] = Lanes<T>::load(shape + (4 + i) * width);
    if (task.batches.mean_pressures_Pa != nullptr) pressure_ = T(task.batches.mean_pressures_Pa[batch]);
  }

  MENGER_HOST_DEVICE void place() {
    u_ = field(task_.motion.displacements_m);
    for (std::size_t j = 0; j < 3; ++j) {
      f_[j] = u_.g[j];
      f_[j][j] = f_[j][j] + T(1.0);
    }
    set_metrics();
    normal_ = cross(f_[0], f_[1]);
    const auto& g = u_.g;
    // n3 - 1 and J - 1 without cancellation
    const T normal_excess = (g[0][0] + g[1][1]) + fms(g[0][0], g[1][1], g[0][1] * g[1][0]);
    ratio_excess_ = fma(normal_excess, g[2][2], normal_excess + g[2][2]);
    ratio_excess_ = fma(normal_[0], f_[2][0], fma(normal_[1], f_[2][1], ratio_excess_));
    for (std::size_t i = 0; i < 2; ++i) shears_[i] = roots_[i] * (g[i][2] + g[2][i] + dot(g[i], g[2]));
    strains_ = strains_of(f_, u_.H);
  }

  /// The smallest of J and of both area ratios; what is not a number counts as -1.
  [[nodiscard]] MENGER_HOST_DEVICE T smallest_ratio() const {
    const T square = smallest_square();
    return select(square > T(0.0), sqrt(max(square, T(0.0))), T(-1.0));
  }

  /// The square of the smallest ratio, or -1.
  [[nodiscard]] MENGER_HOST_DEVICE T smallest_square() const {
    const T d = T(1.0) + min(points_[0].area_excess, points_[1].area_excess);
    const T ratio = T(1.0) + ratio_excess_;
    const T square = select(d > T(0.0), min(d, ratio * abs(ratio)), T(-1.0));  // min hides a d that is not a number
    return select(admissible_ > T(0.0), select(square > T(0.0), square, T(-1.0)), T(-1.0));
  }

  /// @tparam Law a law, called with a metric @tparam is_damped whether there is a branch or a viscosity
  template <bool is_damped, class Law>
  MENGER_HOST_DEVICE void compute_forces(const Law& law, const WallBranch<T>& branch) {
    std::array<PlaneStress<T>, 2> stresses;
    for (std::size_t z = 0; z < 2; ++z) {
      const MembraneResponse<T> response = law(points_[z]);
      stresses[z] = response.stress;
      admissible_ = min(admissible_, response.admissible);
    }
    std::array<T, 2> shears = shears_;
    WallStrains<T> strains = strains_;
    shear_forces_ = {T(0.0), T(0.0)};
    if constexpr (is_damped) {
      if (branch.is_there) add_branch(branch, stresses, strains);
      if (task_.viscosity_Pa_s > 0.0) add_viscosity(stresses, strains);
    }
    const T half = T(0.5);
    const PlaneStress<T> mean{half * (stresses[0].s11 + stresses[1].s11), half * (stresses[0].s22 + stresses[1].s22),
                              half * (stresses[0].s12 + stresses[1].s12)};
    const T point = T(0.5 * gauss_point);
    const PlaneStress<T> moment{point * (stresses[1].s11 - stresses[0].s11), point * (stresses[1].s22 - stresses[0].s22),
                                point * (stresses[1].s12 - stresses[0].s12)};
    PlaneStress<T> metric_stress = mean;
    add_shear(T(shear_factor) * mu_, shears, metric_stress);
    set_gradient_forces(metric_stress, mean, moment);
    add_hourglass_forces(strains);
  }

  MENGER_HOST_DEVICE void store(Number* forces) const {
    BoxModes<T> modes;
    modes.constant = scaled(volume_, face_forces_[2]);
    for (std::size_t j = 0; j < 3; ++j) modes.linear[j] = scaled(c_[j] * volume_, column_forces_[j]);
    for (std::size_t j = 0; j < 2; ++j) add(modes.linear[j], volume_, face_forces_[j]);
    for (std::size_t a = 0; a < 4; ++a) modes.hourglass[a] = scaled(volume_, pattern_forces_[a]);
    BoxMemory<T>::template store<true>(modes, first_axis_, forces);
  }

  /// Sets the mean of the pressures on both faces, Pa; before the forces are computed.
  MENGER_HOST_DEVICE void set_mean_pressure(const T& pressure_Pa) { pressure_ = pressure_Pa; }

  /// Adds the pressures on the faces to the forces, which must have been computed, and finds what volume the faces have swept.
  MENGER_HOST_DEVICE void press_faces(std::size_t batch) {
    const std::size_t count = task_.batches.pressed_faces[batch];
    for (std::size_t face = 0; face < count; ++face) {
      T side = Lanes<T>::load(task_.batches.sides + width * batch);
      if (face == 1) side = -side;
      const T swept = press_face(side, T(task_.batches.face_pressures_Pa[2 * batch + face]));
      if (task_.batches.face_volumes_m3 == nullptr) continue;
      LaneSums<T> change;
      change.add(swept);
      task_.batches.face_volumes_m3[2 * batch + face] = change.total();
    }
  }

  /// Adds the pressure on the face at zeta = side. See FacePressureKernels. The tangents in its middle are A = l1/2 (f1 + side
  /// q1) and C = l2/2 (f2 + side q2), and the twist is (H3 + side H4)/8. With 1/c_i = 4 l_i and l1 l2 / 4 = V c3, A x C = V c3
  /// f1' x f2', and A x k = V c2 c3 f1' x h. Half of a force on the face belongs to the patterns that are constant across the
  /// wall.
  /// @return the change of volume behind the face, m^3
  MENGER_HOST_DEVICE T press_face(const T& side, const T& pressure) {
    const T to_second = c_[1] * c_[2];
    const T to_first = c_[0] * c_[2];
    Vector3<T> g1 = u_.g[0];
    Vector3<T> g2 = u_.g[1];
    Vector3<T> h = u_.H[2];
    add(g1, side, u_.q1);
    add(g2, side, u_.q2);
    add(h, side, u_.H[3]);
    Vector3<T> f1 = g1;
    Vector3<T> f2 = g2;
    f1[0] = f1[0] + T(1.0);
    f2[1] = f2[1] + T(1.0);
    const Vector3<T> total = scaled(T(0.5) * pressure, cross(f1, f2));
    const Vector3<T> along_first = scaled(T(1.0 / 6.0) * pressure * to_second, cross(f1, h));
    const Vector3<T> along_second = scaled(T(1.0 / 6.0) * pressure * to_first, cross(h, f2));
    add(column_forces_[2], T(1.0), total);
    add(face_forces_[2], side * c_[2], total);
    add(pattern_forces_[1], T(1.0), along_first);
    add(face_forces_[0], side, along_first);
    add(pattern_forces_[0], T(1.0), along_second);
    add(face_forces_[1], side, along_second);
    return -(side * swept_volume(side, g1, g2, h));
  }

  /// Energy in J. @param branch nullptr: without one
  template <class Law>
  [[nodiscard]] MENGER_HOST_DEVICE T energy(const Law& law, const Number* branch) {
    T sum(0.0);
    for (const PlaneMetric<T>& point : points_) {
      const MembraneResponse<T> response = law(point);
      sum = fma(T(0.5), response.energy, sum);
      admissible_ = min(admissible_, response.admissible);
    }
    sum = sum + quadratic_energy(shears_, strains_);
    sum = fma(ratio_excess_, fms(T(0.5 * task_.wall_penalty_Pa), ratio_excess_, pressure_), sum);
    if (branch == nullptr) return volume_ * sum;
    for_each_branch(task_, branch, [&](std::size_t n, const Number* own) {
      WallBranch<T> state;
      state.load(own);
      T stored(0.0);
      for (std::size_t z = 0; z < 2; ++z) {
        const T change = membrane_contraction(state.tensors[z], points_[z]) - log(determinant(state.tensors[z]));
        stored = fma(T(0.25) * mu_, change, stored);  // m/2 of half the volume, below
      }
      stored = stored + quadratic_energy(difference(shears_, state.shears), difference(strains_, state.strains));
      sum = fma(T(task_.branch_ratios[n]), stored, sum);
    });
    return volume_ * sum;
  }

  /// Where the branch would be at rest.
  [[nodiscard]] MENGER_HOST_DEVICE WallBranch<T> rest() const {
    WallBranch<T> rest;
    for (std::size_t z = 0; z < 2; ++z) {
      const PlaneMetric<T>& m = points_[z];
      rest.tensors[z] = {m.inverse * (T(1.0) + m.b_excess), m.inverse * (T(1.0) + m.a_excess), -(m.inverse * m.c),
                         T(1.0) + m.area_excess};
    }
    rest.shears = shears_;
    rest.strains = strains_;
    return rest;
  }

  /// @param values of the first set @return the mean of all branches
  [[nodiscard]] MENGER_HOST_DEVICE WallBranch<T> load_branch(const Number* values) {
    WallBranch<T> branch;
    branch.load(values);
    for (std::size_t n = 0; task_.branch_count > 1 && n < task_.branch_count; ++n)
      load_numbers(values + (n + 1) * task_.sets_apart + 8 * Lanes<T>::count, shear_rests_[n]);
    return branch;
  }

  /// Lets branches go their shares of the way to rest. @param values of the first set, changed @return the mean of before and
  /// after
  MENGER_HOST_DEVICE WallBranch<T> relax(Number* values) {
    return relax_all<WallBranch<T>, T>(task_, values, rest(), [&](std::size_t n, Number* own, const WallBranch<T>& rest) {
      WallBranch<T> before;
      before.load(own);
      const WallBranch<T> after = before.moved_to(rest, T(task_.shares[n]));
      after.store(own);
      T released(0.0);
      for (std::size_t z = 0; z < 2; ++z) {
        const PlaneMetric<T>& m = points_[z];
        const SymmetricTensor<T> C{T(1.0) + m.a_excess, T(1.0) + m.b_excess, m.inverse, T(0.0), T(0.0), m.c};
        released = fma(T(0.25) * mu_, energy_fall(whole(before.tensors[z]), whole(after.tensors[z]), C), released);
      }
      released = released + quadratic_energy(difference(shears_, before.shears), difference(strains_, before.strains));
      released = released - quadratic_energy(difference(shears_, after.shears), difference(strains_, after.strains));
      relaxed_ = fma(volume_ * T(task_.branch_ratios[n]), released, relaxed_);
      const WallBranch<T> mean = before.moved_to(after, T(0.5));
      shear_rests_[n] = mean.shears;
      return mean;
    });
  }

  [[nodiscard]] MENGER_HOST_DEVICE T dissipation() const { return dissipation_; }
  [[nodiscard]] MENGER_HOST_DEVICE T volume_change() const { return volume_ * ratio_excess_; }
  [[nodiscard]] MENGER_HOST_DEVICE T relaxed() const { return relaxed_; }

 private:
  /// The volume that a face has swept along the third axis, see swept_volume of the kernels of faces: with the displacement m of
  /// its middle, the changes g of its columns and the twist h/8 it is 4 V c3 m . (e3 + (e1 x g2 + g1 x e2)/2 + g1 x g2/3) + 2/3
  /// (A0^2 g1 . (e1 x h)/8 + C0^2 g2 . (h x e2)/8).
  [[nodiscard]] MENGER_HOST_DEVICE T swept_volume(const T& side, const Vector3<T>& g1, const Vector3<T>& g2,
                                                  const Vector3<T>& h) const {
    Vector3<T> middle = scaled(c_[2], u_.sum);  // times 8 c3
    add(middle, side, u_.g[2]);
    const T third = T(1.0 / 3.0);
    const T half = T(0.5);
    const Vector3<T> both = cross(g1, g2);
    const Vector3<T> area{fnma(half, g1[2], third * both[0]), fnma(half, g2[2], third * both[1]),
                          T(1.0) + fma(half, g1[0] + g2[1], third * both[2])};
    const T of_first = c_[1] * c_[1] * fms(g1[2], h[1], g1[1] * h[2]);
    const T of_second = c_[0] * c_[0] * fms(g2[2], h[0], g2[0] * h[2]);
    const T of_twist = T(16.0 / 3.0) * volume_ * c_[2] * c_[2] * (of_first + of_second);
    return volume_ * fma(half, dot(middle, area), of_twist);
  }

  static constexpr double gauss_point = 0.57735026918962576451;  // 1/sqrt(3)

  [[nodiscard]] MENGER_HOST_DEVICE WallField<T> field(const Number* nodal) const {
    const BoxModes<T> modes = BoxMemory<T>::modes(nodes_, first_axis_, nodal);
    WallField<T> result;
    result.sum = modes.constant;
    for (std::size_t j = 0; j < 3; ++j) result.g[j] = scaled(c_[j], modes.linear[j]);
    result.q1 = scaled(c_[0], modes.hourglass[1]);
    result.q2 = scaled(c_[1], modes.hourglass[0]);
    result.H = modes.hourglass;
    return result;
  }

  /// The metric at the centre and at zeta = -+1/sqrt(3), where it is that of the centre and parts linear and quadratic in zeta.
  MENGER_HOST_DEVICE void set_metrics() {
    const auto& g = u_.g;
    const T a = fma(T(2.0), g[0][0], dot(g[0], g[0]));
    const T b = fma(T(2.0), g[1][1], dot(g[1], g[1]));
    const T c = (g[0][1] + g[1][0]) + dot(g[0], g[1]);
    centre_ = plane_metric(a, b, c);
    const T third = T(1.0 / 3.0);
    const T a2 = fma(third, dot(u_.q1, u_.q1), a);
    const T b2 = fma(third, dot(u_.q2, u_.q2), b);
    const T c2 = fma(third, dot(u_.q1, u_.q2), c);
    const T a1 = T(2.0 * gauss_point) * dot(f_[0], u_.q1);
    const T b1 = T(2.0 * gauss_point) * dot(f_[1], u_.q2);
    const T c1 = T(gauss_point) * (dot(f_[0], u_.q2) + dot(f_[1], u_.q1));
    points_[0] = plane_metric(a2 - a1, b2 - b1, c2 - c1);
    points_[1] = plane_metric(a2 + a1, b2 + b1, c2 + c1);
  }

  [[nodiscard]] MENGER_HOST_DEVICE WallStrains<T> strains_of(const std::array<Vector3<T>, 3>& f,
                                                             const std::array<Vector3<T>, 4>& H) const {
    return {c_[0] * dot(f[0], H[2]),
            c_[1] * dot(f[1], H[2]),
            fma(c_[2], dot(f[0], H[0]), c_[0] * dot(f[2], H[2])),
            fma(c_[2], dot(f[1], H[1]), c_[1] * dot(f[2], H[2])),
            c_[2] * dot(f[2], H[0]),
            c_[2] * dot(f[2], H[1]),
            c_[0] * dot(f[0], H[3]),
            c_[1] * dot(f[1], H[3]),
            c_[2] * dot(f[2], H[3])};
  }

  /// What each hourglass strain is multiplied by to give its stress.
  [[nodiscard]] MENGER_HOST_DEVICE WallStrains<T> hourglass_moduli() const {
    const T shear = T(shear_factor / 3.0) * mu_;
    const T across = T(4.0 / 3.0) * mu_;
    const T twist = T(1.0 / 3.0) * mu_;
    return {
        mu_, mu_, shear * roots_[0] * roots_[0], shear * roots_[1] * roots_[1], across, across, twist, twist, T(4.0 / 9.0) * mu_};
  }

  /// C^-1 x with the metric of the centre.
  [[nodiscard]] MENGER_HOST_DEVICE std::array<T, 2> raised(const std::array<T, 2>& x) const {
    const T a = T(1.0) + centre_.a_excess;
    const T b = T(1.0) + centre_.b_excess;
    return {centre_.inverse * fms(b, x[0], centre_.c * x[1]), centre_.inverse * fms(a, x[1], centre_.c * x[0])};
  }

  /// Adds the stress of modulus/2 p.C^-1.p: a force along f3 for each shear, and what C's change does.
  MENGER_HOST_DEVICE void add_shear(const T& modulus, const std::array<T, 2>& shears, PlaneStress<T>& stress) {
    const std::array<T, 2> y = raised(shears);
    for (std::size_t i = 0; i < 2; ++i) shear_forces_[i] = fma(modulus * roots_[i], y[i], shear_forces_[i]);
    stress.s11 = fnma(modulus * y[0], y[0], stress.s11);
    stress.s22 = fnma(modulus * y[1], y[1], stress.s22);
    stress.s12 = fnma(modulus * y[0], y[1], stress.s12);
  }

  MENGER_HOST_DEVICE void add_branch(const WallBranch<T>& branch, std::array<PlaneStress<T>, 2>& stresses,
                                     WallStrains<T>& strains) {
    const T modulus = T(task_.branch_modulus_Pa);
    for (std::size_t z = 0; z < 2; ++z) {
      const PlaneMetric<T>& m = points_[z];
      const std::array<T, 4>& A = branch.tensors[z];
      const T across = A[3] * m.inverse * m.inverse;
      stresses[z].s11 = fma(modulus, fnma(across, T(1.0) + m.b_excess, A[0]), stresses[z].s11);
      stresses[z].s22 = fma(modulus, fnma(across, T(1.0) + m.a_excess, A[1]), stresses[z].s22);
      stresses[z].s12 = fma(modulus, fma(across, m.c, A[2]), stresses[z].s12);
    }
    const T ratio = T(task_.branch_ratio);
    for (std::size_t n = 0; n < 9; ++n) strains[n] = fma(ratio, strains_[n] - branch.strains[n], strains[n]);
    branch_metric_ = {};
    if (task_.branch_count == 1) {
      add_shear(T(shear_factor) * modulus, difference(shears_, branch.shears), branch_metric_);
      return;
    }
    // Shear energy has its metric in squares of shears, so each branch counts by itself.
    for (std::size_t n = 0; n < task_.branch_count; ++n)
      add_shear(T(shear_factor) * T(task_.branch_moduli_Pa[n]), difference(shears_, shear_rests_[n]), branch_metric_);
  }

  MENGER_HOST_DEVICE void add_viscosity(std::array<PlaneStress<T>, 2>& stresses, WallStrains<T>& strains) {
    const WallField<T> v = field(task_.motion.velocities_m_per_s);
    const T eta = T(task_.viscosity_Pa_s);
    const auto rate = [&](std::size_t i, std::size_t j, const T& zeta) {  // of the metric, at zeta
      const Vector3<T>& qi = i == 0 ? u_.q1 : u_.q2;
      const Vector3<T>& qj = j == 0 ? u_.q1 : u_.q2;
      const Vector3<T>& vi = i == 0 ? v.q1 : v.q2;
      const Vector3<T>& vj = j == 0 ? v.q1 : v.q2;
      const T constant = dot(f_[i], v.g[j]) + dot(f_[j], v.g[i]);
      const T linear = (dot(f_[i], vj) + dot(f_[j], vi)) + (dot(qi, v.g[j]) + dot(qj, v.g[i]));
      const T square = dot(qi, vj) + dot(qj, vi);
      return fma(zeta, linear, fma(T(1.0 / 3.0), square, constant));
    };
    T power(0.0);
    for (std::size_t z = 0; z < 2; ++z) {
      const T zeta = T(z == 0 ? -gauss_point : gauss_point);
      const PlaneStress<T> viscous = viscous_stress(points_[z], rate(0, 0, zeta), rate(1, 1, zeta), rate(0, 1, zeta), power);
      stresses[z].s11 = fma(eta, viscous.s11, stresses[z].s11);
      stresses[z].s22 = fma(eta, viscous.s22, stresses[z].s22);
      stresses[z].s12 = fma(eta, viscous.s12, stresses[z].s12);
    }
    power = T(0.25) * eta * power;  // half of the volume per point, half of the stress times the rate of the metric
    WallStrains<T> rates = strains_of(f_, v.H);
    const WallStrains<T> turning = strains_of(v.g, u_.H);
    for (std::size_t n = 0; n < 9; ++n) rates[n] = rates[n] + turning[n];
    std::array<T, 2> shear_rates;
    for (std::size_t i = 0; i < 2; ++i) shear_rates[i] = roots_[i] * (dot(f_[i], v.g[2]) + dot(v.g[i], f_[2]));
    const T time = T(task_.viscous_time_s);
    for (std::size_t n = 0; n < 9; ++n) strains[n] = fma(time, rates[n], strains[n]);
    const std::array<T, 2> y = raised(shear_rates);
    for (std::size_t i = 0; i < 2; ++i) shear_forces_[i] = fma(T(shear_factor) * eta * roots_[i], y[i], shear_forces_[i]);
    dissipation_ = volume_ * fma(T(2.0) * time, quadratic_energy(shear_rates, rates), power);
  }

  /// C^-1 Cdot C^-1 + tr(C^-1 Cdot) C^-1: the stress of 2 dev(d) in a layer that keeps its volume. Adds its work with Cdot to
  /// `power`.
  MENGER_HOST_DEVICE static PlaneStress<T> viscous_stress(const PlaneMetric<T>& m, const T& a_rate, const T& b_rate,
                                                          const T& c_rate, T& power) {
    const T a = m.inverse * (T(1.0) + m.a_excess);  // C^-1 is [b, -c; -c, a]
    const T b = m.inverse * (T(1.0) + m.b_excess);
    const T c = m.inverse * m.c;
    const T x11 = fms(b, a_rate, c * c_rate);
    const T x12 = fms(b, c_rate, c * b_rate);
    const T x21 = fms(a, c_rate, c * a_rate);
    const T x22 = fms(a, b_rate, c * c_rate);
    const T trace = x11 + x22;
    const PlaneStress<T> stress{fma(x11 + trace, b, -(x12 * c)), fms(x22 + trace, a, x21 * c), fms(x12, a, (x11 + trace) * c)};
    power = fma(stress.s11, a_rate, fma(stress.s22, b_rate, fma(T(2.0) * stress.s12, c_rate, power)));
    return stress;
  }

  /// P_j, the derivatives by f_j, and those by q1 and q2.
  MENGER_HOST_DEVICE void set_gradient_forces(const PlaneStress<T>& centre, const PlaneStress<T>& mean,
                                              const PlaneStress<T>& moment) {
    const T pressure = fms(T(task_.wall_penalty_Pa), ratio_excess_, pressure_);
    const PlaneStress<T> s{centre.s11 + branch_metric_.s11, centre.s22 + branch_metric_.s22, centre.s12 + branch_metric_.s12};
    column_forces_[0] = scaled(pressure, cross(f_[1], f_[2]));
    column_forces_[1] = scaled(pressure, cross(f_[2], f_[0]));
    column_forces_[2] = scaled(pressure, normal_);
    add(column_forces_[0], s.s11, f_[0]);
    add(column_forces_[0], s.s12, f_[1]);
    add(column_forces_[0], moment.s11, u_.q1);
    add(column_forces_[0], moment.s12, u_.q2);
    add(column_forces_[0], shear_forces_[0], f_[2]);
    add(column_forces_[1], s.s22, f_[1]);
    add(column_forces_[1], s.s12, f_[0]);
    add(column_forces_[1], moment.s22, u_.q2);
    add(column_forces_[1], moment.s12, u_.q1);
    add(column_forces_[1], shear_forces_[1], f_[2]);
    add(column_forces_[2], shear_forces_[0], f_[0]);
    add(column_forces_[2], shear_forces_[1], f_[1]);
    const T third = T(1.0 / 3.0);
    Vector3<T> Q1 = scaled(moment.s11, f_[0]);
    add(Q1, moment.s12, f_[1]);
    add(Q1, third * mean.s11, u_.q1);
    add(Q1, third * mean.s12, u_.q2);
    Vector3<T> Q2 = scaled(moment.s22, f_[1]);
    add(Q2, moment.s12, f_[0]);
    add(Q2, third * mean.s22, u_.q2);
    add(Q2, third * mean.s12, u_.q1);
    pattern_forces_[0] = scaled(c_[1], Q2);
    pattern_forces_[1] = scaled(c_[0], Q1);
  }

  MENGER_HOST_DEVICE void add_hourglass_forces(const WallStrains<T>& strains) {
    const WallStrains<T> moduli = hourglass_moduli();
    WallStrains<T> s;
    for (std::size_t n = 0; n < 9; ++n) s[n] = moduli[n] * strains[n];
    const auto& H = u_.H;
    const T e11 = c_[0] * s[0];
    const T e22 = c_[1] * s[1];
    const T across1 = c_[2] * s[2];
    const T across2 = c_[2] * s[3];
    const T along = fma(c_[0], s[2], c_[1] * s[3]);
    const T t1 = c_[2] * s[4];
    const T t2 = c_[2] * s[5];
    const std::array<T, 3> k{c_[0] * s[6], c_[1] * s[7], c_[2] * s[8]};
    add(column_forces_[0], e11, H[2]);
    add(column_forces_[0], across1, H[0]);
    add(column_forces_[0], k[0], H[3]);
    add(column_forces_[1], e22, H[2]);
    add(column_forces_[1], across2, H[1]);
    add(column_forces_[1], k[1], H[3]);
    add(column_forces_[2], along, H[2]);
    add(column_forces_[2], t1, H[0]);
    add(column_forces_[2], t2, H[1]);
    add(column_forces_[2], k[2], H[3]);
    add(pattern_forces_[0], across1, f_[0]);
    add(pattern_forces_[0], t1, f_[2]);
    add(pattern_forces_[1], across2, f_[1]);
    add(pattern_forces_[1], t2, f_[2]);
    pattern_forces_[2] = scaled(e11, f_[0]);
    add(pattern_forces_[2], e22, f_[1]);
    add(pattern_forces_[2], along, f_[2]);
    pattern_forces_[3] = scaled(k[0], f_[0]);
    add(pattern_forces_[3], k[1], f_[1]);
    add(pattern_forces_[3], k[2], f_[2]);
  }

  /// Of transverse shear and hourglass strains.
  [[nodiscard]] MENGER_HOST_DEVICE T quadratic_energy(const std::array<T, 2>& shears, const WallStrains<T>& strains) const {
    const std::array<T, 2> y = raised(shears);
    const WallStrains<T> moduli = hourglass_moduli();
    T sum = T(shear_factor) * mu_ * fma(shears[0], y[0], shears[1] * y[1]);
    for (std::size_t n = 0; n < 9; ++n) sum = fma(moduli[n] * strains[n], strains[n], sum);
    return T(0.5) * sum;
  }

  /// A : C - 3 with the stretch across the layer that keeps its volume.
  MENGER_HOST_DEVICE static T membrane_contraction(const std::array<T, 4>& A, const PlaneMetric<T>& m) {
    const T in_plane = fma(A[0], T(1.0) + m.a_excess, fma(A[1], T(1.0) + m.b_excess, T(2.0) * A[2] * m.c));
    return fma(A[3], m.inverse, in_plane - T(3.0));
  }

  /// The tensor of a wall with its shears across the layer, which are zero.
  MENGER_HOST_DEVICE static SymmetricTensor<T> whole(const std::array<T, 4>& A) {
    return {A[0], A[1], A[3], T(0.0), T(0.0), A[2]};
  }

  MENGER_HOST_DEVICE static T determinant(const std::array<T, 4>& A) { return fms(A[0], A[1], A[2] * A[2]) * A[3]; }

  const ThinWallTask<Number>& task_;
  std::size_t first_axis_;
  const std::uint32_t* nodes_;
  T mu_;
  std::array<T, 3> c_;
  T volume_;
  std::array<T, 2> roots_;
  T pressure_ = T(0.0);
  WallField<T> u_;
  std::array<Vector3<T>, 3> f_;
  Vector3<T> normal_;
  T ratio_excess_;
  PlaneMetric<T> centre_;
  std::array<PlaneMetric<T>, 2> points_;
  std::array<T, 2> shears_;
  WallStrains<T> strains_;
  std::array<T, 2> shear_forces_;
  PlaneStress<T> branch_metric_;
  std::array<std::array<T, 2>, most_branches> shear_rests_;  ///< of each of several branches
  std::array<Vector3<T>, 3> column_forces_;
  std::array<Vector3<T>, 4> pattern_forces_;
  /// Of the pressure on faces: along the first two axes beside what column_forces_ become, and the resultant.
  std::array<Vector3<T>, 3> face_forces_{{{T(0.0), T(0.0), T(0.0)}, {T(0.0), T(0.0), T(0.0)}, {T(0.0), T(0.0), T(0.0)}}};
  T admissible_ = T(1.0);
  T dissipation_ = T(0.0);
  T relaxed_ = T(0.0);
};

}  // namespace menger::fem::detail
