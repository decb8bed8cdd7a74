#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "fem/elements/maxwell_branch.h"
#include "fem/thin_walls/lane_places.h"
#include "materials/laws/hyperelastic_law.h"

namespace menger::fem {

/// The two elements that a body of thin walls is made of; both are boxes with eight corners in the reference configuration.
enum class ThinWallElement {
  wall,   ///< one layer through a wall: a plane-stress solid-shell
  block,  ///< where walls meet, solid parts, and walls too thick for the above: one point with assumed strains
};

/// What the elements are made of. All moduli but that of the law itself are shares of mu, the law's shear modulus at rest.
///
/// Those of transverse shear and of the hourglass patterns stay what they are at rest, whatever the law: energy is then kept
/// exactly, they are positive wherever a law goes, and the stable step changes with the membrane alone. What they stand for, how
/// a wall shears across itself and how strain varies inside an element, is small beside the membrane's stretch and bending, which
/// follow the law; at stretches of 1.5 laws of silicones stiffen by a few to twenty per cent.
///
/// The defaults of the two ratios are not those of menger's programs, which take ThinWallConstants.
///
/// @cite belytschko1993assumed @cite macneal1978simple @cite schwarze2009reduced @cite schwarze2011reduced
struct ThinWallMaterial {
  materials::HyperelasticLaw law;
  double bulk_modulus_Pa = 0.0;           ///< kappa > 0 of the silicone, which the membrane of walls has in full
  double wall_penalty_ratio = 4.0;        ///< kappa' / mu > 0: keeps the volume of walls, by their thickness; softer than kappa
  double block_stiffness_ratio = 5.0;     ///< lambda / mu > 0 of blocks
  double viscosity_Pa_s = 0.0;            ///< eta >= 0 of a Kelvin-Voigt solid; 0: none
  std::vector<MaxwellBranch> branches{};  ///< at most most_branches, all with a modulus
};

/// Numbers of the shape of one element; see shape_of.
inline constexpr std::size_t shape_numbers_per_lane = 6;

/// Numbers of the forces of one element: four for each corner, of which the last is zero.
inline constexpr std::size_t slot_numbers_per_lane = 32;

/// Numbers of one set of Maxwell branches of one element.
///
/// Of a wall: the tensor A at two points across it (11, 22, 12, 33), the two transverse shears and nine hourglass strains at
/// which the branch is at rest. Of a block: A (11, 22, 33, 23, 13, 12) and twelve hourglass strains.
constexpr std::size_t thin_wall_branch_numbers(ThinWallElement element) { return element == ThinWallElement::wall ? 19 : 18; }

/// The shape of an element as kernels take it: 1/(4 l_i), the volume, and for walls the square roots of the shares of k mu that
/// bending inside an element leaves to transverse shear, 1 / (1 + k l_i^2 / (4 t^2)) with k = 5/6 @cite macneal1978simple.
/// @param edges_m along the local axes, l1, l2, l3; the third is a wall's thickness
std::array<double, shape_numbers_per_lane> shape_of(const std::array<double, 3>& edges_m);

/// Which corner of a box along the global axes is the local corner c, of both numbered with the first axis fastest. The third
/// local axis is the normal of a wall, the others follow in a circle. @param normal 0, 1, 2 for x, y, z
constexpr std::size_t global_corner(std::size_t normal, std::size_t c) {
  const std::size_t first = (normal + 1) % 3;
  const std::size_t second = (normal + 2) % 3;
  return (c & 1U) << first | (c >> 1U & 1U) << second | (c >> 2U & 1U) << normal;
}

/// Batches of elements of one kind and material. Lanes without an element repeat another one with a volume of zero, so that they
/// add nothing to sums. Arrays of lanes are interleaved, entry n of lane l of a batch of N numbers at (b N + n) width + l, and
/// aligned to 64 bytes.
template <class Number>
struct ThinWallBatches {
  ThinWallElement element = ThinWallElement::wall;
  std::size_t count = 0;
  /// Per lane eight corners, in local order: the index of the first component of a node; corner c of lane l of batch b at
  /// 8 (b width + l) + c. One number more than a node's three may be read.
  const std::uint32_t* first_components = nullptr;
  const Number* shapes = nullptr;         ///< shape_numbers_per_lane
  const std::uint8_t* normals = nullptr;  ///< per batch: the global axis of its third local one
  /// Per batch: the mean of the pressures on both faces of its walls, Pa, positive towards them; nullptr: none. Not read for
  /// blocks.
  const double* mean_pressures_Pa = nullptr;
  /// Per batch, written with the forces: the change of the volume of its walls, V (J - 1) of their centres, m^3. Minus this times
  /// the pressure is the pressure's energy. 0 for blocks. nullptr: not wanted.
  double* volume_changes_m3 = nullptr;
  /// Per batch: on how many faces of its walls a pressure acts as a force: 0, 1 or 2, the faces across the wall. 0 for blocks.
  /// nullptr: on none.
  const std::uint8_t* pressed_faces = nullptr;
  const Number* sides = nullptr;              ///< per lane 1 or -1, aligned: the first of them lies at this end of the third axis
  const double* face_pressures_Pa = nullptr;  ///< per batch two, positive towards the wall
  /// Per batch two, written with the forces: the change of volume behind the faces, m^3, which is right in sum over a closed
  /// surface. nullptr: not wanted.
  double* face_volumes_m3 = nullptr;
};

/// Where a body is; component i of a node at its first component plus i.
template <class Number>
struct ThinWallMotion {
  const Number* displacements_m = nullptr;
  const Number* velocities_m_per_s = nullptr;  ///< read where there is a viscosity; nullptr: no viscous force
};

/// Branches of batches, thin_wall_branch_numbers in each set; see branch_set_count, and BranchTensors of explicit dynamics.
template <class Number>
struct ThinWallBranches {
  Number* values = nullptr;    ///< of the first set; nullptr: no branch acts
  double relaxed_s = 0.0;      ///< >= 0, the time by which they relax before they act; forces are those of the mean
  std::size_t sets_apart = 0;  ///< how far the same number of the next set is; not read for one branch
};

/// What elements say besides their forces.
struct ThinWallOutcome {
  /// Below it an element counts as inverted: nothing in its energy keeps it from going through itself, and its membrane's energy
  /// has no lower bound much further down.
  static constexpr double smallest_allowed_ratio = 0.3;

