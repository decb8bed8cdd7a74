#include "meshes/robot/calibration_cases.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <string_view>

#include "io/text/toml_text.h"

namespace menger::meshes {
namespace {

/// Displacements are written to a nanometre.
constexpr double length_digits_per_m = 1e9;

using Numbers = std::vector<double>;

struct CalibrationCase {
  std::string_view name;
  std::string_view kind;
  std::array<std::int64_t, 3> cells;
  std::string_view digits;
  std::int64_t level = 1;
  Numbers pressure_fractions{};
  Numbers displacements{};  ///< over the edge of a cell
  Numbers angles_rad{};
  Numbers gravity_factors{};
  Numbers known_pressures_Pa{};  ///< of the cells for which scaled_pressure_Pa has no effect
};

constexpr std::array<std::int64_t, 3> cell{1, 1, 1};
constexpr std::array<std::int64_t, 3> bar{3, 1, 1};
constexpr std::array<std::int64_t, 3> square{2, 2, 1};
constexpr std::array<std::int64_t, 3> cube{3, 3, 3};
constexpr std::array<std::int64_t, 3> joint{2, 1, 1};
constexpr std::string_view cube_digits = "111111111111111111111111111";

/// Pressures at which bodies are loaded: vacuum, none and pressure.
const Numbers& three_pressures() {
  static const Numbers fractions{-0.6, 0, 0.6};
  return fractions;
}

const Numbers& seven_pressures() {
  static const Numbers fractions{-0.9, -0.6, -0.3, 0.25, 0.5, 0.75, 1};
  return fractions;
}

std::vector<CalibrationCase> all_cases() {
  const Numbers& three = three_pressures();
  const Numbers& seven = seven_pressures();
  return {
      {"cell_inflation", "inflation", cell, "1"},
      {"bar_inflation", "inflation", bar, "111"},
      {"square_inflation", "inflation", square, "1111"},
      {"slab_inflation", "inflation", {3, 2, 1}, "111111"},
      // A square that an arm leaves, beside which the square bulges further.
      {"armed_square_inflation", "inflation", {3, 2, 1}, "111110"},
      {"elbow_inflation", "inflation", square, "1110"},
      {"tripod_inflation", "inflation", {2, 2, 2}, "11101000"},
      // Two legs below the ends of a bar: the corners open, and move the feet apart.
      {"arch_inflation", "inflation", {3, 1, 2}, "101111"},
      {"cube_inflation", "inflation", cube, cube_digits},
      {"joint_inflation", "inflation", joint, "11", 2},
      {"cell_blocked", "blocked", cell, "1", 1, seven},
      {"bar_blocked", "blocked", bar, "111", 1, seven},
      {"cell_stretch", "stretch", cell, "1", 1, three, {-0.1, -0.05, 0.05, 0.1, 0.2}},
      {"bar_stretch", "stretch", bar, "111", 1, three, {-0.15, -0.075, 0.1, 0.2, 0.4}},
      {"square_stretch", "stretch", square, "1111", 1, three, {-0.1, -0.05, 0.1, 0.2}},
      {"cube_stretch", "stretch", cube, cube_digits, 1, {0, 0.6}, {-0.1, 0.1, 0.2}},
      {"joint_stretch", "stretch", joint, "11", 2, three, {-0.15, -0.075, 0.1, 0.2, 0.4}},
      {"cell_shear", "shear", cell, "1", 1, three, {0.05, 0.1, 0.2}},
      {"bar_shear", "shear", bar, "111", 1, three, {0.1, 0.2, 0.4}},
      {"cell_bending", "bending", cell, "1", 1, three, {}, {0.1, 0.2, 0.4}},
      {"bar_bending", "bending", bar, "111", 1, three, {}, {0.1, 0.2, 0.4, 0.8}},
      {"joint_bending", "bending", joint, "11", 2, three, {}, {0.1, 0.2, 0.4, 0.8}},
      {"cell_torsion", "torsion", cell, "1", 1, three, {}, {0.1, 0.2, 0.4}},
      {"bar_torsion", "torsion", bar, "111", 1, three, {}, {0.2, 0.4, 0.8}},
      {"joint_torsion", "torsion", joint, "11", 2, three, {}, {0.2, 0.4, 0.8}},
      {"cell_press", "press", cell, "1", 1, {0, 0.5}, {0.01, 0.025, 0.05, 0.1}},
      {"bar_press", "press", bar, "111", 1, {0, 0.5}, {0.01, 0.025, 0.05}},
      {"bar_sag", "sag", bar, "111", 1, {0, 0.6}, {}, {}, {1, 2, 4}},
      {"bar_modes", "modes", bar, "111", 1, three},
      // Legs that leave a plate off its middle: how far the plate stands out where a limb leaves it. Under stronger vacuum the
      // voxels, whose walls reach the inside of the slab a little earlier, have no response.
      {"legged_slab_inflation",
       "inflation",
       {3, 2, 2},
       "100001111111",
       1,
       {},
       {},
       {},
       {},
       {-1000, -500, 0, 2000, 4000, 6000, 8000, 10000, 12000, 14000}},
  };
}

void add_numbers(io::TomlText& text, std::string_view key, const Numbers& numbers) {
  if (!numbers.empty()) text.add(key, std::span<const double>(numbers));
}

}  // namespace

std::string calibration_cases_text(const Robot& robot) {
  io::TomlText text;
  for (const CalibrationCase& load : all_cases()) {
    text.line("").entry("case").add("name", load.name).add("kind", load.kind);
    text.add("cells", std::span<const std::int64_t>(load.cells)).add("digits", load.digits);
    if (load.level > 1) text.add("level", load.level);
    add_numbers(text, "pressure_fractions", load.pressure_fractions);
    Numbers displacements_m;
    for (const double displacement : load.displacements)
      displacements_m.push_back(std::round(displacement * robot.design.cell_edge_m * length_digits_per_m) / length_digits_per_m);
    add_numbers(text, "displacement_m", displacements_m);
    add_numbers(text, "angle_rad", load.angles_rad);
    add_numbers(text, "gravity_factor", load.gravity_factors);
    Numbers pressures_Pa;
    for (const double pressure_Pa : load.known_pressures_Pa) pressures_Pa.push_back(scaled_pressure_Pa(robot, pressure_Pa));
    add_numbers(text, "pressures_Pa", pressures_Pa);
  }
  return text.text();
}

bool is_fitted_body(const Robot& robot) {
  const Polycube& body = robot.design.body;
  const std::array<std::int64_t, 3> cells{body.nx(), body.ny(), body.nz()};
  std::string digits = body.digits();
  if (chamber_count(robot) > 1) return false;
  std::ranges::replace(digits, '2', '1');  // in one chamber, which material a cell has decides nothing
  const std::vector<CalibrationCase> cases = all_cases();
  return std::ranges::any_of(cases, [&](const CalibrationCase& load) {
    return load.kind == "inflation" && load.level == 1 && load.cells == cells && load.digits == digits;
  });
}

int longest_fitted_body_cells() {
  std::int64_t longest = 0;
  for (const CalibrationCase& load : all_cases()) longest = std::max(longest, *std::ranges::max_element(load.cells));
  return static_cast<int>(longest);
}

std::vector<std::string> calibration_case_names() {
  std::vector<std::string> names;
  for (const CalibrationCase& load : all_cases()) names.emplace_back(load.name);
  return names;
}

}  // namespace menger::meshes
