#include "evolution/page/report_run.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <set>
#include <string_view>
#include <system_error>
#include <utility>

#include "evolution/findings/inflation_result.h"
#include "evolution/loop/loop_verdict_file.h"
#include "evolution/outputs/command_outputs.h"
#include "evolution/outputs/result_facts.h"
#include "evolution/page/input_table.h"
#include "evolution/page/report_scenes.h"
#include "evolution/page/report_sections.h"
#include "evolution/page/walk_animation.h"
#include "evolution/verdict/finding_words.h"
#include "evolution/verdict/verdict.h"
#include "io/shown/shown_quantity.h"
#include "io/text/input_error.h"
#include "io/text/is_file.h"
#include "io/text/joined_text.h"
#include "io/text/manifest.h"
#include "io/text/version.h"
#include "io/text/whole_file.h"

namespace menger::evolution {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view png_signature = "\x89PNG\r\n\x1a\n";

/// A picture; nothing if the file is none or takes more than most_bytes.
std::optional<std::string> read_picture(const fs::path& file, std::size_t most_bytes, std::vector<std::string>& notes) {
  try {
    std::string content = io::read_start(file, most_bytes + 1);
    if (!content.starts_with(png_signature))
      notes.push_back(file.string() + ": is no PNG picture");
    else if (content.size() > most_bytes)
      notes.push_back("the picture " + file.string() + " is left out to keep the page small");
    else
      return content;
  } catch (const io::InputError& error) {
    notes.emplace_back(error.what());
  }
  return std::nullopt;
}

/// What a loop said of its results, as far as these are still there.
struct KnownLoop {
  LoopVerdict verdict{};
  std::vector<std::string> changed{};  ///< folders of its results that have changed since
};

/// What the loop that made these results left for their report; nothing if no loop did. If they have changed since, it only tells
/// what is of an earlier robot, and the limit pressure if that has not changed.
KnownLoop known_loop(const fs::path& folder, std::vector<std::string>& notes) {
  KnownLoop known;
  try {
    std::optional<LoopVerdict> verdict = read_loop_verdict(folder);
    if (!verdict) return known;
    known.verdict = std::move(*verdict);
    known.changed = known.verdict.changed(folder);
    if (known.changed.empty()) return known;
    known.verdict.lines.clear();
    known.verdict.forecast.clear();
    if (std::ranges::find(known.changed, "limit") != known.changed.end()) known.verdict.softest_limit_Pa.reset();
    notes.push_back(std::string(loop_verdict_name) +
                    ": what the loop said came out is of earlier results, and is left out; run menger loop again");
  } catch (const io::InputError& error) {
    notes.emplace_back(error.what());
  }
  return known;
}

/// Says before the headline that the results are not of one run of the loop.
void warn_of_changes(const std::vector<std::string>& changed, Verdict& verdict) {
  if (changed.empty()) return;
  verdict.headline.insert(
      0, "The results of " + io::joined(changed) +
             " have changed since the loop ended, and may not be of the robot that the others are of: menger loop "
             "brings all up to date. ");
  verdict.tone = worse_of(verdict.tone, Tone::caution);
}

/// Leaves out what stages of a loop computed for an earlier robot, unless a command by hand has taken its place since.
void leave_out(const fs::path& folder, const std::map<std::string, std::string>& left_behind, std::vector<CommandOutput>& outputs,
               std::vector<std::string>& notes) {
  for (const auto& [manifest, hash] : left_behind) {
    if (io::hash_of_results(folder / manifest) != hash) continue;
    const std::string stage = fs::path(manifest).parent_path().string();
    const auto is_of_stage = [&](const CommandOutput& output) {
      return output.place == stage || output.place.starts_with(stage + "/");
    };
    if (std::erase_if(outputs, is_of_stage) > 0) notes.push_back(stage + ": is of an earlier robot.toml, and is left out");
  }
}

/// What a picture shows, for people.
std::string caption_of(const CommandOutput& output, const std::string& name, const std::vector<InflationFacts>& inflations) {
  std::string caption;
  if (name == "chamber.png") {
    const auto inflation = std::ranges::find(inflations, output.name, &InflationFacts::place);
    const bool is_beyond = inflation != inflations.end() && inflation->limit &&
                           inflation->last_pressure_Pa.value_or(0.0) < inflation->limit->pressure_Pa &&
                           !are_of_one_state(inflation->last_pressure_Pa.value_or(0.0), inflation->limit->pressure_Pa);
    caption = std::string("The body, cut open, at the end of its inflation") +
              (is_beyond ? ", which lies beyond the limit pressure: the pressure falls again there" : "") +
              ". Thin lines: the body at rest, grey where it was cut away.";
    if (inflation != inflations.end() && inflation->sideways_m)
      caption += " It floats free here: seen from its near end, the middle of its far end moves " +
                 io::millimetres(*inflation->sideways_m) + " sideways.";
  } else if (name == "robot.png" && command_of(output) == "simulate") {
    caption = "The body of voxels at the end of its walk, with the path of its centre.";
  } else if (name == "robot.png") {
    caption = "The body at the end of its walk. Thin lines: the body at the start. Red line: the path of its centre.";
  } else if (name == "champion.png") {
    caption = "The best robot of the search.";
  } else if (name == "winner/strip.png") {
    caption = "The best robot of the re-evaluation, at several times of its walk.";
  } else if (name == "worst.png") {
    caption = "The state in which the surrogate is furthest off; the picture says by how much.";
  } else {
    caption = "Shapes of the robot in both models, over the pressure.";
  }
  return caption;
}

/// The pictures of bodies that commands drew; charts are drawn anew by the page. Each is taken once, where several commands wrote
/// into its folder.
std::vector<PagePicture> read_pictures(const std::vector<CommandOutput>& outputs, const std::vector<InflationFacts>& inflations,
                                       std::size_t most_bytes, std::vector<std::string>& notes) {
  constexpr std::array names{"chamber.png",      "robot.png", "champion.png",
                             "winner/strip.png", "worst.png", "curve_robot_inflation.png"};
  std::vector<PagePicture> pictures;
  std::set<std::string> taken;
  std::size_t bytes = 0;
  for (const CommandOutput& output : outputs) {
    for (const char* name : names) {
      const fs::path file = output.folder / name;
      if (!io::is_file(file) || !taken.insert(file_of(output, name)).second) continue;
      std::optional<std::string> content = read_picture(file, most_bytes - bytes, notes);
      if (!content) continue;
      bytes += content->size();
      pictures.push_back(
          {.caption = caption_of(output, name, inflations), .file = file_of(output, name), .png = std::move(*content)});
    }
  }
  return pictures;
}

/// The page as text, without what does not fit: first pictures, then motions are left out, the last ones first.
std::string fitting_text(ReportPage& page, const ReportOptions& options) {
  while (true) {
    std::string text = page_text(page, options.three.code);
    if (text.size() <= options.most_bytes) return text;
    const std::string why = " is left out to keep the page below " + std::to_string(options.most_bytes) + " bytes";
    if (!page.pictures.empty()) {
      page.notes.push_back("the picture " + page.pictures.back().file + why);
      page.pictures.pop_back();
    } else if (options.three.code && !page.scenes.empty()) {
      page.notes.push_back(page.scenes.back().title + why);
      page.scenes.pop_back();
    } else {
      throw io::InputError("the page has " + std::to_string(text.size()) +
                           " bytes without any picture and motion, and must have at most " + std::to_string(options.most_bytes) +
                           ": report on one of the sub-folders instead");
    }
  }
}

std::string made_text(const fs::path& folder, std::size_t outputs) {
  std::error_code ignored;
  const fs::path whole = fs::weakly_canonical(folder, ignored);
  return "Made by menger " + std::string(io::version()) + " from " + std::to_string(outputs) + (outputs == 1 ? " run" : " runs") +
         " of its commands in " + (whole.empty() ? folder : whole).string() + ". One file, which needs no network.";
}

/// What the page is about: the robot of a loop, the body of all results, or else the folder.
std::string title_of(const fs::path& folder, const std::vector<CommandOutput>& outputs) {
  // Stages of a loop may have an earlier name.
  if (const CommandOutput* loop = loop_of(outputs); loop != nullptr && !loop->robot_name.empty())
    return "Report: " + loop->robot_name;
  std::set<std::string> bodies;
  for (const CommandOutput& output : outputs)
    if (!output.body_name.empty()) bodies.insert(output.body_name);
  if (bodies.size() == 1) return "Report: " + *bodies.begin();
  std::error_code ignored;
  fs::path whole = fs::weakly_canonical(folder, ignored);
  if (whole.filename().empty()) whole = whole.parent_path();
  if (whole.filename() == "results" && whole.has_parent_path()) whole = whole.parent_path();  // of the robot in the folder above
  return "Report: " + (whole.filename().empty() ? folder.string() : whole.filename().string());
}

/// "report.walk_1.gif" for report.html: animations have the name of their page, so that no file of anyone else is meant.
fs::path animation_of(const fs::path& page, std::size_t number) {
  const fs::path folder = page.has_parent_path() ? page.parent_path() : fs::path(".");
  return folder / (page.stem().string() + ".walk_" + std::to_string(number + 1) + ".gif");
}

/// Removes the animations of an earlier page of this name.
void remove_animations(ReportResult& result) {
  for (std::size_t n = 0; n < most_animations; ++n) {
    try {
      io::remove_if_there(animation_of(result.file, n));
    } catch (const io::InputError& error) {
      result.notes.emplace_back(error.what());
    }
  }
}

/// Draws the walks of the page beside it, and notes in each what shows it. What cannot be drawn is said in a note.
void animate(ReportPage& page, const ReportOptions& options, ReportResult& result) {
  std::vector<PageScene*> walks;
  for (PageScene& scene : page.scenes)
    if (scene.ground_m && scene.unit == "s") walks.push_back(&scene);
  const std::size_t count = std::min({walks.size(), options.animations, most_animations});
  if (count < walks.size())
    result.notes.push_back("of " + std::to_string(walks.size()) + " walks, the first " + std::to_string(count) + " are animated");
  for (std::size_t n = 0; n < count; ++n) {
    const fs::path file = animation_of(result.file, n);
    const std::string name = file.filename().string();
    const auto progress = [&](double share) {
      if (options.progress) options.progress(name, 0.5 + 0.5 * (static_cast<double>(n) + share) / static_cast<double>(count));
    };
    AnimationOutcome outcome;
    try {
      outcome = write_walk_animation(file, *walks[n], find_ffmpeg(), options.stop, progress);
    } catch (const io::InputError& error) {
      outcome.missing = error.what();
    }
    if (outcome.stopped) {
      result.stopped = true;
      return;
    }
    if (!outcome.written) {
      result.notes.push_back("no animation of walks: " + outcome.missing);
      return;
    }
    result.animations.push_back(file);
    walks[n]->animation = name;
    result.notes.push_back(name + " shows: " + walks[n]->title);
  }
}

/// The results of menger loop, where its robot.toml or the folder of that is given: what the loop said came out is with them.
fs::path results_in(const fs::path& given) {
  const fs::path folder = given.extension() == ".toml" && io::is_file(given) ? given.parent_path() : given;
  const fs::path results = folder / "results";
  return io::is_file(results / loop_state_name) && !io::is_file(folder / "manifest.json") ? results : given;
}

}  // namespace

