#include "meshes/load_cases/load_case_subject.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

namespace menger::meshes {

namespace {

/// A module as a grid of cells with digits, x fastest.
struct Module {
  std::array<int, 3> cells{};
  std::string digits;

  [[nodiscard]] char at(int x, int y, int z) const {
    const int position = x + cells[0] * (y + cells[1] * z);
    return digits.at(static_cast<std::size_t>(position));
  }
};

/// Returns the module without the empty layers around it.
Module without_surroundings(const Module& module) {
  const CellBox box = occupied_box(module.cells, module.digits);
  Module inner{.cells = box.size, .digits = {}};
  for (int z = 0; z < box.size[2]; ++z) {
    for (int y = 0; y < box.size[1]; ++y) {
      for (int x = 0; x < box.size[0]; ++x) inner.digits += module.at(box.lowest[0] + x, box.lowest[1] + y, box.lowest[2] + z);
    }
  }
  return inner;
}

/// Returns the module after a quarter turn about an axis.
Module turned(const Module& module, std::size_t axis) {
  const std::size_t from = (axis + 1) % 3;
  const std::size_t to = (axis + 2) % 3;
  Module result{.cells = module.cells, .digits = {}};
  std::swap(result.cells.at(from), result.cells.at(to));
  std::array<int, 3> cell{};
  for (cell[2] = 0; cell[2] < result.cells[2]; ++cell[2]) {
    for (cell[1] = 0; cell[1] < result.cells[1]; ++cell[1]) {
      for (cell[0] = 0; cell[0] < result.cells[0]; ++cell[0]) {
        std::array<int, 3> before = cell;
        before.at(from) = cell.at(to);
        before.at(to) = result.cells.at(from) - 1 - cell.at(from);
        result.digits += module.at(before[0], before[1], before[2]);
      }
    }
  }
  return result;
}

bool has_both_phases(const std::string& digits) {
  return digits.find('1') != std::string::npos && digits.find('2') != std::string::npos;
}

/// Renames phases so that the first one that occurs is 1.
void rename_phases(std::string& digits) {
  const std::size_t first = digits.find_first_not_of('0');
  if (first == std::string::npos || digits[first] == '1') return;
  for (char& digit : digits) {
    if (digit != '0') digit = digit == '1' ? '2' : '1';
  }
}

/// Returns the axes about which a body may be rotated without changing the load case.
std::vector<std::size_t> free_axes(LoadCaseKind kind) {
  switch (kind) {
    case LoadCaseKind::inflation:
      return {0, 1, 2};
    case LoadCaseKind::blocked:
    case LoadCaseKind::stretch:
    case LoadCaseKind::torsion:
    case LoadCaseKind::modes:
      return {0};
    case LoadCaseKind::press:
      return {2};
    case LoadCaseKind::shear:
    case LoadCaseKind::bending:
    case LoadCaseKind::sag:
      break;
  }
  return {};
}

/// Returns one representative of all rotations of a module that do not change the load case, with its phases renamed. It is the
/// longest along x, then y, then z; among these the last by its digits.
Module standing_for_all(const Module& module, LoadCaseKind kind) {
  using Key = std::pair<std::array<int, 3>, std::string>;
  std::set<Key> seen;
  std::vector<Module> found{module};
  for (std::size_t next = 0; next < found.size(); ++next) {
    rename_phases(found[next].digits);
    for (const std::size_t axis : free_axes(kind)) {
      Module other = turned(found[next], axis);
      rename_phases(other.digits);
      if (seen.insert({other.cells, other.digits}).second) found.push_back(std::move(other));
    }
  }
  return *std::max_element(found.begin(), found.end(), [](const Module& a, const Module& b) {
    return std::tie(a.cells, a.digits) < std::tie(b.cells, b.digits);
  });
}

}  // namespace

std::string subject_of(const LoadCase& load_case) {
  Module module{load_case.cells, load_case.digits};
  const bool per_phase = load_case.per_phase && has_both_phases(module.digits);
  if (!per_phase) std::replace(module.digits.begin(), module.digits.end(), '2', '1');
  if (load_case.level == 1) module = without_surroundings(module);
  module = standing_for_all(module, load_case.kind);
  std::string text(to_string(load_case.kind));
  text += " of ";
  for (std::size_t axis = 0; axis < 3; ++axis) text += (axis > 0 ? "x" : "") + std::to_string(module.cells.at(axis));
  text += ":" + module.digits + ", level " + std::to_string(load_case.level);
  return per_phase ? text + ", chambers per phase" : text;
}

}  // namespace menger::meshes
