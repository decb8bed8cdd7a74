#include "meshes/robot/starting_points.h"

#include <array>

#include "io/study/study_reader.h"
#include "io/study/study_template.h"
#include "io/text/toml_document.h"
#include "meshes/robot/robot_file.h"

namespace menger::meshes {
namespace {

constexpr std::array points{
    StartingPoint{"crawler", "a plate with a heel, which crawls: two of its lengths in 5 s on finite elements", R"(
[robot]
layers = [["100", "100", "100"], ["111", "111", "111"]]
cell_edge_m = 0.01
silicone = "dragon_skin_10"
)"},
    StartingPoint{"table", "a table on two legs; chance decides where it goes, as of bodies that are alike to both sides", R"(
[robot]
layers = [["000", "101", "000"], ["111", "111", "111"]]
cell_edge_m = 0.01
silicone = "dragon_skin_10"
)"},
    StartingPoint{"quadruped", "a plate on four feet, the paper's kind of walker; as it is, it does not walk on finite elements",
                  R"(
[robot]
layers = [["101", "000", "101"], ["111", "111", "111"]]
cell_edge_m = 0.01
silicone = "dragon_skin_10"
)"},
    StartingPoint{"trotter",
                  "four legs of two phases, of which those across from each other move together: it walks alike in both models",
                  R"(
[robot]
layers = [["1002", "0000", "2001"], ["1122", "1122", "2211"]]
cell_edge_m = 0.01
silicone = "dragon_skin_10"
chambers = "per-phase"
[drive]
mode = "antiphase"
pressure_Pa = [0, 5000]
)"},
    StartingPoint{"finger",
                  "a finger: a bar of nine cells with bellows on top, whose end bends 17 mm sideways at 12 kPa (14 mm on thin "
                  "walls), of which a "
                  "softer silicone bears less; it does not walk",
                  R"(
[robot]
layers = [["111111111"], ["101010101"]]
cell_edge_m = 0.01
silicone = "dragon_skin_10"
[drive]
mode = "hold"
pressure_Pa = [0, 12000]
[walk]
present = false
)"},
    StartingPoint{"menger", "the Menger sponge, 20 cells", R"(
[robot]
layers = [["111", "101", "111"], ["101", "000", "101"], ["111", "101", "111"]]
cell_edge_m = 0.01
silicone = "dragon_skin_10"
)"},
    StartingPoint{"evolve", "no body yet: a search on finite elements finds one that walks (a quarter of an hour)", R"(
[robot]
design = "evolve"
cell_edge_m = 0.01
silicone = "dragon_skin_10"
[search]
)"},
};

/// Writes the layers of a body below one another, as design files have them.
/// @param design a copy from before the template: this shows other ways to give the body, with bodies of their own
std::string with_drawn_layers(std::string text, const Design& design) {
  const std::size_t start = text.find("\nlayers = [") + 1;
  if (start == 0) return text;  // std::string::npos + 1
  const std::string drawn = design_text(design);
  return text.replace(start, text.find('\n', start) + 1 - start, drawn.substr(drawn.find("layers = [")));
}

}  // namespace

std::span<const StartingPoint> starting_points() { return points; }

std::string robot_template(const StartingPoint& start, const std::string& robot_name) {
  Robot robot;
  io::read_described(io::parse_toml(start.changes, "starting point"), robot);
  robot.design.name = robot_name;
  const Design design = robot.design;
  io::StudyTemplateWriter writer;
  writer.keep_values();
  describe(writer, robot);
  return "# A robot of silicone, begun from " + std::string(start.name) + ": " + std::string(start.purpose) +
         ".\n#   menger loop robot.toml      computes what this file asks for, and writes results/\n"
         "# Lengths are in metres, pressures in pascals (1 kPa = 1000 Pa). What stands behind a # is not used; remove the # to "
         "use it.\n\n" +
         with_drawn_layers(writer.text(), design);
}

}  // namespace menger::meshes