  /// Of the volume at the centre and of the area at both points of a wall, over all elements; -1 where the law has no value.
  double smallest_ratio = 1.0;
  double dissipated_W = 0.0;  ///< by the viscosity, >= 0
  double relaxed_J = 0.0;     ///< what the branches' energy fell by while they relaxed, >= 0 up to rounding

  [[nodiscard]] bool is_inverted() const { return !(smallest_ratio >= smallest_allowed_ratio); }
};

namespace detail {
template <class Number>
struct ThinWallTable;
}

/// Energies and internal forces of the elements of thin walls, of one instruction set and number type. Results of two instruction
/// sets differ by rounding. The result of a lane does not depend on the other lanes.
///
/// The energy of a wall of volume V = l1 l2 t with the columns f_i = e_i + c_i D_i of F at its centre, c_i = 1 / (4 l_i), and the
/// changes q1 = c1 H2 and q2 = c2 H1 of f1 and f2 across it, D and H being the signed sums of displacements over the corners:
///
/// W/V = 1/2 sum over zeta = -+1/sqrt(3) of w(f1 + zeta q1, f2 + zeta q2) + k mu/2 p.C^-1.p + kappa'/2 (J - 1)^2
///       - (p_a + p_b)/2 (J - 1) + 1/2 [mu (e11^2 + e22^2) + (G1 s13^2 + G2 s23^2)/3 + 4 mu/3 (t1^2 + t2^2)
///       + mu/3 (k1^2 + k2^2) + 4 mu/9 k3^2]
///
/// - w: the law's energy in plane stress.
/// - p_i = sqrt(G_i / (k mu)) f_i.f3 is the transverse shear, C the metric in the plane, 1/G_i = 1/(k mu) + l_i^2 / (4 mu t^2).
///   The second part of this is the bending inside an element that its corners cannot show @cite macneal1978simple.
/// - The pressures on both faces, p_a and p_b, press the wall together. The term moves the rest of the penalty to where the law
///   alone would have it, so that the wall keeps its volume.
/// - Hourglass strains: e11 = c1 f1.H3, e22 = c2 f2.H3, s13 = c3 f1.H1 + c1 f3.H3, s23 = c3 f2.H2 + c2 f3.H3, t_i = c3 f3.H_i,
///   k_i = c_i f_i.H4.
///
/// A block has its law at the centre, with excesses of the invariants for a body that can change its volume, lambda/2 (J - 1)^2,
/// and assumed strains @cite belytschko1993assumed: for (i, j, k) in a circle, x = c_i f_i.H_j, y = c_j f_j.H_i and g = c_j
/// f_i.H_i + c_i f_j.H_j give E / (6 (1 - nu^2)) (x^2 + y^2 + 2 nu x y) + mu g^2 / 6, and the last pattern E/18 sum (c_i
/// f_i.H4)^2, with E = 2 mu (1 + nu) and nu = 0.49.
///
/// With branches of modulus m, shares m / mu of everything but the penalties respond to the difference to their rest (see
/// MaxwellBranch); the membrane's part is incompressible. With a viscosity eta, eta / mu of them respond to the rate; the
/// membrane and the block's centre have the Kirchhoff stress 2 eta dev(d).
template <class Number>
class ThinWallKernels {
 public:
  explicit ThinWallKernels(const detail::ThinWallTable<Number>& table);

