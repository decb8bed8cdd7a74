#include "meshes/robot/known_parameters.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "io/study/installed_folders.h"
#include "io/text/number_text.h"
#include "io/text/toml_document.h"
#include "materials/laws/law_file.h"

namespace menger::meshes {
namespace {

namespace fs = std::filesystem;

bool is_same_length(double one_m, double other_m) { return std::abs(one_m - other_m) <= 1e-9 * std::max(one_m, other_m); }

}  // namespace

std::vector<std::string> other_subject_of(const fs::path& parameters, const Robot& robot) {
  const io::TomlTable subject = io::read_toml(parameters).table("holds_for");
  std::vector<std::string> others;
  const auto compare_text = [&](std::string_view key, const std::string& own) {
    const std::string text = subject.text(key);
    if (text != own) others.push_back(std::string(key) + " " + text + " in place of " + own);
  };
  const auto compare_length = [&](std::string_view key, double own_m) {
    const double length_m = subject.number(key);
    if (!is_same_length(length_m, own_m))
      others.push_back(std::string(key) + " " + io::number_text(length_m) + " in place of " + io::number_text(own_m));
  };
  compare_text("silicone", robot.record.name);
  compare_text("law", materials::law_line(robot.law.law));
  compare_length("cell_edge_m", robot.design.cell_edge_m);
  compare_length("wall_thickness_m", robot.wall_thickness_m);
  if (const int voxels = subject.integer_or<int>("voxels_per_cell", 1); voxels != 1)
    others.push_back("voxels_per_cell " + std::to_string(voxels) + " in place of 1");
  return others;
}

std::optional<fs::path> known_parameters(const Robot& robot) {
  const std::vector<fs::path> files = io::data_files(io::parameter_data);
  const auto found =
      std::find_if(files.begin(), files.end(), [&](const fs::path& file) { return other_subject_of(file, robot).empty(); });
  return found == files.end() ? std::nullopt : std::optional(*found);
}

}  // namespace menger::meshes
