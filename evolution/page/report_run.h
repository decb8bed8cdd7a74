#pragma once

#include <atomic>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "evolution/page/page_text.h"
#include "evolution/page/report_page.h"

namespace menger::evolution {

/// Animations of walks beside a page at most: each takes seconds to draw.
inline constexpr std::size_t most_animations = 4;

/// Options of a report.
struct ReportOptions {
  std::filesystem::path file;                ///< of the page; empty: report.html in the folder
  std::size_t most_bytes = 20'000'000;       ///< of the page; pictures and motions are left out to keep to it
  std::size_t animations = most_animations;  ///< of the first walks, beside the page; 0 for none: those there are stay
  ThreeCode three = read_three();            ///< the code that moves the bodies
  const std::atomic<bool>* stop = nullptr;   ///< once true, no further animation is made
  std::function<void(const std::string& doing, double share)> progress{};
};

/// What was written.
struct ReportResult {
  std::filesystem::path file;
  std::size_t bytes = 0;
  Verdict verdict;
  std::size_t outputs = 0;  ///< of commands, that were found
  bool has_motion = false;  ///< whether the page shows bodies that move
  bool stopped = false;     ///< by the user: animations are missing
  std::vector<std::filesystem::path> animations{};
  std::vector<std::string> notes{};  ///< what could not be shown or made, and why
};

/// Writes a page on all that commands of menger left in a folder and its sub-folders: report.html, whole or not at all, and
/// beside it animations (GIF) of its first walks, report.walk_1.gif to report.walk_4.gif. Those of an earlier page of this name
/// go. What stages of a loop computed for an earlier robot is left out. What cannot be read or drawn becomes a note.
/// @param place the folder; or the robot.toml of a loop or its folder, whose results are taken
/// @throws io::InputError if the folder holds no results of a command, or if the page cannot be written; nothing is overwritten
/// then
ReportResult write_report(const std::filesystem::path& place, const ReportOptions& options = {});

}  // namespace menger::evolution
