#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "fem/inflation/inflation_study_file.h"
#include "fem/inflation/inflation_study_words.h"
#include "io/study/study_reader.h"
#include "io/study/study_schema.h"
#include "io/text/input_error.h"
#include "io/text/whole_file.h"
#include "meshes/design/reference_shapes.h"
#include "tests/support/described_study.h"
#include "tests/support/test_folder.h"

namespace menger::fem {
namespace {

namespace fs = std::filesystem;

/// A study of a cube and what its tables hold, each to be replaced by a test.
struct StudyText {
  std::string body = "[design]\nfile = \"cube.toml\"\nwall_thickness_m = 0.002\n";
  std::string material = "[material]\nbulk_modulus_Pa = 2.5e6\nlaw = {name = \"neo_hookean\", shear_modulus_Pa = 5e4}\n";
  std::string path = "[path]\npressure_Pa = [0, 6000]\n";
  std::string rest{};
};

class InflationStudyFile : public testing::Test {
 protected:
  InflationStudyFile() { io::write_whole(folder_ / "cube.toml", "name = \"cube\"\ncell_edge_m = 0.02\nlayers = [[\"1\"]]\n"); }

  [[nodiscard]] InflationStudy read(const StudyText& text) const {
    io::write_whole(folder_ / "study.toml", text.body + text.material + text.path + text.rest);
    return read_inflation_study(folder_ / "study.toml");
  }

  /// The message with which a study is refused.
  [[nodiscard]] std::string refusal(const StudyText& text) const {
    try {
      static_cast<void>(read(text));
    } catch (const io::InputError& error) {
      return error.what();
    }
    return "accepted";
  }