  std::string_view instruction_set;  ///< "scalar", "baseline", "avx2", "avx512"
  std::size_t width;                 ///< lanes: elements computed at once

  /// Returns the slot of a corner among those of all batches. @param lane counted over all batches
  [[nodiscard]] std::size_t slot(std::size_t lane, std::size_t corner) const {
    return (lane / width * 8 + corner) * width + lane_places_[lane % width];
  }

  /// Computes the forces on the corners of each lane: d(energy)/du plus the viscous force, minus those of the pressures on faces.
  /// @param branches changed where they relax
  /// @param slots_N slot_numbers_per_lane for each lane of all batches, aligned to 64 bytes: component i of slot s, see slot(),
  /// at 4 s + i, and a zero after the three components
  [[nodiscard]] ThinWallOutcome forces(const ThinWallMaterial& material, const ThinWallBatches<Number>& batches,
                                       const ThinWallMotion<Number>& motion, const ThinWallBranches<Number>& branches,
                                       Number* slots_N) const;

  /// Energy of each lane, J, with that of its branches and of the pressures' term, and its smallest ratio.
  /// @param branches do not relax
  void energies(const ThinWallMaterial& material, const ThinWallBatches<Number>& batches, const ThinWallMotion<Number>& motion,
                const ThinWallBranches<const Number>& branches, Number* energies_J, Number* smallest_ratios) const;

  /// One set of branches that are at rest at the displacements: each of them and their mean.
  void rest_branches(const ThinWallBatches<Number>& batches, const ThinWallMotion<Number>& motion, Number* branch) const;

 private:
  LanePlaces lane_places_;
  const detail::ThinWallTable<Number>* table_;
};

extern template class ThinWallKernels<double>;
extern template class ThinWallKernels<float>;

/// The kernels of the widest instruction set that this machine has.
template <class Number>
ThinWallKernels<Number> best_thin_wall_kernels();

/// All kernels that this machine can run, the portable ones first.
template <class Number>
std::vector<ThinWallKernels<Number>> available_thin_wall_kernels();

}  // namespace menger::fem
