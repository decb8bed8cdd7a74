#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "voxel/engine/pressure_drive.h"
#include "voxel/engine/voxel_classes.h"
#include "voxel/kernels/step_data.h"
#include "voxel/model/hollow_voxels.h"
#include "voxel/model/wall_feet.h"

namespace menger::voxel {

/// Contact of a calibrated body with the ground, at the feet of its walls (WallFoot): corners, middles and crowns.
///
/// They lie r = R d from the centre of their voxel, with R its orientation and d made of its half lengths and of how far the wall
/// stands out there. The corners are the rim that a wall stands on while it does not bulge, and what keeps a body from rolling
/// over one that does; a wide wall bulges as one dome, whose top the crowns are. A foot that is p deep in the ground is pushed up
/// by N = max(0, k p - c v_z) with its share, a fifth for a corner and a middle, of the ground's stiffness k and of c = 2 zeta_c
/// sqrt(m k / 2), and v the velocity of the foot. Friction acts there, too, not at the centre of the voxel: that is what makes a
/// body tip over its feet and lets it step. A foot holds on by -k (x - a) - c v with x its horizontal place and a where that was
/// when it touched, until that takes more than mu_s N; then it slides with mu_k N in the direction in which it held, and drags a
/// along, until it needs no more than that. So friction never exceeds mu_s N. Bulges enter v only as what they do to the voxel.
///
/// In double for both number types, and the same for every instruction set.
template <class Real>
class FootContact {
 public:
  /// @param height_m of the ground in the world
  FootContact(const Lattice& lattice, const HollowVoxels& voxels, const BodyClasses& classes, double height_m);

  /// Force (N) and moment (N m) on a voxel.
  struct Load {
    Vector3<double> force{0.0, 0.0, 0.0};
    Vector3<double> moment{0.0, 0.0, 0.0};
  };

  /// Adds the loads of all feet to the load lines, for positions and velocities as they are. @param origin_m of the positions
  void add_loads(const StepData<Real>& d, const std::array<double, 3>& origin_m, const PressureDrive<Real>& drive);

  /// Of the last add_loads: of the ground's pressure, of friction, and how a voxel stands.
  [[nodiscard]] const Load& pressing(std::size_t voxel) const { return states_[voxel].pressing; }
  [[nodiscard]] const Load& friction(std::size_t voxel) const { return states_[voxel].friction; }
  [[nodiscard]] bool touches(std::size_t voxel) const { return states_[voxel].touches; }
  [[nodiscard]] bool sticks(std::size_t voxel) const { return states_[voxel].sticks; }

 private:
  struct Foot {
    WallFoot of_wall;
    bool touches = false;
    bool slides = false;
    std::array<double, 2> anchor{};  ///< m, in the world

    void lift() { touches = slides = false; }
  };
  struct State {
    Load pressing, friction;
    bool touches = false;
    bool sticks = false;  ///< all feet that touch
  };
  /// A voxel as its feet see it.
  struct Body {
    Vector3<double> place, velocity, spin;
    Rotation<double> turn;
  };

  void press(Foot& foot, State& state, const Body& body, const FloorCoefficients<double>& floor,
             const Vector3<double>& arm) const;

  double height_m_;
  std::vector<VoxelCoefficients<double>> coefficients_;  ///< per class
  std::vector<std::size_t> class_of_;                    ///< per voxel
  std::vector<std::vector<Foot>> feet_;                  ///< per voxel
  std::vector<State> states_;
};

}  // namespace menger::voxel
