#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "io/text/toml_text.h"
#include "meshes/load_cases/observables.h"
#include "voxel/simulate/simulation_run.h"

namespace menger::voxel {
namespace {

void add_divergence(io::TomlText& text, const Divergence& divergence) {
  const auto& cell = divergence.cell;
  text.line("").table("divergence").add("voxel", divergence.voxel);
  text.add("cell", std::vector<std::int64_t>{cell.x, cell.y, cell.z}).add("quantity", divergence.quantity);
  // A value that is not finite cannot be written to the file, and is not compared with a limit.
  if (divergence.value) text.add("value", *divergence.value).add("limit", divergence.limit);
  text.add("time_s", divergence.time_s);
}

/// Adds a list with one line per text.
void add_lines(io::TomlText& text, std::string_view key, const std::vector<std::string>& lines) {
  if (lines.empty()) {
    text.raw(key, "[]");
    return;
  }
  text.line(std::string(key) + " = [");
  for (const std::string& line : lines) text.line("  " + io::toml_value_text(line) + ",");
  text.line("]");
}

}  // namespace

std::string result_text(const SceneResult& result) {
  io::TomlText text;
  text.add("status", io::to_string(result.status));
  if (!result.reason.empty()) text.add("reason", result.reason);
  text.add("time_s", result.time_s).add("steps", result.steps).add("time_step_s", result.time_step_s);
  text.add("voxels", result.voxels).add("beams", result.beams).add("parts", result.parts);
  text.add("records", result.trajectory.size()).add("body_length_m", result.body_length_m);
  if (result.displacement_m) {
    const double distance_m = meshes::horizontal_displacement(*result.displacement_m);
    text.add("displacement_m", *result.displacement_m).add("horizontal_displacement_m", distance_m);
    text.add("horizontal_displacement_body_lengths", distance_m / result.body_length_m);
  }
  add_lines(text, "kernel_report", result.kernel_report);
  text.line("").table("collisions").add("steps_with_pairs", result.collisions.steps_with_pairs);
  text.add("steps_skipped", result.collisions.steps_skipped).add("list_rebuilds", result.collisions.list_rebuilds);
  if (result.strain_range) {
    text.line("").table("surrogate").add("smallest_strain", result.strain_range->smallest);
    text.add("largest_strain", result.strain_range->largest);
    add_lines(text, "outside_validity", result.outside_validity);
    if (!result.expected_error.empty()) add_lines(text, "expected_error", result.expected_error);
  }
  if (result.divergence) add_divergence(text, *result.divergence);
  if (result.step_check) text.line("").lines(step_check_text(*result.step_check, result.body_length_m));
  return text.text();
}

}  // namespace menger::voxel
