#pragma once

#include <chrono>
#include <iosfwd>
#include <mutex>
#include <string>
#include <string_view>

namespace menger::io {

/// Where a progress bar is drawn.
struct ProgressStyle {
  std::ostream* out = nullptr;  ///< nothing is drawn without one
  double quiet_s = 2.0;         ///< a job that is done sooner draws nothing
  double interval_s = 0.2;      ///< time between two drawings
  int width = 79;               ///< characters of a line
};

/// Standard error if it is a terminal; otherwise nothing is drawn.
ProgressStyle terminal_progress();

/// A line that shows how much of a job is done, how long the rest takes, and a note of the caller. Threads may update it at the
/// same time.
class Progress {
 public:
  /// @param total amount of work in any unit, > 0
  explicit Progress(std::string title, double total, const ProgressStyle& style = terminal_progress());

  /// Clears the line.
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// @param done amount of work done since the start, in the unit of the total
  /// @param note any text for the end of the line, such as a rate
  void update(double done, std::string_view note = {});

  /// Clears the line so that other text can be printed; the next update draws it again.
  void clear();

 private:
  void clear_line();

  using Clock = std::chrono::steady_clock;
  std::mutex mutex_;
  std::string title_;
  double total_;
  ProgressStyle style_;
  Clock::time_point start_;
  Clock::time_point last_drawn_;
  bool on_screen_ = false;
};

/// Returns the line of a progress bar: title, bar, percentage, estimated time to the end and note, at most `width` characters.
/// @param fraction part of the work that is done, 0 to 1
/// @param elapsed_s time since the start, in seconds
std::string progress_line(std::string_view title, double fraction, double elapsed_s, std::string_view note, int width);

/// Returns a duration as people write it: "8 s", "3 min 20 s", "2 h 05 min", "4 d 03 h".
std::string duration_text(double seconds);

}  // namespace menger::io
