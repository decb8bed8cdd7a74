#pragma once

#include <optional>
#include <string>

namespace menger::meshes {

/// How far and whereto a body walks, in either model.
struct WalkOutcome {
  double body_lengths = 0.0;              ///< horizontal displacement of the centre of mass, >= 0
  double time_s = 0.0;                    ///< > 0
  std::optional<double> direction_deg{};  ///< of the displacement, from x
};

/// How alike two walks of one body are, from alike to not at all.
enum class WalkAgreement { alike, both_go_nowhere, same_direction, different, one_goes_nowhere };

/// The limits by which walks are compared. They are choices; they decide words, never numbers.
namespace walk_limits {
/// A shorter walk is none, and has no direction. Small changes of step, ground, friction or pressure move where a robot of some
/// centimetres ends by 1.9 mm in 5 s (paper/known_walks/README.md), which is about this.
inline constexpr double least_body_lengths = 0.1;
inline constexpr double same_speed = 1.5;           ///< speeds agree if neither is more than this times the other
inline constexpr double comparable_speed = 3.0;     ///< beyond it, walks differ in whatever direction they go
inline constexpr double same_direction_deg = 45.0;  ///< directions agree within this angle
}  // namespace walk_limits

/// Returns the direction of a walk, degrees from the axis x towards y, -180 to 180.
double direction_deg(double x_m, double y_m);

/// Returns the angle between two directions, 0 to 180 degrees.
double angle_between_directions_deg(double a_deg, double b_deg);

/// Returns whether two walks last equally long but for a few steps of time: distances of others are not compared.
bool last_as_long(double a_s, double b_s);

/// "table after 5 s: its centre moved by x = 14.20 mm, y = -0.31 mm": the title of a picture of a walk, the same in all programs
std::string moved_text(const std::string& name, double time_s, double x_m, double y_m);

/// Compares two walks by their speeds and directions. Directions agree if one of them is not known.
WalkAgreement compare_walks(const WalkOutcome& a, const WalkOutcome& b);

}  // namespace menger::meshes
