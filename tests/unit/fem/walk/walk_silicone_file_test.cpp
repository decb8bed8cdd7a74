#include "fem/walk/walk_silicone_file.h"

#include <gtest/gtest.h>

#include <numbers>
#include <string>
#include <vector>

#include "fem/explicit/material_damping.h"
#include "io/study/study_reader.h"
#include "io/study/study_text.h"
#include "tests/support/described_study.h"
#include "tests/support/input_error_message.h"

namespace menger::fem {
namespace {

using tests::message_of;

struct Read {
  WalkSilicone given;
  WalkMaterial material;
  std::vector<std::string> notes;
};

WalkSilicone parse(const std::string& text) {
  WalkSilicone silicone;
  io::read_described(io::parse_toml(text, "material.toml"), silicone);
  return silicone;
}

Read read(const std::string& keys, DampingModel usual = DampingModel::maxwell) {
  Read result;
  result.given = parse(keys);
  result.material = material_of(result.given, usual, result.notes);
  return result;
}

double shear_modulus_Pa(const Read& read) { return materials::shear_modulus_at_rest_Pa(read.material.law); }

// Every law is linear in its moduli, so that stiffness at rest is a fair witness for all its coefficients but of laws whose other
// terms vanish there: the record's Yeoh law has three.
TEST(WalkMaterial, StiffensEveryModulusOfALaw) {
  const materials::HyperelasticLaw yeoh = materials::Yeoh{3e4, -1e2, 4e1};
  const auto stiff = std::get<materials::Yeoh>(stiffened(yeoh, 2.5));
  EXPECT_EQ(stiff.c10_Pa, 7.5e4);
  EXPECT_EQ(stiff.c20_Pa, -2.5e2);
  EXPECT_EQ(stiff.c30_Pa, 1e2);
  const materials::HyperelasticLaw gent = materials::Gent{5e4, 12.0};
  EXPECT_EQ(std::get<materials::Gent>(stiffened(gent, 0.5)).locking_excess, 12.0) << "a stretch is no modulus";
}

TEST(WalkMaterial, TakesTheRecordsLawAndGivesItAYoungsModulus) {
  const Read plain = read("silicone = \"dragon_skin_10\"\n");
  EXPECT_EQ(plain.given.law.file.filename(), "dragon_skin_10.toml");
  EXPECT_NEAR(plain.material.bulk_modulus_Pa, 50.0 * shear_modulus_Pa(plain), 1e-6);
  const Read soft = read("silicone = \"dragon_skin_10\"\nyoungs_modulus_Pa = 107e3\nbulk_modulus_ratio = 100\n");
  EXPECT_NEAR(3.0 * shear_modulus_Pa(soft), 107e3, 1e-6);
  EXPECT_NEAR(soft.material.bulk_modulus_Pa, 100.0 * 107e3 / 3.0, 1e-4);
  const Read twice = read("silicone = \"dragon_skin_10\"\nmodulus_factor = 2\n");
  EXPECT_NEAR(shear_modulus_Pa(twice), 2.0 * shear_modulus_Pa(plain), 1e-6);
}

TEST(WalkMaterial, SaysThatDampingIsNotMeasured) {
  const Read assumed = read("silicone = \"dragon_skin_10\"\nbulk_modulus_ratio = 50\n");
  ASSERT_FALSE(assumed.material.is_damping_measured) << "the record has got a measurement: this test needs another one";
  ASSERT_EQ(assumed.notes.size(), 1U);
  EXPECT_NE(assumed.notes[0].find("damping is not measured"), std::string::npos);
  EXPECT_EQ(assumed.material.loss.tan_delta, assumed_silicone_loss().tan_delta);
}

TEST(WalkMaterial, DampsAsTheStudyStates) {
  const std::string keys =
      "law = {name = \"neo_hookean\", shear_modulus_Pa = 6e4}\ndensity_kg_per_m3 = 1000\n"
      "loss_factor = 0.2\nloss_frequency_Hz = 5\n";
  const Read viscous = read(keys + "damping_model = \"kelvin_voigt\"\n");
  EXPECT_NEAR(viscous.material.viscosity_Pa_s, 6e4 * 0.2 / (2.0 * std::numbers::pi * 5.0), 1e-9);
  EXPECT_TRUE(viscous.material.branches.empty());
  const Read branched = read(keys + "damping_model = \"maxwell\"\n");
  EXPECT_EQ(branched.material.branches.front().shear_modulus_Pa, maxwell_branch(6e4, branched.material.loss).shear_modulus_Pa);
  EXPECT_EQ(branched.material.viscosity_Pa_s, 0.0);
  EXPECT_EQ(read(keys, DampingModel::maxwell).material.damping_model, DampingModel::maxwell);
  EXPECT_EQ(read(keys, DampingModel::kelvin_voigt).material.damping_model, DampingModel::kelvin_voigt);
  const Read elastic = read(
      "law = {name = \"neo_hookean\", shear_modulus_Pa = 6e4}\ndensity_kg_per_m3 = 1000\n"
      "loss_factor = 0\nloss_frequency_Hz = 5\n");
  EXPECT_EQ(elastic.material.viscosity_Pa_s, 0.0);
  EXPECT_TRUE(elastic.material.branches.empty());
}

// Ecoflex 00-30 has a published loss factor at four frequencies.
TEST(WalkMaterial, DampsAsItsRecordSays) {
  const Read recorded = read("silicone = \"ecoflex_00_30\"\nbulk_modulus_ratio = 50\n");
  EXPECT_TRUE(recorded.material.is_damping_measured);
  EXPECT_TRUE(recorded.notes.empty());
  ASSERT_EQ(recorded.material.branches.size(), 3U);
  const double modulus_Pa = materials::shear_modulus_at_rest_Pa(recorded.material.law);
  for (const auto& [tan_delta, frequency_Hz] : recorded.material.loss.points())
    EXPECT_NEAR(loss_factor(modulus_Pa, recorded.material.branches, frequency_Hz), tan_delta, 0.03 * tan_delta) << frequency_Hz;
  const Read stated = read("silicone = \"ecoflex_00_30\"\nloss_factor = 0.1\nloss_frequency_Hz = 30\n");
  EXPECT_EQ(stated.material.branches.size(), 1U);
}

TEST(WalkMaterial, FollowsLossFactorsOfTheStudy) {
  const std::string record = "silicone = \"dragon_skin_10\"\n";
  const Read stated = read(record + "loss_factors = [0.1, 0.2]\nloss_frequencies_Hz = [2, 20]\n");
  const double modulus_Pa = materials::shear_modulus_at_rest_Pa(stated.material.law);
  EXPECT_NEAR(loss_factor(modulus_Pa, stated.material.branches, 2.0), 0.1, 1e-12);
  EXPECT_NEAR(loss_factor(modulus_Pa, stated.material.branches, 20.0), 0.2, 1e-12);
  EXPECT_EQ(stated_loss_factor(stated.given), 0.2);
  const auto message = [&](const std::string& keys) { return message_of([&] { (void)read(record + keys); }); };
  EXPECT_NE(message("loss_factors = [0.1, 0.2]\n").find("loss_frequencies_Hz is missing"), std::string::npos);
  EXPECT_NE(message("loss_factors = [0.1]\nloss_frequencies_Hz = [2]\n").find("loss_factors"), std::string::npos);
  EXPECT_NE(message("loss_factors = [0.1, 0.2]\nloss_frequencies_Hz = [2, 20, 30]\n").find("as many values as loss_factors"),
            std::string::npos);
  EXPECT_NE(message("loss_factors = [0.1, 0.2]\nloss_frequencies_Hz = [20, 2]\n").find("must ascend"), std::string::npos);
  EXPECT_NE(message("loss_factors = [0.1, 0.2]\nloss_frequencies_Hz = [2, 20]\nloss_factor = 0.1\nloss_frequency_Hz = 3\n")
                .find("cannot stand beside loss_factor"),
            std::string::npos);
}

TEST(WalkMaterial, RefusesWhatIsNoSilicone) {
  const auto message = [](const std::string& keys) { return message_of([&] { (void)read(keys); }); };
  const std::string record = "silicone = \"dragon_skin_10\"\n";
  EXPECT_NE(message("silicone = \"cheese\"\n").find("silicone = \"cheese\""), std::string::npos);
  EXPECT_NE(message(record + "law_name = \"hookean\"\n").find("law_name = \"hookean\": the record has recommended"),
            std::string::npos);
  EXPECT_NE(message(record + "law_variant = 2\n").find("one recommended law"), std::string::npos);
  EXPECT_NE(message(record + "modulus_factor = 2\nyoungs_modulus_Pa = 1e5\n").find("keep one"), std::string::npos);
  EXPECT_NE(message(record + "loss_factor = 0.1\n").find("loss_frequency_Hz is missing"), std::string::npos);
  EXPECT_NE(message(record + "damping_model = \"rubber\"\n").find("damping_model = \"rubber\""), std::string::npos);
  EXPECT_NE(message(record + "bulk_modulus_ratio = 0.5\n").find("bulk_modulus_ratio = 0.5"), std::string::npos);
  EXPECT_NE(message("law = {name = \"neo_hookean\", shear_modulus_Pa = 5e4}\n").find("density_kg_per_m3 is missing"),
            std::string::npos);
  EXPECT_NE(message("record = \"dragon_skin_10\"\n").find("record = \"dragon_skin_10\": is called silicone now"),
            std::string::npos);
  EXPECT_NE(message(record + "loss_frequency_Hz = 30\n").find("loss_frequency_Hz = 30: belongs to loss_factor"),
            std::string::npos);
}

// What a study leaves open, the record's law among it, stands in the text of what a material was made of.
TEST(WalkMaterial, IsTheSameByItsText) {
  const std::string stated = "modulus_factor = 2\nloss_factor = 0.2\nloss_frequency_Hz = 5\n";
  const std::string several = "loss_factors = [0.1, 0.15]\nloss_frequencies_Hz = [3, 30]\n";
  for (const std::string& keys : {std::string(), std::string("youngs_modulus_Pa = 107e3\n"), stated, several}) {
    const Read first = read("silicone = \"dragon_skin_10\"\n" + keys);
    const std::string text = io::described_text(first.given);
    const Read again = read(text);
    EXPECT_EQ(shear_modulus_Pa(again), shear_modulus_Pa(first));
    EXPECT_EQ(again.material.bulk_modulus_Pa, first.material.bulk_modulus_Pa);
    EXPECT_EQ(again.material.density_kg_per_m3, first.material.density_kg_per_m3);
    EXPECT_EQ(again.material.branches.front().shear_modulus_Pa, first.material.branches.front().shear_modulus_Pa);
    EXPECT_EQ(again.material.branches.front().relaxation_time_s, first.material.branches.front().relaxation_time_s);
    EXPECT_EQ(again.material.branches.size(), first.material.branches.size());
    EXPECT_EQ(io::described_text(again.given), text);
  }
}

TEST(WalkMaterial, TemplateAndTextsAreRead) {
  const auto adopt = [](WalkSilicone& told, const WalkSilicone& read) { told.law = read.law; };
  tests::expect_template_is_read<WalkSilicone>(parse, {"law"}, adopt);  // a law needs a density
  tests::expect_texts_are_read_back<WalkSilicone>(parse, 20);
}

}  // namespace
}  // namespace menger::fem
