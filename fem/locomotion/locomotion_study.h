#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "fem/contact/rigid_ground_file.h"
#include "fem/explicit/explicit_dynamics.h"
#include "fem/locomotion/locomotion_drive.h"
#include "fem/locomotion/locomotion_material.h"
#include "fem/pneumatics/pneumatic_supply_file.h"
#include "fem/thin_walls/element_choice.h"
#include "meshes/design/design_file.h"
#include "meshes/design/hollow_body_options.h"
#include "meshes/hexahedra/hexahedral_mesh.h"

namespace menger::fem {

/// The files that are written besides trajectory and result.
struct LocomotionOutput {
  bool frames = true;
  bool pictures = true;
  std::size_t records_per_frame = 10;  ///< >= 1
};

/// The sweep of a study: some of its numbers take several values, with one run for each.
struct LocomotionSweep {
  std::vector<std::string> keys;  ///< numbers that the study states: "ground.static_friction", ...
  std::vector<double> values;     ///< one per case, the same for all keys
};

/// Settings of implicit dynamics in a study; see ImplicitOptions.
struct LocomotionImplicit {
  int degree = 1;                ///< of the elements: 1 (Q1/P0) or 2 (Q2/P1)
  double tolerance = 2e-5;       ///< > 0
  double stick_stiffness = 1.0;  ///< > 0
};

/// A study of `menger locomote`: everything that its results depend on. The physics takes parts of it and does not read the file.
struct LocomotionStudy {
  std::filesystem::path file;  ///< from which it was read, for messages
  std::string text;            ///< of that file

  meshes::Design design;
  /// How it is made hollow. The elements are those that `elements` asks for once the study has been read.
  meshes::HollowBodyOptions hollow;
  ElementChoice elements;
  StudySilicone silicone;
  StudyGround stated_ground;
  double gravity_m_per_s2 = 9.81;                ///< downwards, >= 0
  double mass_damping_per_s = 0.0;               ///< >= 0
  std::optional<SurrogateDrive> drive{};         ///< drive of all plena
  StudySupply stated_supply;                     ///< instead of the drive
  double duration_s = 5.0;                       ///< > 0
  double record_interval_s = 0.01;               ///< > 0, at most the duration
  std::optional<LocomotionImplicit> implicit{};  ///< empty: explicit dynamics
  double step_safety = 0.8;                      ///< in (0, 1]; for explicit dynamics only, like self_contact and threads
  std::optional<double> largest_step_s{};        ///< > 0
  /// Empty: walls that touch end the run.
  std::optional<SelfContactLaw> self_contact = SelfContactLaw{};
  int threads = 1;  ///< >= 1; results do not depend on it
  LocomotionOutput output;
  std::optional<LocomotionSweep> sweep{};

  // Members that are derived from the above once it has been read.
  meshes::HexahedralMesh mesh;  ///< of the design, hollow
  LocomotionMaterial material;
  RigidGround ground;
  std::optional<PneumaticSupply> supply{};    ///< of all plena
  std::map<std::string, std::string> inputs;  ///< content hash of every file that was read, with the study's own
  std::vector<std::string> notes;             ///< assumptions and doubts, for users
};

/// Returns the body length: the largest number of cells along an axis of the design, to the power of its level, times the cell
/// edge. That is 3^level cell edges for designs of 3 cells.
double body_length_m(const meshes::Design& design, int level);

/// Returns everything that the records and frames of a run depend on: the study with defaults filled in and the content of its
/// files inserted. Equal texts give equal files.
std::string locomotion_text(const LocomotionStudy& study);

/// Returns the modulus by which the default stiffness of the ground is chosen, Pa.
double contact_modulus_Pa(const LocomotionStudy& study);

/// Returns the materials and elements of a body of the study.
ExplicitBodyOptions body_options(const LocomotionStudy& study);
/// Returns the settings of explicit dynamics for a study.
ExplicitOptions dynamics_options(const LocomotionStudy& study);

/// Returns the times of the records after the start; the last one is the duration.
std::vector<double> record_times_s(const LocomotionStudy& study);

}  // namespace menger::fem
