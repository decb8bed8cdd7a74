#include "materials/laws/study_law.h"

#include <gtest/gtest.h>

#include <string>

#include "io/study/study_reader.h"
#include "io/text/whole_file.h"
#include "materials/laws/law_file.h"
#include "tests/support/described_study.h"
#include "tests/support/input_error_message.h"
#include "tests/support/test_folder.h"

namespace menger::materials {
namespace {

HyperelasticLaw parse_law(const std::string& text) {
  HyperelasticLaw law;
  io::read_described(io::parse_toml(text, "law.toml"), law);
  return law;
}

StudyLaw parse(const std::string& text) {
  StudyLaw law;
  io::read_described(io::parse_toml(text, "material.toml"), law);
  return law;
}

std::string message(const std::string& text) {
  return tests::message_of([&] { (void)parse(text); });
}

TEST(StudyLaw, TemplateOfEveryLawIsRead) {
  tests::expect_template_is_read<HyperelasticLaw>(parse_law);
  tests::expect_texts_are_read_back<HyperelasticLaw>(parse_law);
}

TEST(StudyLaw, TemplateIsReadWithASiliconeOrALaw) { tests::expect_template_is_read<StudyLaw>(parse); }

TEST(StudyLaw, LawInPlaceIsReadBack) { tests::expect_texts_are_read_back<StudyLaw>(parse, 20); }

TEST(StudyLaw, IsTheRecommendedOneOfASilicone) {
  const StudyLaw law = parse("silicone = \"dragon_skin_10\"");
  ASSERT_TRUE(law.record);
  EXPECT_EQ(law_text(law.law), law_text(law.record->recommended.law));
  EXPECT_EQ(law.largest_stretch, law.record->recommended.largest_stretch);
  EXPECT_EQ(law.count, 0U);
  EXPECT_EQ(law.name(), law.record->name + ", " + std::string(name_of(law.law)));
  EXPECT_EQ(law_text(parse(io::described_text(law)).law), law_text(law.law)) << "the text has the law in place";
}

TEST(StudyLaw, MayBeAnotherOneOfTheRecord) {
  const StudyLaw usual = parse("silicone = \"dragon_skin_10\"");
  ASSERT_FALSE(usual.record->others.empty());
  const SourcedLaw& other = usual.record->others.front();
  const StudyLaw law = parse("silicone = \"dragon_skin_10\"\nlaw_name = \"" + std::string(name_of(other.law)) + "\"");
  EXPECT_EQ(law_text(law.law), law_text(other.law));
  EXPECT_GE(law.count, 1U);
}

TEST(StudyLaw, TellsAResultOfAFitFromARecord) {
  const tests::TestFolder folder;
  const std::string file = (folder / "fits.toml").string();
  io::write_whole(file, "material = \"tensile\"\nrecommended = \"yeoh\"\n\n[[fits]]\nname = \"yeoh\"\n");
  EXPECT_EQ(message("silicone = \"" + file + "\""),
            "material.toml:1: silicone = \"" + file + "\": " + file +
                ": is a result of menger fit, not a record of a silicone: see \"Your own silicone\" in materials/README.md");
}

TEST(StudyLaw, NamesBadInput) {
  EXPECT_NE(message("").find("silicone or law is missing: give a silicone or a law"), std::string::npos) << message("");
  for (const auto& [text, part] : std::initializer_list<std::pair<const char*, const char*>>{
           {"silicone = \"jelly\"", "silicone = \"jelly\": is neither a file (.toml) nor one of "},
           {"record = \"dragon_skin_10\"", "record = \"dragon_skin_10\": is called silicone now"},
           {"silicone = \"dragon_skin_10\"\nlaw_name = \"jelly\"", "law_name = \"jelly\": the record has recommended, "},
           {"silicone = \"dragon_skin_10\"\nlaw_variant = 2", "law_variant = 2: there is only one recommended law"},
           {"silicone = \"dragon_skin_10\"\n[law]\nname = \"gent\"", "law = {...}: silicone is also given: keep one of them"},
           {"law = \"gent\"", "law = \"gent\": is called law_name now"},
           {"[law]\nname = \"neo_hookean\"\nshear_modulus_Pa = 1\nc10_Pa = 1",
            "law.c10_Pa = 1: belongs to name = \"mooney_rivlin\" or name = \"yeoh\""},
           {"[law]\nname = \"mooney_rivlin\"\nc10_Pa = -1\nc01_Pa = 0", "the shear modulus at rest is -2 Pa, it must be > 0"}})
    EXPECT_NE(message(text).find(part), std::string::npos) << message(text);
}

}  // namespace
}  // namespace menger::materials
