#include <gtest/gtest.h>
#include <sys/wait.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <string>
#include <thread>

#include "io/text/csv_table.h"
#include "io/text/whole_file.h"
#include "meshes/design/design_file.h"
#include "meshes/design/reference_shapes.h"
#include "meshes/files/vtu_mesh.h"
#include "meshes/hexahedra/boundary_labels.h"
#include "tests/support/paraview_files.h"
#include "tests/support/program_run.h"
#include "tests/support/test_folder.h"

namespace menger::meshes {
namespace {

namespace fs = std::filesystem;

/// The program in a folder of its own, beside the design of a bar of two cells.
class MeshProgram : public testing::Test {
 protected:
  MeshProgram() { write_design(folder_ / "bar.toml", {"bar", bar(2), 0.01}); }

  /// The exit code; what it printed goes to the files out and err.
  [[nodiscard]] int run(const std::string& arguments) const {
    const std::string command =
        "cd '" + folder_.path().string() + "' && '" MENGER_PROGRAM_DIR "/menger-mesh' " + arguments + " >out 2>err";
    const int status = std::system(command.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  [[nodiscard]] std::string text(const char* name) const { return io::read_whole(folder_ / name); }

  const tests::TestFolder folder_;
};

TEST_F(MeshProgram, LeavesSoonAfterAnInterruptAndWritesNothing) {
  const test_support::ProgramRun program(folder_, MENGER_PROGRAM_DIR "/menger-mesh",
                                         {"bar.toml", "--elements-through-wall", "50"});
  program.wait_for_processor_seconds(0.5);
  program.send(SIGINT);
  const test_support::Outcome outcome = program.wait();
  EXPECT_EQ(outcome.code, 130) << outcome.signal << outcome.err;
  EXPECT_NE(outcome.err.find("stopped in the middle"), std::string::npos) << outcome.err;
  EXPECT_FALSE(fs::exists(folder_ / "bar.vtu"));
}

TEST_F(MeshProgram, WritesMeshQualityAndManifest) {
  ASSERT_EQ(run("bar.toml"), 0) << text("err");
  EXPECT_EQ(read_vtu_mesh(folder_ / "bar.vtu").elements.size(), 10U * 5U * 5U - 8U * 3U * 3U);
  test_support::expect_opens_in_paraview(folder_);
  const io::CsvContents quality = io::read_csv(folder_ / "bar_quality.csv");
  EXPECT_EQ(quality.columns(), (std::vector<std::string>{"quantity", "value", "closed_form"}));
  EXPECT_EQ(quality.text(1, "quantity"), "elements");
  EXPECT_EQ(quality.number(1, "value"), 178.0);
  EXPECT_NE(text("bar_manifest.json").find("\"elements_through_wall\": 1"), std::string::npos);
  EXPECT_NE(text("out").find("178 elements"), std::string::npos);
}

TEST_F(MeshProgram, FlagsReplaceTheKeysOfAStudy) {
  io::write_whole(folder_ / "mesh.toml",
                  "[design]\nfile = \"bar.toml\"\nlevel = 2\nelements_through_wall = 3\n"
                  "[[design.tubes]]\ncell = [0, 0, 0]\nside = \"z max\"\nedge_m = 0.002\n");
  ASSERT_EQ(run("mesh.toml --elements-through-wall 1 --hole-edge-m 0.002 -o out.vtu"), 0) << text("err");
  const HexahedralMesh mesh = read_vtu_mesh(folder_ / "out.vtu");
  // Two modules, less one hole through both walls of the joint and one tube hole, of an element in each wall.
  EXPECT_EQ(mesh.elements.size(), 2U * 178U - 2U - 1U);
  EXPECT_EQ(mesh.plenum_names.size(), 1U);
  EXPECT_NO_THROW(static_cast<void>(label_index(mesh, "tube")));
}

TEST_F(MeshProgram, MeshesItsOwnTemplate) {
  ASSERT_EQ(run("--template"), 0) << text("err");
  io::write_whole(folder_ / "study.toml", text("out"));
  ASSERT_EQ(run("study.toml"), 0) << text("err");
  EXPECT_FALSE(read_vtu_mesh(folder_ / "study.vtu").elements.empty());
  ASSERT_EQ(run("--keys"), 0);
  EXPECT_NE(text("out").find("design.wall_thickness_m"), std::string::npos);
  ASSERT_EQ(run("--schema"), 0);
  EXPECT_NE(text("out").find("study of menger mesh"), std::string::npos);
}

TEST_F(MeshProgram, CountsModulesHolesAndEdgeContacts) {
  // An L of three cells: at level 2 its three modules meet in two joints. The two at its ends touch along an edge.
  write_design(folder_ / "l.toml", {"l", Polycube::from_digits(2, 2, 1, "1110"), 0.01});
  ASSERT_EQ(run("l.toml --level 2 --hole-edge-m 0.002"), 0) << text("err");
  const io::CsvContents quality = io::read_csv(folder_ / "l_quality.csv");
  std::map<std::string, double> value;
  for (std::size_t row = 0; row < quality.row_count(); ++row) value[quality.text(row, "quantity")] = quality.number(row, "value");
  EXPECT_EQ(value.at("modules"), 3.0);
  EXPECT_EQ(value.at("joint_holes"), 2.0);
  EXPECT_EQ(value.at("edge_contacts"), 1.0);
  EXPECT_EQ(text("out").find("note:"), std::string::npos) << text("out");
  // Modules on top of each other are never joined.
  write_design(folder_ / "tower.toml", {"tower", Polycube::from_digits(1, 1, 2, "11"), 0.01});
  ASSERT_EQ(run("tower.toml --level 2 --hole-edge-m 0.002"), 0) << text("err");
  EXPECT_NE(text("out").find("note: hole_edge_m made no hole"), std::string::npos) << text("out");
}

TEST_F(MeshProgram, RefusesBadInputAndLeavesWhatIsThere) {
  io::write_whole(folder_ / "bar.vtu", "earlier");
  EXPECT_EQ(run("bar.toml --wall-thickness-m 0.005"), 2);
  EXPECT_EQ(text("err"),
            "menger-mesh: error: bar.toml: design bar: wall_thickness_m = 0.005: must be smaller than half a cell (0.005), so "
            "that a chamber remains\n");
  EXPECT_EQ(run("none.toml"), 2);
  EXPECT_EQ(run("bar.toml --chambers double"), 2);
  EXPECT_EQ(run("bar.toml --level 2 --hole-edge-m 0.02"), 2);
  EXPECT_EQ(run("bar.toml --length-unit-m 0.001"), 2);
  EXPECT_EQ(run("bar.toml -o bar.stl"), 2);
  io::write_whole(folder_ / "bar.msh", "no mesh");
  EXPECT_EQ(run("bar.msh"), 2);
  EXPECT_NE(text("err").find("bar.msh: is not a mesh of Gmsh"), std::string::npos) << text("err");
  for (const char* option :
       {"--level 2", "--level 1", "--wall-thickness-m 0.002", "--elements-through-wall 1", "--largest-element-m 0.002",
        "--growth 1.5", "--chambers single", "--hole-edge-m 0.002", "--lid none", "--joint-region"}) {
    EXPECT_EQ(run(std::string("bar.msh ") + option), 2) << option;
    EXPECT_NE(text("err").find("options of a design do not apply"), std::string::npos) << option << ": " << text("err");
  }
  EXPECT_EQ(text("bar.vtu"), "earlier");
}

}  // namespace
}  // namespace menger::meshes
