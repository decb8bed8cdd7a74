#include "evolution/page/body_frames.h"

#include <gtest/gtest.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkUnstructuredGrid.h>

#include <array>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "evolution/outputs/result_facts.h"
#include "evolution/page/report_scenes.h"
#include "evolution/page/report_sections.h"
#include "io/text/whole_file.h"
#include "io/vtk/collection.h"
#include "io/vtk/vtk_file.h"
#include "tests/support/input_error_message.h"
#include "tests/support/moved_grid.h"
#include "tests/support/test_folder.h"
#include "voxel/picture/vtk_output.h"

namespace menger::evolution {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t plenty = 1'000'000;

/// A block of n x n x n cubes of edge 1 from the origin; a cube is left out where `hole` says so.
vtkSmartPointer<vtkUnstructuredGrid> block(int n, bool hole, double shift_x, double displacement_x) {
  std::vector<tests::Place> rest_m;
  for (int z = 0; z <= n; ++z)
    for (int y = 0; y <= n; ++y)
      for (int x = 0; x <= n; ++x) rest_m.push_back({x + shift_x, static_cast<double>(y), static_cast<double>(z)});
  const auto moved_to = [&](const tests::Place& place) { return tests::Place{place[0] + displacement_x, place[1], place[2]}; };
  const auto grid = tests::moved_grid(rest_m, moved_to, tests::PointsAre::at_rest);
  const auto at = [&](int x, int y, int z) { return static_cast<vtkIdType>((z * (n + 1) + y) * (n + 1) + x); };
  for (int z = 0; z < n; ++z)
    for (int y = 0; y < n; ++y)
      for (int x = 0; x < n; ++x) {
        if (hole && x == 1 && y == 1 && z == 1) continue;
        const std::array<vtkIdType, 8> ids{at(x, y, z),     at(x + 1, y, z),     at(x + 1, y + 1, z),     at(x, y + 1, z),
                                           at(x, y, z + 1), at(x + 1, y, z + 1), at(x + 1, y + 1, z + 1), at(x, y + 1, z + 1)};
        grid->InsertNextCell(VTK_HEXAHEDRON, 8, ids.data());
      }
  vtkNew<vtkDoubleArray> pressure;
  pressure->SetName("plenum_pressures_Pa");
  pressure->InsertNextValue(1000.0 * (shift_x + displacement_x));
  grid->GetFieldData()->AddArray(pressure);
  return grid;
}

class BodyFramesTest : public testing::Test {
 protected:
  BodyFrame add(vtkUnstructuredGrid& grid) {
    const fs::path file = folder_ / ("frame_" + std::to_string(frames_.size()) + ".vtu");
    io::write_vtu(file, grid);
    frames_.push_back({0.5 * static_cast<double>(frames_.size()), file});
    return frames_.back();
  }
  PageBody read(std::size_t most_bytes = plenty, std::size_t most_frames = 100) {
    return read_page_body(
        {.name = "block", .frames = frames_, .most_bytes = most_bytes, .most_frames = most_frames, .body = body_});
  }
  tests::TestFolder folder_;
  std::vector<BodyFrame> frames_;
  std::optional<ManifestBody> body_;
};

TEST_F(BodyFramesTest, HaveTheFacesThatBelongToOneElement) {
  add(*block(2, false, 0.0, 0.0));
  const PageBody body = read();
  EXPECT_EQ(body.faces.size(), 24U);
  EXPECT_EQ(body.corners, 26U);
  EXPECT_EQ(body.times, std::vector<double>{0.0});
}

TEST_F(BodyFramesTest, LeaveOutTheWallsOfAClosedChamber) {
  add(*block(3, true, 0.0, 0.0));
  EXPECT_EQ(read().faces.size(), 54U);
}

TEST_F(BodyFramesTest, AddDisplacementsToPointsThatDoNotMove) {
  add(*block(1, false, 0.0, 0.0));
  add(*block(1, false, 0.0, 0.25));
  const PageBody body = read();
  EXPECT_NEAR(box_of(body, 1).first[0], 0.25, 1e-4);
  EXPECT_NEAR(box_of(body, 1).second[0], 1.25, 1e-4);
  EXPECT_NEAR(box_of(body, 0).first[0], 0.0, 1e-4);
}

TEST_F(BodyFramesTest, AreHeldAtTheNearEndWhereABodyFloatsFree) {
  add(*block(2, false, 0.0, 0.0));
  const auto bar = block(2, false, 0.0, 0.25);
  // Beyond its first cell it bends, and as a whole it has floated away by 0.25.
  auto& moved = *vtkDoubleArray::SafeDownCast(bar->GetPointData()->GetArray("displacement_m"));
  for (vtkIdType n = 0; n < bar->GetNumberOfPoints(); ++n)
    if (bar->GetPoint(n)[0] > 1.5) moved.SetTuple3(n, 0.25, 0.0, -0.5);
  add(*bar);
  io::write_collection(folder_ / "fields.pvd", {{0.0, frames_[0].file.filename()}, {1.0, frames_[1].file.filename()}});
  CommandOutput inflation{.program = "menger-inflate", .folder = folder_.path(), .body_name = "bar"};
  inflation.stated.body = ManifestBody{.layers = {{"11", "11"}, {"11", "11"}}, .cell_edge_m = 1.0};
  std::vector<std::string> notes;
  const auto scene_of_inflation = [&](const std::string& supports) {
    inflation.stated.supports = supports;
    return read_scenes({inflation}, plenty, notes).at(0);
  };
  const PageScene held = scene_of_inflation("free");
  EXPECT_NEAR(box_of(held.bodies.at(0), 1).first[0], 0.0, 1e-4);
  EXPECT_NEAR(box_of(held.bodies.at(0), 1).second[0], 2.0, 1e-4);
  EXPECT_NEAR(box_of(held.bodies.at(0), 1).first[2], -0.5, 1e-4);
  EXPECT_TRUE(held.note.ends_with("the middle of its far end moves 500 mm sideways.")) << held.note;
  EXPECT_NEAR(bend_of(inflation)->sideways_m, 0.5, 1e-9);
  io::write_whole(folder_ / "curves.csv", "step,plenum_0_pressure_Pa,plenum_0_volume_m3\n0,0,1e-6\n1,3000,2e-6\n");
  io::write_whole(folder_ / "result.toml", "status = \"completed\"\n");
  const std::vector<std::string> bends{"the middle of its far end moves sideways, seen from the near one (mm)", "500"};
  EXPECT_EQ(report_sections({inflation}, notes).at(0).tables.at(0).rows.back(), bends);
  const PageScene on_ground = scene_of_inflation("ground_guided");
  EXPECT_NEAR(box_of(on_ground.bodies.at(0), 1).first[0], 0.25, 1e-4);
  EXPECT_EQ(on_ground.note, "");
  EXPECT_FALSE(bend_of(inflation));
}

TEST_F(BodyFramesTest, AddNoDisplacementsToPointsThatMove) {
  add(*block(1, false, 0.0, 0.0));
  add(*block(1, false, 0.25, 0.25));
  EXPECT_NEAR(box_of(read(), 1).first[0], 0.25, 1e-4);
}

TEST_F(BodyFramesTest, RoundPositionsToAPartOfTheMotion) {
  add(*block(2, false, 0.0, 0.0));
  add(*block(2, false, 98.0, 0.0));
  const PageBody body = read();
  // Half of a step of the largest extent, 100, in 16 bits.
  const double most = 0.5 * 100.0 / 65535.0 * 1.0001;
  EXPECT_NEAR(box_of(body, 1).second[0], 100.0, most);
  for (std::size_t c = 0; c < body.corners; ++c) {
    const auto place = corner_m(body, 0, c);
    for (const double x : place) EXPECT_NEAR(x, std::round(x), most);
  }
}

TEST_F(BodyFramesTest, HaveThePressureOfTheOnlyPlenum) {
  add(*block(1, false, 0.0, 0.0));
  add(*block(1, false, 0.0, 3.0));
  const PageBody body = read();
  ASSERT_EQ(body.pressures_Pa.size(), 1U);
  EXPECT_EQ(body.pressures_Pa[0], (std::vector<double>{0.0, 3000.0}));
  EXPECT_EQ(body.chambers, std::vector<std::uint8_t>(6, 0));
}

TEST_F(BodyFramesTest, TakeMaterialsFromTheCellsOfTheBody) {
  add(*block(2, false, 0.0, 0.0));
  body_ = ManifestBody{.layers = {{"12", "11"}, {"11", "11"}}, .cell_edge_m = 1.0};
  const PageBody body = read();
  // The second cell of the first row has three faces outside.
  EXPECT_EQ(std::ranges::count(body.materials, 2), 3);
  EXPECT_EQ(std::ranges::count(body.materials, 1), 21);
}

TEST_F(BodyFramesTest, LeaveOutFramesThatDoNotFit) {
  for (int n = 0; n < 9; ++n) add(*block(1, false, n, 0.0));
  EXPECT_EQ(read(plenty, 3).times, (std::vector<double>{0.0, 2.0, 4.0}));
  // Six faces of 16 bytes, and 48 bytes per frame.
  EXPECT_EQ(read(6 * 16 + 2 * 48).times, (std::vector<double>{0.0, 4.0}));
  EXPECT_NE(tests::message_of([&] { read(6 * 16 + 48); }).find("too large for the page"), std::string::npos);
}

TEST_F(BodyFramesTest, RefuseFilesThatAreNoGridOrOfAnotherMesh) {
  add(*block(1, false, 0.0, 0.0));
  add(*block(2, false, 0.0, 0.0));
  EXPECT_NE(tests::message_of([&] { read(); }).find("another mesh"), std::string::npos);
  io::write_whole(frames_[1].file, "<VTKFile");
  EXPECT_NE(tests::message_of([&] { read(); }).find("frame_1.vtu: is no grid"), std::string::npos);
  fs::remove(frames_[1].file);
  EXPECT_NE(tests::message_of([&] { read(); }).find("frame_1.vtu: is no grid"), std::string::npos);
}

/// A hexahedron on whose top side the wall of a chamber lies, as text whose parts a test damages.
struct GridText {
  std::string points = "0 0 0 1 0 0 1 1 0 0 1 0 0 0 1 1 0 1 1 1 1 0 1 1";
  std::string connectivity = "0 1 2 3 4 5 6 7 4 5 6 7";
  std::string offsets = "8 12";
  std::string types = "12 9";
  std::string chamber = "-1 0";
  std::string pressure = "0 1000";
  std::string displacement = "0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0";
  std::string displacement_components = "3";

