#include <initializer_list>
#include <string>
#include <string_view>

#include "io/text/number_text.h"
#include "io/text/toml_document.h"
#include "meshes/load_cases/observables.h"
#include "voxel/simulate/simulation_run.h"

namespace menger::voxel {
namespace {

std::string list_text(std::initializer_list<std::string> values) {
  std::string text = "[";
  for (const std::string& value : values) text.append(text.size() > 1 ? ", " : "").append(value);
  return text.append("]");
}

void add_line(std::string& text, std::string_view key, std::string_view value) {
  text.append(key).append(" = ").append(value).append("\n");
}

void add_divergence(std::string& text, const Divergence& divergence) {
  text += "\n[divergence]\n";
  add_line(text, "voxel", std::to_string(divergence.voxel));
  const auto& cell = divergence.cell;
  add_line(text, "cell", list_text({std::to_string(cell.x), std::to_string(cell.y), std::to_string(cell.z)}));
  add_line(text, "quantity", io::toml_quoted(divergence.quantity));
  // What is not finite has no value that a file could hold, and no limit to pass.
  if (divergence.value) {
    add_line(text, "value", io::number_text(*divergence.value));
    add_line(text, "limit", io::number_text(divergence.limit));
  }
  add_line(text, "time_s", io::number_text(divergence.time_s));
}

}  // namespace

std::string result_text(const SceneResult& result) {
  std::string text;
  add_line(text, "status", io::toml_quoted(io::to_string(result.status)));
  if (!result.reason.empty()) add_line(text, "reason", io::toml_quoted(result.reason));
  add_line(text, "time_s", io::number_text(result.time_s));
  add_line(text, "steps", std::to_string(result.steps));
  add_line(text, "time_step_s", io::number_text(result.time_step_s));
  add_line(text, "voxels", std::to_string(result.voxels));
  add_line(text, "beams", std::to_string(result.beams));
  add_line(text, "parts", std::to_string(result.parts));
  add_line(text, "records", std::to_string(result.trajectory.size()));
  add_line(text, "body_length_m", io::number_text(result.body_length_m));
  if (result.displacement_m) {
    const double distance_m = meshes::horizontal_displacement(*result.displacement_m);
    const auto& [x, y, z] = *result.displacement_m;
    add_line(text, "displacement_m", list_text({io::number_text(x), io::number_text(y), io::number_text(z)}));
    add_line(text, "horizontal_displacement_m", io::number_text(distance_m));
    add_line(text, "horizontal_displacement_body_lengths", io::number_text(distance_m / result.body_length_m));
  }
  text += "kernel_report = [\n";
  for (const std::string& line : result.kernel_report) text += "  " + io::toml_quoted(line) + ",\n";
  text += "]\n\n[collisions]\n";
  add_line(text, "steps_with_pairs", std::to_string(result.collisions.steps_with_pairs));
  add_line(text, "steps_skipped", std::to_string(result.collisions.steps_skipped));
  add_line(text, "list_rebuilds", std::to_string(result.collisions.list_rebuilds));
  if (result.strain_range) {
    text += "\n[surrogate]\n";
    add_line(text, "smallest_strain", io::number_text(result.strain_range->smallest));
    add_line(text, "largest_strain", io::number_text(result.strain_range->largest));
    text += "outside_validity = [";
    for (const std::string& fault : result.outside_validity) text += "\n  " + io::toml_quoted(fault) + ",";
    text += "]\n";
  }
  if (result.divergence) add_divergence(text, *result.divergence);
  if (result.step_check) text += "\n" + step_check_text(*result.step_check, result.body_length_m);
  return text;
}

}  // namespace menger::voxel
