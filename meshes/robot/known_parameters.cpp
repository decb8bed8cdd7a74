#include "meshes/robot/known_parameters.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "io/study/installed_folders.h"
#include "io/text/toml_document.h"
#include "materials/laws/law_file.h"

namespace menger::meshes {
namespace {

namespace fs = std::filesystem;

bool is_same_length(double one_m, double other_m) { return std::abs(one_m - other_m) <= 1e-9 * std::max(one_m, other_m); }

bool holds_for(const fs::path& file, const Robot& robot) {
  const io::TomlTable question = io::read_toml(file).table("holds_for");
  return question.text("silicone") == robot.record.name && question.text("law") == materials::law_line(robot.law.law) &&
         is_same_length(question.number("cell_edge_m"), robot.design.cell_edge_m) &&
         is_same_length(question.number("wall_thickness_m"), robot.wall_thickness_m) &&
         question.integer_or<int>("voxels_per_cell", 1) == 1;
}

}  // namespace

std::optional<fs::path> known_parameters(const Robot& robot) {
  const std::vector<fs::path> files = io::data_files(io::parameter_data);
  const auto found = std::find_if(files.begin(), files.end(), [&](const fs::path& file) { return holds_for(file, robot); });
  return found == files.end() ? std::nullopt : std::optional(*found);
}

}  // namespace menger::meshes
