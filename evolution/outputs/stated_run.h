#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

namespace menger::evolution {

/// Cells of a body as a manifest names them: `layers[z][y][x]` is '0', '1' or '2'.
struct ManifestBody {
  std::vector<std::vector<std::string>> layers;
  double cell_edge_m = 0.0;
  bool operator==(const ManifestBody&) const = default;
};

/// What the parameters of a run state of its body and its motion. What they do not state is empty.
struct StatedRun {
  std::optional<ManifestBody> body{};  ///< if the parameters have a design of level 1
  std::optional<double> wall_thickness_m{};
  std::string chambers{};                       ///< "single" or "per-phase"
  std::string silicone{};                       ///< its name
  std::string law{};                            ///< kind and numbers of the hyperelastic law, in a form that can be compared
  std::string supports{};                       ///< of an inflation: "free", "ground_guided", ...
  std::string elements{};                       ///< kind of the finite elements: "thin_wall", "three_field"
  std::string fidelity{};                       ///< of thin walls: "draft", "standard", "fine"
  std::optional<double> highest_pressure_Pa{};  ///< of the drive
  std::optional<double> frequency_Hz{};         ///< of the drive, also where it holds its pressure
  bool has_strokes = true;                      ///< false for a drive that does nothing or holds its pressure
  std::string drive{};  ///< what decides the motion of the drive, in a form that can be compared; empty without one
  std::optional<double> static_friction{};   ///< of the ground
  std::optional<double> kinetic_friction{};  ///< likewise

  [[nodiscard]] std::optional<double> stroke_frequency_Hz() const { return has_strokes ? frequency_Hz : std::nullopt; }
};

/// Reads them from the parameters of a manifest. Voxels have their walls and silicone from the parameters of their surrogate.
StatedRun stated_run(const nlohmann::json& parameters);

/// Returns whether a re-evaluation compares its finite elements with those that decided the search, not with a surrogate.
/// @param parameters of its manifest
bool compares_elements_of_search(const nlohmann::json& parameters);

/// Returns whether two runs are of one body: both state the same cells, and their walls, chambers and silicone agree where both
/// state them.
bool are_of_one_body(const StatedRun& a, const StatedRun& b);

/// Returns whether two runs are one walk: of one body, driven alike, on ground whose friction agrees where both state it.
bool are_one_walk(const StatedRun& a, const StatedRun& b);

}  // namespace menger::evolution
