#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "evolution/evaluation/steady_displacement.h"
#include "evolution/genome/robot_form.h"
#include "evolution/search/search_plan.h"
#include "evolution/study/silicone_physics.h"
#include "io/device/graphics_processor.h"
#include "voxel/model/parameters.h"

namespace menger::evolution {

/// The model that moves the bodies of a search.
enum class EvaluationModel {
  voxels,
  finite_elements,
  both  ///< voxels with calibrated parameters screen new bodies, and finite elements decide who survives
};
std::string_view to_string(EvaluationModel model);  ///< "voxels", "finite_elements" or "both"

/// What an evaluation measures of a motion.
enum class Measure {
  net_displacement,  ///< from the time at which displacement counts to the end
  last_periods       ///< in one of the last periods of the drive, see steady_displacement_m
};
std::string_view to_string(Measure measure);  ///< "net_displacement" or "last_periods"

/// The scenarios in which a robust robot must walk: all pairs of these values, which are not measured for silicones; as voxels
/// its frictions alone. A robot's score is that of its worst ones.
struct RobustOptions {
  /// Of robots on the ground and on themselves, static and kinetic alike: published friction of silicones lies between 0.25 and
  /// 1 (doi 10.1007/s11012-023-01719-5), and 1.2 is a fifth above the largest.
  std::vector<double> frictions{0.4, 0.8, 1.2};

  /// Of the silicone, at the loss frequency of its damping: the least and the greatest published for Ecoflex 00-30 between 1 and
  /// 30 Hz (arXiv 2310.11396), which drives and first vibrations of modules lie in. Other silicones are not measured; the loss
  /// factor that is assumed for them, 0.1, lies between.
  std::vector<double> loss_factors{0.059, 0.146};

  double quantile = 0.0;  ///< share of the scenarios, the worst ones, that do not count, in [0, 1)

  bool operator==(const RobustOptions&) const = default;
};

/// What a search may cost, counted in steps: so its end does not depend on the machine. It decides when a search ends, not its
/// course, as the number of generations does.
struct Budget {
  /// No generation begins once the search has cost as much, in steps times finite elements. > 0
  double element_steps = 1e10;

  /// What a step of a finite element costs in steps of a voxel, > 0: measured once for all machines on which a search may go on.
  double voxel_steps_per_element_step = 0.5;

  bool operator==(const Budget&) const = default;
};

/// Everything that decides the result of a search.
struct Study {
  SearchPlan search;
  double duration_s = 5.0;      ///< simulated time of an evaluation, > 0
  double measure_from_s = 0.0;  ///< time from which displacement counts, >= 0 and < duration_s
  EvaluationModel model = EvaluationModel::voxels;
  io::Device device = io::Device::cpu;
  Measure measure = Measure::net_displacement;
  std::size_t measure_periods = 5;  ///< how many periods count if the last ones are measured
  /// If the last periods are measured: a body that leans more than this, in degrees, has fallen and has no
  /// fitness; see fem::largest_lean. 180: none has.
  double largest_lean_deg = 45.0;

  /// How many of the best robots of a search on finite elements walk on finer elements at its end; none where there are no
  /// finer ones (finer_fidelities). It decides nothing in the search.
  std::size_t confirm = 3;

  /// Loads, ground, drive and voxels. Finite elements take no values of voxels from it; see VoxelEvaluator, WalkEvaluator.
  voxel::Physics physics;
  SiliconePhysics silicone;  ///< of finite elements

  /// Counted cost that ends the search before its generations do. None: nothing does.
  std::optional<Budget> budget{};

  /// Scenarios, in place of the one ground and silicone. search.scenarios and search.quantile follow from it.
  std::optional<RobustOptions> robust{};

  bool operator==(const Study&) const = default;
};

/// Returns what makes two robots of a study different. The materials do not matter if the drive is the same for all cells. The
/// place of a body matters only if the drive is a wave.
Distinction distinction_of(const Study& study);

/// Returns whether finite elements decide the fitness in a study.
bool uses_elements(const Study& study);

/// Returns the fidelities of elements that are finer than those of a search on finite elements; only thin walls have such.
std::vector<fem::Fidelity> finer_fidelities(const Study& study);

/// Returns how the bodies of a study of silicone are hollow: as the calibrated parameters say, or without any as the study does.
HollowModule module_of(const Study& study);

/// Returns whether the bodies of a study are of silicone, driven by the pressure in them.
bool is_of_silicone(const Study& study);

/// Returns the periods that the evaluator measures; nothing if it measures the net displacement.
std::optional<LastPeriods> measured_periods(const Study& study);

/// Returns the body lengths that a fitness makes over a whole evaluation; nothing if the objective is not in body lengths.
std::optional<double> walked_body_lengths(const Study& study, double fitness);

/// Returns whether a body of a study that has fallen has no fitness.
bool tells_falls(const Study& study);

/// Returns the number of voxels of a whole cell.
std::size_t voxels_in_cell(const Study& study);

/// Returns what a reader of the results should know about the values of the study, a sentence each.
std::vector<std::string> study_notes(const Study& study);

/// Returns what is outside the range of validity of calibrated parameters for every body that the search of a study may make, a
/// sentence each; nothing for a study without calibrated parameters.
///
/// This concerns a drive at which no wall was fitted (with joints, if bodies have several modules), the chambers, and the length
/// of the shortest bodies that the search allows. If there is no such sentence, a body may still be outside the range: its own
/// walls are checked body by body (voxel::outside_validity).
std::vector<std::string> outside_validity_of_all(const Study& study);

/// Returns the same for a body with every kind of wall and of the greatest length. Some bodies of the search may be outside the
/// range in this way, not all.
std::vector<std::string> outside_validity_of_some(const Study& study);

/// Returns the memory in bytes that evaluations in this many threads may take as voxels if every body is full. What finite
/// elements take is not estimated. Saturates at SIZE_MAX.
std::size_t estimated_memory_bytes(const Study& study, int threads);

}  // namespace menger::evolution
