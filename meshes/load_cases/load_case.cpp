#include "meshes/load_cases/load_case.h"

#include <algorithm>
#include <limits>

#include "meshes/load_cases/body_feet.h"
#include "meshes/load_cases/load_case_file.h"

namespace menger::meshes {

std::string_view to_string(LoadCaseKind kind) {
  for (const auto& [word, value] : load_case_kind_words()) {
    if (value == kind) return word;
  }
  return "";
}

std::vector<std::array<int, 3>> occupied_cells(const std::array<int, 3>& cells, std::string_view digits) {
  std::vector<std::array<int, 3>> occupied;
  for (std::size_t i = 0; i < digits.size(); ++i) {
    if (digits[i] == '0') continue;
    const int position = static_cast<int>(i);
    occupied.push_back({position % cells[0], position / cells[0] % cells[1], position / (cells[0] * cells[1])});
  }
  return occupied;
}

CellBox occupied_box(const std::array<int, 3>& cells, std::string_view digits) {
  std::array<int, 3> low = cells;
  std::array<int, 3> high{-1, -1, -1};
  for (const std::array<int, 3>& at : occupied_cells(cells, digits)) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], at[axis]);
      high[axis] = std::max(high[axis], at[axis]);
    }
  }
  CellBox box{.lowest = low};
  for (std::size_t axis = 0; axis < 3; ++axis) box.size[axis] = std::max(0, high[axis] - low[axis] + 1);
  return box;
}

int longest_side_cells(const std::array<int, 3>& cells, std::string_view digits) {
  const CellBox box = occupied_box(cells, digits);
  return *std::max_element(box.size.begin(), box.size.end());
}

int longest_side_modules(int longest_side_cells, int level) {
  constexpr int most = std::numeric_limits<int>::max();
  int modules = 1;
  for (int i = 1; i < level; ++i) modules = longest_side_cells > most / modules ? most : modules * longest_side_cells;
  return modules;
}

std::vector<std::string> response_columns(LoadCaseKind kind) {
  switch (kind) {
    case LoadCaseKind::inflation:
      return {"pressure_Pa", "volume_change", "extent_x_m", "extent_y_m", "extent_z_m", "top_m"};
    case LoadCaseKind::blocked:
      return {"pressure_Pa", "force_N", "volume_change"};
    case LoadCaseKind::stretch:
      return {"pressure_Pa", "displacement_m", "force_N", "volume_change", "extent_y_m", "extent_z_m"};
    case LoadCaseKind::shear:
    case LoadCaseKind::press:
      return {"pressure_Pa", "displacement_m", "force_N"};
    case LoadCaseKind::bending:
    case LoadCaseKind::torsion:
      return {"pressure_Pa", "angle_rad", "moment_N_m"};
    case LoadCaseKind::sag:
      return {"pressure_Pa", "gravity_factor", "tip_m"};
    case LoadCaseKind::modes:
      return {"pressure_Pa", "frequency_1_Hz", "frequency_2_Hz", "frequency_3_Hz"};
  }
  return {};
}

std::vector<std::string> response_columns(const LoadCase& load_case) {
  std::vector<std::string> columns = response_columns(load_case.kind);
  if (load_case.kind != LoadCaseKind::inflation || load_case.level > 1) return columns;
  const std::size_t feet = feet_of(occupied_cells(load_case.cells, load_case.digits)).size();
  for (std::size_t foot = 1; feet > 1 && foot <= feet; ++foot) columns.push_back("foot_" + std::to_string(foot) + "_out_m");
  return columns;
}

std::size_t abscissa_count(LoadCaseKind kind) {
  const bool by_pressure_alone = kind == LoadCaseKind::inflation || kind == LoadCaseKind::blocked || kind == LoadCaseKind::modes;
  return by_pressure_alone ? 1 : 2;
}

}  // namespace menger::meshes
