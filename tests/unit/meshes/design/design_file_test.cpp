#include "meshes/design/design_file.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "io/study/study_reader.h"
#include "io/text/input_error.h"
#include "io/text/whole_file.h"
#include "meshes/design/connectivity.h"
#include "meshes/design/hollow_body_file.h"
#include "meshes/design/reference_shapes.h"
#include "tests/support/described_study.h"
#include "tests/support/input_error_message.h"
#include "tests/support/test_folder.h"

namespace menger::meshes {
namespace {

namespace fs = std::filesystem;

/// The message with which a design of this text is refused, without the folder; "" if it is accepted.
std::string refusal(const std::string& text) {
  const tests::TestFolder folder;
  const fs::path file = folder / "design.toml";
  io::write_whole(file, text);
  try {
    (void)read_design(file);
  } catch (const io::InputError& error) {
    const std::string message = error.what();
    const std::string start = folder.path().string() + "/";
    return message.rfind(start, 0) == 0 ? message.substr(start.size()) : message;
  }
  return {};
}

/// The same for a well-formed file with the given layers on line 3.
std::string refusal_of_layers(const std::string& layers) {
  return refusal("name = \"a\"\ncell_edge_m = 0.01\nlayers = " + layers + "\n");
}

std::string place(int line) { return "design.toml:" + std::to_string(line) + ": "; }

TEST(DesignFile, ReadsLayersFromTheGroundUpAndRowsAlongX) {
  const tests::TestFolder folder;
  const fs::path file = folder / "corner.toml";
  io::write_whole(file, "name = \"corner\"\ncell_edge_m = 0.02\nlayers = [[\"12\", \"00\", \"01\"], [\"00\", \"20\", \"00\"]]\n");
  const Design design = read_design(file);
  EXPECT_EQ(design.name, "corner");
  EXPECT_EQ(design.cell_edge_m, 0.02);
  EXPECT_EQ(design.body, Polycube::from_digits(2, 3, 2, "120001002000"));
}

TEST(DesignFile, ReadsBackWhatItWrote) {
  const Design design{
      .name = "a \"quoted\" näme \\ \n", .body = Polycube::from_digits(3, 2, 2, "012210100002"), .cell_edge_m = 0.1 / 3};
  const tests::TestFolder folder;
  const fs::path file = folder / "design.toml";
  write_design(file, design);
  EXPECT_EQ(read_design(file), design);
}

TEST(DesignFile, WritesExactlyTheReadyDesigns) {
  for (const auto& entry : fs::directory_iterator(fs::path(MENGER_SOURCE_DIR) / "meshes/designs")) {
    EXPECT_EQ(design_text(read_design(entry.path())), io::read_whole(entry.path())) << entry.path();
  }
}

TEST(DesignFile, ReadyDesignsAreConnectedAndHaveTheirKnownCellCounts) {
  const std::map<std::string, std::size_t> counts{{"menger", 20},  {"plane", 9}, {"quadruped", 13}, {"l", 5},
                                                  {"stand18", 18}, {"bar3", 3},  {"full_cube", 27}};
  for (const auto& [name, count] : counts) {
    const Design design = read_design(fs::path(MENGER_SOURCE_DIR) / "meshes/designs" / (name + ".toml"));
    EXPECT_EQ(design.name, name);
    EXPECT_EQ(design.cell_edge_m, 0.01);
    EXPECT_EQ(design.body.count(), count) << name;
    EXPECT_TRUE(is_connected(design.body)) << name;
  }
}

TEST(DesignFile, ReadyMengerIsTheMengerSponge) {
  EXPECT_EQ(read_design(fs::path(MENGER_SOURCE_DIR) / "meshes/designs/menger.toml").body, menger_sponge());
}

TEST(DesignFile, RefusesAnUnknownKey) {
  EXPECT_EQ(refusal("name = \"a\"\ncell_edge_m = 0.01\ncell_edge_mm = 10\nlayers = [[\"1\"]]\n"),
            place(3) + "cell_edge_mm: unknown key, did you mean cell_edge_m?");
}

TEST(DesignFile, RefusesACellEdgeThatIsNotPositive) {
  EXPECT_EQ(refusal("name = \"a\"\ncell_edge_m = 0\nlayers = [[\"1\"]]\n"), place(2) + "cell_edge_m = 0: must be > 0");
  EXPECT_EQ(refusal("name = \"a\"\ncell_edge_m = -0.01\nlayers = [[\"1\"]]\n"), place(2) + "cell_edge_m = -0.01: must be > 0");
}

TEST(DesignFile, RefusesDigitsThatAreNoMaterial) {
  EXPECT_EQ(refusal_of_layers("[[\"10\",\n\"13\"]]"), place(4) + "layers[1][2] = \"13\": must hold only 0, 1 and 2");
  EXPECT_EQ(refusal_of_layers("[[\"1x\"]]"), place(3) + "layers[1][1] = \"1x\": must hold only 0, 1 and 2");
}

TEST(DesignFile, RefusesRaggedRowsAndLayers) {
  EXPECT_EQ(refusal_of_layers("[[\"10\"],\n[\"1\"]]"),
            place(4) + "layers[2][1] = \"1\": must have 2 digits, as in the first row");
  EXPECT_EQ(refusal_of_layers("[[\"10\"],\n[\"10\", \"10\"]]"),
            place(4) + "layers[2] = [\"10\", \"10\"]: has 2 rows where the first layer has 1");
}

TEST(DesignFile, RefusesAnEmptyDesign) {
  EXPECT_EQ(refusal_of_layers("[[\"00\"]]"),
            place(3) + "layers = [[\"00\"]]: the body is empty: at least one digit must be 1 or 2");
  for (const char* layers : {"[]", "[[]]", "[[\"\"]]"}) {
    EXPECT_EQ(refusal_of_layers(layers), place(3) + "layers = " + layers + ": must hold at least one cell") << layers;
  }
}

TEST(DesignFile, RefusesAnAbsurdSize) {
  EXPECT_EQ(refusal_of_layers("[[\"" + std::string(1001, '1') + "\"]]"),
            place(3) + "layers = [[...]]: must not have more than 1000 cells along an axis");
}

TEST(DesignFile, RefusesMissingKeysAndWrongTypes) {
  EXPECT_NE(refusal("cell_edge_m = 0.01\nlayers = [[\"1\"]]\n").find("name is missing"), std::string::npos);
  EXPECT_NE(refusal("name = \"a\"\nlayers = [[\"1\"]]\n").find("cell_edge_m is missing"), std::string::npos);
  EXPECT_NE(refusal("name = \"a\"\ncell_edge_m = 0.01\n").find("layers is missing"), std::string::npos);
  EXPECT_EQ(refusal_of_layers("[[1]]"), place(3) + "layers[1][1] = 1: must be a text in quotes");
  EXPECT_EQ(refusal_of_layers("[\"1\"]"), place(3) + "layers[1] = \"1\": must be an array of strings");
}

TEST(DesignFile, NamesAMissingFile) {
  const tests::TestFolder folder;
  EXPECT_THROW((void)read_design(folder / "absent.toml"), io::InputError);
}

TEST(DesignFile, LeavesTheOldFileWhereAPlaceCannotBeWritten) {
  const tests::TestFolder folder;
  const fs::path file = folder / "design.toml";
  io::write_whole(file, "old");
  const Design design{.name = "a", .body = full_cube(1), .cell_edge_m = 0.01};
  EXPECT_THROW(write_design(file / "below_a_file.toml", design), io::InputError);
  EXPECT_EQ(io::read_whole(file), "old");
}

/// A design in the table of a study.
struct GivenDesign {
  Design design;
  std::optional<fs::path> file;
};

void describe(io::StudyVisitor& visitor, GivenDesign& given) { describe_design(visitor, given.design, given.file); }

GivenDesign parse_given(const std::string& text, const fs::path& file = "study.toml") {
  GivenDesign given;
  io::read_described(io::parse_toml(text, file), given);
  return given;
}

TEST(DescribeDesign, TemplateIsReadWithLayersOrDigits) {
  tests::expect_template_is_read<GivenDesign>([](const std::string& text) { return parse_given(text); },
                                              {"file"});  // names a file that is not there
}

TEST(DescribeDesign, LayersBeginAtTheLowestYAndX) {
  const Polycube body = parse_given("cell_edge_m = 0.01\nlayers = [[\"12\", \"01\"], [\"10\", \"00\"]]\n").design.body;
  EXPECT_EQ(body.at({0, 0, 0}), 1);
  EXPECT_EQ(body.at({1, 0, 0}), 2);
  EXPECT_EQ(body.at({0, 1, 0}), 0);
  EXPECT_EQ(body.at({1, 1, 0}), 1);
  EXPECT_EQ(body.at({0, 0, 1}), 1);
  EXPECT_EQ(body.count(), 4U);
}

TEST(DescribeDesign, TakesAFileWithCellsOfItsOwnSizeOrAnother) {
  const tests::TestFolder folder;
  write_design(folder / "plus.toml", {"plus", meshes::bar(3), 0.02});
  const GivenDesign given = parse_given("file = \"plus.toml\"\n", folder / "study.toml");
  EXPECT_EQ(given.design, (Design{"plus", meshes::bar(3), 0.02}));
  EXPECT_EQ(given.file, folder / "plus.toml");
  EXPECT_EQ(parse_given("file = \"plus.toml\"\ncell_edge_m = 0.01\n", folder / "study.toml").design.cell_edge_m, 0.01);
  const GivenDesign again = parse_given(io::described_text(given));
  EXPECT_EQ(again.design, given.design) << "a text has the design itself";
  EXPECT_EQ(again.file, std::nullopt);
}

TEST(DescribeDesign, NamesBadInput) {
  const auto message = [](const std::string& text) { return tests::message_of([&] { (void)parse_given(text); }); };
  for (const auto& [text, part] : std::initializer_list<std::pair<const char*, const char*>>{
           {"cell_edge_m = 1", "layers or digits or file is missing: give one of them"},
           {"layers = [[\"1\"]]", "cell_edge_m is missing"},
           {"layers = [[\"1\"]]\ndigits = \"1\"", "digits = \"1\": layers is also given: keep one of them"},
           {"digits = \"12\"\ncells = [1, 1, 2]\ncell_edge_m = 0", "cell_edge_m = 0: must be > 0"},
           {"digits = \"1\"\ncells = [1, 1]\ncell_edge_m = 1", "must be three integers, not 2"},
           {"digits = \"123\"\ncells = [3, 1, 1]\ncell_edge_m = 1", "digits = \"123\": "},
           {"digits = \"000\"\ncells = [3, 1, 1]\ncell_edge_m = 1", "the body is empty"},
           {"layers = [[\"13\"]]\ncell_edge_m = 1", "layers[1][1] = \"13\": must hold only 0, 1 and 2"}})
    EXPECT_NE(message(text).find(part), std::string::npos) << message(text);
}

TEST(NamedDesign, IsRefusedWithThePlaceOfItsName) {
  const tests::TestFolder folder;
  io::write_whole(folder / "study.toml", "[design]\nfile = \"broken.toml\"\n");
  io::write_whole(folder / "broken.toml", "name = 1\n");
  const std::string message = tests::message_of([&] { (void)read_mesh_study(folder / "study.toml"); });
  const std::string study = (folder / "study.toml").string();
  const std::string design = (folder / "broken.toml").string();
  EXPECT_EQ(message, study + ":2: design.file = \"broken.toml\": " + design + ":1: name = 1: must be a text in quotes");
}

}  // namespace
}  // namespace menger::meshes
