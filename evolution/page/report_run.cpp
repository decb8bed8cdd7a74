#include "evolution/page/report_run.h"

#include <algorithm>
#include <array>
#include <set>
#include <string_view>
#include <system_error>
#include <utility>

#include "evolution/page/command_outputs.h"
#include "evolution/page/report_scenes.h"
#include "evolution/page/report_sections.h"
#include "evolution/page/result_facts.h"
#include "evolution/page/verdict.h"
#include "evolution/page/walk_animation.h"
#include "io/text/input_error.h"
#include "io/text/version.h"
#include "io/text/whole_file.h"

namespace menger::evolution {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view png_signature = "\x89PNG\r\n\x1a\n";

/// The pictures of bodies that commands drew; charts are drawn anew by the page.
std::vector<PagePicture> read_pictures(const std::vector<CommandOutput>& outputs, std::size_t most_bytes,
                                       std::vector<std::string>& notes) {
  constexpr std::array names{"chamber.png", "robot.png", "champion.png", "winner/strip.png", "worst.png"};
  std::vector<PagePicture> pictures;
  std::size_t bytes = 0;
  std::size_t left_out = 0;
  for (const CommandOutput& output : outputs) {
    for (const char* name : names) {
      const fs::path file = output.folder / name;
      std::error_code ignored;
      if (!fs::is_regular_file(file, ignored)) continue;
      std::string content = io::read_whole(file);
      if (!content.starts_with(png_signature)) {
        notes.push_back(file.string() + ": is no PNG picture");
        continue;
      }
      if (bytes + content.size() > most_bytes) {
        ++left_out;
        continue;
      }
      bytes += content.size();
      pictures.push_back({.caption = (fs::path(output.name) / name).generic_string(), .png = std::move(content)});
    }
  }
  if (left_out > 0) notes.push_back(std::to_string(left_out) + " pictures are left out to keep the page small");
  return pictures;
}

/// The page as text, without what does not fit: first pictures, then motions are left out, the last ones first.
std::string fitting_text(ReportPage& page, const ReportOptions& options) {
  while (true) {
    std::string text = page_text(page, options.three.code);
    if (text.size() <= options.most_bytes) return text;
    const std::string why = " is left out to keep the page below " + std::to_string(options.most_bytes) + " bytes";
    if (!page.pictures.empty()) {
      page.notes.push_back("the picture " + page.pictures.back().caption + why);
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
  return "Made by menger " + std::string(io::version()) + " from " + std::to_string(outputs) +
         (outputs == 1 ? " folder" : " folders") + " of results in " + (whole.empty() ? folder : whole).string() +
         ". One file, which needs no network.";
}

std::string title_of_folder(const fs::path& folder) {
  std::error_code ignored;
  fs::path whole = fs::weakly_canonical(folder, ignored);
  if (whole.filename().empty()) whole = whole.parent_path();
  return "Report: " + (whole.filename().empty() ? folder.string() : whole.filename().string());
}

/// "walk.gif", "walk_2.gif", ...
std::string animation_name(std::size_t number) {
  return number == 0 ? "walk.gif" : "walk_" + std::to_string(number + 1) + ".gif";
}

/// Draws the walks of the page beside it.
void animate(const ReportPage& page, const ReportOptions& options, ReportResult& result) {
  constexpr std::size_t most_names = 16;
  const fs::path folder = result.file.has_parent_path() ? result.file.parent_path() : fs::path(".");
  for (std::size_t n = 0; n < most_names; ++n) io::remove_if_there(folder / animation_name(n));  // of an earlier report
  std::vector<const PageScene*> walks;
  for (const PageScene& scene : page.scenes)
    if (scene.ground_m && scene.unit == "s") walks.push_back(&scene);
  const std::size_t count = std::min({walks.size(), options.most_animations, most_names});
  if (count < walks.size())
    result.notes.push_back("of " + std::to_string(walks.size()) + " walks, the first " + std::to_string(count) + " are animated");
  for (std::size_t n = 0; n < count; ++n) {
    const fs::path file = folder / animation_name(n);
    const auto progress = [&](double share) {
      if (options.progress)
        options.progress(animation_name(n), 0.5 + 0.5 * (static_cast<double>(n) + share) / static_cast<double>(count));
    };
    const AnimationOutcome outcome = write_walk_animation(file, *walks[n], find_ffmpeg(), options.stop, progress);
    if (outcome.stopped) {
      result.stopped = true;
      return;
    }
    if (!outcome.written) {
      result.notes.push_back("no animation of walks: " + outcome.missing);
      return;
    }
    result.animations.push_back(file);
    result.notes.push_back(animation_name(n) + " shows: " + walks[n]->title);
  }
}

}  // namespace

ReportResult write_report(const fs::path& folder, const ReportOptions& options) {
  const auto tell = [&](const std::string& doing, double share) {
    if (options.progress) options.progress(doing, share);
  };
  ReportResult result{
      .file = options.file.empty() ? folder / "report.html" : options.file, .verdict = {}, .animations = {}, .notes = {}};
  ReportPage page{.title = title_of_folder(folder), .made = {}, .verdict = {}};
  tell("look for results", 0.0);
  const std::vector<CommandOutput> outputs = find_command_outputs(folder, page.notes);
  if (outputs.empty()) throw io::InputError(folder.string() + ": holds no results of a command of menger (no manifest.json)");
  result.outputs = outputs.size();
  page.made = made_text(folder, outputs.size());
  page.verdict = verdict_of(read_facts(outputs, page.notes));
  page.sections = report_sections(outputs, page.notes);
  tell("read motions", 0.1);
  // In base64 bytes take a third more; the rest is for three.js, tables and pictures.
  page.scenes = read_scenes(outputs, options.most_bytes / 20 * 11, page.notes);
  page.pictures = read_pictures(outputs, options.most_bytes / 5, page.notes);
  if (!options.three.code) page.notes.push_back(options.three.missing);
  std::set<std::string> known;
  std::erase_if(page.notes, [&](const std::string& note) { return !known.insert(note).second; });
  tell("write the page", 0.4);
  const std::string text = fitting_text(page, options);
  io::write_whole(result.file, text);
  result.bytes = text.size();
  result.verdict = page.verdict;
  result.has_motion = options.three.code && !page.scenes.empty();
  result.notes = page.notes;
  if (options.most_animations > 0) animate(page, options, result);
  return result;
}

}  // namespace menger::evolution
