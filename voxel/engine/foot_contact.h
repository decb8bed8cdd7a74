#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "voxel/engine/foot_press.h"
#include "voxel/engine/pressure_drive.h"
#include "voxel/engine/voxel_classes.h"
#include "voxel/kernels/step_data.h"
#include "voxel/model/hollow_voxels.h"
#include "voxel/model/wall_feet.h"

namespace menger::voxel {

/// Contact of a calibrated body with the ground, at the feet of its walls (WallFoot): corners, middles and crowns.
///
/// A foot lies at r = R d from the centre of its voxel, with R the orientation of the voxel. d consists of the half lengths of
/// the voxel and of how far the wall stands out at the foot. The corners are the rim that a wall stands on while it does not
/// bulge. They also keep a body from rolling over a wall that does. A wide wall bulges as one dome, and the crowns are the top of
/// that dome.
///
/// Let k and c be the foot's share, a fifth for a corner and a middle, of the ground's stiffness k_g and of its damping
/// 2 zeta_c sqrt(m k_g / 2). Let v be the velocity of the foot. A foot at the depth p in the ground is pushed up by
/// N = max(0, k p - c v_z).
///
/// Friction also acts at the foot, not at the centre of the voxel. Therefore a body can tip over its feet and step. A foot sticks
/// with the force -k (x - a) - c v, where x is its horizontal position and a its position when it touched. When that force
/// exceeds mu_s N, the foot slides: the force becomes mu_k N in the same direction, and a moves along. The foot sticks again when
/// the force needed is no more than mu_k N. So friction never exceeds mu_s N. Bulges change v only through their effect on the
/// voxel.
///
/// All is computed in double for both number types, and is the same for every instruction set.
template <class Real>
class FootContact {
 public:
  /// @param height_m of the ground in the world
  FootContact(const Lattice& lattice, const HollowVoxels& voxels, const BodyClasses& classes, double height_m);

  using Load = FootLoad;

  /// Adds the loads of all feet to the load lines, for the present positions and velocities.
  /// @param origin_m of the positions
  void add_loads(const StepData<Real>& d, const std::array<double, 3>& origin_m, const PressureDrive<Real>& drive);

  /// Results of the last add_loads for a voxel: the load from the pressure of the ground, the load from friction, whether a foot
  /// touches the ground, and whether all feet that touch it stick.
  [[nodiscard]] const Load& pressing(std::size_t voxel) const { return states_[voxel].pressing; }
  [[nodiscard]] const Load& friction(std::size_t voxel) const { return states_[voxel].friction; }
  [[nodiscard]] bool touches(std::size_t voxel) const { return states_[voxel].touches; }
  [[nodiscard]] bool sticks(std::size_t voxel) const { return states_[voxel].sticks; }

  struct Foot {
    WallFoot of_wall;
    FootGrip grip;
  };
  /// Return what code that computes the contact by itself needs: the height of the ground (m) and the feet of a voxel.
  [[nodiscard]] double height_m() const { return height_m_; }
  [[nodiscard]] const std::vector<Foot>& feet(std::size_t voxel) const { return feet_[voxel]; }

  /// Takes over the contact of a voxel from such code, but for its loads.
  /// @param grips of its feet, in their order
  void take_over(std::size_t voxel, std::span<const FootGrip> grips, bool touches, bool sticks);

 private:
  double height_m_;
  std::vector<VoxelCoefficients<double>> coefficients_;  ///< per class
  std::vector<std::size_t> class_of_;                    ///< per voxel
  std::vector<std::vector<Foot>> feet_;                  ///< per voxel
  std::vector<FeetState> states_;
};

}  // namespace menger::voxel
