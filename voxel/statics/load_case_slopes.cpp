#include "voxel/statics/load_case_slopes.h"

#include <oneapi/tbb/parallel_for.h>

#include <cmath>
#include <memory>

#include "voxel/statics/load_case_body.h"
#include "voxel/statics/load_case_ordinates.h"
#include "voxel/statics/load_case_response.h"
#include "voxel/statics/tangent_factors.h"

namespace menger::voxel {
namespace {

using meshes::LoadCase;
using meshes::LoadCaseKind;

/// A surrogate with neighbouring parameters, placed at the equilibrium of another.
class Neighbour {
 public:
  /// @param by signed distance of its parameters in the coordinate of the span
  Neighbour(const SurrogateParameters& parameters, const StaticBody& body, LoadCaseKind kind, double by)
      : body_(with(parameters, body)), equilibrium_(body_, load_case_supports(kind)), by_(by) {}

  [[nodiscard]] double by() const { return by_; }

  /// Puts it into the equilibrium state of another surrogate. @return its residual there, scaled as that of the other; nothing if
  /// its laws have no value
  [[nodiscard]] std::optional<Eigen::VectorXd> residual_beside(const Equilibrium& other) {
    if (!equilibrium_.place(other.loads(), other.state())) return std::nullopt;
    const ForceBalance& balance = equilibrium_.balance();
    return balance.force_scale_N() / other.balance().force_scale_N() * balance.residual(equilibrium_.state());
  }

  /// Ordinates after a step from its state; nothing if there are none.
  [[nodiscard]] std::optional<std::vector<double>> ordinates(const std::vector<std::string>& columns, LoadCaseKind kind,
                                                             const Eigen::VectorXd& step) {
    StaticState moved = equilibrium_.state();
    equilibrium_.balance().move(moved, step);
    if (!equilibrium_.place(StaticLoads(equilibrium_.loads()), moved)) return std::nullopt;
    std::vector<double> row = load_case_ordinates(columns, kind, equilibrium_);
    for (const double value : row) {
      if (!std::isfinite(value)) return std::nullopt;
    }
    return row.empty() ? std::nullopt : std::optional(std::move(row));
  }

 private:
  static StaticBody with(const SurrogateParameters& parameters, const StaticBody& body) {
    std::vector<meshes::Side> sides;
    for (const Plate& plate : body.plates) sides.push_back(plate.side);
    return {parameters, body.voxels, sides};
  }

  StaticBody body_;
  Equilibrium equilibrium_;
  double by_;
};

/// The surrogates on both sides of a span, as far as they exist.
struct Neighbours {
  std::unique_ptr<Neighbour> below;
  std::unique_ptr<Neighbour> above;
};

/// Computes the slopes of all spans along the states of a load case.
class SlopeSweep {
 public:
  SlopeSweep(const LoadCase& load_case, const std::vector<ParameterSpan>& spans)
      : kind_(load_case.kind),
        columns_(meshes::response_columns(load_case)),
        spans_(spans),
        neighbours_(spans.size()),
        slopes_(spans.size(), ResponseSlope(columns_.size())) {}

  void visit(const Equilibrium& equilibrium);

  [[nodiscard]] std::vector<std::optional<ResponseSlope>> take() { return std::move(slopes_); }

 private:
  void begin(const Equilibrium& equilibrium);
  /// Derivative of the residual with respect to the coordinate of a span. Drops a side that has no value.
  [[nodiscard]] std::optional<Eigen::VectorXd> residual_slope(std::size_t span, const Equilibrium& equilibrium);
  /// Derivative of the ordinates if the unknowns change at a rate.
  [[nodiscard]] std::optional<std::vector<double>> ordinate_slope(std::size_t span, const Eigen::VectorXd& rate,
                                                                  const std::vector<double>& here);

