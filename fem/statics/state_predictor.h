#pragma once

#include <cstddef>
#include <vector>

#include "fem/statics/equilibrium.h"

namespace menger::fem {

/// The last states of a path, from which the next one is extrapolated.
class StatePredictor {
 public:
  /// @param order of the polynomial in the path parameter: 0 to 2
  explicit StatePredictor(int order) : order_(order) {}

  void add(double s, BodyState state);
  void clear();

  /// The polynomial of the stated order, or of as many states as there are, at s; displacements, pressures of plena and of
  /// elements.
  [[nodiscard]] BodyState at(double s, int order) const;
  [[nodiscard]] BodyState at(double s) const { return at(s, order_); }

  /// Order that `at` really has now: fewer states make it lower.
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
