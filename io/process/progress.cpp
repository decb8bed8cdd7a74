#include "io/process/progress.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ostream>
#include <utility>

#include "io/process/plain_output.h"
#include "io/process/told_progress.h"
#include "io/text/printable.h"

namespace menger::io {

namespace {

constexpr int bar_width = 20;

std::string two_digits(long long value) { return std::string(value < 10 ? "0" : "").append(std::to_string(value)); }

}  // namespace

ProgressStyle terminal_progress() {
  ProgressStyle style;
  if (::isatty(STDERR_FILENO) == 1) style.out = &terminal();
  return style;
}

Progress::Progress(std::string title, double total, const ProgressStyle& style)
    : title_(std::move(title)), total_(total), style_(style), start_(Clock::now()), last_drawn_(start_) {}

Progress::~Progress() { clear_line(); }

void Progress::update(double done, std::string_view note) {
  if (style_.out == nullptr && !is_asked_for_progress()) return;
  const std::scoped_lock lock(mutex_);
  const auto now = Clock::now();
  const double elapsed_s = std::chrono::duration<double>(now - start_).count();
  const double pause_s = std::chrono::duration<double>(now - last_drawn_).count();
  if (pause_s < style_.interval_s || (style_.out != nullptr && elapsed_s < style_.quiet_s)) return;
  last_drawn_ = now;
  tell_progress(done / total_, note);
  if (style_.out == nullptr) return;
  *style_.out << '\r' << progress_line(title_, done / total_, elapsed_s, note, style_.width) << "\x1b[K" << std::flush;
  on_screen_ = true;
}

void Progress::clear() {
  const std::scoped_lock lock(mutex_);
  clear_line();
}

void Progress::clear_line() {
  if (on_screen_) *style_.out << "\r\x1b[K" << std::flush;
  on_screen_ = false;
}

std::string progress_line(std::string_view title, double fraction, double elapsed_s, std::string_view note, int width) {
  const double part = std::isfinite(fraction) ? std::clamp(fraction, 0.0, 1.0) : 0.0;
  const auto filled = static_cast<std::size_t>(std::floor(part * bar_width));
  std::string line = printable(title);
  line += " [" + std::string(filled, '#') + std::string(bar_width - filled, '.') + "] ";
  line += std::to_string(static_cast<int>(std::floor(100.0 * part))) + " %";
  if (part > 0.0) line += ", " + duration_text(elapsed_s * (1.0 - part) / part) + " left";
  if (!note.empty()) line += ", " + printable(note);
  return line.substr(0, static_cast<std::size_t>(std::max(width, 0)));
}

std::string duration_text(double seconds) {
  constexpr double longest = 1e12;
  const auto whole = static_cast<long long>(std::llround(std::clamp(seconds, 0.0, longest)));
  const long long minutes = whole / 60;
  const long long hours = minutes / 60;
  if (whole < 60) return std::to_string(whole) + " s";
  if (minutes < 60) return std::to_string(minutes) + " min " + two_digits(whole % 60) + " s";
  if (hours < 24) return std::to_string(hours) + " h " + two_digits(minutes % 60) + " min";
  return std::to_string(hours / 24) + " d " + two_digits(hours % 24) + " h";
}

}  // namespace menger::io
