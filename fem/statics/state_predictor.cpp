#include "fem/statics/state_predictor.h"

#include <algorithm>

namespace menger::fem {

void StatePredictor::add(double s, BodyState state) {
  s_.push_back(s);
  states_.push_back(std::move(state));
  if (s_.size() > static_cast<std::size_t>(std::max(order_, 2)) + 1) {
    s_.erase(s_.begin());
    states_.erase(states_.begin());
  }
}

void StatePredictor::clear() {
  s_.clear();
  states_.clear();
}

int StatePredictor::present_order() const { return std::min(order_, static_cast<int>(states_.size()) - 1); }

BodyState StatePredictor::at(double s, int order) const {
  const std::size_t count = std::min(static_cast<std::size_t>(order) + 1, states_.size());
  const std::size_t first = states_.size() - count;
  BodyState result = states_.back();
  if (count == 1) return result;
  const auto extrapolate = [&](auto member) {
    std::vector<double>& values = result.*member;
    std::fill(values.begin(), values.end(), 0.0);
    for (std::size_t i = first; i < states_.size(); ++i) {
      double weight = 1.0;  // Lagrange polynomial of state i
      for (std::size_t j = first; j < states_.size(); ++j)
        if (j != i) weight *= (s - s_[j]) / (s_[i] - s_[j]);
      const std::vector<double>& from = states_[i].*member;
      for (std::size_t n = 0; n < std::min(values.size(), from.size()); ++n) values[n] += weight * from[n];
    }
  };
  extrapolate(&BodyState::displacements_m);
  extrapolate(&BodyState::plenum_pressures_Pa);
  extrapolate(&BodyState::element_pressures_Pa);
  return result;
}

}  // namespace menger::fem
