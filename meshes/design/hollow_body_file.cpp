#include "meshes/design/hollow_body_file.h"

#include <vector>

#include "io/text/number_text.h"

namespace menger::meshes {
namespace {

template <class Value>
std::string word_of(Value value, const io::Words<Value>& words) {
  for (const auto& [word, meaning] : words) {
    if (meaning == value) return std::string(word);
  }
  return {};
}

TubeHole read_tube(const io::TomlTable& table) {
  TubeHole tube;
  const std::vector<double> cell = table.numbers("cell", io::within(0.0, 1e6));
  for (const double index : cell) {
    if (index != static_cast<double>(static_cast<int>(index))) throw table.error("cell", "must hold three integers");
  }
  if (cell.size() != 3) throw table.error("cell", "must hold three integers");
  tube.cell = {static_cast<int>(cell[0]), static_cast<int>(cell[1]), static_cast<int>(cell[2])};
  tube.side = table.word("side", side_words());
  tube.edge_m = table.number("edge_m", io::positive());
  return tube;
}

}  // namespace

const io::Words<ChamberLayout>& chamber_layout_words() {
  static const io::Words<ChamberLayout> words{{"single", ChamberLayout::single}, {"per-phase", ChamberLayout::per_phase}};
  return words;
}

const io::Words<LidPlace>& lid_place_words() {
  static const io::Words<LidPlace> words{{"none", LidPlace::none}, {"bottom", LidPlace::bottom}, {"top", LidPlace::top}};
  return words;
}

const io::Words<Side>& side_words() {
  static const io::Words<Side> words = [] {
    io::Words<Side> all;
    for (const Side side : all_sides) all.emplace_back(to_string(side), side);
    return all;
  }();
  return words;
}

HollowBodyOptions read_hollow_body_options(const io::TomlTable& table) {
  HollowBodyOptions options;
  options.wall_thickness_m = table.number_or("wall_thickness_m", options.wall_thickness_m, io::positive());
  options.elements_through_wall = table.integer_or("elements_through_wall", options.elements_through_wall, io::within(1, 1000));
  options.largest_element_m = table.optional_number("largest_element_m", io::positive());
  options.growth = table.number_or("growth", options.growth, io::at_least(1.0));
  options.chambers = table.word_or("chambers", options.chambers, chamber_layout_words());
  options.level = table.integer_or("level", options.level, io::within(1, 10));
  options.hole_edge_m = table.optional_number("hole_edge_m", io::positive());
  for (const io::TomlTable& tube : table.optional_tables("tubes")) options.tubes.push_back(read_tube(tube));
  options.lid = table.word_or("lid", options.lid, lid_place_words());
  options.joint_region = table.boolean_or("joint_region", options.joint_region);
  return options;
}

MeshStudy read_mesh_study(const std::filesystem::path& file) {
  const io::TomlTable table = io::read_toml(file);
  if (!table.has("design")) return {file, read_design(file), {}};
  MeshStudy study;
  study.design_file = table.path("design");
  study.options = read_hollow_body_options(table);
  table.finish();
  study.design = read_design(study.design_file);
  return study;
}

std::string hollow_body_text(const HollowBodyOptions& options) {
  std::string text;
  const auto add = [&](const std::string& key, const std::string& value) { text += key + " = " + value + "\n"; };
  add("wall_thickness_m", io::number_text(options.wall_thickness_m));
  add("elements_through_wall", std::to_string(options.elements_through_wall));
  if (options.largest_element_m) add("largest_element_m", io::number_text(*options.largest_element_m));
  add("growth", io::number_text(options.growth));
  add("chambers", io::toml_quoted(word_of(options.chambers, chamber_layout_words())));
  add("level", std::to_string(options.level));
  if (options.hole_edge_m) add("hole_edge_m", io::number_text(*options.hole_edge_m));
  add("lid", io::toml_quoted(word_of(options.lid, lid_place_words())));
  add("joint_region", options.joint_region ? "true" : "false");
  // Inline, so that the text can stand inside a table of another file.
  if (!options.tubes.empty()) {
    std::string tubes;
    for (const TubeHole& tube : options.tubes) {
      const CellIndex& cell = tube.cell;
      tubes += (tubes.empty() ? "{cell = [" : ", {cell = [") + std::to_string(cell.x) + ", " + std::to_string(cell.y) + ", " +
               std::to_string(cell.z) + "], side = " + io::toml_quoted(to_string(tube.side)) +
               ", edge_m = " + io::number_text(tube.edge_m) + "}";
    }
    add("tubes", "[" + tubes + "]");
  }
  return text;
}

}  // namespace menger::meshes
