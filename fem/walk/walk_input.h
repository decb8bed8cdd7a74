#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fem/contact/rigid_ground_file.h"
#include "fem/explicit/explicit_dynamics.h"
#include "fem/pneumatics/pneumatic_supply.h"
#include "fem/thin_walls/element_choice.h"
#include "fem/walk/walk_drive.h"
#include "fem/walk/walk_silicone.h"
#include "io/device/graphics_processor.h"
#include "meshes/design/design_file.h"
#include "meshes/design/hollow_body_options.h"
#include "meshes/hexahedra/hexahedral_mesh.h"

namespace menger::fem {

/// A walk as its caller states it: which body, of what, on which ground, driven how, and for how long.
struct WalkInput {
  meshes::Design design;
  /// How it is made hollow. The elements are those that `elements` asks for once the walk is prepared.
  meshes::HollowBodyOptions hollow;
  ElementChoice elements;
  WalkSilicone silicone;
  StudyGround stated_ground;
  double gravity_m_per_s2 = 9.81;           ///< downwards, >= 0
  double mass_damping_per_s = 0.0;          ///< >= 0
  std::optional<SurrogateDrive> drive{};    ///< of all plena
  std::optional<PneumaticSupply> supply{};  ///< of all plena, instead of the drive; neither: no pressure
  double duration_s = 5.0;                  ///< > 0
  double record_interval_s = 0.01;          ///< > 0, at most the duration
  double step_safety = 0.8;                 ///< in (0, 1]; for explicit dynamics only, like self_contact and threads
  std::optional<double> largest_step_s{};   ///< > 0
  /// Empty: walls that touch end the run.
  std::optional<SelfContactLaw> self_contact = SelfContactLaw{};
  int threads = 1;                      ///< >= 1; results do not depend on it
  io::Device device = io::Device::cpu;  ///< where the steps of explicit dynamics are taken; results differ by rounding
};

/// A walk with what follows from its input: mesh, material, ground and supply.
struct PreparedWalk : WalkInput {
  meshes::HexahedralMesh mesh{};  ///< of the design, hollow
  WalkMaterial material{};
  RigidGround ground{};
  std::vector<std::string> notes{};  ///< assumptions and doubts, for users
};

/// Computes what follows from the input of a walk, and fills in there what it does not state. A supply that needs the plena of
/// the mesh can be added afterwards.
/// @param usual damping model if the silicone names none
/// @throws WalkInputError for a body that cannot be hollowed out or meshed, a ground above its lowest point, and a plenum whose
/// cells differ in phase
void prepare(PreparedWalk& walk, DampingModel usual = DampingModel::maxwell);

/// Checks the numbers of an input that no file reader has checked.
/// @throws WalkInputError for the first one that is outside of its range
void check(const WalkInput& input);

/// Returns the modulus by which the default stiffness of the ground is chosen, Pa.
double contact_modulus_Pa(const PreparedWalk& walk);

/// Returns the materials and elements of the body of a walk.
ExplicitBodyOptions body_options(const PreparedWalk& walk);
/// Returns the settings of explicit dynamics for a walk.
ExplicitOptions dynamics_options(const PreparedWalk& walk);

/// Returns the times of the records after the start; the last one is the duration.
std::vector<double> record_times_s(const WalkInput& walk);

}  // namespace menger::fem