ReportResult write_report(const fs::path& place, const ReportOptions& options) {
  const fs::path folder = results_in(place);
  const auto tell = [&](const std::string& doing, double share) {
    if (options.progress) options.progress(doing, share);
  };
  ReportResult result{
      .file = options.file.empty() ? folder / "report.html" : options.file, .verdict = {}, .animations = {}, .notes = {}};
  ReportPage page{.title = {}, .made = {}, .verdict = {}};
  tell("look for results", 0.0);
  std::vector<CommandOutput> outputs = find_command_outputs(folder, page.notes);
  if (outputs.empty()) throw io::InputError(folder.string() + ": holds no results of a command of menger (no manifest.json)");
  const auto [loop, changed] = known_loop(folder, page.notes);
  leave_out(folder, loop.left_behind, outputs, page.notes);
  // What a loop set aside is of another robot.toml.
  if (!loop.results.empty())
    std::erase_if(outputs,
                  [](const CommandOutput& output) { return fs::path(output.place).begin()->string() == set_aside_folder; });
  if (outputs.empty())
    throw io::InputError(folder.string() + ": all results are of an earlier robot.toml; run menger loop again");
  result.outputs = outputs.size();
  page.title = title_of(folder, outputs);
  page.made = made_text(folder, outputs.size());
  page.folder = fs::absolute(folder)
                    .lexically_normal()
                    .lexically_relative(fs::absolute(result.file).lexically_normal().parent_path())
                    .generic_string();
  ReportFacts facts = read_facts(outputs, page.notes);
  facts.softest_limit_Pa = loop.softest_limit_Pa;
  page.verdict = verdict_of(facts);
  warn_of_changes(changed, page.verdict);
  page.verdict.came_out = loop.lines;
  page.verdict.forecast = loop.forecast;
  page.inputs = input_table(outputs, folder);
  page.sections = report_sections(outputs, page.notes);
  tell("read motions", 0.1);
  // In base64 bytes take a third more; the rest is for three.js, tables and pictures.
  page.scenes = read_scenes(outputs, options.most_bytes / 20 * 11, page.notes);
  page.pictures = read_pictures(outputs, facts.inflations, options.most_bytes / 5, page.notes);
  if (!options.three.code) page.notes.push_back(options.three.missing);
  std::set<std::string> known;
  std::erase_if(page.notes, [&](const std::string& note) { return !known.insert(note).second; });
  tell("write the page", 0.4);
  const auto write = [&] {
    const std::string text = fitting_text(page, options);
    io::write_whole(result.file, text);
    result.bytes = text.size();
  };
  write();
  result.verdict = page.verdict;
  result.has_motion = options.three.code && !page.scenes.empty();
  result.notes = page.notes;
  if (options.animations > 0) {
    remove_animations(result);
    animate(page, options, result);
    if (!result.animations.empty()) write();  // with links to them
  }
  return result;
}

}  // namespace menger::evolution
