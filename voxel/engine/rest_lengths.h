#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "voxel/engine/wall_response.h"
#include "voxel/kernels/step_data.h"
#include "voxel/laws/lattice.h"
#include "voxel/model/surrogate_parameters.h"

namespace menger::voxel {

/// Returns the length (m) of the half beam of a voxel with a size class along it: (L / 2)(1 + extension(p)).
inline double half_length_m(const SurrogateParameters& parameters, std::size_t size_class, double pressure_Pa) {
  return half_length_m(parameters.voxel_edge_m(), parameters.extension_of(size_class), pressure_Pa);
}

/// Returns the rate (m/s) of half_length_m at a rate of the pressure (Pa/s).
inline double half_length_rate_m_s(const SurrogateParameters& parameters, std::size_t size_class, double pressure_Pa,
                                   double pressure_rate_Pa_s) {
  return half_length_rate_m_s(parameters.voxel_edge_m(), parameters.extension_of(size_class), pressure_Pa, pressure_rate_Pa_s);
}

/// Makes a body thinner where it is stretched (lateral coupling): a stretched beam adds tension to the beams across it.
///
/// A beam i of rest length l_i, present length d_i and section stiffness EA_i has the spring stiffness k_i = EA_i / l_i. It
/// stores the energy e_i^2 / 2 with e_i = sqrt(k_i) (d_i - l_i). Let S_a(v) be half the sum of e_i over the beams along axis a at
/// voxel v. The coupling adds the energy
///
///   U_c = c sum over v of (S_x S_y + S_y S_z + S_z S_x).
///
/// Every beam along x thus gets the additional tension sqrt(k_i) (c / 2) sum over its ends v of (S_y + S_z)(v), along the line
/// between its ends, and likewise for y and z. To first order, and between equal beams, this acts like a rest length that is
/// shorter by l c (e_y + e_z). Here e_y and e_z are strains, not the e_i above: those of the beams across this one, averaged over
/// its two ends. The rest lengths themselves do not change.
///
/// Under uniaxial tension a wide body contracts by c / (1 + c) of its strain, so Poisson's ratio is 0.5 at c = 1. A bar n voxels
/// wide contracts more, by a share of about 0.7 / n of this, because the outermost beams along it have half the neighbours. A bar
/// one voxel wide does not contract, because there are no beams across it.
///
/// The energy stays positive for -1/2 < c < 1, whatever the stiffnesses and lengths of the beams. The largest stiffness grows by
/// at most the factor 1 + 2 c, so the recommended time step (recommended_time_step_s) is shorter by up to the factor
/// sqrt(1 + 2 c). Both hold because the sum over v of S_a(v)^2 is at most the sum of e_i^2. The tensions are central and in
/// pairs, so momentum and moment of momentum are conserved. The coupling adds no damping: beams are damped as without it.
template <class Real>
class LateralCoupling {
 public:
  /// @param coupling c, 0 <= c < 1
  /// @param axial_N EA per axis and beam, in the order of the lattice
  LateralCoupling(const Lattice& lattice, double coupling, const std::array<std::vector<double>, 3>& axial_N);

  /// Adds the tensions to the load lines, for the present positions and rest lengths.
  void add_loads(const StepData<Real>& d);

  /// Returns U_c of the last add_loads, J.
  [[nodiscard]] double energy_J() const;

  /// Returns -dU_c / d(rest length) of a beam in the last add_loads, N: (1 + (d_i - l_i) / (2 l_i)) times its tension.
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
