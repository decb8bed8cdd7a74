#include "evolution/outputs/stated_run.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>

#include "evolution/outputs/json_parts.h"
#include "io/text/formatted.h"

namespace menger::evolution {
namespace {

using nlohmann::json;

/// A way through tables: {"surrogate", "values", "holds_for"}.
using Way = std::initializer_list<const char*>;

/// The table at the end of a way; null if there is none.
const json* table_at(const json& parameters, Way way) {
  const json* table = &parameters;
  for (const char* key : way)
    if (table != nullptr) table = object_of(*table, key);
  return table;
}

/// Nine digits: numbers that differ by rounding only are the same.
std::string same_number(double value) { return io::formatted("%.9g", value); }

std::string same_value(const json& value) {
  if (value.is_number()) return same_number(value.get<double>());
  if (value.is_string()) return value.get<std::string>();
  if (!value.is_array()) return value.dump(-1, ' ', false, json::error_handler_t::replace);
  std::string list;
  for (const json& one : value) list += (list.empty() ? "" : ", ") + same_value(one);
  return "[" + list + "]";
}

std::string joined(const std::map<std::string, std::string>& parts) {
  std::string text;
  for (const auto& [key, value] : parts) text.append(text.empty() ? "" : ", ").append(key).append(" = ").append(value);
  return text;
}

std::optional<ManifestBody> body_of(const json& design) {
  if (const auto level = number_of(design, "level"); level && *level != 1.0) return std::nullopt;
  const auto edge = number_of(design, "cell_edge_m");
  const auto layers = design.find("layers");
  if (!edge || !(*edge > 0.0) || !std::isfinite(*edge) || layers == design.end() || !layers->is_array()) return std::nullopt;
  ManifestBody body{.layers = {}, .cell_edge_m = *edge};
  for (const json& layer : *layers) {
    if (!layer.is_array()) return std::nullopt;
    std::vector<std::string> rows;
    for (const json& row : layer) {
      if (!row.is_string()) return std::nullopt;
      rows.push_back(row.get<std::string>());
    }
    body.layers.push_back(std::move(rows));
  }
  return body;
}

/// What must be equal for two bodies to be driven alike. Keys that have no meaning in a mode are left out: one model writes them
/// all the same, the other does not.
std::string drive_of(const json& drive) {
  std::map<std::string, std::string> same;
  const auto take = [&](std::initializer_list<const char*> keys) {
    for (const char* key : keys)
      if (const auto found = drive.find(key); found != drive.end()) same[key] = same_value(*found);
  };
  const std::string mode = text_of(drive, "mode");
  take({"mode", "pressure_Pa", "frequency_Hz", "ramp_s"});
  if (mode == "antiphase") take({"material_phase"});
  if (mode == "wave") take({"wave_axis", "wave_periods_per_body", "wave_over_gaps"});
  const auto frequency_Hz = number_of(drive, "frequency_Hz");
  if (!same.contains("ramp_s") && frequency_Hz && *frequency_Hz > 0.0) same["ramp_s"] = same_number(1.0 / *frequency_Hz);
  return joined(same);
}

/// The largest of the numbers of a list.
std::optional<double> highest_in(const json& table, const char* key) {
  const auto list = table.find(key);
  if (list == table.end() || !list->is_array()) return std::nullopt;
  std::optional<double> highest;
  for (const json& value : *list)
    if (value.is_number()) highest = std::max(highest.value_or(value.get<double>()), value.get<double>());
  return highest;
}

/// The law of a study of finite elements, with what changes its moduli.
std::string law_of_material(const json& material) {
  const json* law = object_of(material, "law");
  if (law == nullptr) return {};
  std::map<std::string, std::string> parts;
  for (const auto& [key, value] : law->items()) parts[key] = same_value(value);
  if (const auto factor = number_of(material, "modulus_factor"); factor && *factor != 1.0)
    parts["modulus_factor"] = same_number(*factor);
  if (const auto modulus = number_of(material, "youngs_modulus_Pa")) parts["youngs_modulus_Pa"] = same_number(*modulus);
  return joined(parts);
}

/// A law on one line of TOML, as parameters of a surrogate hold it; empty for other texts.
std::string law_of_line(const std::string& line) {
  std::map<std::string, std::string> parts;
  std::size_t begin = 0;
  int depth = 0;
  for (std::size_t at = 0; at <= line.size(); ++at) {
    if (at < line.size() && line[at] == '[') ++depth;
    if (at < line.size() && line[at] == ']') --depth;
    if (at < line.size() && (line[at] != ',' || depth > 0)) continue;
    const std::string part = line.substr(begin, at - begin);
    begin = at + 1;
    const std::size_t sign = part.find('=');
    const std::size_t first = part.find_first_not_of(' ');
    if (sign == std::string::npos || first >= sign) return {};
    const json value = json::parse(part.substr(sign + 1), nullptr, false);
    if (value.is_discarded()) return {};
    parts[part.substr(first, part.find_last_not_of(' ', sign - 1) + 1 - first)] = same_value(value);
  }
  return joined(parts);
}

std::string first_text(const json& parameters, std::initializer_list<Way> tables, const char* key) {
  for (const Way& way : tables) {
    const json* table = table_at(parameters, way);
    if (table == nullptr) continue;
    if (std::string text = text_of(*table, key); !text.empty()) return text;
  }
  return {};
}

std::optional<double> first_number(const json& parameters, std::initializer_list<Way> tables, const char* key) {
  for (const Way& way : tables) {
    const json* table = table_at(parameters, way);
    if (table == nullptr) continue;
    if (const auto number = number_of(*table, key)) return number;
  }
  return std::nullopt;
}

template <class Value>
bool agree(const std::optional<Value>& a, const std::optional<Value>& b) {
  constexpr double largest_difference = 1e-9;
  return !a || !b || std::abs(*a - *b) <= largest_difference * std::max(std::abs(*a), std::abs(*b));
}

bool agree(const std::string& a, const std::string& b) { return a.empty() || b.empty() || a == b; }

}  // namespace

StatedRun stated_run(const json& parameters) {
  StatedRun run;
  if (!parameters.is_object()) return run;
  if (const json* design = object_of(parameters, "design")) run.body = body_of(*design);
  run.wall_thickness_m = first_number(
      parameters,
      {{"design"}, {"body"}, {"surrogate"}, {"surrogate", "values", "holds_for"}, {"surrogate", "parameters", "holds_for"}},
      "wall_thickness_m");
  run.chambers = first_text(
      parameters,
      {{"design"}, {"body"}, {"surrogate"}, {"surrogate", "values", "holds_for"}, {"surrogate", "parameters", "holds_for"}},
      "chambers");
  run.silicone = first_text(
      parameters, {{"surrogate"}, {"surrogate", "values", "holds_for"}, {"surrogate", "parameters", "holds_for"}}, "silicone");
  if (const json* material = object_of(parameters, "material")) run.law = law_of_material(*material);
  if (run.law.empty()) {
    run.law = law_of_line(
        first_text(parameters, {{"surrogate", "values", "holds_for"}, {"surrogate", "parameters", "holds_for"}}, "law"));
  }
  if (const json* supports = object_of(parameters, "supports")) run.supports = text_of(*supports, "kind");
  if (const json* elements = object_of(parameters, "elements")) {
    run.elements = text_of(*elements, "kind");
    run.fidelity = text_of(*elements, "fidelity");
  }
  if (const json* drive = object_of(parameters, "drive")) {
    run.drive = drive_of(*drive);
    run.highest_pressure_Pa = highest_in(*drive, "pressure_Pa");
    run.frequency_Hz = number_of(*drive, "frequency_Hz");
    const std::string mode = text_of(*drive, "mode");
    run.has_strokes = mode != "hold" && mode != "none";
  }
  run.static_friction = first_number(parameters, {{"ground"}}, "static_friction");
  run.kinetic_friction = first_number(parameters, {{"ground"}}, "kinetic_friction");
  return run;
}

bool compares_elements_of_search(const json& parameters) {
  if (!parameters.is_object() || text_of(parameters, "compare_with") != "search") return false;
  const json* evaluation = table_at(parameters, {"search", "evaluation"});
  return evaluation != nullptr && text_of(*evaluation, "model") != "voxels";
}

bool are_of_one_body(const StatedRun& a, const StatedRun& b) {
  return a.body && a.body == b.body && agree(a.wall_thickness_m, b.wall_thickness_m) && agree(a.chambers, b.chambers) &&
         agree(a.silicone, b.silicone) && agree(a.law, b.law);
}

bool are_one_walk(const StatedRun& a, const StatedRun& b) {
  return are_of_one_body(a, b) && a.drive == b.drive && agree(a.static_friction, b.static_friction) &&
         agree(a.kinetic_friction, b.kinetic_friction);
}

}  // namespace menger::evolution
