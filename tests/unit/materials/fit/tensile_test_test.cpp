#include "materials/fit/tensile_test.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "io/text/input_error.h"
#include "io/text/whole_file.h"
#include "materials/fit/tensile_cleaning.h"
#include "materials/laws/homogeneous_deformations.h"
#include "materials/laws/law_file.h"
#include "tests/support/test_folder.h"
#include "tests/unit/materials/laws/law_samples.h"

namespace menger::materials {
namespace {

namespace fs = std::filesystem;

const std::string database_head =
    "PARAMETER;INFO;URL;;\nSpecimen Length (mm);33;;;\nStrain calculation;Derived from the crosshead;;;\n"
    "Material;Rubber;;;\n;;;;\nTime (s);True Strain;True Stress (MPa);Engineering Strain;Engineering Stress (MPa)\n";

/// What a file "rubber.csv" of this text says.
TensileTest test_of(const std::string& text) {
  const tests::TestFolder folder;
  const fs::path file = folder / "rubber.csv";
  io::write_whole(file, text);
  return read_tensile_test(file);
}

/// The message with which a file is refused, without the folder.
std::string refusal(const std::string& text) {
  const tests::TestFolder folder;
  const fs::path file = folder / "rubber.csv";
  io::write_whole(file, text);
  try {
    (void)read_tensile_test(file);
  } catch (const io::InputError& error) {
    return std::string(error.what()).substr(file.string().size());
  }
  return "accepted";
}

/// A record of a Mooney-Rivlin body: 100 rows, every 0.1 s.
TensileTest clean_record() {
  TensileTest test;
  for (int i = 1; i <= 100; ++i) {
    const double strain = 0.02 * i;
    test.time_s.push_back(0.1 * i);
    test.strain.push_back(strain);
    test.stress_Pa.push_back(nominal_stress(MooneyRivlin{20e3, 5e3}, LoadingMode::uniaxial, 1.0 + strain).stress_Pa);
  }
  return test;
}

TEST(TensileTest, ReadsTheFormatOfTheDatabase) {
  const TensileTest test = test_of(database_head + "0.2;0.04;0.002;0.05;0.0015\r\n0.3;0.06;0.006;0.07;0.006\r\n");
  EXPECT_EQ(test.material, "Rubber");
  EXPECT_EQ(test.strain_source, "Derived from the crosshead");
  EXPECT_EQ(test.time_s, (std::vector{0.2, 0.3}));
  EXPECT_EQ(test.strain, (std::vector{0.05, 0.07}));
  ASSERT_EQ(test.stress_Pa.size(), 2U);
  EXPECT_DOUBLE_EQ(test.stress_Pa[0], 1500.0);
  EXPECT_DOUBLE_EQ(test.stress_Pa[1], 6000.0);
}

TEST(TensileTest, ReadsTwoColumnsInAnyOfTheUnits) {
  for (const char* text : {"strain,stress_Pa\n0.1,2000\n0.5,8000\n", "strain_percent,stress_kPa\n10,2\n50,8\n",
                           "stretch,stress_MPa\n1.1,0.002\n1.5,0.008\n", "Stress (kPa),Strain (%)\n2,10\n8,50\n",
                           "strain [-],stress [psi]\n0.1,0.29007547546\n0.5,1.16030190184\n"}) {
    const TensileTest test = test_of(text);
    ASSERT_EQ(test.strain.size(), 2U) << text;
    EXPECT_NEAR(test.strain[0], 0.1, 1e-15) << text;
    EXPECT_NEAR(test.stress_Pa[1], 8000.0, 1e-5) << text;
    EXPECT_TRUE(test.time_s.empty());
    EXPECT_EQ(test.material, "rubber");
  }
}

TEST(TensileTest, RefusesAHeaderWithoutUnitsOrWithOthers) {
  EXPECT_EQ(refusal("strain,stress\n0.1,2\n0.5,8\n"),
            ":1: header = \"strain,stress\": one column must be stress_Pa, stress_kPa, stress_MPa or stress_psi");
  EXPECT_EQ(refusal("elongation_mm,stress_Pa\n0.1,2\n0.5,8\n"),
            ":1: header = \"elongation_mm,stress_Pa\": one column must be strain, strain_percent or stretch");
  EXPECT_EQ(refusal("strain,stress_Pa,width_mm\n0.1,2,1\n0.5,8,1\n"), ":1: must have two columns, strain and stress");
  EXPECT_NE(refusal("Time (s);True Strain;True Stress (kPa);Engineering Strain;Engineering Stress (kPa)\n1;1;1;1;1\n")
                .find(":1: the header must be"),
            std::string::npos);
}

TEST(TensileTest, AsksForCommasWhereTheHeaderHasOtherSeparators) {
  const std::string reason = "\": columns must be separated by commas, and numbers have a decimal point";
  EXPECT_EQ(refusal("strain;stress_kPa\n0.1;2\n0.5;8\n"), ":1: header = \"strain;stress_kPa" + reason);
  EXPECT_EQ(refusal("strain;stress_kPa\n0,1;2\n0,5;8\n"), ":1: header = \"strain;stress_kPa" + reason);
  EXPECT_EQ(refusal("\nstrain\tstress_kPa\n0.1\t2\n"), ":2: header = \"strain\tstress_kPa" + reason);
  EXPECT_NE(refusal("strain\n0.1\n").find("one column must be stress_Pa"), std::string::npos);
}

TEST(TensileTest, RefusesBadRowsWithLineAndValue) {
  EXPECT_EQ(refusal(database_head + "0.2;0.04;0.002;0.05;0,0015\n"),
            ":7: Engineering Stress (MPa) = \"0,0015\": must be a finite number with a decimal point");
  EXPECT_EQ(refusal(database_head + "0.2;0.04;0.002;0.05;nan\n"),
            ":7: Engineering Stress (MPa) = \"nan\": must be a finite number with a decimal point");
  EXPECT_EQ(refusal(database_head + "0.2;0.04;0.002\n"), ":7: has 3 fields, must have 5");
  EXPECT_NE(refusal(database_head + "0.2;0.04;0.002;-1.5;1\n").find(":7: strain = -1.5"), std::string::npos);
  EXPECT_NE(refusal("stretch,stress_Pa\n1.1,1\n0,2\n").find(":3: stretch = 0: must be > 0"), std::string::npos);
  EXPECT_NE(refusal("stretch,stress_Pa\n1.1,1\n1.2,x\n").find(":3: stress_Pa"), std::string::npos);
}

TEST(TensileTest, RefusesAFileWithoutRowsAndAMissingOne) {
  EXPECT_EQ(refusal(database_head), ": must hold at least two rows of data");
  EXPECT_EQ(refusal("strain,stress_Pa\n0.1,2\n"), ": must hold at least two rows of data");
  EXPECT_THROW((void)read_tensile_test("absent.csv"), io::InputError);
}

TEST(TensileCleaning, LeavesACleanRecordAlone) {
  TensileTest test = clean_record();
  EXPECT_EQ(clean(test), std::vector<std::string>{});
  EXPECT_EQ(test.stress_Pa, clean_record().stress_Pa);
  EXPECT_EQ(test.time_s, clean_record().time_s);
}

TEST(TensileCleaning, CountsACorruptClockAnew) {
  TensileTest test = clean_record();
  for (std::size_t i = 60; i < 100; ++i) test.time_s[i] = 6.0 + 0.01 * static_cast<double>(i - 60);
  test.time_s[60] = 5.0;
  for (std::size_t i = 0; i < 60; ++i) ASSERT_NEAR(test.time_s[i], clean_record().time_s[i], 1e-12);
  const std::vector<std::string> notes = clean(test);
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_EQ(notes[0], "time is corrupt after 6 s: replaced by steps of 0.1 s per row");
  for (std::size_t i = 0; i < 100; ++i) EXPECT_NEAR(test.time_s[i], clean_record().time_s[i], 1e-9);
}

TEST(TensileCleaning, LeavesOutTheFailureTail) {
  TensileTest test = clean_record();
  for (const double stress_Pa : {90e3, 20e3, 0.0}) {
    test.time_s.push_back(test.time_s.back() + 0.1);
    test.strain.push_back(test.strain.back() + 0.02);
    test.stress_Pa.push_back(stress_Pa);
  }
  const std::vector<std::string> notes = clean(test);
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_EQ(notes[0], "failure tail: 3 rows after the largest stress, at a strain of 200 %, are left out");
  EXPECT_EQ(test.stress_Pa, clean_record().stress_Pa);
}

TEST(TensileCleaning, LeavesOutWhatFollowsADropOut) {
  TensileTest test = clean_record();
  for (std::size_t i = 80; i < 100; ++i) test.stress_Pa[i] -= 3e3;
  const std::vector<std::string> notes = clean(test);
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_EQ(notes[0].rfind("drop-out: the stress falls by 2.1", 0), 0U) << notes[0];
  EXPECT_EQ(test.strain.size(), 80U);
}

TEST(TensileCleaning, TakesNoiseForNoDropOut) {
  TensileTest test = clean_record();
  for (std::size_t i = 0; i < 99; ++i) test.stress_Pa[i] += i % 2 == 0 ? 1500.0 : -1500.0;
  (void)clean(test);
  EXPECT_GE(test.strain.size(), 99U);
}

TEST(TensileCleaning, TakesOffTheZeroOfTheLoad) {
  TensileTest test = clean_record();
  for (double& stress_Pa : test.stress_Pa) stress_Pa -= 2500.0;
  const std::vector<std::string> notes = clean(test);
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_EQ(notes[0], "zero of the load: -2.5 kPa at zero strain, subtracted");
  for (std::size_t i = 0; i < 100; ++i) EXPECT_NEAR(test.stress_Pa[i], clean_record().stress_Pa[i], 1e-3);
}

/// The curve of a law at strains of 0.02, 0.04, ... 1.2, with an error of the zero.
TensileTest record_of(const HyperelasticLaw& law, double offset_Pa, double step = 0.02, double first = 0.02) {
  TensileTest test;
  for (int i = 0; first + step * i <= 1.2; ++i) {
    test.strain.push_back(first + step * i);
    test.stress_Pa.push_back(nominal_stress(law, LoadingMode::uniaxial, 1.0 + test.strain.back()).stress_Pa + offset_Pa);
  }
  return test;
}

std::vector<HyperelasticLaw> laws_of_all_shapes() {
  std::vector<HyperelasticLaw> laws{Ogden<1>{{OgdenTerm{25e3, 5.0}}}, Ogden<1>{{OgdenTerm{10e3, 8.0}}},
                                    Ogden<1>{{OgdenTerm{-25e3, -5.0}}}};
  for_each_law([&](const auto& law) { laws.emplace_back(law); });
  return laws;
}

TEST(TensileCleaning, TakesTheShapeOfNoLawForAnErrorOfTheZero) {
  for (const HyperelasticLaw& law : laws_of_all_shapes()) {
    TensileTest test = record_of(law, 0.0);
    EXPECT_EQ(clean(test), std::vector<std::string>{}) << law_text(law);
    EXPECT_EQ(test.stress_Pa, record_of(law, 0.0).stress_Pa) << law_text(law);
  }
}

TEST(TensileCleaning, FindsTheErrorOfTheZeroUnderEveryLaw) {
  for (const HyperelasticLaw& law : laws_of_all_shapes()) {
    TensileTest test = record_of(law, -3000.0);
    const std::vector<std::string> notes = clean(test);
    ASSERT_EQ(notes.size(), 1U) << law_text(law);
    EXPECT_NE(notes[0].find(", subtracted"), std::string::npos) << notes[0];
    EXPECT_NEAR(test.stress_Pa[0], record_of(law, 0.0).stress_Pa[0], 500.0) << law_text(law);
  }
}

TEST(TensileCleaning, SaysWhereTheZeroCannotBeFound) {
  // Too coarse, too late, and bent near rest as no law is.
  for (const TensileTest& record :
       {record_of(NeoHookean{50e3}, -3000.0, 0.04, 0.04), record_of(NeoHookean{50e3}, -3000.0, 0.01, 0.11)}) {
    TensileTest test = record;
    const std::vector<std::string> notes = clean(test);
    ASSERT_EQ(notes.size(), 1U);
    EXPECT_EQ(notes[0].rfind("zero of the load: not determined", 0), 0U) << notes[0];
    EXPECT_EQ(test.stress_Pa, record.stress_Pa);
  }
  TensileTest bent = record_of(NeoHookean{50e3}, 0.0, 0.01, 0.01);
  for (std::size_t i = 0; i < bent.strain.size(); ++i) bent.stress_Pa[i] -= 8e3 * std::exp(-bent.strain[i] / 0.02);
  const std::vector<double> before = bent.stress_Pa;
  const std::vector<std::string> notes = clean(bent);
  ASSERT_EQ(notes.size(), 2U);
  EXPECT_NE(notes[0].find("nothing is subtracted"), std::string::npos) << notes[0];
  EXPECT_EQ(notes[1].rfind("first rows: the stress has the wrong sign up to a strain of 2 %", 0), 0U) << notes[1];
  EXPECT_EQ(bent.stress_Pa, std::vector<double>(before.begin() + 2, before.end()));
}

TEST(TensileCleaning, KeepsACompressionTestWhole) {
  TensileTest test;
  for (int i = 1; i <= 50; ++i) {
    test.strain.push_back(-0.01 * i);
    test.stress_Pa.push_back(nominal_stress(NeoHookean{50e3}, LoadingMode::uniaxial, 1.0 - 0.01 * i).stress_Pa);
  }
  const TensileTest whole = test;
  EXPECT_EQ(clean(test), std::vector<std::string>{});
  EXPECT_EQ(test.stress_Pa, whole.stress_Pa);
  test.strain.push_back(-0.51);
  test.stress_Pa.push_back(-10.0);
  const std::vector<std::string> notes = clean(test);
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_EQ(notes[0], "failure tail: 1 rows after the largest stress, at a strain of -50 %, are left out");
}

TEST(TensileCleaning, LeavesOutWhatFollowsAJump) {
  TensileTest test = clean_record();
  for (std::size_t i = 80; i < 100; ++i) test.stress_Pa[i] += 3e3;
  const std::vector<std::string> notes = clean(test);
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_EQ(notes[0].rfind("drop-out: the stress jumps by 3.", 0), 0U) << notes[0];
  EXPECT_EQ(test.strain.size(), 80U);
}

/// A record with the rows of the database: strains from 0.0446 in steps of 0.0227, noise of 0.15 kPa, an error of the zero, and
/// first rows that are low because the specimen settles in its grips.
TensileTest crosshead_record(const HyperelasticLaw& law, double highest_strain, double offset_Pa, double bent_Pa) {
  TensileTest test;
  for (int i = 0; 0.0446 + 0.02273 * i <= highest_strain; ++i) {
    const double strain = 0.0446 + 0.02273 * i;
    const double noise_Pa = i % 4 == 0 || i % 4 == 3 ? 150.0 : -150.0;
    test.time_s.push_back(0.2 + 0.1 * i);
    test.strain.push_back(strain);
    test.stress_Pa.push_back(nominal_stress(law, LoadingMode::uniaxial, 1.0 + strain).stress_Pa + offset_Pa + noise_Pa -
                             bent_Pa * std::exp(-(strain - 0.0446) / 0.025));
  }
  return test;
}

/// As in the record of Dragon Skin 30, whose bent start made the error of the zero twice as large as it is.
TEST(TensileCleaning, TakesNoBentStartForAnErrorOfTheZero) {
  const HyperelasticLaw law = Ogden<1>{{OgdenTerm::from_shear_modulus(155e3, 3.2)}};
  for (const double bent_Pa : {2e3, 3e3}) {
    TensileTest test = crosshead_record(law, 1.4, -4500.0, bent_Pa);
    const TensileTest before = test;
    const std::vector<std::string> notes = clean(test);
    ASSERT_EQ(notes.size(), 1U);
    EXPECT_NE(notes[0].find("the start is bent"), std::string::npos) << notes[0];
    EXPECT_NEAR(before.stress_Pa.back() - test.stress_Pa.back(), -4500.0, 500.0) << notes[0];
  }
}

TEST(TensileCleaning, SubtractsNothingWhereOnlyABentStartMakesTheZero) {
  TensileTest test = crosshead_record(Ogden<1>{{OgdenTerm::from_shear_modulus(155e3, 3.2)}}, 1.4, 0.0, 4e3);
  const TensileTest before = test;
  const std::vector<std::string> notes = clean(test);
  ASSERT_FALSE(notes.empty());
  EXPECT_NE(notes[0].find("nothing is subtracted"), std::string::npos) << notes[0];
  EXPECT_EQ(test.stress_Pa.back(), before.stress_Pa.back());
}

/// As in the record of Ecoflex 00-50.
TEST(TensileCleaning, LeavesOutFirstRowsOfTheWrongSign) {
  TensileTest test = crosshead_record(Ogden<1>{{OgdenTerm::from_shear_modulus(20e3, 2.4)}}, 1.4, 0.0, 0.0);
  test.stress_Pa[0] = -700.0;
  const TensileTest before = test;
  const std::vector<std::string> notes = clean(test);
  ASSERT_FALSE(notes.empty());
  EXPECT_EQ(notes.back(), "first rows: the stress has the wrong sign up to a strain of 4.5 % (-0.7 kPa): 1 rows are left out");
  ASSERT_EQ(test.strain.size(), before.strain.size() - 1);
  EXPECT_EQ(test.strain.front(), before.strain[1]);
  EXPECT_EQ(test.time_s.front(), before.time_s[1]);
  EXPECT_EQ(test.stress_Pa.size(), test.strain.size());
}

/// As in the record of Mold Star 16: the first row is 19 kPa too high. What follows is the test.
TEST(TensileCleaning, LeavesOutFirstRowsBeforeAFallWhileGripsSettle) {
  TensileTest test = crosshead_record(Ogden<1>{{OgdenTerm::from_shear_modulus(80e3, 3.2)}}, 1.4, 0.0, 0.0);
  const TensileTest before = test;
  test.stress_Pa[0] += 19e3;
  const std::vector<std::string> notes = clean(test);
  ASSERT_FALSE(notes.empty());
  EXPECT_EQ(notes[0].rfind("first rows: the stress falls by ", 0), 0U) << notes[0];
  EXPECT_NE(notes[0].find(" at a strain of 4.5 %: 1 rows up to there are left out"), std::string::npos) << notes[0];
  ASSERT_EQ(test.strain.size(), before.strain.size() - 1);
  EXPECT_EQ(test.strain.front(), before.strain[1]);
  EXPECT_EQ(test.time_s.front(), before.time_s[1]);
  EXPECT_EQ(test.strain.back(), before.strain.back());
}

/// A small fall among steep rises: what is missing is the fall and the rise together. As in the record of Ecoflex 00-50.
TEST(TensileCleaning, FindsASmallFallOfASteepCurve) {
  TensileTest test = crosshead_record(Ogden<1>{{OgdenTerm::from_shear_modulus(20e3, 2.4)}}, 16.0, 0.0, 0.0);
  for (std::size_t i = 0; i < test.stress_Pa.size(); ++i) test.stress_Pa[i] += i % 4 < 2 ? 350.0 : -350.0;
  const TensileTest whole = test;
  ASSERT_EQ(clean(test), std::vector<std::string>{}) << "noise is none";
  test = whole;
  const std::size_t at = 450;
  const double step_Pa = test.stress_Pa[at + 1] - test.stress_Pa[at];
  ASSERT_GT(step_Pa, 0.0);
  for (std::size_t i = at + 1; i < test.stress_Pa.size(); ++i) test.stress_Pa[i] -= step_Pa + 4700.0;
  const std::vector<std::string> notes = clean(test);
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_EQ(notes[0].rfind("drop-out: the stress falls by 4.7 kPa", 0), 0U) << notes[0];
  EXPECT_EQ(test.strain.size(), at + 1);
}

TEST(TensileCleaning, DividesCrossheadStrain) {
  TensileTest test = clean_record();
  EXPECT_EQ(correct_crosshead_strain(test, 1.71),
            "strain of the crosshead divided by 1.71 to correct for the shoulders of the specimen, an estimate");
  EXPECT_DOUBLE_EQ(test.strain[49], 1.0 / 1.71);
}

/// Records that were measured; the folder is named by MENGER_TENSILE_DATA.
fs::path measured(const char* name) {
  const char* folder = std::getenv("MENGER_TENSILE_DATA");
  return folder == nullptr ? fs::path() : fs::path(folder) / name;
}

TEST(TensileCleaning, FindsTheKnownFaultsOfTheDatabase) {
  if (measured("").empty()) GTEST_SKIP() << "MENGER_TENSILE_DATA names no folder with the curves of the database";
  TensileTest dragon_skin = read_tensile_test(measured("Dragon Skin 10 MEDIUM.csv"));
  EXPECT_EQ(dragon_skin.strain.size(), 457U);
  const std::vector<std::string> notes = clean(dragon_skin);
  ASSERT_EQ(notes.size(), 2U);
  EXPECT_EQ(notes[0].rfind("drop-out", 0), 0U) << notes[0];
  // A constant of 8 to 10 kPa would be a tenth of the stress at 100 %; the curve is bent near rest, which is something else.
  EXPECT_NE(notes[1].find("nothing is subtracted"), std::string::npos) << notes[1];
  EXPECT_NEAR(dragon_skin.strain.back(), 9.5, 0.01);

  TensileTest stiffer = read_tensile_test(measured("Dragon Skin 20.csv"));
  const std::vector<std::string> jump = clean(stiffer);
  ASSERT_FALSE(jump.empty());
  EXPECT_EQ(jump[0].rfind("drop-out: the stress jumps by 23.1 kPa", 0), 0U) << jump[0];
  EXPECT_NEAR(stiffer.strain.back(), 8.977, 0.001);

  TensileTest ecoflex = read_tensile_test(measured("Ecoflex 00-30.csv"));
  const std::vector<std::string> clock = clean(ecoflex);
  ASSERT_FALSE(clock.empty());
  EXPECT_EQ(clock[0], "time is corrupt after 40.9 s: replaced by steps of 0.1 s per row");
  EXPECT_NEAR(ecoflex.time_s.back(), 0.3 + 0.1 * 704, 1e-9);
  EXPECT_NEAR(ecoflex.strain.back(), 16.07, 0.01);
}

}  // namespace
}  // namespace menger::materials
