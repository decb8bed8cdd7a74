#include "io/process/told_progress.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>

#include "io/text/printable.h"

namespace menger::io {
namespace {

constexpr const char* variable = "MENGER_PROGRESS_FILE";

/// The file that this program tells its progress in; empty if no program has asked. A program that asks others tells nothing.
std::filesystem::path& own_file() {
  static std::filesystem::path file = [] {
    const char* const name = std::getenv(variable);
    return std::filesystem::path(name == nullptr ? "" : name);
  }();
  return file;
}

}  // namespace

void ask_for_progress(const std::filesystem::path& file) {
  own_file().clear();
  ::setenv(variable, file.c_str(), 1);
}

bool is_asked_for_progress() { return !own_file().empty(); }

void tell_progress(double part, std::string_view note) {
  if (!is_asked_for_progress() || !std::isfinite(part)) return;
  // Rewritten in place: who finds half a line reads it again a moment later.
  std::ofstream(own_file()) << part << ' ' << printable(note) << '\n';
}

std::optional<ToldProgress> told_progress(const std::filesystem::path& file) {
  std::ifstream in(file);
  ToldProgress told;
  if (!(in >> told.part) || !std::isfinite(told.part)) return std::nullopt;
  in.ignore();
  std::getline(in, told.note);
  told.part = std::clamp(told.part, 0.0, 1.0);
  return told;
}

}  // namespace menger::io
