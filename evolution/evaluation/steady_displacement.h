#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace menger::evolution {

/// Displacements of the centre of mass (x, y, z) in successive whole periods of the drive, in metres, from the start.
using PeriodDisplacements = std::vector<std::array<double, 3>>;

/// The last whole periods of an evaluation, over which a steady motion is measured.
struct LastPeriods {
  double period_s = 0.0;  ///< of the drive, > 0
  std::size_t count = 5;  ///< number of periods, >= 1

  bool operator==(const LastPeriods&) const = default;
};

/// Returns the number of whole periods in a time. A period that rounding makes longer than the time counts.
std::size_t whole_periods(double duration_s, double period_s);

/// Returns the displacement in one period of a body that moves steadily, in metres: for each axis the median of the means of all
/// pairs of successive periods. Of an even number of means it is the smaller in magnitude of the two in the middle.
///
/// A median of each axis depends on the axes: for a body that turns it is not that of the same motion in turned axes.
///
/// For equal periods it is their displacement. The means of pairs of a body that rocks, whose periods alternate between a and -a,
/// are 0. One period out of five or more that differs, such as that of a fall, changes at most half of the means: it cannot make
/// the median larger than those of the others, whether the body walks, lies or rocks otherwise.
/// @param periods not empty; of one period it is its displacement
std::array<double, 3> steady_displacement_m(std::span<const std::array<double, 3>> periods);

/// Returns the same of the last periods of an evaluation; nothing if it has fewer.
std::optional<std::array<double, 3>> steady_displacement_m(const PeriodDisplacements& all, const LastPeriods& last);

}  // namespace menger::evolution
