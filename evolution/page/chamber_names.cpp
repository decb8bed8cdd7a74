#include "evolution/page/chamber_names.h"

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <optional>
#include <string_view>
#include <system_error>

#include "meshes/design/modular_body.h"
#include "meshes/design/polycube.h"

namespace menger::evolution {
namespace {

/// The number in "plenum 0" and "plenum_0".
std::optional<std::size_t> plenum_number(const std::string& plenum) {
  constexpr std::string_view before = "plenum";
  if (!plenum.starts_with(before) || plenum.size() < before.size() + 2) return std::nullopt;
  std::size_t number = 0;
  const char* end = plenum.data() + plenum.size();
  const auto [rest, fault] = std::from_chars(plenum.data() + before.size() + 1, end, number);
  return fault == std::errc() && rest == end ? std::optional(number) : std::nullopt;
}

}  // namespace

ChamberNames::ChamberNames(const CommandOutput& output) {
  if (output.stated.chambers != "per-phase" || !output.stated.body) return;
  const auto& layers = output.stated.body->layers;
  if (layers.empty() || layers.front().empty()) return;
  std::string digits;
  for (const auto& rows : layers)
    for (const std::string& row : rows) digits += row;
  const std::size_t along_x = layers.front().front().size();
  const std::size_t along_y = layers.front().size();
  if (digits.size() != along_x * along_y * layers.size()) return;
  const auto cells = meshes::Polycube::from_digits(static_cast<int>(along_x), static_cast<int>(along_y),
                                                   static_cast<int>(layers.size()), digits);
  const meshes::ModularBody body(cells, 1, meshes::ChamberLayout::per_phase);
  for (const auto& region : body.regions()) materials_.push_back(region.material);
}

int ChamberNames::material_of(const std::string& plenum) const {
  const auto number = plenum_number(plenum);
  return number && *number < materials_.size() ? materials_[*number] : 0;
}

std::string ChamberNames::name_of(const std::string& plenum) const {
  const int material = material_of(plenum);
  if (material == 0) {
    std::string name = plenum;
    std::ranges::replace(name, '_', ' ');
    return name;
  }
  const auto end = materials_.begin() + static_cast<std::ptrdiff_t>(*plenum_number(plenum)) + 1;
  const bool is_one = std::ranges::count(materials_, material) == 1;
  return "chamber " + (is_one ? "" : std::to_string(std::count(materials_.begin(), end, material)) + " ") + "of material " +
         std::to_string(material);
}

std::string ChamberNames::all() const {
  std::string text;
  for (std::size_t number = 0; number < materials_.size(); ++number) {
    const std::string plenum = "plenum " + std::to_string(number);
    text += (text.empty() ? "" : ", ") + name_of(plenum) + " (" + plenum + " in files)";
  }
  return text;
}

}  // namespace menger::evolution