  [[nodiscard]] std::string text() const {
    const auto array = [](const std::string& name, const std::string& type, const std::string& values,
                          const std::string& components) {
      return "<DataArray type=\"" + type + "\" Name=\"" + name + "\" NumberOfComponents=\"" + components +
             "\" format=\"ascii\">" + values + "</DataArray>\n";
    };
    return "<VTKFile type=\"UnstructuredGrid\" version=\"0.1\"><UnstructuredGrid><Piece NumberOfPoints=\"8\" "
           "NumberOfCells=\"2\"><Points>" +
           array("Points", "Float64", points, "3") + "</Points><Cells>" + array("connectivity", "Int64", connectivity, "1") +
           array("offsets", "Int64", offsets, "1") + array("types", "UInt8", types, "1") + "</Cells><CellData>" +
           array("chamber", "Float64", chamber, "1") + array("chamber_pressure_Pa", "Float64", pressure, "1") +
           "</CellData><PointData>" + array("displacement_m", "Float64", displacement, displacement_components) +
           "</PointData></Piece></UnstructuredGrid></VTKFile>\n";
  }
};

class DamagedFramesTest : public BodyFramesTest {
 protected:
  /// Adds a frame; the first one is whole.
  void add_text(const GridText& grid) {
    const fs::path file = folder_ / ("frame_" + std::to_string(frames_.size()) + ".vtu");
    io::write_whole(file, grid.text());
    frames_.push_back({static_cast<double>(frames_.size()), file});
  }
  /// What is said of a damaged frame, alone and between whole ones.
  std::string refusal_of(const GridText& damaged) {
    frames_.clear();
    add_text(damaged);
    std::string said = tests::message_of([&] { read(); });
    EXPECT_NE(said.find("frame_0.vtu"), std::string::npos) << said;
    frames_.clear();
    add_text({});
    add_text(damaged);
    GridText moved;
    moved.displacement.replace(0, 1, "1");  // from which follows that displacements are to be added
    add_text(moved);
    const std::string between = tests::message_of([&] { read(); });
    EXPECT_NE(between.find("frame_1.vtu"), std::string::npos) << between;
    return said;
  }
  void expect_refusal(const GridText& damaged, const std::string& words) {
    const std::string said = refusal_of(damaged);
    EXPECT_NE(said.find(words), std::string::npos) << said;
  }
};

TEST_F(DamagedFramesTest, AreReadIfTheyAreWhole) {
  add_text({});
  const PageBody body = read();
  EXPECT_EQ(body.faces.size(), 5U);
  ASSERT_EQ(body.pressures_Pa.size(), 1U);
  EXPECT_EQ(body.pressures_Pa[0], std::vector<double>{1000.0});
}

TEST_F(DamagedFramesTest, AreRefusedForCellsThatAreNone) {
  GridText grid;
  grid.connectivity = "0 1 2 3 4 5 6 1000000 4 5 6 7";
  expect_refusal(grid, "has the point 1000000 of 8");
  grid.connectivity = "0 1 2 3 4 5 6 -7 4 5 6 7";
  expect_refusal(grid, "has the point -7 of 8");
  grid = {};
  grid.offsets = "3 12";
  expect_refusal(grid, "cell 0 has 3 corners, its type has 8");
  grid.offsets = "8 12000000";
  EXPECT_FALSE(refusal_of(grid).empty());
  grid = {};
  grid.types = "10 9";
  expect_refusal(grid, "cell 0 is neither a hexahedron nor a polygon");
}

TEST_F(DamagedFramesTest, AreRefusedForChambersThatAreNoNumbers) {
  for (const char* chambers : {"-1 0.5", "-1 1e300"}) {
    GridText grid;
    grid.chamber = chambers;
    expect_refusal(grid, "chamber holds");
  }
  const auto refusal_with = [&](const char* name, double value) {
    const auto grid = block(1, false, 0.0, 0.0);
    vtkNew<vtkDoubleArray> numbers;  // in binary, since texts of VTK have no such numbers
    numbers->SetName(name);
    numbers->InsertNextValue(value);
    grid->GetCellData()->AddArray(numbers);
    frames_.clear();
    add(*grid);
    return tests::message_of([&] { read(); });
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(refusal_with("chamber", nan).find("chamber holds nan"), std::string::npos);
  EXPECT_NE(refusal_with("material", nan).find("material holds nan"), std::string::npos);
  EXPECT_NE(refusal_with("chamber_pressure_Pa", nan).find("a pressure that is not finite"), std::string::npos);
}

TEST_F(DamagedFramesTest, HaveTheChambersOfTheFirstFrame) {
  add_text({});
  GridText other;
  other.chamber = "-1 7";
  other.pressure = "0 2000";
  add_text(other);
  other.chamber = "-1 -1";
  add_text(other);
  const PageBody body = read();
  ASSERT_EQ(body.pressures_Pa.size(), 1U);
  EXPECT_EQ(body.pressures_Pa[0], (std::vector<double>{1000.0, 2000.0, 2000.0}));
}

TEST_F(DamagedFramesTest, AreRefusedForPlacesThatAreNone) {
  GridText grid;
  grid.points.replace(0, 1, "nan");
  expect_refusal(grid, "a point that is not finite");
  grid = {};
  grid.points.replace(0, 1, "1e308");
  expect_refusal(grid, "a point of 1e+308 m");
  grid = {};
  grid.displacement = "0 0 0 0 0 0 0 0";
  grid.displacement_components = "1";
  expect_refusal(grid, "displacement_m must have 3 x 8 numbers");
}

TEST_F(DamagedFramesTest, AreRefusedForTheirCutEnd) {
  add_text({});
  const std::string text = io::read_whole(frames_[0].file);
  io::write_whole(frames_[0].file, text.substr(0, text.size() / 2));
  EXPECT_NE(tests::message_of([&] { read(); }).find("frame_0.vtu"), std::string::npos);
}

TEST_F(BodyFramesTest, AreNotFollowedOutOfTheirResults) {
  const auto message = [&](const fs::path& named) {
    voxel::write_collection(folder_ / "results/winner/both.pvd", {{0.0, named, 0}});
    return tests::message_of([&] { read_body_frames(folder_ / "results/winner/both.pvd", folder_ / "results"); });
  };
  EXPECT_EQ(message("../runs/a.vtu"), "no error") << "the winner of a re-evaluation names frames of its runs";
  EXPECT_NE(message("../../a.vtu").find("leads out of"), std::string::npos);
  EXPECT_NE(message("/dev/zero").find("leads out of"), std::string::npos);
  fs::create_directories(folder_ / "elsewhere");
  fs::create_directory_symlink(folder_ / "elsewhere", folder_ / "results/link");
  EXPECT_NE(message("../link/a.vtu").find("leads out of"), std::string::npos);
}

TEST_F(BodyFramesTest, MayBeInPiecesThatLieBesideThem) {
  add(*block(1, false, 0.0, 0.0));
  const auto add_pieces = [&](const std::string& piece) {
    const fs::path file = folder_ / "step.pvtu";
    io::write_whole(file,
                    "<VTKFile type=\"PUnstructuredGrid\" version=\"0.1\"><PUnstructuredGrid GhostLevel=\"0\"><PPointData>"
                    "<PDataArray type=\"Float64\" Name=\"displacement_m\" NumberOfComponents=\"3\"/></PPointData><PPoints>"
                    "<PDataArray type=\"Float64\" Name=\"Points\" NumberOfComponents=\"3\"/></PPoints><Piece Source=\"" +
                        piece + "\"/></PUnstructuredGrid></VTKFile>\n");
    frames_ = {{0.0, file}};
  };
  add_pieces("frame_0.vtu");
  EXPECT_EQ(read().faces.size(), 6U);
  for (const std::string& elsewhere : {std::string("../frame_0.vtu"), (folder_ / "frame_0.vtu").string()}) {
    add_pieces(elsewhere);
    EXPECT_NE(tests::message_of([&] { read(); }).find("which does not lie beside it"), std::string::npos);
  }
}

TEST_F(BodyFramesTest, AreReadByPartInOrderOfTime) {
  voxel::write_collection(folder_ / "both.pvd", {{1.0, "b.vtu", 0}, {0.0, "a.vtu", 0}, {0.0, "c.vtu", 1}});
  const std::vector<BodyFrames> parts = read_body_frames(folder_ / "both.pvd", folder_.path());
  ASSERT_EQ(parts.size(), 2U);
  ASSERT_EQ(parts[0].frames.size(), 2U);
  EXPECT_EQ(parts[0].frames[0].file, folder_ / "a.vtu");
  EXPECT_EQ(parts[1].part, 1);
}

TEST(ShownFrames, AreEvenlySpacedWithTheFirstAndTheLast) {
  EXPECT_EQ(shown_frames(3, 5), (std::vector<std::size_t>{0, 1, 2}));
  EXPECT_EQ(shown_frames(101, 3), (std::vector<std::size_t>{0, 50, 100}));
  EXPECT_TRUE(shown_frames(0, 3).empty());
}

}  // namespace
}  // namespace menger::evolution
