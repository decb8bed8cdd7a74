#include "meshes/design/hollow_body_file.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "io/study/study_reader.h"
#include "io/text/input_error.h"
#include "io/text/whole_file.h"
#include "meshes/design/reference_shapes.h"
#include "tests/support/described_study.h"
#include "tests/support/input_error_message.h"
#include "tests/support/test_folder.h"

namespace menger::meshes {
namespace {

HollowBodyOptions parse(const std::string& text) {
  HollowBodyOptions options;
  io::read_described(io::parse_toml(text, "mesh.toml"), options);
  return options;
}

TEST(HollowBodyFile, EmptyTableMeansTheDefaults) { EXPECT_EQ(parse(""), HollowBodyOptions{}); }

TEST(HollowBodyFile, TextReadsBackEqual) {
  HollowBodyOptions options;
  EXPECT_EQ(parse(hollow_body_text(options)), options);
  options.wall_thickness_m = 0.0015;
  options.elements_through_wall = 3;
  options.largest_element_m = 0.003;
  options.growth = 1.25;
  options.chambers = ChamberLayout::per_phase;
  options.level = 2;
  options.hole_edge_m = 0.0025;
  options.tubes = {{{1, 2, 3}, Side::y_min, 0.003}, {{0, 0, 8}, Side::z_max, 0.004}};
  options.lid = LidPlace::top;
  options.joint_region = true;
  EXPECT_EQ(parse(hollow_body_text(options)), options);
}

TEST(HollowBodyFile, NamesKeyAndValueOfWhatItRefuses) {
  const auto refusal = [](const std::string& text) -> std::string {
    try {
      static_cast<void>(parse(text));
    } catch (const io::InputError& error) {
      return error.what();
    }
    return "accepted";
  };
  const auto expect = [&](const std::string& text, const std::string& part) {
    EXPECT_NE(refusal(text).find(part), std::string::npos) << refusal(text);
  };
  expect("wall_thickness_m = 0.0", "wall_thickness_m = 0");
  expect("elements_through_wall = 0", "elements_through_wall = 0");
  expect("growth = 0.5", "growth = 0.5");
  expect("chambers = \"double\"", "per-phase");
  expect("level = 0", "level = 0");
  expect("lid = \"side\"", "lid");
  expect("wall_thickness_mm = 2.0", "wall_thickness_mm");
  expect("[[tubes]]\ncell = [0, 0]\nside = \"x min\"\nedge_m = 0.002", "three integers");
  expect("[[tubes]]\ncell = [0, 0.5, 0]\nside = \"x min\"\nedge_m = 0.002", "cell[2] = 0.5: must be an integer");
  expect("[[tubes]]\ncell = [0, 0, 0]\nside = \"left\"\nedge_m = 0.002", "x min");
  expect("[[tubes]]\ncell = [0, 0, 0]\nside = \"x min\"", "edge_m");
}

TEST(MeshStudy, IsADesignOrNamesOne) {
  const tests::TestFolder folder;
  const Design design{"bar", bar(2), 0.00667};
  write_design(folder / "designs/bar.toml", design);
  const MeshStudy plain = read_mesh_study(folder / "designs/bar.toml");
  EXPECT_EQ(plain.design, design);
  EXPECT_EQ(plain.options, HollowBodyOptions{});
  io::write_whole(folder / "mesh.toml", "[design]\nfile = \"designs/bar.toml\"\nlevel = 2\n");
  const MeshStudy study = read_mesh_study(folder / "mesh.toml");
  EXPECT_EQ(study.design, design);
  EXPECT_EQ(study.options.level, 2);
  EXPECT_EQ(study.design_file, folder / "designs/bar.toml");
  const auto refusal = [&](const std::string& text) {
    io::write_whole(folder / "mesh.toml", text);
    return tests::message_of([&] { static_cast<void>(read_mesh_study(folder / "mesh.toml")); });
  };
  const std::string unknown = refusal("[design]\nfile = \"designs/bar.toml\"\nlevels = 2\n");
  EXPECT_NE(unknown.find("design.levels: unknown key"), std::string::npos) << unknown;
  const std::string earlier = refusal("design = \"designs/bar.toml\"\nlevel = 2\n");
  EXPECT_NE(earlier.find("design = \"designs/bar.toml\": is a table now"), std::string::npos) << earlier;
}

TEST(MeshStudy, TemplateAndTextsAreRead) {
  const auto parse_study = [](const std::string& text) {
    MeshStudy study;
    io::read_described(io::parse_toml(text, "mesh.toml"), study);
    return study;
  };
  tests::expect_template_is_read<MeshStudy>(parse_study, {"design.file"});  // names a file that is not there
  tests::expect_texts_are_read_back<MeshStudy>(parse_study);
}

TEST(HollowBodyOptions, TemplateAndTextsAreRead) {
  tests::expect_template_is_read<HollowBodyOptions>(parse);
  tests::expect_texts_are_read_back<HollowBodyOptions>(parse, 300);
}

}  // namespace
}  // namespace menger::meshes
