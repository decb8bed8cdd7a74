#include "evolution/study/study.h"

#include <algorithm>
#include <limits>

#include "io/text/number_text.h"
#include "meshes/design/reference_shapes.h"
#include "voxel/model/covered_pressures.h"
#include "voxel/scene/scene.h"

namespace menger::evolution {

namespace {

constexpr int longest_side = 3;  ///< cells along the longest side that a basal body may have

/// Returns the length in cells of the shortest bodies: the edge of the smallest cube that the least number of cells fits into.
int shortest_side(const Study& study) {
  const std::size_t fewest = study.search.offspring.constraints.smallest_body;
  std::size_t side = 1;
  while (side * side * side < fewest) ++side;
  return static_cast<int>(side);
}

/// Returns what all calibrated bodies of the search have in common, at their highest level.
voxel::CalibratedBody largest_bodies(const Study& study) {
  voxel::CalibratedBody body = *study.physics.surrogate;
  body.level = study.search.levels().back();
  return body;
}

/// Checks that at least one kind of wall was fitted at both ends of the drive. Returns nothing if so, otherwise a sentence.
std::vector<std::string> drive_beyond_every_wall(const voxel::CalibratedBody& body) {
  const auto [low_Pa, high_Pa] = body.pressure_Pa;
  double lowest_Pa = 0.0;
  double highest_Pa = 0.0;
  for (std::size_t gap = 0; gap < voxel::gap_count; ++gap) {
    for (std::size_t c = 0; c < voxel::wall_class_count; ++c) {
      voxel::BodyWalls wall;
      wall.facing[gap][c] = true;
      wall.has_joints = body.level > 1;
      const voxel::CoveredPressures covered = voxel::covered_pressures(body.parameters.validity, wall);
      if (covered.contains(low_Pa) && covered.contains(high_Pa)) return {};
      lowest_Pa = std::min(lowest_Pa, covered.lowest_Pa);
      highest_Pa = std::max(highest_Pa, covered.highest_Pa);
    }
  }
  return {
      "pressure_Pa = [" + io::number_text(low_Pa) + ", " + io::number_text(high_Pa) +
      "] is outside the range of the fit for every body: no kind of wall was fitted at both pressures; the fits together cover " +
      io::number_text(lowest_Pa) + " to " + io::number_text(highest_Pa) + " Pa" + (body.level > 1 ? " (walls with joints)" : "")};
}

void add_notes_of_silicone(const Study& study, std::vector<std::string>& notes) {
  const fem::WalkSilicone& silicone = study.silicone.silicone;
  const std::string name = silicone.law.record ? silicone.law.record->name : "this silicone";
  if (!silicone.law.record || !silicone.law.record->loss) {
    notes.push_back("the damping of " + name + " is not measured; its loss factor is taken as " +
                    io::number_text(fem::stated_loss_factor(silicone)) + " at " + io::number_text(silicone.loss_frequency_Hz) +
                    " Hz");
  }
  if (silicone.is_ratio_assumed)
    notes.push_back("material.bulk_modulus_ratio = " + io::number_text(silicone.bulk_modulus_ratio) + " is assumed");
  std::string friction = "friction of " + name + " on a ground is not measured";
  if (silicone.law.record && silicone.law.record->friction) {
    const materials::PublishedFriction& published = *silicone.law.record->friction;
    friction += ", that of silicones lies between " + io::number_text(published.lowest) + " and " +
                io::number_text(published.highest) + " (" + published.source + ")";
  }
  if (study.robust) {
    notes.push_back(friction);
  } else {
    const voxel::VoxelMaterial& ground = study.physics.materials[0];
    notes.push_back(friction + "; static_friction = " + io::number_text(ground.static_friction) +
                    " and kinetic_friction = " + io::number_text(ground.kinetic_friction) + " are assumptions");
  }
  if (!study.search.offspring.constraints.castable)
    notes.emplace_back("bodies that cannot be cast get no result; with body.castable = true there are none");
}

void add_notes_of_scenarios(const Study& study, std::vector<std::string>& notes) {
  if (!study.robust) return;
  notes.push_back("a robot walks in up to " + std::to_string(study.search.scenarios) + " scenarios, of which the worst " +
                  (study.search.left_out_scenarios() == 0 ? std::string("is its score")
                                                          : std::to_string(study.search.left_out_scenarios()) + " do not count"));
}

std::vector<std::string> notes_of_model(const Study& study) {
  std::vector<std::string> notes;
  if (uses_elements(study)) {
    add_notes_of_silicone(study, notes);
  } else if (voxel::effective_coupling(study.physics) == 0.0) {
    notes.emplace_back(
        "Poisson's ratio is 0. The paper states 0.5, but its released files switch volume effects off and so simulate 0");
  }
  add_notes_of_scenarios(study, notes);
  return notes;
}

}  // namespace

std::string_view to_string(EvaluationModel model) {
  switch (model) {
    case EvaluationModel::voxels:
      return "voxels";
    case EvaluationModel::finite_elements:
      return "finite_elements";
    case EvaluationModel::both:
      break;
  }
  return "both";
}

std::string_view to_string(Measure measure) { return measure == Measure::net_displacement ? "net_displacement" : "last_periods"; }

bool uses_elements(const Study& study) { return study.model != EvaluationModel::voxels; }

std::vector<fem::Fidelity> finer_fidelities(const Study& study) {
  const fem::ElementChoice& elements = study.silicone.elements;
  std::vector<fem::Fidelity> finer;
  if (!uses_elements(study) || elements.kind != fem::ElementKind::thin_wall) return finer;
  for (const fem::Fidelity fidelity : {fem::Fidelity::standard, fem::Fidelity::fine})
    if (fidelity > elements.fidelity) finer.push_back(fidelity);
  return finer;
}

HollowModule module_of(const Study& study) {
  if (!study.physics.surrogate) return study.silicone.module;
  const voxel::CalibratedBody& body = *study.physics.surrogate;
  return {.wall_thickness_m = body.parameters.wall_thickness_m, .chambers = body.chambers, .pressure_Pa = body.pressure_Pa};
}

bool is_of_silicone(const Study& study) { return uses_elements(study) || study.physics.surrogate.has_value(); }

std::optional<LastPeriods> measured_periods(const Study& study) {
  if (study.measure == Measure::net_displacement) return std::nullopt;
  return LastPeriods{.period_s = study.physics.actuation.period_s(), .count = study.measure_periods};
}

std::optional<double> walked_body_lengths(const Study& study, double fitness) {
  if (fitness_unit(study.search.objective) != "body_lengths") return std::nullopt;
  const auto measured = measured_periods(study);
  return measured ? fitness * study.duration_s / measured->period_s : fitness;
}

bool tells_falls(const Study& study) { return study.measure == Measure::last_periods && study.largest_lean_deg < 180.0; }

Distinction distinction_of(const Study& study) {
  const voxel::ActuationMode mode = study.physics.actuation.mode;
  const bool is_single = is_of_silicone(study) && module_of(study).chambers == meshes::ChamberLayout::single;
  const bool materials = mode == voxel::ActuationMode::antiphase || !is_single;
  return {.materials = materials, .place = mode == voxel::ActuationMode::wave};
}

std::size_t voxels_in_cell(const Study& study) {
  const auto along_edge = static_cast<std::size_t>(voxel::voxels_per_cell(study.physics));
  return along_edge * along_edge * along_edge;
}

/// How a search could keep its graphics processor busy, where it does not.
std::string note_of_idle_device(const Study& study) {
  const SearchPlan& plan = study.search;
  if (study.device != io::Device::cuda) return "";
  if (!uses_elements(study)) {
    if (!plan.pruning || plan.selection_time == SelectionTime::steady_state) return "";
    return "with pruning, a generation is a row of small batches, each as long as its slowest robot; with evaluation.pruning = "
           "false the graphics processor steps all robots of a generation at once";
  }
  const bool may_be_steady = plan.scenarios == 1 && !plan.map_elites && !plan.screening && !plan.step_checks;
  if (plan.selection_time == SelectionTime::steady_state || !may_be_steady) return "";
  return "at the end of every generation the graphics processor waits for the slowest walk; with population.selection = "
         "\"steady_state\" it does not";
}

std::vector<std::string> study_notes(const Study& study) {
  std::vector<std::string> notes = notes_of_model(study);
  if (const auto last = measured_periods(study)) {
    notes.push_back("the fitness is the displacement in one period, from the last " + std::to_string(last->count) +
                    " periods of an evaluation" + (tells_falls(study) ? "; bodies that fall have none" : ""));
  }
  if (uses_elements(study) && finer_fidelities(study).empty())
    notes.emplace_back("menger evolve has no finer elements than these: it does not confirm the best robots");
  if (const std::string note = note_of_idle_device(study); !note.empty()) notes.push_back(note);
  const bool has_surrogate = study.model != EvaluationModel::finite_elements && study.physics.surrogate;
  for (const std::string& fault : has_surrogate ? outside_validity_of_some(study) : std::vector<std::string>{}) {
    const bool refuses = study.physics.surrogate->outside_range == voxel::OutsideRange::refuse;
    notes.push_back("bodies with every kind of wall would be outside the range of validity of the calibrated parameters: " +
                    fault + (refuses ? "; bodies outside get no result" : "; bodies outside are marked"));
  }
  if (has_surrogate) {
    for (const std::string& fault : voxel::sizeless_walls(*study.physics.surrogate))
      notes.push_back(fault + ": bodies with such walls get no result");
  }
  if (study.search.offspring.constraints.disconnected == DisconnectedPolicy::allow) {
    notes.emplace_back("bodies that fall apart at some level are simulated in pieces");
  }
  return notes;
}

std::vector<std::string> outside_validity_of_all(const Study& study) {
  if (!study.physics.surrogate) return {};
  voxel::CalibratedBody body = largest_bodies(study);
  std::vector<std::string> faults = drive_beyond_every_wall(body);
  body.pressure_Pa = {0.0, 0.0};  // inside the range of all walls: only chambers and lengths remain to be checked
  const std::vector<std::string> others = voxel::outside_validity(body, shortest_side(study));
  faults.insert(faults.end(), others.begin(), others.end());
  return faults;
}

std::vector<std::string> outside_validity_of_some(const Study& study) {
  if (!study.physics.surrogate) return {};
  return voxel::outside_validity(largest_bodies(study), longest_side);
}

std::size_t estimated_memory_bytes(const Study& study, int threads) {
  constexpr auto largest = std::numeric_limits<std::size_t>::max();
  const std::size_t one =
      voxel::estimated_memory_bytes(meshes::full_cube(3), study.search.levels().back(), voxel::voxels_per_cell(study.physics));
  const auto count = static_cast<std::size_t>(threads);
  return one > largest / count ? largest : one * count;
}

}  // namespace menger::evolution
