#include "evolution/verdict/verdict.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace menger::evolution {
namespace {

const ManifestBody table{.layers = {{"101"}, {"111"}}, .cell_edge_m = 0.012};

WalkFacts walk(WalkModel model, double body_lengths, double direction_deg) {
  return {.name = "table",
          .source = model == WalkModel::elements ? "locomote/locomotion.toml" : "simulate/result.toml",
          .model = model,
          .status = io::RunStatus::completed,
          .time_s = 2.0,
          .body_lengths = body_lengths,
          .per_minute = 30.0 * body_lengths,
          .direction_deg = direction_deg,
          .stated = {.body = table, .drive = "mode = in_phase"}};
}

ReportFacts two_walks(double elements, double elements_deg, double surrogate, double surrogate_deg) {
  ReportFacts facts;
  facts.walks = {walk(WalkModel::elements, elements, elements_deg), walk(WalkModel::surrogate, surrogate, surrogate_deg)};
  return facts;
}

/// Walks of one body on finite elements of two meshes and in the surrogate.
ReportFacts walks_of_two_meshes(double coarse, double coarse_deg, double fine, double fine_deg) {
  ReportFacts facts;
  facts.walks = {walk(WalkModel::elements, coarse, coarse_deg), walk(WalkModel::elements, fine, fine_deg),
                 walk(WalkModel::surrogate, 1.0, 0.0)};
  facts.walks[0].place = "locomote";
  facts.walks[1].place = "locomote_finer";
  return facts;
}

/// The finding that has a text; an empty one if none has.
Finding finding_with(const Verdict& verdict, const std::string& text) {
  const auto found = std::ranges::find_if(verdict.findings,
                                          [&](const Finding& finding) { return finding.text.find(text) != std::string::npos; });
  return found == verdict.findings.end() ? Finding{} : *found;
}

TEST(Verdict, SaysThatNothingWasComputed) {
  const Verdict verdict = verdict_of({});
  EXPECT_EQ(verdict.headline, "Nothing here compares the surrogate with finite elements on a whole body.");
  EXPECT_EQ(verdict.tone, Tone::missing);
  ASSERT_EQ(verdict.findings.size(), 5U);
  for (const Finding& finding : verdict.findings) {
    EXPECT_EQ(finding.tone, Tone::missing);
    EXPECT_TRUE(finding.text.ends_with("was not computed.")) << finding.text;
    EXPECT_TRUE(finding.source.starts_with("menger ")) << finding.source;
  }
}

TEST(Verdict, MissesNoWalkOfARobotThatDoesNotWalk) {
  ReportFacts facts;
  facts.robot_walks = false;
  EXPECT_EQ(finding_with(verdict_of(facts), "A walk").text, "");
  EXPECT_NE(finding_with(verdict_of({}), "A walk").text, "");
}

TEST(Verdict, StatesTheLowestLimitPressure) {
  ReportFacts facts;
  facts.inflations = {{.name = "table",
                       .source = "inflate/result.toml",
                       .status = io::RunStatus::limit_point,
                       .highest_pressure_Pa = 3042.0,
                       .limit = meshes::LimitPressure{3042.0, "plenum 0"}}};
  const Verdict verdict = verdict_of(facts);
  EXPECT_TRUE(
      verdict.headline.starts_with("Usable up to 2.43 kPa, 20 % or more below 3.04 kPa, where the body balloons or buckles."))
      << verdict.headline;
  const Finding finding = finding_with(verdict, "Balloons or buckles at 3.04 kPa: there the pressure stops rising");
  EXPECT_EQ(finding.tone, Tone::caution);
  EXPECT_EQ(finding.source, "inflate/result.toml");
  EXPECT_EQ(finding.text.find("thin walls"), std::string::npos);
  facts.inflations.front().stated.elements = "thin_wall";
  EXPECT_NE(
      finding_with(verdict_of(facts), "Up to 2.17 kPa it is 20 % or more below that and below what it may be: thin walls put")
          .text,
      "");
  EXPECT_TRUE(verdict_of(facts).headline.starts_with("Usable up to 2.17 kPa")) << verdict_of(facts).headline;
}

/// An inflation to a pressure, one to the limit pressure, and a walk that is driven with a pressure, all of one body.
ReportFacts driven_body(double inflated_Pa, double limit_Pa, double drive_Pa) {
  ReportFacts facts;
  facts.inflations = {
      {.name = "table", .status = io::RunStatus::completed, .highest_pressure_Pa = inflated_Pa, .stated = {.body = table}},
      {.name = "table",
       .status = io::RunStatus::completed,
       .highest_pressure_Pa = limit_Pa,
       .limit = meshes::LimitPressure{limit_Pa, "plenum 0"},
       .stated = {.body = table}}};
  facts.walks = {walk(WalkModel::elements, 0.8, 0.0)};
  facts.walks.front().stated.highest_pressure_Pa = drive_Pa;
  return facts;
}

TEST(Verdict, NamesADriveNearOrBeyondTheLimitPressure) {
  const Verdict safe = verdict_of(driven_body(2900.0, 7610.0, 2900.0));
  EXPECT_TRUE(safe.headline.starts_with("Usable up to 6.08 kPa, 20 % or more below 7.61 kPa")) << safe.headline;
  EXPECT_EQ(finding_with(safe, "The drive of 2.9 kPa is 38 % of the limit pressure.").tone, Tone::good);

  const Verdict near = verdict_of(driven_body(7000.0, 7610.0, 7000.0));
  EXPECT_TRUE(
      near.headline.starts_with("The drive of 7 kPa is 92 % of the limit pressure of 7.61 kPa, where the body balloons or "
                                "buckles: a thin spot in a cast wall decides."))
      << near.headline;
  EXPECT_EQ(finding_with(near, "Inflated to 7 kPa").tone, Tone::caution);
  EXPECT_NE(finding_with(near, "7 kPa is 92 % of the limit pressure, 7.61 kPa: a thin spot").text, "");

  const Verdict beyond = verdict_of(driven_body(7000.0, 7500.0, 300e3));
  EXPECT_EQ(beyond.tone, Tone::bad);
  EXPECT_TRUE(beyond.headline.starts_with("The drive of 300 kPa is 40 times the limit pressure of 7.5 kPa")) << beyond.headline;
  EXPECT_EQ(finding_with(beyond, "The drive of 300 kPa is 40 times the limit pressure: it balloons or buckles before.").tone,
            Tone::bad);
}

TEST(Verdict, NamesTheVacuumAtWhichWallsTouch) {
  ReportFacts facts;
  facts.inflations = {{.status = io::RunStatus::wall_contact, .highest_pressure_Pa = 0.0, .last_pressure_Pa = -515.85}};
  EXPECT_NE(finding_with(verdict_of(facts), "Walls of chambers touch beyond -0.516 kPa. The finite elements end there.").text,
            "");
}

TEST(Verdict, SaysThatTheElementsOfAValidationEndedEarly) {
  ReportFacts facts;
  facts.validations = {{.bodies = 1, .displacement = {.count = 9, .median = 0.05}}};
  EXPECT_EQ(finding_with(verdict_of(facts), "shapes are 5 %").tone, Tone::good);
  facts.validations.front().early_end = "limit_point, pressure_Pa = 5000 was not reached";
  const Finding finding =
      finding_with(verdict_of(facts),
                   "Its finite elements, quadratic ones, ended before the pressure of the drive (limit_point, "
                   "pressure_Pa = 5000 was not reached).");
  EXPECT_EQ(finding.tone, Tone::caution);
}

TEST(Verdict, TellsAVacuumByItsLowestPressure) {
  ReportFacts facts;
  facts.inflations = {{.status = io::RunStatus::completed,
                       .highest_pressure_Pa = 0.0,
                       .lowest_pressure_Pa = -900.0,
                       .volume_growth = -0.34,
                       .stated = {.elements = "thin_wall"}}};
  EXPECT_NE(finding_with(verdict_of(facts),
                         "Evacuated to -0.9 kPa by thin walls, where no walls of its chambers touch. Its chamber then has 0.66 "
                         "times its volume at rest.")
                .text,
            "");
  EXPECT_EQ(verdict_of(facts).headline.find("Usable"), std::string::npos) << verdict_of(facts).headline;
}

TEST(Verdict, SaysThatABodyFellOver) {
  ReportFacts facts = two_walks(0.5, 0.0, 1.2, 0.0);
  facts.walks.back().fell_s = 1.67;
  const Verdict verdict = verdict_of(facts);
  EXPECT_NE(finding_with(verdict, "The body falls over in the surrogate, at 1.7 s: this is no walk.").text, "");
  EXPECT_NE(finding_with(verdict, "in the surrogate it does not walk. Do not trust the surrogate").text, "");
  facts.walks.erase(facts.walks.begin());
  EXPECT_EQ(finding_with(verdict_of(facts), "It moves 1.2 body lengths").text.find("towards"), std::string::npos);
}

TEST(Verdict, TellsADirectionThatMeshesAgreeOn) {
  ReportFacts facts = two_walks(0.53, 0.0, 0.85, 1.0);
  facts.walks.back().model = WalkModel::elements;
  facts.walks.back().body_lengths = 3.0;  // more than comparable
  EXPECT_NE(finding_with(verdict_of(facts), "The direction of this walk is known, its distance is not.").text, "");
  facts.walks.back().direction_deg = 180.0;
  EXPECT_NE(finding_with(verdict_of(facts), "How it walks is not known: chance decides such a walk.").text, "");
}

TEST(Verdict, ClaimsNoMoreThanThePressureThatWasReached) {
  ReportFacts facts;
  facts.inflations = {{.status = io::RunStatus::completed, .highest_pressure_Pa = 6000.0, .volume_growth = 0.68}};
  EXPECT_TRUE(verdict_of(facts).headline.starts_with(
      "Usable up to 4.8 kPa at least, 20 % or more below 6 kPa, to which it was inflated."));
  EXPECT_NE(
      finding_with(verdict_of(facts), "How far this is from ballooning was not computed (path.volume_ratio, or menger loop).")
          .text,
      "");
  EXPECT_NE(finding_with(verdict_of(facts), "Its chamber then has 1.68 times its volume at rest").text, "");
  facts.inflations.front().sideways_m = 0.0031;
  EXPECT_NE(
      finding_with(verdict_of(facts), "at rest. The middle of its far end moves 3.1 mm sideways, seen from the near one.").text,
      "");
  facts.inflations.front().plena = 2;
  EXPECT_NE(finding_with(verdict_of(facts), "the one that grows most then has 1.68 times").text, "");
  facts.inflations.front().status = io::RunStatus::not_converged;
  facts.inflations.front().reason = "the step became too small";
  EXPECT_TRUE(verdict_of(facts).headline.starts_with("Known up to 6 kPa only."));
  EXPECT_EQ(finding_with(verdict_of(facts), "not_converged, the step became too small").tone, Tone::caution);
  facts.inflations.front().status = io::RunStatus::wall_contact;
  EXPECT_NE(finding_with(verdict_of(facts), "Walls of chambers touch beyond 6 kPa").text, "");
}

TEST(Verdict, HasNoPressureInTheHeadlineForSeveralBodies) {
  ReportFacts facts;
  facts.inflations = {{.name = "cube", .status = io::RunStatus::completed, .highest_pressure_Pa = 6000.0},
                      {.name = "table", .status = io::RunStatus::completed, .highest_pressure_Pa = 3000.0}};
  const Verdict verdict = verdict_of(facts);
  EXPECT_EQ(verdict.headline.find("kPa"), std::string::npos);
  EXPECT_NE(finding_with(verdict, "cube: Inflated to 6 kPa").text, "");
  EXPECT_NE(finding_with(verdict, "table: Inflated to 3 kPa").text, "");
}

TEST(Verdict, TakesTheLimitPressureOfAnyInflationOfOneBody) {
  ReportFacts facts;
  facts.inflations = {
      {.name = "table", .status = io::RunStatus::completed, .highest_pressure_Pa = 2000.0, .stated = {.body = table}},
      {.name = "table",
       .status = io::RunStatus::limit_point,
       .highest_pressure_Pa = 3042.0,
       .limit = meshes::LimitPressure{3042.0, "plenum 0"},
       .stated = {.body = table}}};
  EXPECT_TRUE(verdict_of(facts).headline.starts_with("Usable up to 2.43 kPa, 20 % or more below 3.04 kPa, where"));
  facts.inflations.back().limit.reset();
  facts.inflations.back().status = io::RunStatus::completed;
  EXPECT_TRUE(verdict_of(facts).headline.starts_with("Usable up to 2.43 kPa at least, 20 % or more below 3.04 kPa, to which"));
  facts.inflations.back().stated.elements = "thin_wall";
  EXPECT_TRUE(verdict_of(facts).headline.starts_with("Usable up to 2.17 kPa at least")) << verdict_of(facts).headline;
  EXPECT_NE(finding_with(verdict_of(facts), "; thin walls balloon 1 to 12 % too late.").text, "");
}

TEST(Verdict, HasNoPressureInTheHeadlineForSeveralWallsOrSilicones) {
  ReportFacts facts;
  facts.inflations = {{.name = "table",
                       .place = "thick",
                       .status = io::RunStatus::completed,
                       .highest_pressure_Pa = 6000.0,
                       .stated = {.body = table, .wall_thickness_m = 0.003}},
                      {.name = "table",
                       .place = "thin",
                       .status = io::RunStatus::completed,
                       .highest_pressure_Pa = 3000.0,
                       .stated = {.body = table, .wall_thickness_m = 0.002}}};
  const Verdict walls = verdict_of(facts);
  EXPECT_EQ(walls.headline.find("kPa"), std::string::npos) << walls.headline;
  EXPECT_NE(finding_with(walls, "thick: Inflated to 6 kPa").text, "");
  EXPECT_NE(finding_with(walls, "thin: Inflated to 3 kPa").text, "");
  facts.inflations[0].stated = {.body = table, .law = "name = gent"};
  facts.inflations[1].stated = {.body = table, .law = "name = yeoh"};
  EXPECT_EQ(verdict_of(facts).headline.find("kPa"), std::string::npos);
  // The second one states no law, so that it agrees with either, but these do not agree with each other.
  facts.inflations.insert(facts.inflations.begin(), facts.inflations[0]);
  facts.inflations[0].stated = {.body = table};
  EXPECT_EQ(verdict_of(facts).headline.find("kPa"), std::string::npos);
}

TEST(Verdict, TrustsASurrogateThatWalksAlike) {
  const Verdict verdict = verdict_of(two_walks(0.8, 10.0, 0.9, -10.0));
  EXPECT_EQ(verdict.headline, "The surrogate walks as finite elements do.");
  EXPECT_EQ(verdict.tone, Tone::good);
  const Finding finding = finding_with(verdict, "Both models agree");
  EXPECT_EQ(finding.text,
            "It walks 24 body lengths a minute on finite elements and 27 in the surrogate, in about the same direction (20 "
            "degrees apart). Both models agree "
            "on this walk.");
  EXPECT_EQ(finding.source, "locomote/locomotion.toml, simulate/result.toml");
}

TEST(Verdict, NamesTheBodiesThatWalkInBothModelsWhereThePageHasOthers) {
  ReportFacts facts = two_walks(0.8, 0.0, 0.8, 0.0);
  facts.rankings = {{.designs = 3, .compared = 3, .spearman = IntervalFact{0.5, {}, {}}}};
  const Verdict ranked = verdict_of(facts);
  EXPECT_EQ(ranked.headline,
            "With table, the surrogate walks as finite elements do. The surrogate's ranking of robots is to be checked on finite "
            "elements, robot by robot.");
  EXPECT_EQ(ranked.tone, Tone::caution);
  facts.rankings.clear();
  for (const double surrogate : {0.8, 2.0, 0.8}) {  // alike, too fast
    ReportFacts other = two_walks(0.8, 0.0, surrogate, 0.0);
    for (WalkFacts& one : other.walks) {
      one.name = surrogate > 1.0 ? "bench" : "chair";
      one.stated.body = ManifestBody{.layers = {{surrogate > 1.0 ? "11" : "111"}}, .cell_edge_m = 0.012};
      facts.walks.push_back(one);
    }
    const std::string expected = surrogate > 1.0 || facts.walks.size() > 4
                                     ? "The surrogate tells where bench walks, not how fast: let finite elements decide."
                                     : "With table, chair, the surrogate walks as finite elements do.";
    EXPECT_EQ(verdict_of(facts).headline, expected);
  }
}

TEST(Verdict, ComparesOnlyWalksThatLastEquallyLong) {
  ReportFacts facts = two_walks(0.8, 0.0, 0.8, 0.0);
  facts.walks[0].time_s = 5.0;
  EXPECT_NE(finding_with(verdict_of(facts), "No body walks in both models").text, "");
  ReportFacts meshes = walks_of_two_meshes(0.1, -176.0, 0.32, 0.0);
  EXPECT_NE(finding_with(verdict_of(meshes), "chance decides").text, "");
  meshes.walks[0].time_s = 5.0;
  EXPECT_EQ(finding_with(verdict_of(meshes), "chance decides").text, "");
}

TEST(Verdict, DoesNotTrustASurrogateThatGoesAnotherWay) {
  const Verdict verdict = verdict_of(two_walks(0.8, 170.0, 0.8, -60.0));
  EXPECT_EQ(verdict.headline, "Do not trust the surrogate for the walk of this body: let finite elements decide.");
  EXPECT_EQ(verdict.tone, Tone::bad);
  EXPECT_NE(finding_with(verdict, "in another direction (130 degrees apart)").text, "");
}

TEST(Verdict, TrustsTheDirectionAloneOfASurrogateThatIsTooFast) {
  const Verdict verdict = verdict_of(two_walks(0.3, 90.0, 0.8, 89.0));
  EXPECT_EQ(verdict.headline, "The surrogate tells where this body walks, not how fast: let finite elements decide.");
  EXPECT_NE(finding_with(verdict, "(1 degree apart)").text, "");
}

TEST(Verdict, DoesNotTrustTheDirectionOfASurrogateThatHopsOnce) {
  const Verdict verdict = verdict_of(two_walks(2.3, 0.0, 0.17, 0.0));
  EXPECT_EQ(verdict.headline, "Do not trust the surrogate for the walk of this body: let finite elements decide.");
  EXPECT_NE(finding_with(verdict, "in about the same direction (0 degrees apart). Do not trust the surrogate").text, "");
}

TEST(Verdict, ComparesNoWalksThatGoNowhere) {
  EXPECT_EQ(verdict_of(two_walks(0.01, 0.0, 0.02, 180.0)).headline,
            "Both models walk, but too little or too briefly to tell whether the surrogate can be trusted.");
  const Verdict one_goes = verdict_of(two_walks(0.01, 0.0, 0.8, 0.0));
  EXPECT_EQ(one_goes.tone, Tone::bad);
  EXPECT_EQ(finding_with(one_goes, "on finite elements it does not walk").tone, Tone::bad);
}

TEST(Verdict, CallsNoWalkWhatIsShorterThanWalksAreKnown) {
  ReportFacts facts;
  facts.walks = {walk(WalkModel::elements, 0.058, 0.0)};
  EXPECT_EQ(finding_with(verdict_of(facts), "on finite elements in 2 s").tone, Tone::caution);
  EXPECT_TRUE(finding_with(verdict_of(facts), "on finite elements in 2 s").text.ends_with(": it does not walk."));
  facts.walks = {walk(WalkModel::elements, 0.11, 0.0)};
  EXPECT_EQ(finding_with(verdict_of(facts), "does not walk").text, "");
}

TEST(Verdict, ComparesOnlyWalksOfOneBodyAndDrive) {
  ReportFacts facts = two_walks(0.8, 0.0, 0.8, 0.0);
  facts.walks[1].stated.drive = "mode = wave";
  EXPECT_EQ(finding_with(verdict_of(facts), "No body walks in both models with the same walls").tone, Tone::missing);
  EXPECT_EQ(verdict_of(facts).headline,
            "The walks in both models are not of one body and drive, so they do not tell whether the surrogate can be trusted.");
  facts = two_walks(0.8, 0.0, 0.8, 0.0);
  facts.walks[1].stated.body->cell_edge_m = 0.01;
  EXPECT_NE(finding_with(verdict_of(facts), "No body walks in both models").text, "");
}

TEST(Verdict, DoesNotTrustASurrogateWhoseWalkEndedEarly) {
  ReportFacts facts = two_walks(0.8, 0.0, 0.8, 0.0);
  facts.walks[1].status = io::RunStatus::diverged;
  facts.walks[1].reason = "voxel 3 is too fast";
  facts.walks[1].body_lengths.reset();
  facts.walks[1].per_minute.reset();
  const Verdict verdict = verdict_of(facts);
  EXPECT_EQ(verdict.tone, Tone::bad);
  EXPECT_NE(finding_with(verdict, "surrogate: diverged, voxel 3 is too fast").text, "");
}

TEST(Verdict, RepeatsTheExpectedErrorOfTheSurrogate) {
  ReportFacts facts;
  facts.walks = {walk(WalkModel::surrogate, 0.8, 0.0)};
  facts.walks[0].expected_error = {"expected error for a plate on legs: 9.1 % in displacement"};
  facts.walks[0].outside_validity = {"level 1: pressure 7 kPa"};
  const Verdict verdict = verdict_of(facts);
  EXPECT_NE(finding_with(verdict, "Expected error for a plate on legs: 9.1 % in displacement.").text, "");
  EXPECT_NE(finding_with(verdict, "Beyond what the surrogate was fitted to: level 1: pressure 7 kPa.").text, "");
}

TEST(Verdict, PutsTheMeasuredErrorBesideTheExpectedOne) {
  ReportFacts facts;
  facts.walks = {walk(WalkModel::surrogate, 0.8, 0.0)};
  facts.walks[0].expected_error = {"expected error for a block: 9.3 % in displacement (median over 7 bodies of this kind)",
                                   "warning: 10 of 248 displacements went the wrong way"};
  facts.validations = {
      {.source = "validate/summary.csv", .bodies = 1, .displacement = {.count = 30, .median = 0.26}, .volume = {.median = 0.05}}};
  const Finding finding = finding_with(verdict_of(facts), "Expected error for a block");
  EXPECT_TRUE(
      finding.text.ends_with(" Measured on this body: 26 % in displacement and 5 % in chamber volume. This body is further "
                             "off than others of its kind."))
      << finding.text;
  EXPECT_EQ(finding.tone, Tone::bad);
  facts.validations[0].displacement = {.count = 30, .median = 0.1, .percentile_90 = 1.05};
  const Finding alike = finding_with(verdict_of(facts), "Expected error for a block");
  EXPECT_TRUE(alike.text.ends_with(
      " Measured on this body: 10 % in displacement (one displacement in ten by more than 105 %) and 5 % in chamber volume."))
      << alike.text;
  EXPECT_EQ(alike.tone, Tone::caution);
  facts.validations[0].displacement = {.count = 30, .median = 0.26};
  EXPECT_TRUE(finding.source.ends_with(", validate/summary.csv")) << finding.source;
  EXPECT_EQ(finding_with(verdict_of(facts), "Warning: 10 of 248").text.find("Measured"), std::string::npos);
  // Where other bodies walk, too, the validation may have had one of them.
  facts.walks.push_back(walk(WalkModel::elements, 0.8, 0.0));
  facts.walks[1].stated.body.reset();
  EXPECT_EQ(finding_with(verdict_of(facts), "Expected error for a block").text.find("Measured"), std::string::npos);
  facts.walks.pop_back();
  // After a fit the only body of its kind is the robot itself.
  facts.walks[0].expected_error[0] = "expected error for a block: 26 % in displacement (median over 1 body of this kind)";
  EXPECT_EQ(finding_with(verdict_of(facts), "Expected error").text, "");
  EXPECT_EQ(finding_with(verdict_of(facts), "Warning: 10").text, "");
  EXPECT_NE(finding_with(verdict_of(facts), "shapes are 26 % off").text, "");
}

TEST(Verdict, SaysThatParametersCameWithMenger) {
  ReportFacts facts = two_walks(0.8, 0.0, 0.8, 0.0);
  EXPECT_EQ(finding_with(verdict_of(facts), "A calibration of the surrogate").tone, Tone::missing);
  facts.shipped = {{.file = "ecoflex_00_30_12mm.toml", .source = "simulate/manifest.json"}};
  EXPECT_EQ(finding_with(verdict_of(facts), "A calibration of the surrogate").text, "");
  const Finding finding = finding_with(verdict_of(facts), "came with menger: ecoflex_00_30_12mm.toml.");
  EXPECT_EQ(finding.tone, Tone::note);
  EXPECT_EQ(finding.source, "simulate/manifest.json");
}

/// A walk along a line, by its lowest, highest and last place on it, and its largest retreat.
ReportFacts walk_along_a_line(double lowest, double highest, double end, double retreat) {
  ReportFacts facts;
  facts.walks = {walk(WalkModel::elements, end, 0.0)};
  facts.walks[0].lowest_lengths = lowest;
  facts.walks[0].highest_lengths = highest;
  facts.walks[0].retreat_lengths = retreat;
  return facts;
}

TEST(Verdict, SaysThatAWalkGoesToAndFro) {
  const auto found = [](const ReportFacts& facts) { return finding_with(verdict_of(facts), "to and fro").text; };
  EXPECT_EQ(found(walk_along_a_line(-0.02, 0.17, 0.15, 0.05)), "");
  EXPECT_EQ(found(walk_along_a_line(-0.24, 0.17, 0.15, 0.3)),
            "The walk on finite elements goes to and fro: along the line to its end it is between -0.24 and 0.17 body lengths, "
            "comes back by up to 0.3, and ends at 0.15. Its direction and distance depend on when one looks.");
  EXPECT_NE(found(walk_along_a_line(0.0, 0.4, 0.15, 0.25)), "") << "it comes back to less than half of its way";
}

TEST(Verdict, DoesNotCallAStepBackAtTheBeginningToAndFro) {
  EXPECT_EQ(finding_with(verdict_of(walk_along_a_line(-0.12, 1.2, 1.1, 0.15)), "to and fro").text, "");
}

TEST(Verdict, TellsHowFarABodyWandersThatDoesNotWalk) {
  ReportFacts facts = walk_along_a_line(-0.068, 0.3, 0.0097, 0.3);
  facts.walks[0].direction_deg = -140.0;
  facts.walks[0].farthest_lengths = 0.39;
  facts.walks[0].farthest_m = 0.014;
  facts.walks[0].end_m = 0.00035;
  const Verdict verdict = verdict_of(facts);
  EXPECT_EQ(finding_with(verdict, "to and fro").text, "") << "the line to its end is chance";
  EXPECT_EQ(finding_with(verdict, "wanders").text,
            "What it does on finite elements is no walk: it wanders up to 14 mm from its start, and ends 0.35 mm from it.");
  for (const Finding& finding : verdict.findings) EXPECT_EQ(finding.text.find("degrees"), std::string::npos) << finding.text;

  WalkFacts finer = facts.walks[0];
  finer.direction_deg = 20.0;
  facts.walks.push_back(finer);
  const Verdict both = verdict_of(facts);
  EXPECT_NE(finding_with(both, "2 walks on finite elements").text.find("It does not walk."), std::string::npos);
  for (const Finding& finding : both.findings) EXPECT_EQ(finding.text.find("degrees"), std::string::npos) << finding.text;

  facts.walks.resize(1);
  facts.walks[0].farthest_lengths = 0.05;
  EXPECT_EQ(finding_with(verdict_of(facts), "wanders").text, "") << "it stays where it is";
}

TEST(Verdict, JudgesShapesByTheirMedianError) {
  ReportFacts facts;
  facts.validations = {{.source = "validate/summary.csv",
                        .bodies = 2,
                        .displacement = {.count = 28, .median = 0.078, .worst = 1.53, .worst_body = "plane"},
                        .volume = {.median = 0.031}}};
  const Verdict good = verdict_of(facts);
  EXPECT_EQ(good.headline, "The surrogate's shapes can be used; its walks were not compared.");
  EXPECT_EQ(finding_with(good, "The surrogate's shapes are").text,
            "The surrogate's shapes are 7.8 % off finite elements (median of 28 displacements of 2 bodies, inside the range of "
            "the fit; the worst is 153 % off, of plane), its volumes 3.1 %.");
  facts.validations.front().signs = 26;
  facts.validations.front().wrong_signs = 4;
  facts.validations.front().wrong_ways = {"plane extent y (4 of 5)"};
  const Verdict wrong_way = verdict_of(facts);
  EXPECT_EQ(wrong_way.headline, "The surrogate's shapes are rough; its walks were not compared.");
  EXPECT_NE(finding_with(wrong_way, "4 of 26 displacements of at least 0.2 mm go the wrong way: plane extent y (4 of 5).").text,
            "");
  facts.validations.front().displacement.median = 0.3;
  EXPECT_EQ(verdict_of(facts).headline, "Do not trust the surrogate's shapes; its walks were not compared.");
  facts.validations.front().displacement.median.reset();
  EXPECT_NE(finding_with(verdict_of(facts), "no displacement was compared inside the range of its fit").text, "");
}

TEST(Verdict, TrustsTheShapeOfOneBodyWhereTheLoopDoes) {
  ReportFacts facts;
  facts.validations = {{.bodies = 1, .displacement = {.count = 30, .median = 0.12, .worst = 1.11}, .volume = {.median = 0.056}}};
  EXPECT_EQ(verdict_of(facts).headline, "The surrogate's shapes can be used; its walks were not compared.");
  EXPECT_NE(finding_with(verdict_of(facts), "the worst is 111 % off), its volumes 5.6 %.").text, "");
  facts.validations.front().signs = 30;
  facts.validations.front().wrong_signs = 5;
  facts.validations.front().wrong_ways = {"extent y (5 of 5)"};
  const Finding wrong_way =
      finding_with(verdict_of(facts), "5 of 30 displacements of at least 0.2 mm go the wrong way: extent y (5 of 5).");
  EXPECT_TRUE(wrong_way.text.ends_with("Do not trust the surrogate for this body.")) << wrong_way.text;
  EXPECT_EQ(wrong_way.tone, Tone::bad);
  facts.walks = two_walks(0.8, 0.0, 0.8, 0.0).walks;
  const Verdict walks_alike = verdict_of(facts);
  EXPECT_EQ(walks_alike.headline,
            "The surrogate walks as finite elements do. Do not trust the surrogate for the shape of this body.");
  EXPECT_EQ(walks_alike.tone, Tone::bad);
  facts.validations = {{.bodies = 1, .displacement = {}, .outside = 36}};
  EXPECT_EQ(finding_with(verdict_of(facts), "all that was compared lies outside").tone, Tone::bad);
  facts.validations.front().displacement_outside = 0.05;
  const Verdict close = verdict_of(facts);
  EXPECT_EQ(finding_with(close, "The surrogate's shapes are 5 % off finite elements (median), though all that was compared").tone,
            Tone::caution);
  EXPECT_EQ(close.headline.find("Do not trust"), std::string::npos) << close.headline;
  facts.validations.front().volume_outside = 0.16;
  EXPECT_EQ(finding_with(verdict_of(facts), "its shapes are 5 % off finite elements (median), its volumes 16 %. Also, all").tone,
            Tone::bad);
  facts.validations.front().volume_outside.reset();
  facts.validations.front().signs = 4;
  facts.validations.front().wrong_signs = 1;
  EXPECT_EQ(finding_with(verdict_of(facts), "1 of 4 displacements of at least 0.2 mm goes the wrong way").tone, Tone::bad);
  facts.validations.front().wrong_signs = 0;
  facts.validations.front().displacement_outside.reset();
  facts.validations.front().outside_why = {"it is longer than the bodies of the fit",
                                           "its pressures are beyond those of the fit"};
  EXPECT_NE(
      finding_with(verdict_of(facts),
                   "outside the range of its fit: it is longer than the bodies of the fit; its pressures are beyond those of "
                   "the fit.")
          .text,
      "");
}

TEST(Verdict, TellsErrorsOfShapesInMillimetresBesideTheirShareOfACurve) {
  ReportFacts facts;
  facts.validations = {{.bodies = 1,
                        .displacement = {.count = 36,
                                         .median = 0.21,
                                         .worst = 2.67,
                                         .worst_observable = "the extent along y",
                                         .median_m = 0.00068,
                                         .worst_m = 0.00108,
                                         .furthest_m = 0.00207,
                                         .furthest_error = 0.25,
                                         .furthest_body = "robot",
                                         .furthest_observable = "the height of the top"},
                        .volume = {.median = 0.056}}};
  EXPECT_EQ(
      finding_with(verdict_of(facts), "The surrogate's shapes are").text,
      "The surrogate's shapes are 21 % (0.68 mm) off finite elements (median of 36 displacements of 1 body, inside the range "
      "of the fit; the worst is 267 % off, or 1.08 mm, in the extent along y; furthest off over the length of its body, by 2.07 "
      "mm or 25 %, is the height of the top), its volumes "
      "5.6 %. Do not trust the surrogate for this body.");
  facts.validations.front().bodies = 2;
  facts.validations.front().displacement.worst_body = "plane";
  EXPECT_NE(finding_with(verdict_of(facts),
                         "the worst is 267 % off, or 1.08 mm, of plane in the extent along y; furthest off over the length of "
                         "its body, by 2.07 mm or 25 %, is robot in the height of the top)")
                .text,
            "");
}

TEST(Verdict, JudgesByTheWorstOfSeveralValidations) {
  ReportFacts facts;
  facts.validations = {{.source = "a", .displacement = {.count = 8, .median = 0.05}},
                       {.source = "b", .displacement = {.count = 8, .median = 0.2}}};
  EXPECT_EQ(verdict_of(facts).headline, "The surrogate's shapes are rough; its walks were not compared.");
  facts.validations[1].displacement.median.reset();
  EXPECT_EQ(verdict_of(facts).headline, "The surrogate's shapes can be used; its walks were not compared.");
  facts.validations.erase(facts.validations.begin());
  EXPECT_EQ(verdict_of(facts).headline,
            "Whether the surrogate can be trusted is not known: no shape was compared inside its range.");
  facts.validations.front() = {.source = "c", .bodies = 1, .outside = 9, .displacement_outside = 0.044};
  EXPECT_EQ(verdict_of(facts).headline,
            "The surrogate's shapes are close to finite elements, though some outside the range of its fit; its walks were not "
            "compared.");
  facts.validations.front().displacement_outside = 0.5;
  EXPECT_EQ(verdict_of(facts).headline, "Do not trust the surrogate's shapes; its walks were not compared.");
}

TEST(Verdict, SaysWhetherADriveIsSafeByThePressureThatABodyBore) {
  ReportFacts facts;
  facts.inflations = {{.status = io::RunStatus::completed, .highest_pressure_Pa = 6000.0, .stated = {.body = table}}};
  facts.walks = {walk(WalkModel::elements, 0.8, 0.0)};
  facts.walks.front().stated = {.body = table, .highest_pressure_Pa = 6000.0};
  EXPECT_TRUE(
      verdict_of(facts).headline.starts_with("Usable up to 4.8 kPa at least, 20 % or more below 6 kPa, to which it was inflated. "
                                             "Whether its drive of 6 kPa is safe is not "
                                             "known."))
      << verdict_of(facts).headline;
  EXPECT_EQ(finding_with(verdict_of(facts), "is safe is not known").tone, Tone::caution);
  facts.walks.front().stated.highest_pressure_Pa = 4000.0;
  EXPECT_EQ(verdict_of(facts).headline.find("not known"), std::string::npos) << verdict_of(facts).headline;
  facts.inflations.push_back(
      {.place = "limit", .status = io::RunStatus::not_converged, .highest_pressure_Pa = 9000.0, .stated = {.body = table}});
  EXPECT_NE(finding_with(verdict_of(facts), "No limit pressure was found up to 9 kPa.").text, "") << "the stage of a loop ran";
}

TEST(Verdict, TakesTheInflationThatFoundNoEquilibriumBeforeOneThatWentFurther) {
  ReportFacts facts;
  facts.inflations = {
      {.place = "thin",
       .status = io::RunStatus::completed,
       .highest_pressure_Pa = 6000.0,
       .stated = {.body = table, .elements = "thin_wall"}},
      {.place = "quadratic", .status = io::RunStatus::limit_point, .highest_pressure_Pa = 5000.0, .stated = {.body = table}}};
  EXPECT_TRUE(verdict_of(facts).headline.starts_with(
      "Usable up to 4 kPa, 20 % or more below 5 kPa, beyond which the body balloons or buckles."))
      << verdict_of(facts).headline;
}

TEST(Verdict, NamesTheSofterLawWhereItDecides) {
  ReportFacts facts;
  facts.inflations = {{.place = "limit",
                       .status = io::RunStatus::limit_point,
                       .highest_pressure_Pa = 12000.0,
                       .limit = meshes::LimitPressure{12000.0, "plenum 0"},
                       .stated = {.body = table}}};
  facts.walks = {walk(WalkModel::elements, 0.8, 0.0)};
  facts.walks.front().stated = {.body = table, .highest_pressure_Pa = 6000.0};
  facts.softest_limit_Pa = 5000.0;
  EXPECT_TRUE(
      verdict_of(facts).headline.starts_with("The silicone decides whether the drive of 6 kPa is safe: by its softest law the "
                                             "body balloons near 5 kPa, by its own at 12 "
                                             "kPa."))
      << verdict_of(facts).headline;
}

TEST(Verdict, CallsAVacuumByItsName) {
  ReportFacts facts;
  facts.inflations = {{.status = io::RunStatus::limit_point, .highest_pressure_Pa = 0.0, .lowest_pressure_Pa = -3000.0}};
  EXPECT_NE(
      finding_with(verdict_of(facts), "Evacuated to -3 kPa. Beyond it no equilibrium was found (limit point): the body buckles.")
          .text,
      "");
  facts.inflations.front().status = io::RunStatus::not_converged;
  EXPECT_NE(finding_with(verdict_of(facts), "Evacuated to -3 kPa only (not_converged)").text, "");
}

TEST(Verdict, DoesNotSpeakOfASurrogateThatNothingIsAbout) {
  ReportFacts facts;
  facts.inflations = {{.status = io::RunStatus::completed, .highest_pressure_Pa = 6000.0}};
  const std::string usable = "Usable up to 4.8 kPa at least, 20 % or more below 6 kPa, to which it was inflated.";
  EXPECT_EQ(verdict_of(facts).headline, usable);
  facts.walks = {walk(WalkModel::elements, 0.8, 0.0)};
  EXPECT_EQ(verdict_of(facts).headline, usable + " Nothing here compares the surrogate with finite elements on a whole body.");
}

TEST(Verdict, SaysWhatIsCountedInACalibration) {
  ReportFacts facts;
  facts.calibrations = {
      {.source = "residuals.csv", .status = io::RunStatus::completed, .cases = 28, .quantities = 85, .median_error = 0.04}};
  EXPECT_EQ(finding_with(verdict_of(facts), "The fitted surrogate").text,
            "The fitted surrogate is 4 % off the finite elements it was fitted to (median of 85 quantities of 28 load cases).");
}

TEST(Verdict, TellsWalksOfOneBodyApartByTheirFolder) {
  ReportFacts facts;
  facts.walks = {walk(WalkModel::elements, 0.8, 0.0), walk(WalkModel::elements, 0.5, 0.0)};
  facts.walks[0].place = "locomote";
  facts.walks[1].place = "locomote_finer";
  const Verdict verdict = verdict_of(facts);
  EXPECT_NE(finding_with(verdict, "locomote: It moves 0.8").text, "");
  EXPECT_NE(finding_with(verdict, "locomote_finer: It moves 0.5").text, "");
  facts.walks.pop_back();
  EXPECT_TRUE(finding_with(verdict_of(facts), "It moves 0.8").text.starts_with("It moves"));
}

TEST(Verdict, SaysThatAWalkIsNotKnownWhereFiniteElementsDisagree) {
  const Verdict verdict = verdict_of(walks_of_two_meshes(0.1, -176.0, 0.32, 0.0));
  EXPECT_EQ(verdict.headline, "How this body walks is not known: finite elements do not agree among themselves.");
  EXPECT_EQ(verdict.tone, Tone::bad);
  EXPECT_EQ(
      finding_with(verdict, "2 walks on finite elements").text,
      "2 walks on finite elements, of one body driven alike (locomote and locomote_finer): 3 and 9.6 body lengths a minute, "
      "176 degrees apart. How it walks is not known: chance decides such a walk.");
  EXPECT_EQ(finding_with(verdict, "2 walks on finite elements").tone, Tone::bad);
  EXPECT_EQ(finding_with(verdict, "so this says nothing of the surrogate").tone, Tone::note);
  EXPECT_EQ(finding_with(verdict, "Do not trust the surrogate").text, "") << "nothing is known that it could be compared with";
}

TEST(Verdict, TellsHowWellFiniteElementsKnowAWalk) {
  EXPECT_EQ(finding_with(verdict_of(walks_of_two_meshes(0.9, 0.0, 0.95, 3.0)), "They agree").tone, Tone::good);
  EXPECT_EQ(verdict_of(walks_of_two_meshes(0.9, 0.0, 0.95, 3.0)).headline, "The surrogate walks as finite elements do.");
  EXPECT_EQ(finding_with(verdict_of(walks_of_two_meshes(0.4, 0.0, 0.9, 3.0)), "not how fast").tone, Tone::caution);
  EXPECT_EQ(finding_with(verdict_of(walks_of_two_meshes(0.01, 0.0, 0.02, 3.0)), "It does not walk").tone, Tone::caution);
  ReportFacts other_drive = walks_of_two_meshes(0.1, -176.0, 0.32, 0.0);
  other_drive.walks[0].stated.drive = "mode = wave";
  EXPECT_EQ(finding_with(verdict_of(other_drive), "walks on finite elements").text, "") << "two walks, not one on two meshes";
}

TEST(Verdict, CallsARankingChanceWhereItsIntervalReachesZero) {
  ReportFacts facts;
  facts.rankings = {{.source = "reevaluate/ranking.csv", .designs = 8, .compared = 8, .spearman = IntervalFact{0.5, -0.3, 0.9}}};
  EXPECT_EQ(finding_with(verdict_of(facts), "0.50 (95 % interval -0.30 to 0.90): this can be chance.").tone, Tone::caution);
  facts.rankings.front().spearman = IntervalFact{0.8, 0.6, 0.9};
  EXPECT_EQ(verdict_of(facts).headline, "The surrogate's ranking of robots holds on finite elements.");
  facts.rankings.front().spearman = IntervalFact{0.2, 0.1, 0.3};
  EXPECT_EQ(verdict_of(facts).headline, "The surrogate's ranking of robots does not hold on finite elements.");
  facts.rankings.front().compared_with = "the search";
  EXPECT_EQ(verdict_of(facts).headline, "The search's ranking of robots does not hold on finite elements.");
  EXPECT_NE(finding_with(verdict_of(facts), "the rank correlation of the distances of the search with those").text, "");
}

TEST(Verdict, SaysWhetherASearchImproved) {
  ReportFacts facts;
  facts.searches = {{.source = "run.sqlite",
                     .generations = 13,
                     .first_generation = "0",
                     .first_fitness = 0.278,
                     .last_generation = "12",
                     .last_fitness = 0.622,
                     .unit = "body lengths"}};
  EXPECT_EQ(finding_with(verdict_of(facts),
                         "The best robot of generation 12 has a fitness of 0.622 body lengths; the best of "
                         "generation 0 had 0.278.")
                .tone,
            Tone::good);
  EXPECT_EQ(finding_with(verdict_of(facts), "walk on finer elements was not computed").source, "menger reevaluate");
  EXPECT_EQ(verdict_of(facts).headline,
            "The best robot of the search has a fitness of 0.622 body lengths. Nothing here compares its model with finite "
            "elements.");
  facts.searches.front().is_walk = false;
  EXPECT_EQ(finding_with(verdict_of(facts), "That is no walk: give the search more generations or mutants.").tone, Tone::caution);
  facts.searches.front().is_walk = true;
  facts.searches.front().last_fitness = 0.278;
  EXPECT_EQ(finding_with(verdict_of(facts), "It did not improve.").tone, Tone::caution);
  facts.searches.push_back(facts.searches.front());
  EXPECT_NE(finding_with(verdict_of(facts), "Search run.sqlite: The best robot").text, "");
  facts.searches.pop_back();
  facts.searches.front().last_fitness.reset();
  EXPECT_EQ(finding_with(verdict_of(facts), "found no robot with a fitness").tone, Tone::bad);
}

TEST(Verdict, SaysWhetherTheBestRobotsOfASearchKeepTheirWalkOnFinerElements) {
  ReportFacts facts;
  facts.searches = {
      {.source = "run.sqlite", .generations = 1, .last_generation = "0", .last_fitness = 0.3, .unit = "body lengths"}};
  std::vector<ConfirmedWalk>& walks = facts.searches.front().confirmed;
  const ConfirmedWalk first{
      .rank = "1", .individual = "47", .fitness = 0.3, .elements = "standard", .score = 0.21, .angle_deg = 44.0};
  walks = {first};
  EXPECT_EQ(
      finding_with(verdict_of(facts),
                   "Its best robot keeps its walk on finer elements. In body lengths: Number 1 (individual 47) has 0.3 in the "
                   "search, 0.21 on standard elements (turned by 44 degrees).")
          .tone,
      Tone::good);
  for (const Finding& finding : verdict_of(facts).findings) EXPECT_NE(finding.source, "menger reevaluate") << finding.text;
  facts.searches.front().is_walk = false;
  EXPECT_EQ(finding_with(verdict_of(facts), "Its best robot keeps its walk").tone, Tone::caution) << "it hardly moves in either";
  facts.searches.front().is_walk = true;
  walks.front().rank = "2";  // the first one did not walk on all elements
  EXPECT_EQ(finding_with(verdict_of(facts), "number 2 is the first that keeps its walk").tone, Tone::caution);
  walks.front().rank = "1";
  // Squares of distances may differ by the square of what distances may.
  walks.front().score = 0.14;
  EXPECT_EQ(finding_with(verdict_of(facts), "None of its robots").tone, Tone::bad);
  facts.searches.front().unit = "m\u00b2";
  EXPECT_EQ(finding_with(verdict_of(facts), "Its best robot keeps its walk").tone, Tone::good);
  facts.searches.front().unit = "body lengths";
  ReportFacts two = facts;
  two.searches.push_back({.source = "other.sqlite", .generations = 1, .last_generation = "0", .last_fitness = 0.3, .unit = "m"});
  EXPECT_EQ(finding_with(verdict_of(two), "walk on finer elements was not computed").source, "menger reevaluate");
  // Each of these is no such walk: slower or faster by more than half, turned by more than 45 degrees, backwards, none.
  for (const auto& [score, angle_deg] : std::initializer_list<std::pair<std::optional<double>, double>>{
           {0.19, 0.0}, {0.46, 0.0}, {0.3, 46.0}, {-0.3, 0.0}, {std::nullopt, 0.0}}) {
    walks = {first, first};
    walks.back().elements = "fine";
    walks.back().score = score;
    walks.back().angle_deg = angle_deg;
    EXPECT_EQ(finding_with(verdict_of(facts), "None of its robots that were tried on finer elements keeps its walk.").tone,
              Tone::bad);
  }
  walks.back() = {.rank = "1", .individual = "47", .fitness = 0.3, .elements = "fine", .reason = "the body has fallen"};
  EXPECT_NE(finding_with(verdict_of(facts), "(turned by 44 degrees), no walk on fine elements (the body has fallen).").text, "");
  walks.push_back({.rank = "2", .individual = "8", .fitness = 0.25, .elements = "standard", .score = 0.25});
  walks.push_back({.rank = "2", .individual = "8", .fitness = 0.25, .elements = "fine", .score = 0.2});
  const Finding second = finding_with(
      verdict_of(facts), "Of its robots that were tried on finer elements number 2 is the first that keeps its walk.");
  EXPECT_EQ(second.tone, Tone::caution);
  EXPECT_TRUE(
      second.text.ends_with(". Number 2 (individual 8) has 0.25 in the search, 0.25 on standard elements, 0.2 on fine elements."))
      << second.text;
  facts.searches.push_back(facts.searches.front());
  EXPECT_NE(finding_with(verdict_of(facts), "Search run.sqlite: Of its robots that were tried").text, "");
}

TEST(Verdict, SaysWhatIsMissingLast) {
  const Verdict verdict = verdict_of(two_walks(0.8, 0.0, 0.8, 0.0));
  const auto first = std::ranges::find(verdict.findings, Tone::missing, &Finding::tone);
  EXPECT_NE(first, verdict.findings.begin());
  EXPECT_TRUE(std::all_of(first, verdict.findings.end(), [](const Finding& finding) { return finding.tone == Tone::missing; }));
}

}  // namespace
}  // namespace menger::evolution
