#include "evolution/page/input_table.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>

#include "evolution/outputs/json_parts.h"
#include "evolution/outputs/report_numbers.h"
#include "evolution/page/chamber_names.h"
#include "io/shown/shown_column.h"
#include "io/shown/shown_quantity.h"
#include "io/text/content_hash.h"
#include "io/text/formatted.h"
#include "io/text/input_error.h"
#include "io/text/is_file.h"
#include "io/text/joined_text.h"
#include "io/text/toml_document.h"
#include "materials/laws/silicone_record.h"

namespace menger::evolution {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// The values of one input with the runs that have it, in the order in which they are met.
struct InputRow {
  std::string name;
  std::vector<std::pair<std::string, std::vector<std::string>>> values{};
};

/// The rows of the table in a fixed order, whatever order results come in.
class InputRows {
 public:
  void add(const std::string& name, const std::string& value, const std::string& place) {
    if (value.empty()) return;
    auto row = std::ranges::find(rows_, name, &InputRow::name);
    if (row == rows_.end()) row = rows_.insert(rows_.end(), InputRow{.name = name});
    auto known = std::ranges::find(row->values, value, &std::pair<std::string, std::vector<std::string>>::first);
    if (known == row->values.end()) known = row->values.insert(row->values.end(), {value, {}});
    if (std::ranges::find(known->second, place) == known->second.end()) known->second.push_back(place);
  }

  [[nodiscard]] std::vector<std::vector<std::string>> texts(const std::vector<std::string>& order) const {
    std::vector<std::vector<std::string>> lines;
    for (const std::string& name : order)
      if (const auto row = std::ranges::find(rows_, name, &InputRow::name); row != rows_.end())
        lines.push_back({name, text_of_values(*row)});
    return lines;
  }

 private:
  static std::string text_of_values(const InputRow& row) {
    if (row.values.size() == 1) return row.values.front().first;
    constexpr std::size_t most_values = 4;
    constexpr std::size_t most_places = 3;
    std::vector<std::string> texts;
    for (const auto& [value, places] : row.values) {
      if (texts.size() == most_values) break;
      std::vector<std::string> shown(places.begin(),
                                     places.begin() + static_cast<std::ptrdiff_t>(std::min(most_places, places.size())));
      if (places.size() > most_places) shown.emplace_back("...");
      texts.push_back(value + " (" + io::joined(shown) + ")");
    }
    std::string text = io::joined(texts, "; ");
    if (row.values.size() > most_values) text += "; " + std::to_string(row.values.size() - most_values) + " more";
    return text;
  }

