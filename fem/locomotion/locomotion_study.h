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
#include "meshes/design/design_file.h"
#include "meshes/design/hollow_body_options.h"
#include "meshes/hexahedra/hexahedral_mesh.h"

namespace menger::fem {

/// What is written beside trajectory and result.
struct LocomotionOutput {
  bool frames = true;
  bool pictures = true;
  std::size_t records_per_frame = 10;  ///< >= 1
};

/// Numbers of a study that take several values, one run for each.
struct LocomotionSweep {
  std::vector<std::string> keys;  ///< "ground.static_friction", ...: numbers that the study states
  std::vector<double> values;     ///< per case, of all keys alike
};

/// How implicit dynamics moves the body of a study; see ImplicitOptions.
struct LocomotionImplicit {
  int degree = 1;                ///< of the elements: 1 (Q1/P0) or 2 (Q2/P1)
  double tolerance = 2e-5;       ///< > 0
  double stick_stiffness = 1.0;  ///< > 0
};

/// Everything that decides what `menger locomote` computes. Physics takes parts of it and never sees the file.
struct LocomotionStudy {
  std::filesystem::path file;  ///< that it came from, for messages
  std::string text;            ///< of that file

  meshes::Design design;
  meshes::HollowBodyOptions hollow;
  StudySilicone silicone;
  StudyGround stated_ground;
  double gravity_m_per_s2 = 9.81;                ///< downwards, >= 0
  double mass_damping_per_s = 0.0;               ///< >= 0
  std::optional<SurrogateDrive> drive{};         ///< of all plena
  StudySupply stated_supply;                     ///< in place of that
  double duration_s = 5.0;                       ///< > 0
  double record_interval_s = 0.01;               ///< > 0, at most the duration
  std::optional<LocomotionImplicit> implicit{};  ///< nothing: explicit dynamics
  double step_safety = 0.9;                      ///< in (0, 1]; of explicit dynamics, as self_contact and threads are
  std::optional<double> largest_step_s{};        ///< > 0
  /// Nothing: walls that touch end the run.
  std::optional<SelfContactLaw> self_contact = SelfContactLaw{};
  int threads = 1;  ///< >= 1; results do not depend on it
  LocomotionOutput output;
  std::optional<LocomotionSweep> sweep{};

  // What follows from all that, once it was read.
  meshes::HexahedralMesh mesh;  ///< of the design, hollow
  LocomotionMaterial material;
  RigidGround ground;
  std::optional<PneumaticSupply> supply{};    ///< of all plena
  std::map<std::string, std::string> inputs;  ///< content hash of every file that was read, the study's included
  std::vector<std::string> notes;             ///< what was assumed or is doubtful, for people
};

/// Most cells along an axis of the design to the power of its level, times the cell edge; 3^level cell edges for designs of 3
/// cells.
double body_length_m(const meshes::Design& design, int level);

/// All that decides the records and frames of a run: a study with defaults filled in and files put in place. Equal texts give
/// equal files.
std::string locomotion_text(const LocomotionStudy& study);

/// What a body of the study is made of, and what moves it.
ExplicitBodyOptions body_options(const LocomotionStudy& study);
ExplicitOptions dynamics_options(const LocomotionStudy& study);

/// Times of the records after the start, the last one at the duration.
std::vector<double> record_times_s(const LocomotionStudy& study);

}  // namespace menger::fem
