#pragma once

#include <cmath>
#include <filesystem>
#include <optional>
#include <string>

#include "io/text/toml_document.h"
#include "meshes/load_cases/walk_agreement.h"
#include "meshes/robot/robot.h"

namespace menger::evolution {

/// A walk of either model.
struct FoundWalk {
  double x_m = 0.0;
  double y_m = 0.0;
  double body_lengths = 0.0;
  double time_s = 0.0;
  std::optional<double> fell_s{};  ///< when the body fell over, if it did

  [[nodiscard]] double distance_m() const { return std::hypot(x_m, y_m); }
  [[nodiscard]] double direction_deg() const { return meshes::direction_deg(x_m, y_m); }
};

/// Returns the walk that a result tells of, and whether the body fell over in it, by its frames beside the file.
/// @param file result.toml of simulate or locomotion.toml of locomote, which have the same names
/// @param result what it holds
/// @return nothing if the walk never began
std::optional<FoundWalk> walk_in(const std::filesystem::path& file, const io::TomlTable& result, const meshes::Robot& robot);

/// Returns "fell over at 1.7 s"; empty if it did not.
std::string fall_text(const FoundWalk& walk);

/// Returns what the walk in a file came to, for people; empty if the file is not there.
std::string walk_text(const std::filesystem::path& file, const meshes::Robot& robot);

}  // namespace menger::evolution
