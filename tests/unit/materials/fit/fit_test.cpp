#include "materials/fit/fit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <map>
#include <numbers>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>

#include "io/text/input_error.h"
#include "io/text/toml_document.h"
#include "io/text/whole_file.h"
#include "materials/fit/fit_file.h"
#include "materials/fit/law_family.h"
#include "materials/fit/separable_fit.h"
#include "materials/fit/student_quantile.h"
#include "materials/laws/law_file.h"
#include "materials/laws/law_parameters.h"
#include "materials/laws/silicone_record.h"
#include "tests/support/test_folder.h"
#include "tests/unit/materials/laws/law_samples.h"

namespace menger::materials {
namespace {

namespace fs = std::filesystem;

/// The curve of a law up to a strain of 1.2, with errors (Pa) of alternating sign.
TensileTest curve_of(const HyperelasticLaw& law, double error_Pa = 0.0) {
  TensileTest test;
  test.material = "synthetic";
  for (int i = 1; i <= 30; ++i) {
    const double strain = 0.04 * i;
    test.strain.push_back(strain);
    const double error = i % 4 < 2 ? error_Pa : -error_Pa;
    test.stress_Pa.push_back(nominal_stress(law, LoadingMode::uniaxial, 1.0 + strain).stress_Pa + error);
  }
  return test;
}

const LawFit& fit_named(const std::vector<LawFit>& ranking, const std::string& name) {
  const auto found = std::find_if(ranking.begin(), ranking.end(), [&](const LawFit& fit) { return fit.name == name; });
  if (found == ranking.end()) throw std::logic_error("no fit of " + name);
  return *found;
}

double parameter(const LawFit& fit, const std::string& name) {
  for (const auto& [key, value] : parameters_of(fit.law))
    if (key == name) return value;
  throw std::logic_error("no parameter " + name);
}

TEST(Fit, FindsTheLawThatMadeACurve) {
  const std::vector<LawFamily> families = law_families(3.0);
  EXPECT_EQ(families.size(), 12U);
  for_each_law([&](const auto& law) {
    const std::string name(name_of(law));
    const TensileTest test = curve_of(law);
    std::vector<double> stretch;
    for (const double strain : test.strain) stretch.push_back(1.0 + strain);
    const auto family = std::find_if(families.begin(), families.end(), [&](const LawFamily& f) { return f.name == name; });
    ASSERT_NE(family, families.end()) << name;
    const std::optional<SeparableFit> fit = fit_family(*family, stretch, test.stress_Pa);
    ASSERT_TRUE(fit) << name;
    for (std::size_t i = 0; i < stretch.size(); ++i) {
      EXPECT_NEAR(nominal_stress(fit->law, LoadingMode::uniaxial, stretch[i]).stress_Pa, test.stress_Pa[i], 1.0) << name;
    }
    if (name == "ogden2" || name == "ogden3") return;  // tension alone does not tell their terms apart
    const auto expected = parameters_of(law);
    for (std::size_t p = 0; p < expected.size(); ++p) {
      EXPECT_NEAR(parameters_of(fit->law)[p].second, expected[p].second, 1e-6 * std::abs(expected[p].second)) << name;
    }
  });
}

TEST(Fit, StatisticsFollowTheirDefinitions) {
  const double error_Pa = 500.0;
  const LawFit fit = fit_named(fit_laws(curve_of(NeoHookean{50e3}, error_Pa), {0.0, 1.2}), "neo_hookean");
  const double n = 30.0;
  EXPECT_NEAR(fit.rmse_Pa, error_Pa, 1.0);  // the errors have next to no part along the law
  EXPECT_NEAR(fit.aic, n * std::log(std::pow(fit.rmse_Pa * 1e-6, 2)) + 2.0, 1e-9);
  // One parameter: half the interval is t s / sqrt(sum of (stress / mu)^2), t of 29 degrees of freedom 2.0452.
  double square = 0.0;
  for (int i = 1; i <= 30; ++i) square += std::pow(1.0 + 0.04 * i - std::pow(1.0 + 0.04 * i, -2), 2);
  const double expected = 2.0452 * fit.rmse_Pa * std::sqrt(n / (n - 1.0)) / std::sqrt(square);
  ASSERT_EQ(fit.confidence_95.size(), 1U);
  ASSERT_TRUE(fit.confidence_95[0]);
  const auto [low, high] = *fit.confidence_95[0];
  EXPECT_NEAR(0.5 * (high - low), expected, 1e-4 * expected);
  EXPECT_LT(low, 50e3);
  EXPECT_GT(high, 50e3);
  EXPECT_NEAR(fit.relative_rmse, fit.rmse_Pa / curve_of(NeoHookean{50e3}, error_Pa).stress_Pa.back(), 1e-12);
}

TEST(Fit, TakesParametersAtABoundForKnown) {
  const std::vector<LawFit> ranking = fit_laws(curve_of(Ogden<1>{{OgdenTerm{25e3, 3.25}}}, 200.0), {0.0, 1.2});
  const LawFit& held = fit_named(ranking, "mooney_rivlin_non_negative");
  EXPECT_EQ(parameter(held, "c01_Pa"), 0.0);
  EXPECT_EQ(held.at_bound, std::vector<std::string>{"c01_Pa"});
  ASSERT_EQ(held.confidence_95.size(), 2U);
  EXPECT_FALSE(held.confidence_95[1]);
  // What is left is the neo-Hookean law with C10 = mu / 2.
  const LawFit& simpler = fit_named(ranking, "neo_hookean");
  EXPECT_TRUE(simpler.at_bound.empty());
  ASSERT_TRUE(held.confidence_95[0] && simpler.confidence_95[0]);
  EXPECT_NEAR(held.confidence_95[0]->first, 0.5 * simpler.confidence_95[0]->first, 1.0);
  EXPECT_NEAR(held.confidence_95[0]->second, 0.5 * simpler.confidence_95[0]->second, 1.0);
  // A curve without locking drives it to the end of the search.
  const LawFit gent = fit_named(fit_laws(curve_of(MooneyRivlin{20e3, 5e3}), {0.0, 1.2}), "gent");
  EXPECT_EQ(gent.at_bound, std::vector<std::string>{"locking_excess"});
  ASSERT_EQ(gent.confidence_95.size(), 2U);
  EXPECT_TRUE(gent.confidence_95[0] && !gent.confidence_95[1]);
}

TEST(Fit, LeavesOutEmptyTermsAndRecommendsOnlyWhatTheTestDetermines) {
  for (const HyperelasticLaw& law :
       {HyperelasticLaw(MooneyRivlin{20e3, 5e3}), HyperelasticLaw(Ogden<1>{{OgdenTerm{25e3, 3.25}}})}) {
    const std::vector<LawFit> ranking = fit_laws(curve_of(law, 300.0), {0.0, 1.2});
    for (const LawFit& fit : ranking) {
      if (fit.name.rfind("ogden", 0) != 0) continue;
      for (const auto& [name, value] : parameters_of(fit.law)) EXPECT_NE(value, 0.0) << fit.name << ' ' << name;
    }
    const LawFit* best = recommended_fit(ranking);
    ASSERT_NE(best, nullptr);
    EXPECT_EQ(best->status, io::RunStatus::completed);
    EXPECT_LE(best->relative_rmse, 0.05);
    ASSERT_EQ(best->confidence_95.size(), parameters_of(best->law).size());
    for (const auto& interval : best->confidence_95)
      EXPECT_TRUE(!interval || interval->first > 0.0 || interval->second < 0.0) << best->name;
  }
}

/// Its law is known but has an equibiaxial stress that silicone has not, and no other is anywhere near.
TEST(Fit, RecommendsNothingThatMissesTheCurve) {
  const std::vector<LawFit> ranking = fit_laws(curve_of(Ogden<1>{{OgdenTerm{10e3, 8.0}}}), {0.0, 1.2});
  EXPECT_EQ(recommended_fit(ranking), nullptr);
  EXPECT_GT(fit_named(ranking, "neo_hookean").relative_rmse, 0.05);
}

TEST(Fit, SaysWhyALawIsNotUsable) {
  const std::vector<LawFit> ranking = fit_laws(curve_of(MooneyRivlin{20e3, 2e3}, 20.0), {0.0, 1.2});
  bool any_not_usable = false;
  for (const LawFit& fit : ranking) {
    const std::vector<std::string> reasons = shortcomings_of(fit);
    const bool is_usable = reasons.empty();
    EXPECT_FALSE(is_usable && any_not_usable) << fit.name << ": usable laws come first";
    any_not_usable = any_not_usable || !is_usable;
    const auto says = [&](const std::string& reason) { return std::ranges::find(reasons, reason) != reasons.end(); };
    EXPECT_EQ(says("unstable"), !fit.stable) << fit.name;
    EXPECT_EQ(says("it has terms of opposite signs"), fit.cancelled != 0.0) << fit.name;
    EXPECT_EQ(says("its equibiaxial stress is not that of a silicone"), !fit.plausible) << fit.name;
  }
  EXPECT_TRUE(any_not_usable);
  LawFit fit = fit_named(ranking, "mooney_rivlin");
  EXPECT_EQ(shortcomings_of(fit), std::vector<std::string>{});
  fit.confidence_95[1] = std::pair{-1.0, 1.0};
  EXPECT_EQ(shortcomings_of(fit), std::vector<std::string>{"the interval of c01_Pa contains 0"});
  fit.confidence_95[1].reset();
  fit.relative_rmse = 0.06;
  EXPECT_EQ(shortcomings_of(fit),
            (std::vector<std::string>{"its RMSE is more than 5 % of the largest stress", "c01_Pa is at a bound of its search"}));
  fit.confidence_95.clear();
  fit.stable_with_margin = false;
  EXPECT_EQ(shortcomings_of(fit), (std::vector<std::string>{"unstable soon beyond the fitted strains",
                                                            "its RMSE is more than 5 % of the largest stress",
                                                            "the test does not determine its parameters"}));
}

TEST(Fit, KnowsTheRowsOfARange) {
  const TensileTest test = curve_of(NeoHookean{50e3});
  const FittedRows some = fitted_rows(test, {0.1, 0.5});
  EXPECT_EQ(some.count, 10U);
  EXPECT_EQ(some.lowest_strain, test.strain[2]);
  EXPECT_EQ(some.highest_strain, test.strain[11]);
  EXPECT_EQ(fitted_rows(test, {-1.0, 5.0}).highest_strain, test.strain.back());
  EXPECT_EQ(fitted_rows(test, {2.0, 5.0}).count, 0U);
}

TEST(StudentQuantile, IsThatOfTheTables) {
  // Printed to six digits; for one and two degrees of freedom tan(0.475 pi) and 0.95 sqrt(2 / (1 - 0.95^2)).
  EXPECT_NEAR(student_quantile_95(1), std::tan(0.475 * std::numbers::pi), 1e-10);
  EXPECT_NEAR(student_quantile_95(2), 0.95 * std::sqrt(2.0 / (1.0 - 0.95 * 0.95)), 1e-12);
  EXPECT_NEAR(student_quantile_95(5), 2.570582, 1e-6);
  EXPECT_NEAR(student_quantile_95(29), 2.045230, 1e-6);
  // Falls ever more slowly, without a jump between one way of computing it and another.
  const double step = student_quantile_95(198) - student_quantile_95(199);
  EXPECT_NEAR(student_quantile_95(199) - student_quantile_95(200), step, 0.02 * step);
  EXPECT_NEAR(student_quantile_95(100000000), 1.959964, 1e-6);
}

TEST(Fit, NeverPutsAnUnstableLawFirst) {
  // Softening far beyond what a stable law can do, convex, negative and constant curves.
  for (const auto& stress : std::vector<std::function<double(double)>>{
           [](double e) { return 1e5 * e * std::exp(-4.0 * e); }, [](double e) { return 1e5 * e * e * e; },
           [](double e) { return -1e5 * e; }, [](double) { return 3e4; }}) {
    TensileTest test = curve_of(NeoHookean{1.0});
    for (std::size_t i = 0; i < test.strain.size(); ++i) test.stress_Pa[i] = stress(test.strain[i]);
    const std::vector<LawFit> ranking = fit_laws(test, {0.0, 1.2});
    bool any_stable = false;
    for (const LawFit& fit : ranking) any_stable = any_stable || fit.stable;
    EXPECT_EQ(ranking.front().stable, any_stable);
    const LawFit* best = recommended_fit(ranking);
    EXPECT_TRUE(best == nullptr || (best->stable && best->plausible));
  }
}

/// Two large terms of opposite sign can follow a curve in tension and mean nothing.
TEST(Fit, PutsCancellingTermsBehind) {
  const std::vector<LawFit> ranking = fit_laws(curve_of(Ogden<2>{{OgdenTerm{60e3, 2.8}, OgdenTerm{-40e3, 2.2}}}), {0.0, 1.2});
  EXPECT_FALSE(ranking.front().cancelling);
  EXPECT_NE(recommended_fit(ranking), nullptr);
  EXPECT_TRUE(fit_named(ranking, "ogden2").cancelling);
}

TEST(Fit, MeasuresWhatTermsTakeFromEachOther) {
  EXPECT_EQ(cancelled_part(Ogden<2>{{OgdenTerm{20e3, 2.0}, OgdenTerm{-3e3, -4.0}}}), 0.0) << "both parts are positive";
  // Parts of 60 kPa and -20 kPa: 20 of them are cancelled, 40 are left.
  EXPECT_NEAR(cancelled_part(Ogden<2>{{OgdenTerm{60e3, 2.0}, OgdenTerm{-10e3, 4.0}}}), 0.5, 1e-12);
  EXPECT_GT(cancelled_part(Ogden<3>{{OgdenTerm{-5e8, 7.9636620}, OgdenTerm{22e3, 3.475}, OgdenTerm{5e8, 7.9636621}}}),
            most_cancelled);
  EXPECT_EQ(cancelled_part(NeoHookean{50e3}), 0.0);
}

/// Its exponents are equal to six digits and its moduli cancel: that it is close says nothing of a law that is recommended.
TEST(Fit, CountsNoCancellingLawAsTheClosest) {
  std::vector<LawFit> ranking = fit_laws(curve_of(Ogden<1>{{OgdenTerm{25e3, 3.25}}}, 900.0), {0.0, 1.2});
  ASSERT_NE(recommended_fit(ranking), nullptr);
  const LawFit& recommended = ranking.front();
  ASSERT_GT(recommended.relative_rmse, 5e-3);
  LawFit closer = recommended;
  closer.name = "ogden3";
  closer.law = Ogden<3>{{OgdenTerm{-5e8, 7.9636620}, OgdenTerm{22e3, 3.475}, OgdenTerm{5e8, 7.9636621}}};
  closer.relative_rmse = 0.1 * recommended.relative_rmse;
  closer.confidence_95.clear();
  ranking.push_back(closer);
  EXPECT_EQ(recommended_fit(ranking), nullptr) << "a law of sound terms would count";
  ranking.back().cancelled = cancelled_part(closer.law);
  ranking.back().cancelling = true;
  EXPECT_NE(recommended_fit(ranking), nullptr);
  ASSERT_EQ(cancelling_notes(ranking).size(), 1U);
  EXPECT_EQ(cancelling_notes(ranking)[0].rfind("ogden3: its terms cancel ", 0), 0U) << cancelling_notes(ranking)[0];
}

TEST(Fit, TellsHowFarItIs) {
  double last = 0.0;
  std::set<std::string> laws;
  (void)fit_laws(curve_of(NeoHookean{50e3}), {0.0, 1.2}, [&](double done, std::string_view law) {
    EXPECT_GE(done, last);
    EXPECT_LE(done, 1.0 + 1e-12);
    last = done;
    laws.emplace(law);
  });
  EXPECT_NEAR(last, 1.0, 1e-12);
  EXPECT_EQ(laws.size(), 12U);
}

/// Many rows are thinned for the search only: the result is that of all.
TEST(Fit, EndsOnAllRowsOfALongRecord) {
  const HyperelasticLaw law = Ogden<2>{{OgdenTerm::from_shear_modulus(40e3, 3.2), OgdenTerm::from_shear_modulus(10e3, -2.0)}};
  std::vector<double> stretch;
  std::vector<double> stress_Pa;
  for (int i = 1; i <= 3000; ++i) {
    stretch.push_back(1.0 + 1e-3 * i);
    stress_Pa.push_back(nominal_stress(law, LoadingMode::uniaxial, stretch.back()).stress_Pa + (i % 7 == 0 ? 300.0 : -50.0));
  }
  for (const LawFamily& family : law_families(20.0)) {
    if (family.name != "ogden1" && family.name != "ogden2") continue;
    const std::optional<SeparableFit> fit = fit_family(family, stretch, stress_Pa);
    ASSERT_TRUE(fit) << family.name;
    const auto square_of = [&](const HyperelasticLaw& of) {
      double square = 0.0;
      for (std::size_t i = 0; i < stretch.size(); ++i)
        square += std::pow(nominal_stress(of, LoadingMode::uniaxial, stretch[i]).stress_Pa - stress_Pa[i], 2);
      return square;
    };
    // At the least squares of all rows no parameter can be moved to lower them.
    const double least = square_of(fit->law);
    std::vector<double> values;
    for (const auto& [name, value] : parameters_of(fit->law)) values.push_back(value);
    for (std::size_t p = 0; p < values.size(); ++p) {
      for (const double factor : {0.999, 1.001}) {
        std::vector<double> moved = values;
        moved[p] *= factor;
        EXPECT_GT(square_of(with_parameters(fit->law, moved)), least) << family.name << ' ' << p;
      }
    }
  }
}

TEST(Fit, RecommendsNothingForACurveThatNoStableLawHas) {
  TensileTest test = curve_of(NeoHookean{50e3});
  for (double& stress_Pa : test.stress_Pa) stress_Pa = -stress_Pa;
  EXPECT_EQ(recommended_fit(fit_laws(test, {0.0, 1.2})), nullptr);
}

TEST(Fit, RefusesARangeWithTooFewRows) {
  try {
    (void)fit_laws(curve_of(NeoHookean{50e3}), {0.5, 0.61});
    FAIL();
  } catch (const io::InputError& error) {
    EXPECT_EQ(std::string(error.what()), "strain range 0.5 to 0.61: holds 3 rows of the test, at least 8 are needed");
  }
  TensileTest slack = curve_of(NeoHookean{50e3});
  std::fill(slack.stress_Pa.begin(), slack.stress_Pa.end(), 0.0);
  EXPECT_THROW((void)fit_laws(slack, {0.0, 1.2}), io::InputError);
}

TEST(FitFile, HoldsTheLawsInTheirRanking) {
  FitReport report{.file = "folder/test.csv",
                   .material = "a \"b\"",
                   .strain_source = "",
                   .repairs = {"one"},
                   .range = {0.0, 1.2},
                   .ranking = {}};
  const TensileTest test = curve_of(Ogden<1>{{OgdenTerm{25e3, 3.25}}}, 100.0);
  report.ranking = fit_laws(test, report.range);
  const io::TomlTable table = io::parse_toml(fit_text(report, test), "fits.toml");
  EXPECT_EQ(table.text("material"), "a \"b\"");
  EXPECT_EQ(table.texts("repairs"), std::vector<std::string>{"one"});
  EXPECT_EQ(table.text("recommended"), report.ranking.front().name);
  const std::vector<io::TomlTable> fits = table.tables("fits");
  ASSERT_EQ(fits.size(), report.ranking.size());
  for (std::size_t i = 0; i < fits.size(); ++i) {
    EXPECT_EQ(fits[i].text("name"), report.ranking[i].name);
    const std::vector<std::string> reasons = shortcomings_of(report.ranking[i]);
    EXPECT_EQ(fits[i].boolean("usable"), reasons.empty());
    EXPECT_EQ(fits[i].has("not_usable_because") ? fits[i].texts("not_usable_because") : std::vector<std::string>{}, reasons);
    ASSERT_TRUE(fits[i].has("law")) << report.ranking[i].name;
    EXPECT_EQ(law_text(read_law(fits[i].table("law"))), law_text(report.ranking[i].law));
  }
}

TEST(FitFile, StatesTheStrainsOfTheRowsAndNotTheRangeThatWasAskedFor) {
  const TensileTest test = curve_of(NeoHookean{50e3}, 100.0);
  const auto table_of = [&](const StrainRange& range) {
    FitReport report{.file = "test.csv", .material = "", .strain_source = "", .repairs = {}, .range = range, .ranking = {}};
    report.ranking = fit_laws(test, range);
    return io::parse_toml(fit_text(report, test), "fits.toml");
  };
  const io::TomlTable wide = table_of({0.0, 5.0});
  EXPECT_EQ(wide.number("lowest_strain"), test.strain.front());
  EXPECT_EQ(wide.number("highest_strain"), test.strain.back());
  EXPECT_EQ(wide.numbers("range"), (std::vector{0.0, 5.0}));
  EXPECT_EQ(table_of({0.0, 0.5}).number("highest_strain"), test.strain[11]);
}

TEST(FitFile, WritesARecordOfTheSilicone) {
  const TensileTest test = curve_of(NeoHookean{50e3}, 100.0);
  FitReport report{
      .file = "a/test.csv", .material = "Mix 3", .strain_source = "", .repairs = {"one"}, .range = {0.0, 5.0}, .ranking = {}};
  report.ranking = fit_laws(test, report.range);
  const LawFit* best = recommended_fit(report.ranking);
  ASSERT_NE(best, nullptr);
  const std::string text = silicone_text(report, test, *best, 1100.0);
  EXPECT_TRUE(text.starts_with(silicone_text_start)) << text;
  const tests::TestFolder folder;
  io::write_whole(folder / "silicone.toml", text);
  const SiliconeRecord record = read_silicone(folder / "silicone.toml");
  EXPECT_EQ(record.name, "Mix 3");
  EXPECT_EQ(record.data_sheet.density_kg_per_m3, 1100.0);
  EXPECT_EQ(law_text(record.recommended.law), law_text(best->law));
  EXPECT_EQ(record.recommended.smallest_stretch, 1.0);
  EXPECT_EQ(record.recommended.largest_stretch, 1.0 + test.strain.back());
  EXPECT_EQ(record.recommended.source, "tensile test test.csv, strains of 0.04 to 1.2, fitted by menger fit; one");
  EXPECT_EQ(record.not_measured, (std::vector<std::string>{"bulk modulus", "damping", "friction", "compression"}));
}

TEST(FitFile, DoesNotOfferALawWithoutStiffness) {
  FitReport report{.file = "test.csv", .material = "", .strain_source = "", .repairs = {}, .range = {0.0, 1.2}, .ranking = {}};
  TensileTest test = curve_of(NeoHookean{50e3});
  for (double& stress_Pa : test.stress_Pa) stress_Pa = -stress_Pa;
  report.ranking = fit_laws(test, report.range);
  const std::vector<io::TomlTable> fits = io::parse_toml(fit_text(report, test), "fits.toml").tables("fits");
  ASSERT_EQ(fits.size(), report.ranking.size());
  bool any_without = false;
  for (std::size_t i = 0; i < fits.size(); ++i) {
    any_without = any_without || !fits[i].has("law");
    EXPECT_EQ(fits[i].has("law"), shear_modulus_at_rest_Pa(report.ranking[i].law) > 0.0);
    if (fits[i].has("law")) {
      EXPECT_NO_THROW(static_cast<void>(read_law(fits[i].table("law"))));
    }
    EXPECT_NE(fits[i].has("law"), fits[i].has("parameters_of_no_law"));
  }
  EXPECT_TRUE(any_without);
}

/// The fits of the measured curve by other code, raw rows, to ten digits: strain range, law, parameters (Pa where they have a
/// unit) and RMSE.
struct KnownFit {
  double highest_strain;
  std::string name;
  std::map<std::string, double> parameters;
  double rmse_Pa;
  double aic;
  double tolerance;
};

const std::vector<KnownFit>& known_fits() {
  static const std::vector<KnownFit> fits{
      {1.0, "neo_hookean", {{"shear_modulus_Pa", 56355.89195}}, 6535.465754, -420.5629798, 1e-6},
      {1.0, "mooney_rivlin", {{"c10_Pa", 49084.55397}, {"c01_Pa", -35110.00717}}, 1055.12538, -571.7440368, 1e-6},
      {1.0,
       "yeoh",
       {{"c10_Pa", 20446.40842}, {"c20_Pa", 4473.011129}, {"c30_Pa", -534.0704709}},
       618.9689524,
       -614.5462573,
       1e-6},
      {1.0,
       "yeoh_non_negative",
       {{"c10_Pa", 21849.89279}, {"c20_Pa", 2752.702481}, {"c30_Pa", 0.0}},
       1117.412581,
       -564.9261148,
       1e-6},
      {1.0, "ogden1", {{"modulus_1_Pa", 24730.94192}, {"exponent_1", 3.252772413}}, 733.3349936, -602.3042672, 1e-4},
      {1.0, "gent", {{"shear_modulus_Pa", 45780.03569}, {"locking_excess", 6.389523004}}, 1639.437742, -534.7257626, 1e-4},
      {1.0,
       "arruda_boyce",
       {{"shear_modulus_Pa", 31974.21714}, {"locking_stretch", 1.531090951}},
       1592.977518,
       -537.1406303,
       1e-4},
      {2.0, "neo_hookean", {{"shear_modulus_Pa", 78634.87476}}, 24584.87597, -642.7785452, 1e-6},
      {2.0, "mooney_rivlin", {{"c10_Pa", 68341.61491}, {"c01_Pa", -67855.68964}}, 6030.538289, -885.2999067, 1e-6},
      {2.0,
       "yeoh",
       {{"c10_Pa", 21589.78136}, {"c20_Pa", 3044.251204}, {"c30_Pa", -111.6003155}},
       841.5591367,
       -1225.964243,
       1e-6},
      {2.0,
       "yeoh_non_negative",
       {{"c10_Pa", 25028.61942}, {"c20_Pa", 1811.293888}, {"c30_Pa", 0.0}},
       3927.057285,
       -957.9364954,
       1e-6},
      {2.0, "ogden1", {{"modulus_1_Pa", 27039.3653}, {"exponent_1", 3.131440739}}, 2032.368447, -1074.548299, 1e-4},
      {2.0, "gent", {{"shear_modulus_Pa", 57359.9484}, {"locking_excess", 15.53755742}}, 7398.261022, -849.7327928, 1e-4},
      {2.0,
       "arruda_boyce",
       {{"shear_modulus_Pa", 49311.46772}, {"locking_stretch", 2.14866715}},
       7449.195974,
       -848.5389565,
       1e-4},
  };
  return fits;
}

/// The law of one of the known fits.
HyperelasticLaw law_of(const KnownFit& known) {
  HyperelasticLaw law = NeoHookean{};
  if (known.name.rfind("mooney_rivlin", 0) == 0) law = MooneyRivlin{};
  if (known.name.rfind("yeoh", 0) == 0) law = Yeoh{};
  if (known.name == "ogden1") law = Ogden<1>{};
  if (known.name == "gent") law = Gent{};
  if (known.name == "arruda_boyce") law = ArrudaBoyce{};
  std::vector<double> values;
  for (const auto& [name, value] : parameters_of(law)) values.push_back(known.parameters.at(name));
  return with_parameters(law, values);
}

/// The curves of the known laws lead back to them, with the tolerances at which other code agrees on the measured curve.
TEST(Fit, FindsTheKnownLawsFromTheirOwnCurves) {
  for (const KnownFit& known : known_fits()) {
    const HyperelasticLaw law = law_of(known);
    std::vector<double> stretch;
    std::vector<double> stress_Pa;
    for (int i = 2; i * 0.0227 <= known.highest_strain; ++i) {
      stretch.push_back(1.0 + 0.0227 * i);
      stress_Pa.push_back(nominal_stress(law, LoadingMode::uniaxial, stretch.back()).stress_Pa);
    }
    const double largest_excess = stretch.back() * stretch.back() + 2.0 / stretch.back() - 3.0;
    for (const LawFamily& family : law_families(largest_excess)) {
      if (family.name != known.name) continue;
      const std::optional<SeparableFit> fit = fit_family(family, stretch, stress_Pa);
      ASSERT_TRUE(fit) << known.name;
      EXPECT_EQ(fit->status, io::RunStatus::completed) << known.name;
      for (const auto& [name, value] : parameters_of(fit->law)) {
        const double expected = known.parameters.at(name);
        // A modulus of 0 is found to the rounding of the others, 1e4 Pa.
        const double tolerance = expected == 0.0 ? 1e-3 : known.tolerance * std::abs(expected);
        EXPECT_NEAR(value, expected, tolerance) << known.name << ' ' << name << ' ' << known.highest_strain;
      }
    }
  }
}

/// The measured curve must not be part of the project; MENGER_TENSILE_DATA names the folder in which it lies.
TEST(Fit, ReproducesTheKnownFitsOfAMeasuredCurve) {
  const char* folder = std::getenv("MENGER_TENSILE_DATA");
  if (folder == nullptr) GTEST_SKIP() << "MENGER_TENSILE_DATA names no folder with the curves of the database";
  const TensileTest test = read_tensile_test(fs::path(folder) / "Dragon Skin 10 MEDIUM.csv");
  for (const double highest : {1.0, 2.0}) {
    const std::vector<LawFit> ranking = fit_laws(test, {0.0, highest});
    EXPECT_EQ(ranking.front().name, "ogden1");
    for (const KnownFit& known : known_fits()) {
      if (known.highest_strain != highest) continue;
      const LawFit& fit = fit_named(ranking, known.name);
      EXPECT_EQ(fit.status, io::RunStatus::completed);
      for (const auto& [name, value] : known.parameters)
        EXPECT_NEAR(parameter(fit, name), value, known.tolerance * std::abs(value))
            << known.name << ' ' << name << ' ' << highest;
      EXPECT_NEAR(fit.rmse_Pa, known.rmse_Pa, 1e-6 * known.rmse_Pa) << known.name;
      EXPECT_NEAR(fit.aic, known.aic, 1e-4) << known.name;
    }
  }
}

/// The other code's best minima of several terms, which their parameters do not determine: RMSE in Pa. And what is recommended up
/// to a strain of 3, where a law whose terms cancel used to stand in the way.
TEST(Fit, FindsTheBestMinimaOfSeveralTermsOfAMeasuredCurve) {
  const char* folder = std::getenv("MENGER_TENSILE_DATA");
  if (folder == nullptr) GTEST_SKIP() << "MENGER_TENSILE_DATA names no folder with the curves of the database";
  const TensileTest test = read_tensile_test(fs::path(folder) / "Dragon Skin 10 MEDIUM.csv");
  const std::map<double, std::map<std::string, double>> known{{1.0, {{"ogden2", 514.5}, {"ogden3", 347.0}}},
                                                              {2.0, {{"ogden2", 645.5}, {"ogden3", 506.5}}}};
  for (const auto& [highest, rmse_Pa] : known) {
    const std::vector<LawFit> ranking = fit_laws(test, {0.0, highest});
    for (const auto& [name, value] : rmse_Pa) EXPECT_LE(fit_named(ranking, name).rmse_Pa, value) << name << ' ' << highest;
  }
  const std::vector<LawFit> wide = fit_laws(test, {0.0, 3.0});
  const LawFit* best = recommended_fit(wide);
  ASSERT_NE(best, nullptr);
  EXPECT_EQ(best->name, "ogden1");
  for (const LawFit& fit : wide) EXPECT_LE(fit.cancelled, most_cancelled) << fit.name;
}

/// Which laws of the same fits the other code found stable.
TEST(Fit, FindsTheKnownStableLawsOfAMeasuredCurve) {
  const char* folder = std::getenv("MENGER_TENSILE_DATA");
  if (folder == nullptr) GTEST_SKIP() << "MENGER_TENSILE_DATA names no folder with the curves of the database";
  const TensileTest test = read_tensile_test(fs::path(folder) / "Dragon Skin 10 MEDIUM.csv");
  const std::map<std::string, bool> known{{"neo_hookean", true},       {"mooney_rivlin", false}, {"yeoh", false},
                                          {"yeoh_non_negative", true}, {"ogden1", true},         {"ogden2", false},
                                          {"ogden3", false},           {"gent", false},          {"arruda_boyce", true}};
  for (const double highest : {1.0, 2.0}) {
    const std::vector<LawFit> ranking = fit_laws(test, {0.0, highest});
    for (const auto& [name, stable] : known) EXPECT_EQ(fit_named(ranking, name).stable, stable) << name << ' ' << highest;
  }
}

}  // namespace
}  // namespace menger::materials