  std::vector<InputRow> rows_;
};

std::string range_text(const json& table, const char* key) {
  const auto list = table.find(key);
  if (list == table.end() || !list->is_array() || list->size() != 2 || !list->at(0).is_number() || !list->at(1).is_number())
    return {};
  return shown_number(1e-3 * list->at(0).get<double>()) + " to " + io::kilopascals(list->at(1).get<double>());
}

std::string body_text(const CommandOutput& output) {
  if (!output.stated.body) return {};
  const auto& layers = output.stated.body->layers;
  std::size_t cells = 0;
  for (const auto& rows : layers)
    for (const std::string& row : rows) cells += row.size() - static_cast<std::size_t>(std::ranges::count(row, '0'));
  const std::size_t along_y = layers.empty() ? 0 : layers.front().size();
  const std::size_t along_x = along_y == 0 ? 0 : layers.front().front().size();
  return (output.body_name.empty() ? "" : output.body_name + ": ") + std::to_string(cells) + (cells == 1 ? " cell" : " cells") +
         " in " + std::to_string(along_x) + " x " + std::to_string(along_y) + " x " + std::to_string(layers.size());
}

/// Which chambers are of which material.
std::string regions_text(const CommandOutput& output) {
  const std::string chambers = ChamberNames(output).all();
  return "one for each region of cells of one material" + (chambers.empty() ? "" : ": " + chambers);
}

std::string with_spaces(std::string text) {
  std::ranges::replace(text, '_', ' ');
  return text;
}

/// "neo hookean, shear modulus 39.4 kPa"
std::string law_text(const json& material) {
  const json* law = object_of(material, "law");
  if (law == nullptr) return {};
  std::string text = with_spaces(text_of(*law, "name"));
  for (const auto& [key, value] : law->items()) {
    const io::ShownColumn column = io::shown_column(key);
    const auto number = [&](const json& one) { return one.is_number() ? shown_number(column.factor * one.get<double>()) : ""; };
    std::vector<std::string> numbers;
    if (value.is_number()) numbers.push_back(number(value));
    if (value.is_array())
      for (const json& one : value) numbers.push_back(number(one));
    if (!numbers.empty())
      text += ", " + column.quantity + " " + io::joined(numbers, " and ") + (column.unit.empty() ? "" : " " + column.unit);
  }
  if (const auto factor = number_of(material, "modulus_factor"); factor && *factor != 1.0)
    text += ", all moduli times " + shown_number(*factor);
  return text;
}

/// Whether a law of a record has the numbers of a law in a manifest.
bool is_law(const io::TomlTable& law, const json& stated) {
  for (const auto& [key, value] : stated.items()) {
    if (!law.has(key)) return false;
    if (value.is_string() && law.text(key) != value.get<std::string>()) return false;
    if (value.is_number() && law.number(key) != value.get<double>()) return false;
    if (value.is_array() && json(law.numbers(key)) != value) return false;
  }
  return true;
}

/// What a record says of the law that a run took from it.
struct LawSource {
  std::string silicone;
  std::string source;  ///< empty if the law is none of the record
  std::string others;  ///< how stiff the other laws of the record are
};

LawSource source_in(const fs::path& file, const json& law) {
  const io::TomlTable whole = io::read_toml(file);
  const materials::SiliconeRecord record = materials::read_silicone(file);
  std::vector<io::TomlTable> tables{whole.table("recommended")};
  for (io::TomlTable& other : whole.optional_tables("others")) tables.push_back(std::move(other));
  std::vector<materials::SourcedLaw> laws{record.recommended};
  laws.insert(laws.end(), record.others.begin(), record.others.end());
  LawSource found{.silicone = record.name, .source = {}, .others = {}};
  const auto used = std::ranges::find_if(tables, [&](const io::TomlTable& table) { return is_law(table.table("law"), law); });
  if (used == tables.end()) return found;
  found.source = used->text("source");
  const auto number = static_cast<std::size_t>(used - tables.begin());
  if (laws.size() < 2 || laws.size() != tables.size()) return found;
  const double own_Pa = materials::shear_modulus_at_rest_Pa(laws[number].law);
  const auto times = [&](const materials::SourcedLaw& one) {
    return io::shown(materials::shear_modulus_at_rest_Pa(one.law) / own_Pa, 2);
  };
  laws.erase(laws.begin() + static_cast<std::ptrdiff_t>(number));
  const auto [softest, stiffest] = materials::softest_and_stiffest(laws);
  found.others = std::to_string(laws.size()) + " more, with " + times(softest) +
                 (laws.size() == 1 ? "" : " to " + times(stiffest)) + " times its shear modulus at rest";
  return found;
}

/// The source of the law of a run: its record, if it is still where the run read it, and still the same.
std::optional<LawSource> law_source(const CommandOutput& output, const json& law, const fs::path& folder) {
  for (const auto& [name, hash] : output.inputs) {
    const fs::path named(name);
    if (named.extension() != ".toml") continue;
    for (const fs::path& file : {named, folder / named}) {
      try {
        if (!io::is_file(file) || io::file_hash(file) != hash || !io::read_toml(file).has("recommended")) continue;
        return source_in(file, law);
      } catch (const io::InputError&) {
        continue;  // another input file
      }
    }
  }
  return std::nullopt;
}

std::string damping_text(const json& material) {
  if (const auto factors = material.find("loss_factors"); factors != material.end() && factors->is_array()) {
    std::vector<std::string> points;
    const json frequencies_Hz = material.value("loss_frequencies_Hz", json::array());
    for (std::size_t n = 0; n < factors->size() && n < frequencies_Hz.size(); ++n) {
      if ((*factors)[n].is_number() && frequencies_Hz[n].is_number())
        points.push_back(shown_number((*factors)[n].get<double>()) + " at " + shown_number(frequencies_Hz[n].get<double>()) +
                         " Hz");
    }
    return io::joined(points);
  }
  const auto factor = number_of(material, "loss_factor");
  if (!factor) return {};
  std::string text = shown_number(*factor);
  if (const auto frequency_Hz = number_of(material, "loss_frequency_Hz")) text += " at " + shown_number(*frequency_Hz) + " Hz";
  return text;
}

/// How often and how a drive swings; empty if it does not.
std::string strokes_text(const json& drive) {
  const auto frequency_Hz = number_of(drive, "frequency_Hz");
  if (!frequency_Hz || text_of(drive, "mode") == "hold") return {};
  std::string text = shown_number(*frequency_Hz) + " Hz, a sine";
  const double strokes = number_of(drive, "ramp_s").value_or(1.0 / *frequency_Hz) * *frequency_Hz;
  if (strokes == 0.0) return text;
  constexpr double tolerance = 1e-6;
  return text + ", which grows from 0 over the first " +
         (std::abs(strokes - 1.0) < tolerance ? "stroke" : shown_number(strokes) + " strokes");
}

/// "in phase", "held at 12 kPa"
std::string mode_text(const json& drive) {
  const std::string mode = text_of(drive, "mode");
  const auto pressures = drive.find("pressure_Pa");
  if (mode == "hold" && pressures != drive.end() && pressures->is_array() && !pressures->empty() && pressures->back().is_number())
    return "held at " + io::kilopascals(pressures->back().get<double>());
  if (mode == "antiphase") return "antiphase: chambers of material 2 half a stroke after those of material 1";
  return with_spaces(mode);
}

/// How a body is held where it is inflated.
std::string supports_text(const std::string& kind) {
  if (kind == "free") return "free, only its rigid motions are held";
  if (kind == "ground_guided") return "slides on the ground, which it does not leave";
  if (kind == "ground_held") return "held on the ground";
  if (kind == "resting") return "rests on the ground by its weight";
  return with_spaces(kind);
}

/// The voxel parameters of a run: where they come from.
std::string parameters_text(const CommandOutput& output) {
  if (const std::string file = parameters_of_menger(output); !file.empty()) return file + ", which came with menger";
  for (const auto& [name, hash] : output.inputs)
    if (fs::path(name).filename() == "parameters.toml") return name;
  return {};
}

}  // namespace

