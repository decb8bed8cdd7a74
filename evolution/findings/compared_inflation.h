#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace menger::evolution {

/// The inflation of the body in the stage validate: its own finite elements, which compute states of growing pressure.
struct ComparedInflation {
  std::string status;
  std::vector<double> planned_Pa;     ///< the states that were to be compared
  std::vector<double> compared_Pa;    ///< those that were reached
  std::optional<double> missed_Pa{};  ///< the first that was not
  double last_Pa = 0.0;               ///< the last one reached before that; 0: the body at rest

  /// Whether walls of a chamber touch before a state, so that the walk passes through this contact.
  [[nodiscard]] bool has_contact() const { return status == "wall_contact" && missed_Pa; }
  /// Whether no stable equilibrium followed.
  [[nodiscard]] bool is_unstable() const { return status == "limit_point" && missed_Pa; }
};

/// Returns the inflation that the stage validate compared; nothing if there is none.
std::optional<ComparedInflation> compared_inflation(const std::filesystem::path& results);

/// Returns "between 4 kPa and 5 kPa": where a curve ended. @pre a state was missed
std::string where_ended(const ComparedInflation& compared);

/// Returns "compared at 1 to 4 of 6 kPa, where the finite elements ended (no stable equilibrium follows)"; empty if all states of
/// the drive were compared.
std::string compared_text(const std::filesystem::path& results);

}  // namespace menger::evolution
