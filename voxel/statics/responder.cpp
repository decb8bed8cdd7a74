#include "voxel/statics/responder.h"

#include <algorithm>
#include <cmath>

namespace menger::voxel {
namespace {

/// Whether a response has all rows that another has, and all its values are finite.
bool is_like(const LoadCaseResponse& response, const LoadCaseResponse& other) {
  if (response.status != io::RunStatus::completed || response.values.size() != other.values.size()) return false;
  for (std::size_t c = 0; c < other.values.size(); ++c) {
    if (response.values[c].size() != other.values[c].size()) return false;
    if (!std::ranges::all_of(response.values[c], [](double value) { return std::isfinite(value); })) return false;
  }
  return true;
}

}  // namespace

ResponseSlopes Responder::slopes(const SurrogateParameters& parameters, const meshes::LoadCase& load_case, const States& states,
                                 const std::vector<ParameterSpan>& spans) const {
  if (slopes_) return slopes_(parameters, load_case, states, spans);
  ResponseSlopes result;
  result.response = response_(parameters, load_case, states);
  const LoadCaseResponse& here = result.response;
  if (here.status != io::RunStatus::completed) {
    result.slopes.resize(spans.size());
    return result;
  }
  const auto beside = [&](const SurrogateParameters& side, double by) {
    std::optional<LoadCaseResponse> response;
    if (by > 0.0) response = response_(side, load_case, states);
    if (response && !is_like(*response, here)) response.reset();
    return response;
  };
  for (const ParameterSpan& span : spans) {
    const auto above = beside(span.above, span.above_by);
    const auto below = beside(span.below, span.below_by);
    std::optional<ResponseSlope>& slope = result.slopes.emplace_back();
    if (!above && !below) continue;
    const ResponseSlope& high = above ? above->values : here.values;
    const ResponseSlope& low = below ? below->values : here.values;
    const double width = (above ? span.above_by : 0.0) + (below ? span.below_by : 0.0);
    slope = high;
    for (std::size_t c = 0; c < high.size(); ++c) {
      for (std::size_t row = 0; row < high[c].size(); ++row) (*slope)[c][row] = (high[c][row] - low[c][row]) / width;
    }
  }
  return result;
}

}  // namespace menger::voxel
