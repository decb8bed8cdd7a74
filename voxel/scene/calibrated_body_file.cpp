#include "voxel/scene/calibrated_body_file.h"

#include <cmath>
#include <string>

#include "io/study/installed_folders.h"
#include "io/text/number_text.h"
#include "io/text/range.h"
#include "meshes/design/hollow_body_file.h"
#include "voxel/model/surrogate_file.h"

namespace menger::voxel {
namespace {

/// Whether a body has parameters. A new one has none.
bool has_parameters(const CalibratedBody& body) { return body.parameters.cell_edge_m > 0.0; }

void describe_parameters(io::StudyVisitor& visitor, CalibratedBody& body) {
  const auto in_place = [&] {
    visitor.table({.name = "values", .help = "Voxel parameters, given here instead of in a file.", .earlier = "parameters"},
                  [&] { describe(visitor, body.parameters); });
  };
  const auto in_file = [&] {
    if (const io::TomlTable* table = visitor.source(); table != nullptr && table->is_table("parameters")) return in_place();
    std::filesystem::path file;
    visitor.path({.name = "parameters",
                  .help = "File of voxel parameters that menger calibrate wrote, or the name of some that come with menger: "
                          "dragon_skin_10_1cm for example.",
                  .example = "\"parameters.toml\"",
                  .data = io::parameter_data},
                 file);
    if (const io::TomlTable* table = visitor.source())
      body.parameters = table->reading("parameters", [&] { return read_surrogate(file); });
  };
  const auto keep = [] {};
  visitor.one_of({{"parameters", false, keep, in_file}, {"values", has_parameters(body), keep, in_place, "", true}},
                 "give the name of a file of voxel parameters, see menger calibrate");
}

/// Describes the properties that a file may require of the parameters.
void describe_expectations(io::StudyVisitor& visitor, const SurrogateParameters& parameters) {
  std::optional<double> wall_thickness_m;
  visitor.optional_number({"wall_thickness_m", "Thickness of the walls. It must be equal to that of the parameters.", "0.002"},
                          wall_thickness_m, io::positive());
  visitor.check(!wall_thickness_m || std::abs(*wall_thickness_m - parameters.wall_thickness_m) <= 1e-9 * *wall_thickness_m,
                "wall_thickness_m", "the parameters are calibrated for " + io::number_text(parameters.wall_thickness_m));
  std::optional<std::string> silicone;
  visitor.optional_text({"silicone", "Name of the silicone. It must be equal to that of the parameters.", "\"Dragon Skin 10\""},
                        silicone);
  visitor.check(!silicone || *silicone == parameters.silicone, "silicone",
                "the parameters are calibrated for " + io::toml_quoted(parameters.silicone));
}

}  // namespace

void describe(io::StudyVisitor& visitor, CalibratedBody& body) {
  describe_parameters(visitor, body);
  describe_expectations(visitor, body.parameters);
  std::optional<meshes::ChamberLayout> chambers;
  if (visitor.source() != nullptr)
    body.chambers = body.parameters.chambers;
  else if (has_parameters(body))
    chambers = body.chambers;
  visitor.optional_word({"chambers",
                         "Cells that share one chamber: all cells of a module, or each connected region of cells of one phase. "
                         "Without it, as in the fit.",
                         "\"single\""},
                        chambers, meshes::chamber_layout_words());
  body.chambers = chambers.value_or(body.chambers);
  visitor.word({"outside_range", "What happens if a run leaves the range of validity of the parameters."}, body.outside_range,
               io::words_of(OutsideRange::refuse, OutsideRange::warn));
}

std::optional<std::filesystem::path> parameters_file(const io::TomlTable& table) {
  const auto surrogate = table.optional_table("surrogate");
  return surrogate && surrogate->is_text("parameters")
             ? std::optional(io::file_or_data(*surrogate, "parameters", io::parameter_data))
             : std::nullopt;
}

}  // namespace menger::voxel