  const tests::TestFolder folder_;
};

TEST_F(InflationStudyFile, LeavesWhatIsNotNamedAtItsDefault) {
  const InflationStudy study = read({});
  const InflationStudy defaults;
  EXPECT_EQ(study.degree, 2);
  EXPECT_EQ(study.formulation, Formulation::three_field);
  EXPECT_EQ(study.supports.kind, SupportKind::ground_guided);
  EXPECT_EQ(study.gravity_m_per_s2, 0.0);
  EXPECT_EQ(study.path.first_step, defaults.path.first_step);
  EXPECT_EQ(study.solver.relative_force_tolerance, defaults.solver.relative_force_tolerance);
  EXPECT_EQ(study.output.fields_every, 1);
  EXPECT_TRUE(study.notes.empty());
  EXPECT_EQ(study.inputs.size(), 2U) << "the study and the design";
  ASSERT_EQ(study.drives.size(), 1U);
  EXPECT_EQ(study.drives.at("").values, (std::vector<double>{0.0, 6000.0}));
}

TEST_F(InflationStudyFile, TakesSiliconesByNameWithDensityRangeAndAssumedBulkModulus) {
  const InflationStudy study = read({.material = "[material]\nsilicone = \"dragon_skin_10\"\n"});
  EXPECT_EQ(study.material.density_kg_per_m3, 1070.0);
  EXPECT_EQ(study.material.largest_stretch, 2.0);
  EXPECT_EQ(study.material.smallest_stretch, 1.0);
  const auto& volume = std::get<materials::SimoTaylorVolume>(study.material.volume);
  EXPECT_EQ(volume.bulk_modulus_Pa, 50.0 * materials::shear_modulus_at_rest_Pa(study.material.law));
  ASSERT_EQ(study.notes.size(), 1U);
  EXPECT_NE(study.notes.front().find("50 shear moduli"), std::string::npos) << study.notes.front();
}

TEST_F(InflationStudyFile, ChoosesAmongLawsOfOneName) {
  const std::string head = "[material]\nsilicone = \"dragon_skin_10\"\nbulk_modulus_Pa = 1e6\nlaw_name = \"yeoh\"\n";
  const InflationStudy first = read({.material = head});
  const InflationStudy second = read({.material = head + "law_variant = 2\n"});
  EXPECT_LT(first.material.largest_stretch, 2.0);
  EXPECT_GT(second.material.largest_stretch, 2.9);
  ASSERT_FALSE(second.notes.empty());
  EXPECT_NE(second.notes.front().find("number 2 of"), std::string::npos) << second.notes.front();
}

TEST_F(InflationStudyFile, GivesEachPlenumItsDrive) {
  const InflationStudy study = read({.path = "[path]\n[[path.plenum]]\nname = \"plenum 0\"\nvolume_ratio = [1, 2, 1.5]\n"
                                             "[[path.plenum]]\nname = \"plenum 1\"\ngas_amount = [1, 1.5, 1]\n"
                                             "gas_exponent = 1.4\n"});
  ASSERT_EQ(study.drives.size(), 2U);
  EXPECT_EQ(study.drives.at("plenum 0").kind, DriveKind::volume);
  EXPECT_EQ(study.drives.at("plenum 1").kind, DriveKind::gas);
  EXPECT_EQ(study.drives.at("plenum 1").gas_exponent, 1.4);
}

TEST_F(InflationStudyFile, ThinWallsAreChosenByKindAndFidelity) {
  const InflationStudy standard = read({.rest = "[elements]\nkind = \"thin_wall\"\n"});
  EXPECT_TRUE(standard.has_thin_walls());
  EXPECT_EQ(standard.elements.fidelity, Fidelity::standard);
  EXPECT_EQ(standard.space_degree(), 1);
  const InflationStudy fine = read({.rest = "[elements]\nkind = \"thin_wall\"\nfidelity = \"fine\"\n"});
  EXPECT_EQ(fine.elements.fidelity, Fidelity::fine);
  EXPECT_NE(path_text(fine), path_text(standard));
  const std::string constants = text_of(constants_of_equilibria);
  EXPECT_NE(path_text(fine).find(constants), std::string::npos) << "checkpoints with other constants are not resumed";
  const InflationStudy other = read({});
  EXPECT_FALSE(other.has_thin_walls());
  EXPECT_EQ(other.space_degree(), 2);
}

TEST_F(InflationStudyFile, IdentityFollowsThePathAndNotItsOutput) {
  const std::string base = path_text(read({}));
  EXPECT_EQ(path_text(read({.rest = "[output]\npictures = false\nfields_every = 3\n"})), base);
  EXPECT_NE(path_text(read({.path = "[path]\npressure_Pa = [0, 6001]\n"})), base);
  EXPECT_NE(path_text(read({.rest = "[elements]\ndegree = 1\n"})), base);
  EXPECT_NE(path_text(read({.rest = "[supports]\nkind = \"ground_held\"\n"})), base);
  io::write_whole(folder_ / "cube.toml", "name = \"cube\"\ncell_edge_m = 0.021\nlayers = [[\"1\"]]\n");
  EXPECT_NE(path_text(read({})), base) << "another design under the same name";
}

TEST_F(InflationStudyFile, IdentityHasTheContentOfADesignAndOfAMesh) {
  const std::string drawn = "[design]\nlayers = [[\"1\"]]\nname = \"cube\"\ncell_edge_m = 0.02\nwall_thickness_m = 0.002\n";
  EXPECT_EQ(path_text(read({.body = drawn})), path_text(read({})));
  const auto with_mesh = [&](const std::string& name, const std::string& content, const std::string& lines = "") {
    io::write_whole(folder_ / name, content);
    return path_text(read({.body = "[mesh]\nfile = \"" + name + "\"\n" + lines}));
  };
  const std::string base = with_mesh("a.msh", "mesh");
  EXPECT_EQ(with_mesh("b.msh", "mesh"), base) << "wherever it lies";
  EXPECT_NE(with_mesh("a.msh", "another mesh"), base);
  EXPECT_NE(with_mesh("a.msh", "mesh", "length_unit_m = 0.001\n"), base);
}

// The schema does not know how many knots a path has.
TEST_F(InflationStudyFile, StationsMayLieBeyondTheSecondKnot) {
  EXPECT_EQ(read({.path = "[path]\npressure_Pa = [0, 3000, 6000]\nstations = [1.5, 0.5]\n"}).path.stations,
            (std::vector{0.5, 1.5}));
  InflationStudy usual;
  io::StudySchemaWriter writer;
  describe(writer, usual);
  InflationStudy other;
  io::StudySchemaWriter varied(true);
  describe(varied, other);
  writer.leave_out_what_differs(varied);
  const nlohmann::json schema = nlohmann::json::parse(writer.text("inflate"));
  const nlohmann::json& station = schema["properties"]["path"]["properties"]["stations"]["items"];
  EXPECT_EQ(station["minimum"], 0.0);
  EXPECT_FALSE(station.contains("maximum")) << station;
}

InflationStudy parse(const std::string& text) {
  InflationStudy study;
  io::read_described(io::parse_toml(text, "study.toml"), study);
  return study;
}

TEST(InflationStudyKeys, TemplateIsReadWithEachAlternative) {
  tests::expect_template_is_read<InflationStudy>(parse, {"design.file",                    // names a file that is not there
                                                         "supports.kind = \"resting\""});  // needs gravity
}

/// A study whose values fit to each other, whatever they are one by one.
struct PossibleStudy {
  InflationStudy study;
};

void make_possible(StudyMaterial& material) {
  if (!(materials::shear_modulus_at_rest_Pa(material.law) > 0.0)) material.law = materials::NeoHookean{5e4};
  if (!(bulk_modulus_of(material.volume) > 0.0)) material.volume = materials::SimoTaylorVolume{2.5e6};
  if (!material.density_kg_per_m3) material.density_kg_per_m3 = 1000.0;
}

void describe(io::StudyVisitor& visitor, PossibleStudy& possible) {
  InflationStudy& study = possible.study;
  describe(visitor, study);
  auto* source = std::get_if<DesignSource>(&study.source);
  if (source == nullptr) source = &study.source.emplace<DesignSource>();
  if (source->design.body.count() == 0) source->design.body = meshes::full_cube(1);
  make_possible(study.material);
  for (auto& [region, material] : study.region_materials) make_possible(material);
  for (auto& [name, drive] : study.drives) drive.values.front() = drive.kind == DriveKind::pressure ? 0.0 : 1.0;
  for (StudyPlate& plate : study.plates) {
    if (!plate.side) plate.slides = false;
    plate.drive.values.front() = {};
  }
  if (study.supports.kind == SupportKind::free) study.supports.kind = SupportKind::labels;
}

TEST(InflationStudyKeys, TextsAreReadBack) {
  tests::expect_texts_are_read_back<PossibleStudy>(
      [](const std::string& text) { return PossibleStudy{parse(text)}; }, 30, {},
      {"gas_amount", "pressure_Pa", "volume_ratio", "displacement_x_m", "displacement_y_m", "displacement_z_m", "rotation_x_rad",
       "rotation_y_rad", "rotation_z_rad"});
}

/// A fault in a study, and what the message must name beside the file.
struct Fault {
  StudyText text;
  std::string key;
  std::string value;
};

TEST_F(InflationStudyFile, RefusesEachFaultNamingFileKeyAndValue) {
  const std::string material = StudyText{}.material;
  const std::vector<Fault> faults{
      {{.rest = "[elements]\ndegree = 3\n"}, "elements.degree", "3"},
      {{.rest = "[element]\ndegree = 2\n"}, "element.degree = 2", "is called elements.degree now"},
      {{.rest = "[elements]\ndegre = 2\n"}, "elements.degre: unknown key", ""},
      {{.rest = "[elements]\nformulation = \"mixed\"\n"}, "elements.formulation", "mixed"},
      {{.rest = "[elements]\nrefinements = -1\n"}, "elements.refinements", "-1"},
      {{.rest = "[supports]\nkind = \"floating\"\n"}, "supports.kind", "floating"},
      {{.rest = "[supports]\nkind = \"resting\"\n"}, "supports.kind", "resting"},
      {{.rest = "[[supports.labels]]\nlabel = \"outer\"\nheld = [\"w\"]\n"}, "held", "w"},
      {{.rest = "[loads]\ngravity_m_per_s2 = -9.81\n"}, "loads.gravity_m_per_s2", "-9.81"},
      {{.rest = "[loads]\ngravity_m_per_s2 = 9.81\n"}, "loads.gravity_m_per_s2", "9.81"},
      {{.path = "[path]\n"}, "path.pressure_Pa or volume_ratio or gas_amount or plenum is missing", ""},
      {{.path = "[path]\npressure_Pa = [0]\n"}, "path.pressure_Pa", "at least two"},
      {{.path = "[path]\npressure_Pa = [0, 1]\nvolume_ratio = [1, 2]\n"}, "path.volume_ratio", ""},
      {{.path = "[path]\nvolume_ratio = [1, 0]\n"}, "path.volume_ratio", "0"},
      {{.path = "[path]\npressure_Pa = [500, 1000]\n"}, "path.pressure_Pa", "500"},
      {{.path = "[path]\nvolume_ratio = [1.5, 2]\n"}, "path.volume_ratio", "1.5"},
      {{.path = "[path]\ngas_amount = [0.5, 2]\n"}, "path.gas_amount", "0.5"},
      {{.path = "[path]\npressure_Pa = [0, nan]\n"}, "path.pressure_Pa", "nan"},
      {{.path = "[path]\ngas_amount = [1, 2]\ngas_exponent = 0\n"}, "path.gas_exponent", "0"},
      {{.path = "[path]\npressure_Pa = [0, 1]\nlargest_step = 1.5\n"}, "path.largest_step", "1.5"},
      {{.path = "[path]\npressure_Pa = [0, 1]\nfirst_step = 0.75\n"}, "path.first_step", "0.75"},
      {{.path = "[path]\npressure_Pa = [0, 1]\nstations = [1.5]\n"}, "path.stations", "1.5"},
      {{.path =
            "[path]\n[[path.plenum]]\nname = \"a\"\npressure_Pa = [0, 1]\n[[path.plenum]]\nname = \"a\"\npressure_Pa = [0, 1]\n"},
       "name",
       "a"},
      {{.path = "[path]\n[[path.plenum]]\nname = \"a\"\npressure_Pa = [0, 1]\n[[path.plenum]]\nname = \"b\"\npressure_Pa = [0, "
                "1, 2]\n"},
       "pressure_Pa",
       ""},
      {{.rest = "[solver]\nlinear = \"lu\"\n"}, "solver.linear", "lu"},
      {{.rest = "[solver]\nforce_tolerance = 0\n"}, "solver.force_tolerance", "0"},
      {{.rest = "[output]\nfields_every = 0\n"}, "output.fields_every", "0"},
      {{.rest = "[[output.points]]\nname = \"p\"\nposition_m = [0, 0]\n"}, "position_m", ""},
      {{.rest = "[[output.points]]\nname = \"p,q\"\nposition_m = [0, 0, 0]\n"}, "name", "p,q"},
      {{.material = "[material]\nsilicone = \"dragon_skin\"\n"}, "material.silicone", "dragon_skin"},
      {{.material = "[material]\nrecord = \"dragon_skin_10\"\n"}, "material.record", "is called material.silicone now"},
      {{.material = "[material]\n"}, "material.silicone or law is missing", ""},
      {{.material = "[material]\nsilicone = \"dragon_skin_10\"\nlaw_name = \"gent\"\n"}, "material.law_name", "gent"},
      {{.material = "[material]\nsilicone = \"dragon_skin_10\"\nlaw_name = \"yeoh\"\nlaw_variant = 9\n"},
       "material.law_variant",
       "9"},
      {{.material = material + "silicone = \"dragon_skin_10\"\n"}, "material.law", "silicone is also given"},
      {{.material = "[material]\nlaw = {name = \"neo_hookean\", shear_modulus_Pa = -1}\n"}, "shear_modulus_Pa", "-1"},
      {{.material = "[material]\nsilicone = \"dragon_skin_10\"\nbulk_modulus_Pa = 0\n"}, "material.bulk_modulus_Pa", "0"},
      {{.material = "[material]\nsilicone = \"dragon_skin_10\"\nvolumetric = \"linear\"\n"}, "material.volumetric", "linear"},
      {{.body = ""}, "design or mesh is missing", ""},
      {{.body = "[mesh]\nfile = \"body.stl\"\n"}, "mesh.file", "body.stl"},
      {{.body = "[design]\nfile = \"cube.toml\"\nwall = 1\n"}, "design.wall: unknown key", ""},
      {{.rest = "[mesh]\nfile = \"body.msh\"\n"}, "mesh", ""},
      {{.body = "[mesh]\nfile = \"body.vtu\"\nlength_unit_m = 1\n"}, "mesh.length_unit_m", "a .vtu file is in metres"},
      {{.rest = "[supports]\nground_stiffness_Pa_per_m = 1e6\n"}, "supports.ground_stiffness_Pa_per_m", "kind = \"resting\""},
      {{.rest = "[extra]\n"}, "extra", ""},
      {{.rest = "[elements]\nkind = \"shell\"\n"}, "elements.kind", "shell"},
      {{.rest = "[elements]\nfidelity = \"fine\"\n"}, "elements.fidelity", "kind = \"thin_wall\""},
      {{.rest = "[elements]\nkind = \"thin_wall\"\nfidelity = \"best\"\n"}, "elements.fidelity", "best"},
      {{.rest = "[elements]\nkind = \"thin_wall\"\nprecision = \"single\"\n"}, "elements.precision", "unknown key"},
      {{.rest = "[elements]\nkind = \"thin_wall\"\ndegree = 2\n"}, "elements.degree", "three_field"},
      {{.rest = "[elements]\nkind = \"thin_wall\"\nformulation = \"three_field\"\n"}, "elements.formulation", "three_field"},
      {{.rest = "[elements]\nkind = \"thin_wall\"\nrefinements = 1\n"}, "elements.refinements", "three_field"},
      {{.rest = "[elements]\nkind = \"thin_wall\"\n[solver]\npredict_pressure = false\n"},
       "solver.predict_pressure",
       "three_field"},
      {{.body = StudyText{}.body + "elements_through_wall = 2\n", .rest = "[elements]\nkind = \"thin_wall\"\n"},
       "design.elements_through_wall",
       "elements.kind"},
      {{.body = StudyText{}.body + "largest_element_m = 0.005\n", .rest = "[elements]\nkind = \"thin_wall\"\n"},
       "design.largest_element_m",
       "elements.kind"},
      {{.body = "[mesh]\nfile = \"body.vtu\"\n", .rest = "[elements]\nkind = \"thin_wall\"\n"}, "elements.kind", "give a design"},
  };
  for (const Fault& fault : faults) {
    const std::string message = refusal(fault.text);
    EXPECT_NE(message.find("study.toml"), std::string::npos) << message;
    EXPECT_NE(message.find(fault.key), std::string::npos) << fault.key << ": " << message;
    EXPECT_NE(message.find(fault.value), std::string::npos) << fault.value << ": " << message;
  }
}

TEST_F(InflationStudyFile, ReadsTheMotionOfPlatesAtTheKnots) {
  const InflationStudy study =
      read({.path = "[path]\npressure_Pa = [0, 1000, 1000]\n[[plates]]\nname = \"tip\"\nside = \"x max\"\n"
                    "displacement_z_m = [0, 0, 0.001]\nrotation_y_rad = [0, 0, 0.1]\n"
                    "[[plates]]\nname = \"base\"\nlabel = \"ground\"\n"});
  ASSERT_EQ(study.plates.size(), 2U);
  EXPECT_EQ(study.plates[0].side, meshes::Side::x_max);
  ASSERT_EQ(study.plates[0].drive.values.size(), 3U);
  EXPECT_EQ(study.plates[0].drive.values[1], PlateMotion{});
  EXPECT_EQ(study.plates[0].drive.values[2], (PlateMotion{{0.0, 0.0, 0.001}, {0.0, 0.1, 0.0}}));
  EXPECT_EQ(study.plates[1].label, "ground");
  EXPECT_EQ(study.plates[1].drive.values, std::vector<PlateMotion>(3));
  InflationStudy moved = study;
  moved.plates[0].drive.values[2].displacement_m[2] = 0.002;
  EXPECT_NE(path_text(moved), path_text(study));
}

TEST_F(InflationStudyFile, RefusesPlatesThatCannotBe) {
  const auto plate = [&](const std::string& lines) { return refusal({.rest = "[[plates]]\nname = \"tip\"\n" + lines}); };
  const auto has = [](const std::string& message, const std::string& part) {
    EXPECT_NE(message.find("study.toml"), std::string::npos) << message;
    EXPECT_NE(message.find(part), std::string::npos) << message;
  };
  has(plate(""), "side or label is missing");
  has(plate("side = \"x max\"\nlabel = \"outer\"\n"), "side is also given: keep one of them");
  has(plate("side = \"x top\"\n"), "side = \"x top\"");
  has(plate("side = \"x max\"\ndisplacement_x_m = [0, 1, 2]\n"), "one value for each of the 2 knots");
  has(plate("side = \"x max\"\ndisplacement_x_m = [1, 1]\n"), "must begin with 0");
  has(plate("side = \"x max\"\ndisplacement_x_mm = [0, 1]\n"), "displacement_x_mm");
  has(plate("side = \"x max\"\ngrip = \"sliding\"\ndisplacement_y_m = [0, 1e-3]\n"), "moves only along the normal of its side");
  has(plate("label = \"outer\"\ngrip = \"sliding\"\n"), "only the faces of a side can slide");
  has(plate("side = \"x max\"\n[[plates]]\nname = \"tip\"\nside = \"x min\"\n"), "is given twice");
  has(refusal({.rest = "[[plates]]\nname = \"tip 1\"\nside = \"x max\"\n[[plates]]\nname = \"tip_1\"\nside = \"x min\"\n"}),
      "names the same columns as");
}

TEST_F(InflationStudyFile, NamesFilesThatAreMissing) {
  EXPECT_NE(refusal({.body = "[design]\nfile = \"none.toml\"\n"}).find("none.toml"), std::string::npos);
  EXPECT_NE(refusal({.body = "[mesh]\nfile = \"none.msh\"\n"}).find("none.msh"), std::string::npos);
  EXPECT_NE(refusal({.material = "[material]\nsilicone = \"none.toml\"\n"}).find("none.toml"), std::string::npos);
}

// A free body is held without force only if nothing else holds or loads it.
TEST_F(InflationStudyFile, RefusesToHoldOrLoadAFreeBody) {
  const std::string free = "[supports]\nkind = \"free\"\n";
  EXPECT_EQ(read({.rest = free}).supports.kind, SupportKind::free);
  const std::string held = refusal({.rest = free + "[[supports.labels]]\nlabel = \"ground\"\nheld = [\"z\"]\n"});
  EXPECT_NE(held.find("supports.kind"), std::string::npos) << held;
  EXPECT_NE(held.find("[[supports.labels]]"), std::string::npos) << held;
  const std::string gripped = refusal({.rest = free + "[[plates]]\nname = \"tip\"\nside = \"x max\"\n"});
  EXPECT_NE(gripped.find("[[plates]]"), std::string::npos) << gripped;
  StudyText heavy{.rest = free + "[loads]\ngravity_m_per_s2 = 9.81\n"};
  heavy.material += "density_kg_per_m3 = 1070\n";
  EXPECT_NE(refusal(heavy).find("gravity_m_per_s2"), std::string::npos) << refusal(heavy);
}

}  // namespace
}  // namespace menger::fem
