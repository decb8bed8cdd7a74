#include "meshes/design/hollow_body_file.h"

#include <vector>

#include "io/study/study_reader.h"
#include "io/study/study_text.h"
#include "io/text/number_text.h"

namespace menger::meshes {
namespace {

void describe(io::StudyVisitor& visitor, TubeHole& tube) {
  std::vector<int> cell{tube.cell.x, tube.cell.y, tube.cell.z};
  visitor.integers({"cell", "Place of the cell along x, y and z, counted from 0.", "[0, 0, 0]"}, cell, io::within(0.0, 1e6),
                   {.fewest = 3, .most = 3});
  if (cell.size() == 3) tube.cell = {cell[0], cell[1], cell[2]};
  visitor.word({"side", "Side of the cell on which the hole opens.", "\"z max\""}, tube.side, side_words());
  visitor.number({"edge_m", "Edge of the square hole.", "0.002"}, tube.edge_m, io::positive());
}

void describe_elements(io::StudyVisitor& visitor, HollowBodyOptions& options) {
  visitor.integer({"elements_through_wall", "Least number of elements through a wall."}, options.elements_through_wall,
                  io::within(1, 1000));
  visitor.optional_number({"largest_element_m", "Largest edge of elements away from walls.", "0.005"}, options.largest_element_m,
                          io::positive());
  visitor.number({"growth", "Largest ratio of the edges of neighbouring elements where they grow."}, options.growth,
                 io::at_least(1.0));
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

void describe(io::StudyVisitor& visitor, HollowBodyOptions& options, std::optional<bool> are_elements_free) {
  visitor.number({"wall_thickness_m", "Thickness of every outer wall."}, options.wall_thickness_m, io::positive());
  const auto describe_own = [&] { describe_elements(visitor, options); };
  if (are_elements_free)
    visitor.only_if(*are_elements_free, "elements.kind = \"three_field\"", describe_own);
  else
    describe_own();
  visitor.word(
      {"chambers", "Cells that share one chamber: all cells of a module, or each connected region of cells of one phase."},
      options.chambers, chamber_layout_words());
  visitor.integer({"level", "Level of the fractal: 1 is the design itself, at 2 each cell is a copy of the design."},
                  options.level, io::within(1, 10));
  visitor.optional_number({"hole_edge_m", "Edge of the square holes between chambers of neighbouring modules.", "0.002"},
                          options.hole_edge_m, io::positive());
  visitor.tables({"tubes", "Holes for supply tubes."}, options.tubes, [&](TubeHole& tube) { describe(visitor, tube); });
  visitor.word({"lid", "Wall of every module that is a separate region, called \"lid\"."}, options.lid, lid_place_words());
  visitor.boolean({"joint_region", "Whether bonded walls are a separate region, called \"joint\"."}, options.joint_region);
}

void describe(io::StudyVisitor& visitor, MeshStudy& study) {
  const io::TomlTable* table = visitor.source();
  visitor.check(table == nullptr || !table->is_text("design"), "design",
                "is a table now: give this name as file in [design]. The keys of walls and elements also stand in [design]");
  visitor.table({"design", "Design, and how it is made hollow and meshed."}, [&] {
    describe_design(visitor, study.design, study.design_file);
    describe(visitor, study.options);
  });
}

MeshStudy read_mesh_study(const std::filesystem::path& file) {
  const io::TomlTable table = io::read_toml(file);
  if (!table.has("design")) return {file, read_design(file), {}};
  MeshStudy study;
  io::read_described(table, study);
  return study;
}

std::string hollow_body_text(const HollowBodyOptions& options, std::string_view table) {
  HollowBodyOptions described = options;
  io::StudyTextWriter writer(table);
  describe(writer, described);
  return writer.text();
}

}  // namespace menger::meshes
