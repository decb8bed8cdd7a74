#include "materials/laws/law_file.h"

#include <gtest/gtest.h>

#include "io/text/input_error.h"
#include "materials/laws/law_parameters.h"
#include "tests/unit/materials/laws/law_samples.h"

namespace menger::materials {
namespace {

HyperelasticLaw law_from(const std::string& text) {
  const io::TomlTable table = io::parse_toml(text, "law.toml");
  const HyperelasticLaw law = read_law(table);
  table.finish();
  return law;
}

std::string law_refusal(const std::string& text) {
  try {
    (void)law_from(text);
  } catch (const io::InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(LawFile, ReadsBackEveryLawItWrites) {
  for_each_law([](const auto& law) {
    const std::string text = law_text(law);
    const HyperelasticLaw read = law_from(text);
    EXPECT_EQ(name_of(read), name_of(law));
    EXPECT_EQ(law_text(read), text);
    EXPECT_EQ(parameters_of(read), parameters_of(law));
  });
}

TEST(LawFile, NamesALawOnOneLine) {
  EXPECT_EQ(law_line(NeoHookean{86677.0}), "name = \"neo_hookean\", shear_modulus_Pa = 86677");
  EXPECT_EQ(law_line(MooneyRivlin{3e4, 1e3}), "name = \"mooney_rivlin\", c10_Pa = 30000, c01_Pa = 1000");
}

TEST(LawFile, ConvertsTheOtherConventionOfOgden) {
  const HyperelasticLaw law = law_from("name = \"ogden1\"\nconvention = \"abaqus\"\nmoduli_Pa = [40e3]\nexponents = [4]\n");
  EXPECT_EQ(std::get<Ogden<1>>(law).terms[0].modulus_Pa, 20e3);
  EXPECT_EQ(shear_modulus_at_rest_Pa(law), 40e3);
}

TEST(LawFile, RefusesWhatIsNoLaw) {
  EXPECT_NE(law_refusal("shear_modulus_Pa = 1\n").find("name is missing"), std::string::npos);
  EXPECT_EQ(law_refusal("name = \"gent\"\nshear_modulus_Pa = 1e3\nlocking_excess = 0\n"),
            "law.toml:3: locking_excess = 0: must be > 0");
  EXPECT_EQ(law_refusal("name = \"ogden2\"\nmoduli_Pa = [1e3]\nexponents = [2, 3]\n"),
            "law.toml:2: moduli_Pa = [1000.0]: must be two numbers, not 1");
  EXPECT_EQ(law_refusal("name = \"ogden1\"\nmoduli_Pa = [1e3]\nexponents = [0]\n"),
            "law.toml:3: exponents[1] = 0: must not be 0");
  EXPECT_EQ(law_refusal("name = \"mooney_rivlin\"\nc10_Pa = 1\nc01_Pa = -3\n"),
            "law.toml:1: name = \"mooney_rivlin\": the shear modulus at rest is -4 Pa, it must be > 0");
  EXPECT_NE(law_refusal("name = \"neo_hookean\"\nshear_modulus_kPa = 1\n").find("shear_modulus_Pa is missing"),
            std::string::npos);
}

}  // namespace
}  // namespace menger::materials
