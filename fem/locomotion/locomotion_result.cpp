#include "fem/locomotion/locomotion_result.h"

#include <span>
#include <string_view>
#include <utility>

#include "io/text/formatted.h"
#include "io/text/input_error.h"
#include "io/text/run_status_words.h"
#include "io/text/toml_document.h"
#include "io/text/toml_text.h"
#include "meshes/load_cases/observables.h"

namespace menger::fem {
namespace {

/// The works and losses in the order of their columns.
constexpr std::pair<const char*, double MotionWork::*> work_columns[] = {
    {"pressure_work_J", &MotionWork::pressure_J},         {"wall_pressure_work_J", &MotionWork::wall_pressure_J},
    {"gravity_work_J", &MotionWork::gravity_J},           {"contact_work_J", &MotionWork::contact_J},
    {"self_contact_work_J", &MotionWork::self_contact_J}, {"friction_loss_J", &MotionWork::friction_J},
    {"viscous_loss_J", &MotionWork::viscous_J},           {"mass_damping_loss_J", &MotionWork::mass_damping_J},
};

std::vector<std::string> columns_of(const LocomotionResult& result) {
  std::vector<std::string> columns(meshes::locomotion_columns.begin(), meshes::locomotion_columns.end());
  for (const std::string& plenum : result.plenum_names) columns.push_back(io::column_part(plenum) + "_pressure_Pa");
  for (const std::string& chamber : result.chamber_names) columns.push_back(io::column_part(chamber) + "_volume_m3");
  columns.insert(columns.end(), {"kinetic_J", "strain_J"});
  for (const auto& [name, work] : work_columns) columns.emplace_back(name);
  columns.insert(columns.end(), {"imbalance_J", "ground_force_N"});
  return columns;
}

}  // namespace

LocomotionResult named_result(const PreparedWalk& walk, WalkResult result) {
  LocomotionResult named;
  static_cast<WalkResult&>(named) = std::move(result);
  named.plenum_names = walk.mesh.plenum_names;
  for (const meshes::Chamber& chamber : walk.mesh.chambers) named.chamber_names.push_back(chamber.name);
  return named;
}

io::CsvTable trajectory_table(const LocomotionResult& result) {
  io::CsvTable table(columns_of(result));
  for (const WalkRecord& record : result.records) {
    const Point& centre = record.centre_of_mass_m;
    const double displacement = meshes::horizontal_displacement(difference(centre, result.records.front().centre_of_mass_m));
    std::vector<io::CsvCell> cells{record.time_s, centre[0],    centre[1],
                                   centre[2],     displacement, displacement / result.body_length_m};
    cells.insert(cells.end(), record.plenum_pressures_Pa.begin(), record.plenum_pressures_Pa.end());
    cells.insert(cells.end(), record.chamber_volumes_m3.begin(), record.chamber_volumes_m3.end());
    cells.insert(cells.end(), {record.energies.kinetic_J, record.energies.strain_J});
    for (const auto& [name, work] : work_columns) cells.emplace_back(record.energies.work.*work);
    cells.insert(cells.end(), {record.energies.imbalance_J(), record.ground_force_N});
    table.add_cells(cells);
  }
  return table;
}

LocomotionResult read_locomotion_result(const std::filesystem::path& folder) {
  const io::TomlTable table = io::read_toml(folder / "locomotion.toml");
  LocomotionResult result;
  result.status = table.word("status", io::run_status_words());
  result.reason = table.text_or("reason", "");
  result.time_s = table.number("time_s", io::non_negative());
  result.steps = table.integer<std::size_t>("steps", io::at_least(0));
  result.elements = table.integer<std::size_t>("elements", io::at_least(0));
  result.nodes = table.integer<std::size_t>("nodes", io::at_least(0));
  result.seconds = table.number("seconds", io::non_negative());
  result.body_length_m = table.number("body_length_m", io::positive());

  const io::CsvContents trajectory = io::read_csv(folder / "trajectory.csv");
  for (std::size_t row = 0; row < trajectory.row_count(); ++row) {
    result.records.push_back(
        {.time_s = trajectory.number(row, "time_s"),
         .centre_of_mass_m = {trajectory.number(row, "centre_of_mass_x_m"), trajectory.number(row, "centre_of_mass_y_m"),
                              trajectory.number(row, "centre_of_mass_z_m")}});
  }
  if (result.records.empty()) throw io::InputError((folder / "trajectory.csv").string() + ": holds no row");
  return result;
}

std::string result_text(const LocomotionResult& result) {
  io::TomlText text;
  text.add("status", io::to_string(result.status)).add("reason", result.reason).add("time_s", result.time_s);
  text.add("steps", result.steps).add("elements", result.elements).add("nodes", result.nodes);
  text.add("records", result.records.size()).add("body_length_m", result.body_length_m);
  if (const auto travel = travel_of(result)) {
    text.add("displacement_m", std::span<const double>(travel->displacement_m));
    text.add("horizontal_displacement_m", travel->horizontal_displacement_m);
    text.add("horizontal_displacement_body_lengths", travel->horizontal_displacement_body_lengths);
    text.add("body_lengths_per_minute", travel->body_lengths_per_minute);
    text.add("direction_deg", travel->direction_deg);
  }
  text.add("peak_height_m", peak_height_m(result)).add("seconds", result.seconds);
  return text.text();
}

}  // namespace menger::fem
