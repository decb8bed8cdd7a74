#pragma once

#include <cstddef>
#include <vector>

#include "fem/statics/equilibrium.h"

namespace menger::fem {

/// Extrapolates the next state of a path from the last ones.
class StatePredictor {
 public:
  /// @param order of the polynomial in the path parameter: 0 to 2
  explicit StatePredictor(int order) : order_(order) {}

  void add(double s, BodyState state);
  void clear();

  /// Returns the extrapolated state at s: displacements, pressures of plena and of elements. The polynomial has the stated order,
  /// or a lower one if there are too few states.
  [[nodiscard]] BodyState at(double s, int order) const;
  [[nodiscard]] BodyState at(double s) const { return at(s, order_); }

  /// The order that `at` uses at present; with few states it is lower than the one asked for.
  [[nodiscard]] int present_order() const;

  [[nodiscard]] const BodyState& last() const { return states_.back(); }
  [[nodiscard]] const std::vector<double>& path_parameters() const { return s_; }  ///< oldest first
  [[nodiscard]] const std::vector<BodyState>& states() const { return states_; }

 private:
  int order_;
  std::vector<double> s_;
  std::vector<BodyState> states_;
};

}  // namespace menger::fem
