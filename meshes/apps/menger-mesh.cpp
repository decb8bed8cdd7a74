#include <CLI/CLI.hpp>
#include <chrono>
#include <filesystem>
#include <iostream>
#include <map>
#include <optional>
#include <string>

#include "io/process/exit_code.h"
#include "io/process/program.h"
#include "io/process/study_help.h"
#include "io/study/study_text.h"
#include "io/text/content_hash.h"
#include "io/text/input_error.h"
#include "io/text/manifest.h"
#include "io/text/number_text.h"
#include "io/text/whole_file.h"
#include "meshes/design/hollow_body_file.h"
#include "meshes/files/gmsh_mesh.h"
#include "meshes/files/vtu_mesh.h"
#include "meshes/hexahedra/hollow_polycube.h"
#include "meshes/hexahedra/mesh_quality.h"
#include "meshes/robot/command_study.h"
#include "meshes/robot/robot_file.h"

namespace {

using namespace menger;

struct Arguments {
  std::filesystem::path input;
  std::filesystem::path output;
  std::optional<double> length_unit_m;
  std::optional<double> wall_thickness_m;
  std::optional<int> elements_through_wall;
  std::optional<double> largest_element_m;
  std::optional<double> growth;
  std::optional<std::string> chambers;
  std::optional<int> level;
  std::optional<double> hole_edge_m;
  std::optional<std::string> lid;
  bool joint_region = false;
};

template <class Value>
std::map<std::string, Value> word_map(const io::Words<Value>& words) {
  return {words.begin(), words.end()};
}

std::optional<int> parse(int argc, const char* const* argv, Arguments& arguments) {
  CLI::App app("Meshes a design as a hollow silicone body, or checks and converts a mesh of Gmsh.", "menger mesh");
  app.footer(
      "Example:\n  menger mesh meshes/designs/stand18.toml --elements-through-wall 2 --largest-element-m 0.002 -o stand18.vtu\n"
      "writes stand18.vtu (open it in ParaView), stand18_quality.csv and stand18_manifest.json.\n"
      "The input is a design, or a study with a table [design]. This table names a design file or contains the design. It can\n"
      "also have the options above, with underscores (wall_thickness_m = 0.002), and tube holes. --template prints a study.\n"
      "A mesh of Gmsh (.msh) is read with its physical names: surfaces called chamber... are chambers, surfaces called\n"
      "symmetry... are planes of symmetry. Exit codes: 0 done, 2 wrong input.");
  io::add_study_help(app, [](io::StudyVisitor& visitor) {
    meshes::MeshStudy study;
    describe(visitor, study);
  });
  app.add_option("input", arguments.input,
                 "design, mesh study or robot (TOML; of a robot its folder, too), or mesh of Gmsh (.msh)")
      ->required();
  app.add_option("-o,--output", arguments.output, "mesh to write (default: the name of the input with .vtu, here)");
  app.add_option("--wall-thickness-m", arguments.wall_thickness_m, "thickness of every wall (default: 0.002)");
  app.add_option("--elements-through-wall", arguments.elements_through_wall, "elements through every wall (default: 1)");
  app.add_option("--largest-element-m", arguments.largest_element_m,
                 "largest edge of elements away from walls (default: as in the wall)");
  app.add_option("--growth", arguments.growth,
                 "largest ratio of the edges of neighbouring elements where they grow (default: 1.5)");
  app.add_option("--chambers", arguments.chambers,
                 "single (default): one chamber for each module; per-phase: one for each region")
      ->check(CLI::IsMember(word_map(meshes::chamber_layout_words())));
  app.add_option("--level", arguments.level, "level of the fractal (default: 1)");
  app.add_option("--hole-edge-m", arguments.hole_edge_m, "edge of square holes that join the chambers of neighbouring modules");
  app.add_option("--lid", arguments.lid, "wall of every module that is a separate region: none (default), bottom, top")
      ->check(CLI::IsMember(word_map(meshes::lid_place_words())));
  app.add_flag("--joint-region", arguments.joint_region, "make the bonded walls between modules a separate region");
  app.add_option("--length-unit-m", arguments.length_unit_m, "metres per unit of a mesh of Gmsh (default: 1)");
  return io::parse_arguments(app, argc, argv);
}

void override_options(const Arguments& arguments, meshes::HollowBodyOptions& options) {
  if (arguments.wall_thickness_m) options.wall_thickness_m = *arguments.wall_thickness_m;
  if (arguments.elements_through_wall) options.elements_through_wall = *arguments.elements_through_wall;
  if (arguments.largest_element_m) options.largest_element_m = arguments.largest_element_m;
  if (arguments.growth) options.growth = *arguments.growth;
  if (arguments.chambers) options.chambers = word_map(meshes::chamber_layout_words()).at(*arguments.chambers);
  if (arguments.level) options.level = *arguments.level;
  if (arguments.hole_edge_m) options.hole_edge_m = arguments.hole_edge_m;
  if (arguments.lid) options.lid = word_map(meshes::lid_place_words()).at(*arguments.lid);
  if (arguments.joint_region) options.joint_region = true;
}

bool has_design_options(const Arguments& arguments) {
  return arguments.wall_thickness_m || arguments.elements_through_wall || arguments.largest_element_m || arguments.growth ||
         arguments.chambers || arguments.level || arguments.hole_edge_m || arguments.lid || arguments.joint_region;
}

struct MeshToWrite {
  meshes::HexahedralMesh mesh;
  meshes::MeshQuality quality;
};

MeshToWrite convert(const Arguments& arguments, io::Manifest& manifest) {
  const double unit_m = arguments.length_unit_m.value_or(1.0);
  if (!(unit_m > 0.0 && unit_m < 1e6)) throw io::InputError("--length-unit-m " + io::number_text(unit_m) + ": must be > 0");
  manifest.parameters = "length_unit_m = " + io::number_text(unit_m) + "\n";
  meshes::HexahedralMesh mesh = meshes::read_gmsh_mesh(arguments.input, unit_m);
  const meshes::MeshQuality quality = meshes::mesh_quality(mesh);
  return {std::move(mesh), quality};
}

MeshToWrite mesh_design(const Arguments& arguments, io::Manifest& manifest) {
  meshes::MeshStudy study = meshes::read_mesh_study(arguments.input);
  override_options(arguments, study.options);
  if (study.design_file && *study.design_file != arguments.input) io::note_input(manifest.inputs, *study.design_file);
  manifest.parameters = io::described_text(study);
  try {
    meshes::HollowBody body = meshes::hollow_polycube(study.design, study.options);
    const meshes::MeshQuality quality = meshes::mesh_quality(body);
    if (study.options.hole_edge_m && body.hole_count == 0)
      std::cout << "note: hole_edge_m made no hole, because no two chambers of neighbouring modules that may be joined touch\n";
    return {std::move(body.mesh), quality};
  } catch (const io::InputError& error) {
    throw io::InputError(arguments.input.string() + ": " + error.what());
  }
}

int run(int argc, const char* const* argv) {
  Arguments arguments;
  if (const auto code = parse(argc, argv, arguments)) return *code;
  arguments.input = meshes::robot_file_in(arguments.input);
  const bool is_gmsh = arguments.input.extension() == ".msh";
  if (is_gmsh && has_design_options(arguments))
    throw io::InputError(arguments.input.string() + ": options of a design do not apply to a mesh of Gmsh");
  if (!is_gmsh && arguments.length_unit_m) throw io::InputError("--length-unit-m: applies to a mesh of Gmsh (.msh) only");
  if (!is_gmsh) {
    const bool is_robot = meshes::is_robot_file(arguments.input);
    const meshes::CommandStudy command = meshes::command_study(arguments.input, meshes::RobotStudy::mesh,
                                                               arguments.output.parent_path() / arguments.output.stem());
    arguments.input = command.study;
    if (is_robot && arguments.output.empty()) arguments.output = command.folder / "mesh.vtu";
  }
  if (arguments.output.empty()) arguments.output = arguments.input.stem().string() + ".vtu";
  if (arguments.output.extension() != ".vtu") throw io::InputError(arguments.output.string() + ": the output must end in .vtu");
  const auto start = std::chrono::steady_clock::now();

  io::Manifest manifest;
  manifest.program = "menger-mesh";
  io::note_input(manifest.inputs, arguments.input);
  const MeshToWrite result = is_gmsh ? convert(arguments, manifest) : mesh_design(arguments, manifest);
  const std::filesystem::path base = arguments.output.parent_path() / arguments.output.stem();
  for (const char* beside : {"_manifest.json", "_quality.csv"}) io::remove_if_there(base.string() + beside);  // of another mesh
  meshes::write_vtu_mesh(arguments.output, result.mesh);
  meshes::quality_table(result.quality).write(base.string() + "_quality.csv");
  manifest.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  io::write_manifest_file(base.string() + "_manifest.json", manifest);
  std::cout << meshes::quality_text(result.quality) << "mesh in " << arguments.output.string() << '\n';
  return io::exit_code::done;
}

}  // namespace

int main(int argc, char** argv) {
  return menger::io::run_program("menger-mesh", [&] { return run(argc, argv); });
}
