#include "evolution/study/walk_evaluator.h"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <optional>
#include <string_view>
#include <utility>

#include "evolution/study/fallen.h"
#include "evolution/study/half_walk_evaluator.h"
#include "fem/walk/walk_input_error.h"
#include "fem/walk/walk_silicone_file.h"
#include "io/study/study_text.h"
#include "io/text/input_error.h"
#include "io/text/number_text.h"
#include "io/text/toml_text.h"
#include "meshes/design/fractal.h"
#include "voxel/scene/physics_file.h"

namespace menger::evolution {

namespace {

constexpr double records_per_period = 30.0;
constexpr double largest_record_interval_s = 0.02;
constexpr std::string_view refused = "finite elements refuse the body: ";  ///< begins the reason of such a result

fem::DriveMode drive_mode(voxel::ActuationMode mode) {
  switch (mode) {
    case voxel::ActuationMode::none:
      return fem::DriveMode::none;
    case voxel::ActuationMode::in_phase:
      return fem::DriveMode::in_phase;
    case voxel::ActuationMode::antiphase:
      return fem::DriveMode::antiphase;
    case voxel::ActuationMode::wave:
      return fem::DriveMode::wave;
    case voxel::ActuationMode::hold:
      return fem::DriveMode::hold;
  }
  assert(false && "a mode without a name in fem");
  return fem::DriveMode::none;
}

std::array<double, 3> minus(const std::array<double, 3>& a, const std::array<double, 3>& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

/// Returns the number of faces of cells that lie outside.
std::size_t outer_faces(const meshes::Polycube& body) {
  std::size_t count = 0;
  for (const meshes::CellIndex& cell : body.occupied()) {
    for (const auto& [x, y, z] : {std::array{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}) {
      const meshes::CellIndex beside{cell.x + x, cell.y + y, cell.z + z};
      if (body.at_or_empty(beside) == meshes::empty) ++count;
    }
  }
  return count;
}

/// Describes what moves bodies on finite elements: loads, ground, drive, elements and silicone.
void describe_moving(io::StudyVisitor& visitor, Study& study) {
  HollowModule module = module_of(study);
  voxel::Physics physics = study.physics;
  physics.surrogate.reset();
  visitor.table({"body", "The bodies."}, [&] {
    visitor.number({"cell_edge_m", "Edge of a cell."}, study.search.cell_edge_m);
    describe_module(visitor, module);
  });
  voxel::describe(visitor, physics, {.has_voxels = false, .pressure_Pa = &module.pressure_Pa});
  visitor.table({"elements", "The elements."}, [&] {
    describe_elements(visitor, study.silicone.elements, study.silicone.elements_through_wall);
    describe_step_safety(visitor, study.silicone.step_safety);
  });
  visitor.table({"material", "The silicone."}, [&] { fem::describe(visitor, study.silicone.silicone); });
}

}  // namespace

meshes::Polycube module_of_aggregate(const meshes::Polycube& aggregate, int level) {
  const std::optional<meshes::Polycube> module = meshes::basal_body(aggregate, level);
  if (!module) throw io::InputError("the body is not the fractal of level " + std::to_string(level) + " of a module");
  return *module;
}

fem::SurrogateDrive pressure_drive(const Study& study) {
  const voxel::Actuation& drive = study.physics.actuation;
  return {.mode = drive_mode(drive.mode),
          .pressure_Pa = module_of(study).pressure_Pa,
          .frequency_Hz = drive.frequency_Hz,
          .ramp_s = drive.ramp_s,
          .material_phase = drive.material_phase,
          .wave_axis = drive.wave_axis,
          .wave_periods_per_body = drive.wave_periods_per_body,
          .wave_over_gaps = drive.wave_over_gaps};
}

double record_interval_s(const Study& study) {
  const double period_s = study.physics.actuation.period_s();
  const double records = std::max(records_per_period, std::ceil(period_s / largest_record_interval_s));
  return std::min(period_s / records, study.duration_s);
}

fem::WalkInput walk_of(const Study& study, const meshes::Polycube& body, int level) {
  const HollowModule module = module_of(study);
  const voxel::VoxelMaterial& ground = study.physics.materials[0];
  fem::WalkInput walk;
  walk.design = {"body", body, study.search.cell_edge_m};
  walk.hollow.wall_thickness_m = module.wall_thickness_m;
  walk.hollow.elements_through_wall = study.silicone.elements_through_wall;
  walk.hollow.chambers = module.chambers;
  walk.hollow.level = level;
  walk.elements = study.silicone.elements;
  walk.silicone = study.silicone.silicone;
  walk.stated_ground.friction = {.static_coefficient = ground.static_friction, .kinetic_coefficient = ground.kinetic_friction};
  walk.gravity_m_per_s2 = study.physics.gravity_m_s2;
  walk.drive = pressure_drive(study);
  walk.duration_s = study.duration_s;
  walk.record_interval_s = record_interval_s(study);
  walk.step_safety = study.silicone.step_safety;
  walk.device = study.device;
  return walk;
}

void measure(const Study& study, const fem::WalkResult& walk, Evaluation& result) {
  const std::array<double, 3> whole_m = minus(walk.records.back().centre_of_mass_m, walk.records.front().centre_of_mass_m);
  result.period_displacements_m = fem::period_displacements_m(walk, study.physics.actuation.period_s());
  result.displacement_m = whole_m;
  if (const auto last = measured_periods(study)) {
    const meshes::Lean lean = fem::largest_lean(walk, last->period_s);
    if (lean.angle_deg > study.largest_lean_deg) return set_fallen(lean, whole_m, result);
    result.displacement_m = steady_displacement_m(result.period_displacements_m, *last);
    if (!result.displacement_m) {
      result.status = io::RunStatus::diverged;
      result.reason = "the walk has " + std::to_string(result.period_displacements_m.size()) + " whole periods, fewer than the " +
                      std::to_string(last->count) + " that are measured";
      return;
    }
  } else if (study.measure_from_s > 0.0) {
    const fem::Point from_m = fem::centre_of_mass_at(walk, study.measure_from_s);
    result.displacement_m = minus(walk.records.back().centre_of_mass_m, from_m);
  } else {
    return;
  }
  result.left_out_m = minus(whole_m, *result.displacement_m);
}

Evaluation blank_result(const Study& study) {
  Evaluation result;
  if (study.silicone.elements.kind == fem::ElementKind::thin_wall) result.fidelity = to_string(study.silicone.elements.fidelity);
  return result;
}

void take_result(const Study& study, const fem::WalkResult& walk, Evaluation& result) {
  result.status = walk.status;
  result.reason = walk.reason;
  result.steps = walk.steps;
  result.elements = walk.elements;
  if (walk.status == io::RunStatus::completed) measure(study, walk, result);
  if (result.status == io::RunStatus::completed) result.reason.clear();
}

void set_refused(const io::InputError& error, Evaluation& result) {
  // For one body of many this is not wrong input, but a body without a result.
  result.status = io::RunStatus::diverged;
  const auto* of_walk = dynamic_cast<const fem::WalkInputError*>(&error);
  // The reason names the body already.
  result.reason = std::string(refused) + (of_walk != nullptr && of_walk->key() == "design" ? of_walk->reason() : error.what());
}

std::optional<std::string> refusal_of(const Evaluation& result) {
  if (result.status != io::RunStatus::diverged || !result.reason.starts_with(refused)) return std::nullopt;
  return result.reason.substr(refused.size());
}

WalkEvaluator::WalkEvaluator(Study study, std::shared_ptr<PausedWalks> paused)
    : study_(std::move(study)), paused_(std::move(paused)) {}

Evaluation WalkEvaluator::evaluate(const meshes::Polycube& body, int level, const std::atomic<bool>& stop) const {
  const auto start = std::chrono::steady_clock::now();
  Evaluation result = blank_result(study_);
  try {
    const std::unique_ptr<WalkInParts> begun = paused_ ? paused_->take(body) : nullptr;
    if (begun == nullptr) {
      take_result(study_, fem::walk(walk_of(study_, module_of_aggregate(body, level), level), &stop), result);
    } else if (begun->go_on_to(study_.duration_s, stop)) {
      take_result(study_, begun->result(), result);
    }
  } catch (const io::InputError& error) {
    set_refused(error, result);
  }
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

std::string WalkEvaluator::physics() const {
  io::TomlText text;
  text.add("model", to_string(EvaluationModel::finite_elements)).add("duration_s", study_.duration_s);
  if (study_.measure_from_s > 0.0) text.add("measure_from_s", study_.measure_from_s);
  if (const auto last = measured_periods(study_)) text.add("measure_periods", last->count);
  if (tells_falls(study_)) text.add("largest_lean_deg", study_.largest_lean_deg);
  text.add("record_interval_s", record_interval_s(study_));
  if (study_.device != io::Device::cpu) text.add("device", to_string(study_.device));
  io::StudyTextWriter moving;
  Study described = study_;
  describe_moving(moving, described);
  return text.lines(moving.text()).text();
}

double WalkEvaluator::cost(const meshes::Polycube& body, int /*level*/) const {
  const fem::ElementChoice& choice = study_.silicone.elements;
  meshes::HollowBodyOptions options;
  fem::set_elements(choice, options);
  // A face of a cell is cut into those of the span between its walls, and shares those of its edges with its neighbours.
  const double along_edge =
      static_cast<double>(options.elements_per_span.value_or(2 * study_.silicone.elements_through_wall)) + 1.0;
  return static_cast<double>(outer_faces(body)) * along_edge * along_edge;
}

}  // namespace menger::evolution
