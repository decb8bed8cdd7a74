#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "voxel/kernels/step_data.h"
#include "voxel/laws/lattice.h"
#include "voxel/model/surrogate_parameters.h"

namespace menger::voxel {

/// Length (m) of the half of a beam that belongs to a voxel of a class along it, (L / 2)(1 + extension(p)).
inline double half_length_m(const SurrogateParameters& parameters, std::size_t wall_class, double pressure_Pa) {
  return 0.5 * parameters.voxel_edge_m() * (1.0 + parameters.extension[wall_class].value(pressure_Pa));
}

/// Its rate (m/s) at a rate of the pressure (Pa/s).
inline double half_length_rate_m_s(const SurrogateParameters& parameters, std::size_t wall_class, double pressure_Pa,
                                   double pressure_rate_Pa_s) {
  return 0.5 * parameters.voxel_edge_m() * parameters.extension[wall_class].derivative(pressure_Pa) * pressure_rate_Pa_s;
}

/// Lateral coupling: what a body gains in length it loses in width, at no cost of the time step.
///
/// A beam i of rest length l_i, length d_i and section stiffness EA_i has the spring stiffness k_i = EA_i / l_i and stores e_i^2
/// / 2 with e_i = sqrt(k_i) (d_i - l_i). With S_a(v) = 1/2 of the sum of e_i over the beams along axis a at voxel v, the coupling
/// adds
///
///   U_c = c sum over v of (S_x S_y + S_y S_z + S_z S_x),
///
/// that is to every beam along x the tension sqrt(k_i) (c / 2) sum over its ends v of (S_y + S_z)(v), along the line between its
/// ends, and likewise for y and z. To first order, and between equal beams, this is a rest length shortened by l c (e_y + e_z),
/// with e_y and e_z the strains across it in the mean over its ends: uniaxial tension contracts a wide body by c / (1 + c) of its
/// strain, Poisson's ratio 0.5 at c = 1. In a bar n voxels wide that is about 0.7 / n of itself more, because the outermost beams
/// along it have half the neighbours, and one voxel wide it is nothing, because there are no beams across it.
///
/// The energy stays positive for -1/2 < c < 1 and any stiffness and length of the beams, and its largest stiffness grows by 1 + 2
/// c: both because sum over v of S_a(v)^2 is at most the sum of e_i^2. The tensions are central and in pairs, so that momentum
/// and moment of momentum are conserved. Beams are damped without the coupling.
template <class Real>
class LateralCoupling {
 public:
  /// @param coupling c, 0 <= c < 1 @param axial_N EA per axis and beam, in the order of the lattice
  LateralCoupling(const Lattice& lattice, double coupling, const std::array<std::vector<double>, 3>& axial_N);

  /// Adds the tensions to the load lines, for the positions and rest lengths as they are.
  void add_loads(const StepData<Real>& d);

  /// U_c of the last add_loads, J.
  [[nodiscard]] double energy_J() const;

  /// -dU_c / d(rest length) of a beam in the last add_loads, N: (1 + (d_i - l_i) / (2 l_i)) times its tension.
  [[nodiscard]] double rest_length_force_N(std::size_t axis, std::size_t beam) const;

  [[nodiscard]] std::size_t beam_count(std::size_t axis) const { return beams_[axis].size(); }

 private:
  struct Beam {
    std::size_t lower, upper;
    Real axial;         ///< EA
    Real root;          ///< sqrt(k) now
    Real direction[3];  ///< from the lower to the upper end
    Real strain;
    Real tension;
  };

  Real half_coupling_;
  std::array<std::vector<Beam>, 3> beams_;
  std::vector<std::array<Real, 3>> sums_;  ///< S per voxel and axis
};

}  // namespace menger::voxel
