#pragma once

#include <array>

namespace menger::extremes {

/// A solid bar, three times as long as wide. Plates bonded to its ends stretch it by a small strain. The rows of part fem compute
/// these numbers with finite elements; the rows of part voxel compare the surrogate with them.
struct SolidBar {
  double poissons_ratio;
  double stiffness;    ///< force divided by area, strain and Young's modulus
  double contraction;  ///< mean narrowing of the middle section divided by its width and the strain
};

/// Results of Q2/P1 with 2, 4 and 8 elements across half the width, extrapolated; the last digit is uncertain.
inline constexpr std::array solid_bars{SolidBar{0.3, 1.0200, 0.3064}, SolidBar{0.45, 1.0506, 0.4732},
                                       SolidBar{0.49, 1.0626, 0.5211}};

inline constexpr double solid_bar_strain = 1e-4;

}  // namespace menger::extremes
