#include "evolution/page/report_run.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "evolution/loop/loop_verdict_file.h"
#include "evolution/outputs/command_outputs.h"
#include "evolution/outputs/report_numbers.h"
#include "evolution/page/report_scenes.h"
#include "evolution/page/walk_animation.h"
#include "io/text/content_hash.h"
#include "io/text/csv_table.h"
#include "io/text/manifest.h"
#include "io/text/whole_file.h"
#include "tests/support/input_error_message.h"
#include "tests/support/test_folder.h"

namespace menger::evolution {
namespace {

namespace fs = std::filesystem;

/// One cube that moves along x, as an ASCII file.
std::string cube_at(double x) {
  std::string points;
  for (const char* corner : {"0 0 0", "1 0 0", "1 1 0", "0 1 0", "0 0 1", "1 0 1", "1 1 1", "0 1 1"}) {
    points += std::to_string(x + (corner[0] - '0')) + std::string(corner + 1) + "\n";
  }
  return "<VTKFile type=\"UnstructuredGrid\" version=\"0.1\"><UnstructuredGrid><Piece NumberOfPoints=\"8\" "
         "NumberOfCells=\"1\"><Points>"
         "<DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">" +
         points +
         "</DataArray></Points><Cells><DataArray type=\"Int32\" Name=\"connectivity\" format=\"ascii\">0 1 2 3 4 5 6 "
         "7</DataArray>"
         "<DataArray type=\"Int32\" Name=\"offsets\" format=\"ascii\">8</DataArray><DataArray type=\"UInt8\" Name=\"types\" "
         "format=\"ascii\">12</DataArray>"
         "</Cells></Piece></UnstructuredGrid></VTKFile>\n";
}

/// Writes the walk of a cube as a command would.
void write_walk(const fs::path& folder, const std::string& program, const std::string& name, const std::string& end_s = "2",
                const std::string& elements = "1") {
  const std::string result = "status = \"completed\"\ntime_s = " + end_s + "\nelements = " + elements +
                             "\nhorizontal_displacement_m = 0.5\nhorizontal_displacement_body_lengths = "
                             "0.5\ndisplacement_m = [0.5, 0, 0]\n";
  io::write_whole(folder / (program == "menger-locomote" ? "locomotion.toml" : "result.toml"), result);
  io::write_whole(folder / "trajectory.csv",
                  "time_s,centre_of_mass_x_m,centre_of_mass_y_m,horizontal_displacement_m\n0,0,0,0\n2,0.5,0,0.5\n");
  io::write_whole(folder / "frames/a.vtu", cube_at(0.0));
  io::write_whole(folder / "frames/b.vtu", cube_at(0.5));
  io::write_whole(folder / "frames.pvd",
                  "<VTKFile type=\"Collection\"><Collection><DataSet timestep=\"0\" file=\"frames/a.vtu\"/><DataSet timestep=\"" +
                      end_s + "\" file=\"frames/b.vtu\"/></Collection></VTKFile>");
  io::write_manifest(folder, {.program = program,
                              .parameters = "[design]\nname = '" + name +
                                            "'\ncell_edge_m = 1\nlayers = [[\"1\"]]\n[drive]\nmode = \"in_phase\"\n",
                              .seed = std::nullopt,
                              .inputs = {}});
}

ReportOptions quick() {
  ReportOptions options;
  options.animations = 0;
  options.three = {.code = "var THREE;", .missing = {}};
  return options;
}

bool has_note(const ReportResult& result, const std::string& text) {
  return std::ranges::any_of(result.notes, [&](const std::string& note) { return note.find(text) != std::string::npos; });
}

TEST(ReportRun, TakesTheFolderAndTheFileOfARobotForTheResultsOfItsLoop) {
  const tests::TestFolder folder;
  const fs::path results = folder / "bench/results";
  io::write_whole(folder / "bench/robot.toml", "[robot]\n");
  write_walk(results / "locomote", "menger-locomote", "cube");
  io::write_whole(results / loop_state_name, "{}");
  write_loop_verdict(results, {.lines = {"It walks."}, .results = {}});
  for (const fs::path& given : {folder / "bench", folder / "bench/robot.toml", results}) {
    const ReportResult result = write_report(given, quick());
    EXPECT_EQ(result.file, results / "report.html");
    EXPECT_EQ(result.verdict.came_out, std::vector<std::string>{"It walks."}) << given;
  }
}

TEST(ReportRun, IsCalledAsTheRobotOfItsLoopIsNow) {
  const tests::TestFolder folder;
  write_walk(folder / "locomote", "menger-locomote", "cube");
  io::write_manifest(folder,
                     {.program = "menger-loop", .parameters = "[robot]\nname = \"dice\"\n", .seed = std::nullopt, .inputs = {}});
  const ReportResult result = write_report(folder, quick());
  EXPECT_NE(io::read_whole(result.file).find("<title>Report: dice</title>"), std::string::npos);
}

TEST(ReportRun, LeavesOutWhatStagesComputedForAnEarlierRobot) {
  const tests::TestFolder folder;
  write_walk(folder / "locomote", "menger-locomote", "cube");
  write_walk(folder / "simulate", "menger-simulate", "cube");
  write_loop_verdict(folder, {.lines = {"It walks."},
                              .results = {},
                              .left_behind = {{"simulate/manifest.json", io::hash_of_results(folder / "simulate/manifest.json")},
                                              {"limit/manifest.json", "of results that are gone"}}});
  const ReportResult result = write_report(folder, quick());
  EXPECT_EQ(result.outputs, 1U);
  EXPECT_TRUE(has_note(result, "simulate: is of an earlier robot.toml"));
  EXPECT_FALSE(has_note(result, "limit: "));
  // Also where the loop's own words are of earlier results.
  LoopVerdict stale = read_loop_verdict(folder).value();
  stale.results = {{"locomote/manifest.json", "of another run"}};
  write_loop_verdict(folder, stale);
  const ReportResult later = write_report(folder, quick());
  EXPECT_EQ(later.outputs, 1U);
  EXPECT_TRUE(later.verdict.came_out.empty());
  write_walk(folder / "simulate", "menger-simulate", "cube", "3");
  io::write_manifest(
      folder / "simulate",
      {.program = "menger-simulate", .parameters = "[drive]\nmode = \"hold\"\n", .seed = std::nullopt, .inputs = {}});
  EXPECT_EQ(write_report(folder, quick()).outputs, 2U) << "a command by hand has taken its place";
}

TEST(ReportRun, KeepsInSightWhatTheLoopWarnedOf) {
  const tests::TestFolder folder;
  write_walk(folder / "locomote", "menger-locomote", "cube");
  LoopVerdict verdict{.lines = {"It walks."}, .forecast = {"law: soft", "warning: no validation covers this body: it is long"}};
  const auto page = [&] {
    write_loop_verdict(folder, verdict);
    return io::read_whole(write_report(folder, quick()).file);
  };
  const std::string text = page();
  const std::size_t warning = text.find("<li>warning: no validation covers this body: it is long</li>");
  const std::size_t hidden = text.find("<summary>What was to be expected of this robot</summary>");
  ASSERT_NE(warning, std::string::npos);
  ASSERT_NE(hidden, std::string::npos);
  EXPECT_LT(warning, hidden);
  EXPECT_LT(hidden, text.find("<li>law: soft</li>"));
  verdict.results = {{"locomote/manifest.json", "of another run"}};
  EXPECT_EQ(page().find("law: soft"), std::string::npos) << "it is of earlier results";
}

TEST(ReportRun, ShowsAWalkInBothModelsOnOneClock) {
  const tests::TestFolder folder;
  write_walk(folder / "locomote", "menger-locomote", "cube");
  write_walk(folder / "simulate", "menger-simulate", "cube");
  const ReportResult result = write_report(folder, quick());
  EXPECT_EQ(result.file, folder / "report.html");
  EXPECT_TRUE(result.has_motion);
  EXPECT_TRUE(result.notes.empty()) << result.notes.front();
  const std::string text = io::read_whole(result.file);
  EXPECT_EQ(text.size(), result.bytes);
  EXPECT_NE(text.find("Walk of cube: finite elements and voxels"), std::string::npos);
  EXPECT_EQ(result.verdict.headline, "The surrogate walks as finite elements do.");
}

TEST(ReportRun, ShowsTheWalksFirstThatDecideWhatIsSaidOfTheSurrogate) {
  const tests::TestFolder folder;
  write_walk(folder / "a_short", "menger-locomote", "champion", "1", "9000");
  write_walk(folder / "coarse", "menger-locomote", "cube", "2", "100");
  write_walk(folder / "fine", "menger-locomote", "cube", "2", "800");
  write_walk(folder / "simulate", "menger-simulate", "cube", "2.0001");
  std::vector<std::string> notes;
  const std::vector<PageScene> scenes = read_scenes(find_command_outputs(folder, notes), 1'000'000, notes);
  ASSERT_EQ(scenes.size(), 3U);
  EXPECT_EQ(scenes[0].title, "Walk of cube: finite elements and voxels (fine)");
  EXPECT_TRUE(scenes[0].angle_deg);
  EXPECT_EQ(scenes[0].note.find("do not last as long"), std::string::npos) << scenes[0].note;
  EXPECT_EQ(scenes[1].title, "Walk of cube: finite elements and voxels (coarse)");
  EXPECT_EQ(scenes[2].title, "Walk of champion: finite elements and voxels") << "a shorter walk comes last, however fine";
  EXPECT_FALSE(scenes[2].angle_deg) << "between places at two times";
  EXPECT_TRUE(scenes[2].note.starts_with("They do not last as long: finite elements 1 s, voxels 2 s.")) << scenes[2].note;
}

TEST(WalkAnimation, TellsWhenOneOfTwoWalksHasEnded) {
  const auto body = [](const std::string& name, double end_s) {
    return PageBody{.name = name, .times = {0.0, end_s}, .travelled_m = {0.0, 0.0036}};
  };
  const PageScene scene{.bodies = {body("finite elements", 2.0), body("surrogate", 5.0)}, .angle_deg = 1.0};
  EXPECT_EQ(walk_caption(scene, 1.0, {.slower = 2}, 0.01),
            "finite elements behind: 1.8 mm, surrogate in front: 0.7 mm, 1 degree apart at the end, 1.00 s, shown 2 times "
            "slower, bar 10 mm");
  EXPECT_EQ(
      walk_caption(scene, 4.84, {}, 0.01),
      "finite elements behind: 3.6 mm (ended at 2 s), surrogate in front: 3.5 mm, 1 degree apart at the end, 4.84 s, bar 10 mm");
  EXPECT_NE(walk_caption(scene, 4.84, {.pictures_per_stroke = 1.4}, 0.01).find("4.84 s, 1.4 pictures in a stroke, bar"),
            std::string::npos);
  EXPECT_EQ(walk_caption(scene, 4.84, {.pictures_per_stroke = 4.999}, 0.01).find("stroke"), std::string::npos);
}

TEST(ReportRun, RepeatsWhatTheLoopSaidOfTheseResults) {
  const tests::TestFolder folder;
  write_walk(folder / "locomote", "menger-locomote", "cube");
  const auto loop_says = [&](const std::string& manifest) {
    const std::map<std::string, std::string> results{{manifest, io::hash_of_results(folder / "locomote/manifest.json")}};
    write_loop_verdict(folder, {.lines = {"The body bears its <pressure>.", "It walks."}, .results = results});
  };
  loop_says("locomote/manifest.json");
  EXPECT_EQ(write_report(folder, quick()).verdict.came_out,
            (std::vector<std::string>{"The body bears its <pressure>.", "It walks."}));
  const std::string page = io::read_whole(folder / "report.html");
  const std::size_t first = page.find("<li>The body bears its &lt;pressure&gt;.</li>\n<li>It walks.</li>");
  EXPECT_LT(first, page.find("class=\"findings\""));
  EXPECT_EQ(page.find("class=\"headline missing\">Nothing"), std::string::npos) << "the loop's words stand for the headline";

  loop_says("simulate/manifest.json");
  const ReportResult stale = write_report(folder, quick());
  EXPECT_TRUE(stale.verdict.came_out.empty());
  EXPECT_TRUE(has_note(stale, "is of earlier results"));
  EXPECT_TRUE(stale.verdict.headline.starts_with("The results of simulate have changed since the loop ended"))
      << stale.verdict.headline;
  EXPECT_EQ(stale.verdict.tone, Tone::caution);
  io::write_whole(folder / loop_verdict_name, "{}");
  EXPECT_TRUE(has_note(write_report(folder, quick()), "is no verdict of a loop"));
}

TEST(ReportRun, SaysWhatWasComputed) {
  const tests::TestFolder folder;
  io::write_whole(
      folder / "materials/soft.toml",
      "name = \"Soft 30\"\nnot_measured = []\n[data_sheet]\nsource = \"d\"\ndensity_kg_per_m3 = 1000\nshore_hardness = "
      "\"30\"\nmodulus_100_percent_Pa = 7e4\ntensile_strength_Pa = 1e6\nelongation_at_break = 9\n"
      "[recommended]\nsource = \"the <data> sheet\"\nlargest_stretch = 2\nsmallest_stretch = 1\n"
      "[recommended.law]\nname = \"neo_hookean\"\nshear_modulus_Pa = 40000\n"
      "[[others]]\nsource = \"a test\"\nlargest_stretch = 2\nsmallest_stretch = 1\n"
      "[others.law]\nname = \"neo_hookean\"\nshear_modulus_Pa = 16000\n");
  const auto write_run = [&](const std::string& place, double kinetic_friction) {
    write_walk(folder / place, "menger-locomote", "cube");
    std::map<std::string, std::string> inputs;
    io::note_input(inputs, folder / "materials/soft.toml");
    io::write_manifest(
        folder / place,
        {.program = "menger-locomote",
         .parameters = "[design]\nname = 'cube'\ncell_edge_m = 0.012\nlayers = [[\"110\", \"010\"]]\nwall_thickness_m = "
                       "0.0025\nchambers = \"single\"\n[drive]\nmode = \"in_phase\"\npressure_Pa = [0, 2900]\nfrequency_Hz = "
                       "3\n[ground]\nstatic_friction = 1\nkinetic_friction = " +
                       std::to_string(kinetic_friction) +
                       "\n[material]\nloss_factor = 0.1\nloss_frequency_Hz = 30\n[material.law]\nname = "
                       "\"neo_hookean\"\nshear_modulus_Pa = 40000\n[elements]\nkind = \"thin_wall\"\nfidelity = \"fine\"\n",
         .seed = std::nullopt,
         .inputs = inputs});
  };
  write_run("locomote", 0.5);
  static_cast<void>(write_report(folder, quick()));
  const std::string page = io::read_whole(folder / "report.html");
  const std::size_t begin = page.find("<section id=\"inputs\"");
  const std::string inputs = page.substr(begin, page.find("</section>", begin) - begin);
  for (const char* row : {"body</th><td>cube: 3 cells in 3 x 2 x 1<", "edge of a cell</th><td>12 mm<",
                          "thickness of walls</th><td>2.5 mm<", "silicone</th><td>Soft 30<",
                          "law</th><td>neo hookean, shear modulus 40 kPa<", "source of the law</th><td>the &lt;data&gt; sheet<",
                          "other laws in its record</th><td>1 more, with 0.4 times its shear modulus at rest<",
                          "loss factor (damping)</th><td>0.1 at 30 Hz<", "pressure of the drive</th><td>0 to 2.9 kPa<",
                          "strokes</th><td>3 Hz, a sine, which grows from 0 over the first stroke<",
                          "friction on the ground</th><td>1 at rest, 0.5 sliding<", "finite elements</th><td>thin wall, fine<"})
    EXPECT_NE(inputs.find(row), std::string::npos) << row << "\n" << inputs;
  EXPECT_LT(begin, page.find("<section id=\"motion\""));
  write_run("slippery", 0.2);
  static_cast<void>(write_report(folder, quick()));
  EXPECT_NE(io::read_whole(folder / "report.html").find("1 at rest, 0.5 sliding (locomote); 1 at rest, 0.2 sliding (slippery)<"),
            std::string::npos);
}

TEST(ReportRun, SaysWhichChambersAreOfWhichMaterialAndHowADriveSwings) {
  const tests::TestFolder folder;
  const auto inputs_with = [&](const std::string& drive) {
    write_walk(folder / "locomote", "menger-locomote", "pair");
    io::write_manifest(folder / "locomote",
                       {.program = "menger-locomote",
                        .parameters = "[design]\nname = 'pair'\ncell_edge_m = 0.01\nlayers = [[\"1211\"]]\nwall_thickness_m = "
                                      "0.002\nchambers = \"per-phase\"\n[drive]\npressure_Pa = [0, 6000]\nfrequency_Hz = 3\n" +
                                      drive,
                        .seed = std::nullopt,
                        .inputs = {}});
    return io::read_whole(write_report(folder, quick()).file);
  };
  const std::string antiphase = inputs_with("mode = \"antiphase\"\nramp_s = 0.6666666666666666\n");
  EXPECT_NE(
      antiphase.find("one for each region of cells of one material: chamber 1 of material 1 (plenum 0 in files), chamber of "
                     "material 2 (plenum 1 in files), chamber 2 of material 1 (plenum 2 in files)<"),
      std::string::npos);
  EXPECT_NE(antiphase.find("strokes</th><td>3 Hz, a sine, which grows from 0 over the first 2 strokes<"), std::string::npos);
  EXPECT_NE(inputs_with("mode = \"in_phase\"\nramp_s = 0\n").find("strokes</th><td>3 Hz, a sine<"), std::string::npos);
  EXPECT_EQ(inputs_with("mode = \"hold\"\n").find("strokes</th>"), std::string::npos);
}

TEST(ReportRun, IsAboutTheOnlyBodyAndTellsItsScenesApart) {
  const tests::TestFolder folder;
  for (const char* name : {"coarse", "fine"}) write_walk(folder / name, "menger-locomote", "cube");
  const std::string text = io::read_whole(write_report(folder, quick()).file);
  EXPECT_NE(text.find("<title>Report: cube</title>"), std::string::npos);
  EXPECT_NE(text.find("Walk of cube: finite elements (coarse)"), std::string::npos);
  EXPECT_NE(text.find("Walk of cube: finite elements (fine)"), std::string::npos);
}

TEST(ReportRun, RefusesAFolderWithoutResultsAndKeepsItsPage) {
  const tests::TestFolder folder;
  io::write_whole(folder / "report.html", "mine");
  EXPECT_NE(tests::message_of([&] { write_report(folder, quick()); }).find("holds no results"), std::string::npos);
  EXPECT_EQ(io::read_whole(folder / "report.html"), "mine");
}

TEST(ReportRun, MakesNoMarkupOfNamesInResults) {
  const tests::TestFolder folder;
  const std::string hostile = "</script><script>window.harmed=1</script><b>";
  write_walk(folder / "a<b>c", "menger-simulate", hostile);
  const std::string text = io::read_whole(write_report(folder, quick()).file);
  EXPECT_EQ(text.find("<script>window"), std::string::npos);
  EXPECT_EQ(text.find("a<b>"), std::string::npos);
}

TEST(ReportRun, SaysWhatCannotBeReadAndShowsTheRest) {
  const tests::TestFolder folder;
  write_walk(folder / "simulate", "menger-simulate", "cube");
  io::write_manifest(folder / "inflate", {.program = "menger-inflate", .parameters = "", .seed = std::nullopt, .inputs = {}});
  io::write_manifest(folder / "calibrate", {.program = "menger-calibrate", .parameters = "", .seed = std::nullopt, .inputs = {}});
  io::write_whole(folder / "calibrate/result.toml", "[fit]\nstatus = \"splendid\"\n");
  io::write_manifest(folder / "evolve", {.program = "menger-evolve", .parameters = "", .seed = std::nullopt, .inputs = {}});
  io::write_whole(folder / "simulate/frames/b.vtu", "no grid");
  const ReportResult result = write_report(folder, quick());
  EXPECT_TRUE(has_note(result, "inflate/result.toml"));
  EXPECT_TRUE(has_note(result, "status = \"splendid\""));
  EXPECT_TRUE(has_note(result, "evolve"));
  EXPECT_TRUE(has_note(result, "frames/b.vtu: is no grid"));
  EXPECT_FALSE(result.has_motion);
  EXPECT_NE(io::read_whole(result.file).find("It moves 0.5 body lengths"), std::string::npos);
}

TEST(ReportRun, WritesThePageWithout3d) {
  const tests::TestFolder folder;
  write_walk(folder / "simulate", "menger-simulate", "cube");
  io::write_whole(folder / "simulate/robot.png", "\x89PNG\r\n\x1a\n...");
  ReportOptions options = quick();
  options.three = {.code = std::nullopt, .missing = "no 3-D: install the package libjs-three"};
  const ReportResult result = write_report(folder, options);
  EXPECT_FALSE(result.has_motion);
  EXPECT_TRUE(has_note(result, "libjs-three"));
  EXPECT_NE(io::read_whole(result.file).find("simulate/robot.png"), std::string::npos);
}

TEST(ReportRun, KeepsThePageBelowItsLimit) {
  const tests::TestFolder folder;
  write_walk(folder / "simulate", "menger-simulate", "cube");
  const std::string picture = "\x89PNG\r\n\x1a\n" + std::string(100'000, 'x');
  io::write_whole(folder / "simulate/robot.png", picture);
  ReportOptions options = quick();
  const std::size_t whole = write_report(folder, options).bytes;
  options.most_bytes = whole - 1;
  const ReportResult less = write_report(folder, options);
  EXPECT_LE(less.bytes, options.most_bytes);
  EXPECT_TRUE(less.has_motion);
  EXPECT_TRUE(has_note(less, "picture"));
  options.most_bytes = less.bytes - 1;
  const ReportResult least = write_report(folder, options);
  EXPECT_FALSE(least.has_motion);
  EXPECT_LE(least.bytes, options.most_bytes);
  options.most_bytes = 1000;
  EXPECT_NE(tests::message_of([&] { write_report(folder, options); }).find("must have at most 1000"), std::string::npos);
}

TEST(ReportRun, SaysThatFfmpegIsMissing) {
  const tests::TestFolder folder;
  write_walk(folder / "simulate", "menger-simulate", "cube");
  const char* path = std::getenv("PATH");
  const std::string before = path == nullptr ? "" : path;
  ::setenv("PATH", folder.path().c_str(), 1);
  ReportOptions options = quick();
  options.animations = 1;
  const ReportResult result = write_report(folder, options);
  ::setenv("PATH", before.c_str(), 1);
  EXPECT_TRUE(has_note(result, "install the package ffmpeg"));
  EXPECT_TRUE(result.animations.empty());
}

TEST(ReportRun, AnimatesAWalk) {
  if (!find_ffmpeg()) GTEST_SKIP() << "ffmpeg is missing: install the package ffmpeg";
  const tests::TestFolder folder;
  write_walk(folder / "simulate", "menger-simulate", "cube", "0.05");  // five pictures
  ReportOptions options = quick();
  options.animations = 1;
  const ReportResult result = write_report(folder, options);
  ASSERT_EQ(result.animations.size(), 1U) << (result.notes.empty() ? "" : result.notes.back());
  EXPECT_EQ(result.animations.front(), folder / "report.walk_1.gif");
  EXPECT_TRUE(io::read_whole(folder / "report.walk_1.gif").starts_with("GIF89a"));
  EXPECT_NE(io::read_whole(result.file).find("\"animation\":\"report.walk_1.gif\""), std::string::npos) << "a link to it";
}

TEST(ReportRun, RemovesAnimationsOfAnEarlierPageOnly) {
  const tests::TestFolder folder;
  write_walk(folder / "simulate", "menger-simulate", "cube");
  for (const char* name : {"report.walk_1.gif", "report.walk_4.gif", "walk.gif", "walk_2.gif", "other.walk_1.gif"})
    io::write_whole(folder / name, "mine");
  const auto is_there = [&](const char* name) { return fs::exists(folder / name); };
  (void)write_report(folder, quick());
  EXPECT_TRUE(is_there("report.walk_1.gif")) << "a page without animations says nothing of them";
  ReportOptions options = quick();
  options.animations = 1;
  const std::atomic<bool> stop = true;
  options.stop = &stop;
  (void)write_report(folder, options);
  EXPECT_FALSE(is_there("report.walk_1.gif"));
  EXPECT_FALSE(is_there("report.walk_4.gif"));
  for (const char* name : {"walk.gif", "walk_2.gif", "other.walk_1.gif"}) EXPECT_EQ(io::read_whole(folder / name), "mine");
}

TEST(ReportRun, SaysThatAnimationsHaveNoPlaceForTheirPictures) {
  if (!find_ffmpeg()) GTEST_SKIP() << "ffmpeg is missing: install the package ffmpeg";
  const tests::TestFolder folder;
  write_walk(folder / "simulate", "menger-simulate", "cube");
  const char* place = std::getenv("TMPDIR");
  const std::string before = place == nullptr ? "" : place;
  io::write_whole(folder / "file", "no folder");
  ReportOptions options = quick();
  options.animations = 1;
  for (const fs::path& bad : {folder / "missing", folder / "file"}) {
    ::setenv("TMPDIR", bad.c_str(), 1);
    const ReportResult result = write_report(folder, options);
    EXPECT_TRUE(has_note(result, "no animation of walks: TMPDIR")) << bad;
    EXPECT_TRUE(fs::is_regular_file(result.file));
  }
  if (place == nullptr)
    ::unsetenv("TMPDIR");
  else
    ::setenv("TMPDIR", before.c_str(), 1);
}

TEST(ReportRun, SaysWhichPictureCannotBeRead) {
  const tests::TestFolder folder;
  write_walk(folder / "simulate", "menger-simulate", "cube");
  fs::create_symlink("/proc/self/mem", folder / "simulate/robot.png");  // a file whose first byte not even root can read
  const ReportResult result = write_report(folder, quick());
  EXPECT_TRUE(has_note(result, "robot.png: cannot be read"));
  EXPECT_TRUE(fs::is_regular_file(result.file));
}

TEST(ReportRun, TakesAPictureOnceFromAFolderOfSeveralCommands) {
  const tests::TestFolder folder;
  write_walk(folder / "walk", "menger-simulate", "cube");
  io::write_whole(folder / "champion.png", "\x89PNG\r\n\x1a\n...");
  io::write_manifest(folder, {.program = "menger-export", .parameters = "", .seed = std::nullopt, .inputs = {}});
  for (const char* name : {"run.manifest.json", "scores.manifest.json"})
    io::write_manifest_file(folder / name, {.program = "menger-evolve", .parameters = "", .seed = std::nullopt, .inputs = {}});
  const std::string text = io::read_whole(write_report(folder, quick()).file);
  const std::size_t first = text.find("\"file\":\"champion.png\"");
  EXPECT_NE(first, std::string::npos);
  EXPECT_EQ(text.find("manifest.json/champion.png"), std::string::npos);
  EXPECT_EQ(text.find("\"file\":\"champion.png\"", first + 1), std::string::npos) << "it stands there once";
}

TEST(ReportRun, ShowsScoresOfAnotherStudyBesideASearchOfTheSameName) {
  // The second is as it was named before: the table without its ending.
  for (const char* name : {"run.csv.manifest.json", "run.manifest.json"}) {
    const tests::TestFolder folder;
    io::write_whole(folder / "run.csv", "rank,cells\n1,17\n");
    io::write_manifest_file(folder / name, {.program = "menger-confirm", .parameters = "", .seed = std::nullopt, .inputs = {}});
    const std::string text = io::read_whole(write_report(folder, quick()).file);
    EXPECT_NE(text.find("Robots as another study lets them walk"), std::string::npos) << name;
    EXPECT_NE(text.find("From run.csv."), std::string::npos) << name;
  }
}

TEST(ReportRun, SaysWhatAPictureShows) {
  const tests::TestFolder folder;
  for (const char* name : {"inflate", "limit"}) {
    const fs::path place = folder / name;
    const std::string limit = place.filename() == "limit" ? "[[limit_points]]\npressure_Pa = 7600\n" : "";
    io::write_whole(place / "curves.csv", "step,plenum_0_pressure_Pa,plenum_0_volume_m3\n0,0,1e-6\n1,2900,2e-6\n");
    io::write_whole(place / "result.toml", "status = \"completed\"\n" + limit);
    io::write_whole(place / "chamber.png", "\x89PNG\r\n\x1a\n...");
    io::write_manifest(place, {.program = "menger-inflate", .parameters = "", .seed = std::nullopt, .inputs = {}});
  }
  const std::string text = io::read_whole(write_report(folder, quick()).file);
  EXPECT_NE(text.find("at the end of its inflation. Thin lines: the body at rest, grey where it was cut "
                      "away.\",\"file\":\"inflate/chamber.png\""),
            std::string::npos);
  EXPECT_NE(
      text.find("beyond the limit pressure: the pressure falls again there. Thin lines: the body at rest, grey where it was cut "
                "away.\",\"file\":\"limit/chamber.png\",\"link\":\"./limit/chamber.png\""),
      std::string::npos);
}

TEST(ReportRun, SaysWhichFrameIsDamaged) {
  const tests::TestFolder folder;
  write_walk(folder / "simulate", "menger-simulate", "cube");
  std::string damaged = cube_at(0.5);
  damaged.replace(damaged.find("5 6 "), 1, "555555");
  io::write_whole(folder / "simulate/frames/b.vtu", damaged);
  const ReportResult result = write_report(folder, quick());
  EXPECT_TRUE(has_note(result, "b.vtu: cell 0 has the point 555555 of 8"));
  EXPECT_FALSE(result.has_motion);
}

TEST(ReportRun, FollowsNoFrameOutOfItsResults) {
  const tests::TestFolder folder;
  write_walk(folder / "results/simulate", "menger-simulate", "cube");
  io::write_whole(folder / "elsewhere.vtu", cube_at(0.5));
  io::write_whole(folder / "results/simulate/frames.pvd",
                  "<VTKFile type=\"Collection\"><Collection><DataSet timestep=\"0\" file=\"../../elsewhere.vtu\"/></Collection>"
                  "</VTKFile>");
  const ReportResult result = write_report(folder / "results", quick());
  EXPECT_TRUE(has_note(result, "leads out of"));
  EXPECT_FALSE(result.has_motion);
}

TEST(GuessText, SaysWhereFramesDoNotShowAStroke) {
  PageBody body{.name = "surrogate"};
  for (int n = 0; n <= 50; ++n) body.times.push_back(0.1 * n);
  EXPECT_EQ(guess_text(body, 51, 10.0),
            "Of the surrogate, frames shown of a stroke: 1; between them the motion is a guess along straight lines.");
  EXPECT_EQ(guess_text(body, 51, 2.0), "") << "five of each";
  EXPECT_EQ(guess_text(body, 51, 2.001), "") << "times are multiples of a step";
  EXPECT_NE(guess_text(body, 51, 4.0).find("of a stroke: 2.5"), std::string::npos);
  EXPECT_EQ(guess_text(body, 52, 0.0), "");
  EXPECT_NE(guess_text(body, 200, 0.0).find("51 of 200 frames are shown"), std::string::npos);
}

TEST(CaptionSize, LetsLongCaptionsFitAcrossAPicture) {
  EXPECT_EQ(caption_size(0), 15);
  EXPECT_EQ(caption_size(92), 15);
  for (std::size_t letters = 93; letters < 300; ++letters)
    EXPECT_LE(static_cast<double>(caption_size(letters)) * static_cast<double>(letters), 15.0 * 92.0) << letters;
  EXPECT_EQ(caption_size(143), 9) << "the longest caption can still be read";
}

TEST(AnimationPace, ShowsShortWalksSlower) {
  EXPECT_EQ(pace_of(5.0, 0.0).slower, 1);
  EXPECT_EQ(pace_of(2.0, 0.0).slower, 2);
  EXPECT_EQ(pace_of(2.0, 0.0).pictures, 50U);
  EXPECT_EQ(pace_of(0.1, 0.0).slower, 8);
  EXPECT_EQ(pace_of(1000.0, 0.0).pictures, 250U);
  EXPECT_DOUBLE_EQ(pace_of(1000.0, 0.0).pictures_per_s, 0.25);
  EXPECT_EQ(pace_of(0.0, 0.0).pictures, 2U);
}

TEST(AnimationPace, ResolvesEachStroke) {
  EXPECT_EQ(pace_of(5.0, 15.0).pictures, 75U) << "five of each stroke";
  EXPECT_EQ(pace_of(5.0, 15.0).slower, 1);
  EXPECT_DOUBLE_EQ(pace_of(5.0, 15.0).pictures_per_s, 15.0);
  EXPECT_EQ(pace_of(5.0, 50.0).pictures, 250U);
  EXPECT_EQ(pace_of(5.0, 50.0).slower, 2);
  EXPECT_DOUBLE_EQ(pace_of(5.0, 50.0).pictures_per_s, 25.0);
  EXPECT_EQ(pace_of(5.0, 500.0).pictures, 250U) << "as many as there is room for";
  EXPECT_DOUBLE_EQ(pace_of(5.0, 500.0).pictures_per_stroke.value(), 0.5);
  for (const double duration_s : {0.001, 0.1, 1.0, 5.0, 60.0})
    for (const double frequency_Hz : {0.0, 1.0, 10.0, 50.0, 1000.0})
      EXPECT_LE(pace_of(duration_s, duration_s * frequency_Hz).pictures_per_s, 25.0)
          << duration_s << " s, " << frequency_Hz << " Hz";
}

TEST(ReportNumbers, HaveNoSignAtNought) {
  EXPECT_EQ(shown_whole(-0.3), "0");
  EXPECT_EQ(shown_whole(-7.4), "-7");
}

TEST(ReportNumbers, RoundNumbersInTextsOnly) {
  EXPECT_EQ(with_rounded_numbers("(0.018449999999999998, -0.036000000000000004, 12.5) m"), "(0.01845, -0.036, 12.5) m");
  for (const char* kept :
       {"version 0.1.0", "a1.23456789", "1.2345.67890123", "1.23456789e-7", "2122120002122122", "0.123456", ""})
    EXPECT_EQ(with_rounded_numbers(kept), kept);
}

TEST(ReportNumbers, KeepCountsAndDigitsOfBodies) {
  const io::CsvContents table = io::parse_csv("a,b_m,c,d\n22500,0.0123456,2122120002122122,\n", "t.csv");
  EXPECT_EQ(shown_cell(table, 0, io::shown_column("a")), "22500");
  EXPECT_EQ(shown_cell(table, 0, io::shown_column("b_m")), "12.35");
  EXPECT_EQ(shown_cell(table, 0, io::shown_column("c")), "2122120002122122");
  EXPECT_EQ(shown_cell(table, 0, io::shown_column("d")), "");
}

TEST(ReportNumbers, TakeTheMiddleOfSomeNumbers) {
  EXPECT_FALSE(median_of({}));
  EXPECT_EQ(median_of({3.0, 1.0, 2.0}), 2.0);
  EXPECT_EQ(median_of({4.0, 1.0, 2.0, 3.0}), 2.5);
}

}  // namespace
}  // namespace menger::evolution
