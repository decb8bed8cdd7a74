#include "meshes/design/hollow_body_file.h"

#include <vector>

#include "io/study/study_reader.h"
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

void describe(io::StudyVisitor& visitor, TubeHole& tube) {
  std::vector<int> cell{tube.cell.x, tube.cell.y, tube.cell.z};
  visitor.integers({"cell", "The cell: its place along x, y and z, from 0.", "[0, 0, 0]"}, cell, io::within(0.0, 1e6),
                   {.fewest = 3, .most = 3});
  if (cell.size() == 3) tube.cell = {cell[0], cell[1], cell[2]};
  visitor.word({"side", "Side of the cell on which the hole opens.", "\"z max\""}, tube.side, side_words());
  visitor.number({"edge_m", "Edge of the square hole.", "0.002"}, tube.edge_m, io::positive());
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

void describe(io::StudyVisitor& visitor, HollowBodyOptions& options) {
  visitor.number({"wall_thickness_m", "Thickness of every outer wall."}, options.wall_thickness_m, io::positive());
  visitor.integer({"elements_through_wall", "Least number of elements through a wall."}, options.elements_through_wall,
                  io::within(1, 1000));
  visitor.optional_number({"largest_element_m", "Edge that elements may grow to away from walls.", "0.005"},
                          options.largest_element_m, io::positive());
  visitor.number({"growth", "Largest ratio of neighbouring edges while they grow."}, options.growth, io::at_least(1.0));
  visitor.word({"chambers", "Whether all cells of a module share one chamber, or those of each phase."}, options.chambers,
               chamber_layout_words());
  visitor.integer({"level", "Level of the fractal: 1 is the design itself, in 2 each cell is a copy of it."}, options.level,
                  io::within(1, 10));
  visitor.optional_number({"hole_edge_m", "Edge of the square holes between chambers of neighbouring modules.", "0.002"},
                          options.hole_edge_m, io::positive());
  visitor.tables({"tubes", "Holes for supply tubes."}, options.tubes, [&](TubeHole& tube) { describe(visitor, tube); });
  visitor.word({"lid", "Wall of every module that is a region of its own, \"lid\"."}, options.lid, lid_place_words());
  visitor.boolean({"joint_region", "Whether bonded walls are a region of their own, \"joint\"."}, options.joint_region);
}

HollowBodyOptions read_hollow_body_options(const io::TomlTable& table) {
  HollowBodyOptions options;
  io::StudyReader reader(table);
  describe(reader, options);
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