  LoadCaseKind kind_;
  std::vector<std::string> columns_;
  const std::vector<ParameterSpan>& spans_;
  std::optional<ForceBalance> balance_;
  TangentFactors factors_;
  std::vector<Neighbours> neighbours_;
  std::vector<std::optional<ResponseSlope>> slopes_;
};

void SlopeSweep::begin(const Equilibrium& equilibrium) {
  const StaticBody& body = equilibrium.balance().body();
  balance_.emplace(body, load_case_supports(kind_));
  tbb::parallel_for(std::size_t{0}, spans_.size(), [&](std::size_t n) {
    const ParameterSpan& span = spans_[n];
    if (span.below_by > 0.0) neighbours_[n].below = std::make_unique<Neighbour>(span.below, body, kind_, -span.below_by);
    if (span.above_by > 0.0) neighbours_[n].above = std::make_unique<Neighbour>(span.above, body, kind_, span.above_by);
  });
}

std::optional<Eigen::VectorXd> SlopeSweep::residual_slope(std::size_t span, const Equilibrium& equilibrium) {
  std::optional<Eigen::VectorXd> low;
  std::optional<Eigen::VectorXd> high;
  Neighbours& sides = neighbours_[span];
  if (sides.below && !(low = sides.below->residual_beside(equilibrium))) sides.below.reset();
  if (sides.above && !(high = sides.above->residual_beside(equilibrium))) sides.above.reset();
  if (low && high) return (*high - *low) / (sides.above->by() - sides.below->by());
  if (!low && !high) return std::nullopt;
  const Eigen::VectorXd here = equilibrium.balance().residual(equilibrium.state());
  if (high) return (*high - here) / sides.above->by();
  return (*low - here) / sides.below->by();
}

std::optional<std::vector<double>> SlopeSweep::ordinate_slope(std::size_t span, const Eigen::VectorXd& rate,
                                                              const std::vector<double>& here) {
  const auto beside = [&](std::unique_ptr<Neighbour>& side) {
    std::optional<std::vector<double>> row;
    if (side) row = side->ordinates(columns_, kind_, side->by() * rate);
    if (!row) side.reset();
    return row;
  };
  Neighbours& sides = neighbours_[span];
  const auto low = beside(sides.below);
  const auto high = beside(sides.above);
  if (!low && !high) return std::nullopt;
  const double width = (high ? sides.above->by() : 0.0) - (low ? sides.below->by() : 0.0);
  std::vector<double> slope = high ? *high : here;
  for (std::size_t i = 0; i < slope.size(); ++i) slope[i] = (slope[i] - (low ? *low : here)[i]) / width;
  return slope;
}

void SlopeSweep::visit(const Equilibrium& equilibrium) {
  if (!balance_) begin(equilibrium);
  const bool in_range = balance_->set_loads(equilibrium.loads());
  static_cast<void>(balance_->linearise(equilibrium.state()));
  const bool has_converged = in_range && factors_.factorise(balance_->stiffness());
  Eigen::MatrixXd loads = Eigen::MatrixXd::Zero(balance_->unknown_count(), static_cast<Eigen::Index>(spans_.size()));
  tbb::parallel_for(std::size_t{0}, spans_.size(), [&](std::size_t n) {
    if (!slopes_[n]) return;
    if (const auto load = has_converged ? residual_slope(n, equilibrium) : std::nullopt) {
      loads.col(static_cast<Eigen::Index>(n)) = *load;
    } else {
      slopes_[n].reset();
    }
  });
  const Eigen::MatrixXd rates = has_converged ? factors_.solve(loads) : loads;
  const std::vector<double> here = load_case_ordinates(columns_, kind_, equilibrium);
  const std::size_t abscissae = meshes::abscissa_count(kind_);
  tbb::parallel_for(std::size_t{0}, spans_.size(), [&](std::size_t n) {
    if (!slopes_[n]) return;
    const auto row = ordinate_slope(n, rates.col(static_cast<Eigen::Index>(n)), here);
    if (!row) {
      slopes_[n].reset();
      return;
    }
    for (std::size_t c = 0; c < columns_.size(); ++c) (*slopes_[n])[c].push_back(c < abscissae ? 0.0 : (*row)[c - abscissae]);
  });
}

}  // namespace

ResponseSlopes respond_with_slopes(const SurrogateParameters& parameters, const LoadCase& load_case,
                                   const Responder::States& states, const std::vector<ParameterSpan>& spans) {
  SlopeSweep sweep(load_case, spans);
  ResponseSlopes result;
  result.response = visit_states(parameters, load_case, states,
                                 [&sweep](std::size_t, const Equilibrium& equilibrium) { sweep.visit(equilibrium); });
  result.slopes = sweep.take();
  return result;
}

Responder equilibrium_responder() {
  return {[](const SurrogateParameters& parameters, const LoadCase& load_case, const Responder::States& states) {
            return respond(parameters, load_case, states);
          },
          respond_with_slopes};
}

}  // namespace menger::voxel
