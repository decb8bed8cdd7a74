#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace menger::io {

/// How far a program is that another one waits for.
struct ToldProgress {
  double part = 0.0;  ///< of the job that it does at present, 0 to 1
  std::string note;
};

/// Asks the programs that this one starts from now on to tell in a file how far they are. They learn its name from the
/// environment variable MENGER_PROGRESS_FILE, and so do the programs that they start. Call it while there is one thread.
void ask_for_progress(const std::filesystem::path& file);

/// Whether a program has asked this one to tell how far it is.
bool is_asked_for_progress();

/// Tells how far this program is; does nothing if no program has asked. A Progress calls it, so that whatever draws a bar at a
/// terminal also tells.
void tell_progress(double part, std::string_view note);

/// Returns what a file tells; nothing if no program has told anything yet.
std::optional<ToldProgress> told_progress(const std::filesystem::path& file);

}  // namespace menger::io