PageTable input_table(const std::vector<CommandOutput>& outputs, const fs::path& folder) {
  InputRows rows;
  for (const CommandOutput& output : outputs) {
    const std::string place = output.name.empty() ? "." : output.name;
    const std::string command = command_of(output);
    // The load case that a loop validates its robot with; others state their own supports.
    if (command == "validate" && io::is_file(output.folder / "curves/robot_inflation.toml"))
      rows.add("supports", supports_text("free"), place);
    const auto add = [&](const char* name, const std::string& value) { rows.add(name, value, place); };
    if (command == "validate") add("parameters of the surrogate", parameters_text(output));
    if (command != "inflate" && command != "locomote" && command != "simulate" && &output != loop_of(outputs)) continue;
    const json parameters = json::parse(output.parameters, nullptr, false);
    if (!parameters.is_object()) continue;
    add("body", body_text(output));
    if (output.stated.body) add("edge of a cell", io::millimetres(output.stated.body->cell_edge_m));
    if (output.stated.wall_thickness_m) add("thickness of walls", io::millimetres(*output.stated.wall_thickness_m));
    if (output.stated.chambers == "single") add("chambers", "one, which all cells share");
    if (output.stated.chambers == "per-phase") add("chambers", regions_text(output));
    add("silicone", output.stated.silicone);
    if (const json* material = object_of(parameters, "material")) {
      add("law", law_text(*material));
      if (const json* law = object_of(*material, "law")) {
        if (const auto source = law_source(output, *law, folder)) {
          add("silicone", source->silicone);
          add("source of the law", source->source);
          add("other laws in its record", source->others);
        }
      }
      add("loss factor (damping)", damping_text(*material));
    }
    if (const json* drive = object_of(parameters, "drive")) {
      // The robot of a loop has a drive also where it is only inflated.
      if (text_of(*drive, "mode") != "hold") add("pressure of the drive", range_text(*drive, "pressure_Pa"));
      if (output.robot_walks) add("strokes", strokes_text(*drive));
      add("mode of the drive", mode_text(*drive));
    }
    if (command == "loop") continue;
    if (output.stated.static_friction && output.stated.kinetic_friction)
      add("friction on the ground", shown_number(*output.stated.static_friction) + " at rest, " +
                                        shown_number(*output.stated.kinetic_friction) + " sliding");
    if (command == "inflate") add("supports", supports_text(output.stated.supports));
    if (const json* elements = object_of(parameters, "elements")) {
      const std::string fidelity = text_of(*elements, "fidelity");
      add("finite elements", with_spaces(text_of(*elements, "kind")) + (fidelity.empty() ? "" : ", " + fidelity));
    }
    if (output.is_calibrated) add("parameters of the surrogate", parameters_text(output));
  }
  PageTable table{.title = "What was computed",
                  .columns = {"input", "value"},
                  .rows = rows.texts({"body", "edge of a cell", "thickness of walls", "chambers", "silicone", "law",
                                      "source of the law", "other laws in its record", "loss factor (damping)",
                                      "pressure of the drive", "strokes", "mode of the drive", "supports",
                                      "friction on the ground", "finite elements", "parameters of the surrogate"}),
                  .note =
                      "From the manifests of the robot, its inflations, walks and validations. Friction of silicone is hardly "
                      "measured, nor is damping of "
                      "most; the manifests say what is assumed."};
  return table;
}

}  // namespace menger::evolution
