#pragma once

#include <array>

#include "fem/thin_walls/element_choice.h"
#include "fem/walk/walk_silicone.h"
#include "io/study/study_visitor.h"
#include "meshes/design/hollow_body_options.h"

namespace menger::evolution {

/// How bodies of silicone are hollow, and the pressure in them.
struct HollowModule {
  double wall_thickness_m = 0.002;
  meshes::ChamberLayout chambers = meshes::ChamberLayout::single;
  std::array<double, 2> pressure_Pa{};  ///< lowest and highest, gauge

  bool operator==(const HollowModule&) const = default;
};

/// What finite elements need to know of the bodies of a search beyond what voxels need.
struct SiliconePhysics {
  HollowModule module;  ///< of a study without calibrated parameters; see module_of
  /// Draft by default, because a search evaluates many bodies; its best are evaluated again on finer elements.
  fem::ElementChoice elements{.fidelity = fem::Fidelity::draft};
  int elements_through_wall = 1;  ///< of three_field; thin walls have one
  double step_safety = 0.8;       ///< time step / stable time step
  fem::WalkSilicone silicone{};   ///< with everything that its record states

  bool operator==(const SiliconePhysics& other) const;
};

/// Describes the keys with which elements are chosen in the table [elements] of searches and re-evaluations.
void describe_elements(io::StudyVisitor& visitor, fem::ElementChoice& elements, int& elements_through_wall);

/// Describes the key of the time step in the same table.
void describe_step_safety(io::StudyVisitor& visitor, double& step_safety);

/// Describes the keys of walls and chambers, in the table of the body.
void describe_module(io::StudyVisitor& visitor, HollowModule& module);

/// Sets density and damping to those of the record where the study that was read does not state them, so that the text of a study
/// needs no record. @throws fem::WalkInputError for a law without a record and without a density
void state_what_the_record_has(fem::WalkSilicone& silicone);

}  // namespace menger::evolution
