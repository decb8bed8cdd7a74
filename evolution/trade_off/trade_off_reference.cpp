#include "evolution/trade_off/trade_off_reference.h"

#include <algorithm>
#include <cmath>

namespace menger::evolution {
namespace {

/// The runs that differ from the reference in one property of the fidelity, for one observable.
class Neighbours {
 public:
  Neighbours(const std::vector<ElementFidelity>& fidelities, const std::vector<TradeRow>& rows, std::size_t reference,
             std::size_t observable)
      : fidelities_(fidelities), rows_(rows), reference_(reference), finest_(fidelities[reference]), observable_(observable) {}

  /// Returns the estimated relative error of the reference; none without other runs.
  [[nodiscard]] std::optional<double> error() const {
    if (!rows_[reference_].values[observable_] || value(reference_) == 0.0) return std::nullopt;
    std::optional<double> sum;
    for (const std::optional<double>& part : {mesh_part(), bulk_part(), tolerance_part()}) {
      if (part) sum = sum.value_or(0.0) + *part;
    }
    if (sum) *sum /= std::abs(value(reference_));
    return sum;
  }

 private:
  [[nodiscard]] double value(std::size_t run) const { return rows_[run].values[observable_].value_or(0.0); }
  [[nodiscard]] double difference(std::size_t run) const { return std::abs(value(reference_) - value(run)); }

  [[nodiscard]] bool same_mesh(const ElementFidelity& f) const {
    return f.degree == finest_.degree && f.elements_through_wall == finest_.elements_through_wall &&
           f.thin_walls == finest_.thin_walls;
  }
  [[nodiscard]] bool same_bulk(const ElementFidelity& f) const { return f.bulk_ratio == finest_.bulk_ratio; }
  [[nodiscard]] bool same_tolerance(const ElementFidelity& f) const { return f.force_tolerance == finest_.force_tolerance; }
  [[nodiscard]] bool same_but_mesh(const ElementFidelity& f) const { return same_bulk(f) && same_tolerance(f); }

  /// Returns the finest run of the reference's kind of elements, other than the reference, that has a value and for which `fits`
  /// is true.
  template <class Fits>
  [[nodiscard]] std::optional<std::size_t> finest_run(const Fits& fits) const {
    for (std::size_t run = rows_.size(); run-- > 0;) {
      const bool same_kind = fidelities_[run].thin_walls.has_value() == finest_.thin_walls.has_value();
      if (run != reference_ && same_kind && rows_[run].values[observable_] && fits(fidelities_[run])) return run;
    }
    return std::nullopt;
  }

  [[nodiscard]] std::optional<double> mesh_part() const {
    const auto coarser = finest_run([&](const ElementFidelity& f) {
      return same_but_mesh(f) && f.degree == finest_.degree && f.elements_through_wall < finest_.elements_through_wall;
    });
    if (!coarser) {
      const auto other = finest_run([&](const ElementFidelity& f) { return same_but_mesh(f) && !same_mesh(f); });
      return other ? std::optional(difference(*other)) : std::nullopt;
    }
    const int through = fidelities_[*coarser].elements_through_wall;
    const auto coarsest = finest_run([&](const ElementFidelity& f) {
      return same_but_mesh(f) && f.degree == finest_.degree && 2 * f.elements_through_wall == through;
    });
    double falls_by = 2.0;  // order one: the remaining error is as large as the last change
    if (coarsest && 2 * through == finest_.elements_through_wall && difference(*coarser) > 0.0) {
      constexpr double largest_fall = 16.0;  // order four
      falls_by = std::clamp((value(*coarser) - value(*coarsest)) / (value(reference_) - value(*coarser)), 2.0, largest_fall);
    }
    return difference(*coarser) / (falls_by - 1.0);
  }

  [[nodiscard]] std::optional<double> bulk_part() const {
    const auto softer = finest_run(
        [&](const ElementFidelity& f) { return same_mesh(f) && same_tolerance(f) && f.bulk_ratio < finest_.bulk_ratio; });
    if (!softer) return std::nullopt;
    return difference(*softer) / (finest_.bulk_ratio / fidelities_[*softer].bulk_ratio - 1.0);
  }

  [[nodiscard]] std::optional<double> tolerance_part() const {
    const auto looser = finest_run(
        [&](const ElementFidelity& f) { return same_mesh(f) && same_bulk(f) && f.force_tolerance > finest_.force_tolerance; });
    return looser ? std::optional(difference(*looser)) : std::nullopt;
  }

  const std::vector<ElementFidelity>& fidelities_;
  const std::vector<TradeRow>& rows_;
  std::size_t reference_;
  ElementFidelity finest_;
  std::size_t observable_;
};

}  // namespace

std::vector<std::optional<double>> element_reference_errors(const std::vector<ElementFidelity>& fidelities,
                                                            const std::vector<TradeRow>& rows, std::size_t reference) {
  std::vector<std::optional<double>> errors;
  for (std::size_t observable = 0; observable < rows[reference].values.size(); ++observable)
    errors.push_back(Neighbours(fidelities, rows, reference, observable).error());
  return errors;
}

std::optional<double> gait_reference_error(const std::vector<VoxelFidelity>& fidelities, const std::vector<TradeRow>& rows,
                                           std::size_t reference) {
  const VoxelFidelity& finest = fidelities[reference];
  const double value = rows[reference].values.front().value_or(0.0);
  std::optional<std::size_t> next;
  for (std::size_t run = 0; run < rows.size(); ++run) {
    VoxelFidelity same = fidelities[run];
    same.time_step_fraction = finest.time_step_fraction;
    const bool fits =
        same == finest && fidelities[run].time_step_fraction > finest.time_step_fraction && rows[run].values.front();
    if (fits && (!next || fidelities[run].time_step_fraction < fidelities[*next].time_step_fraction)) next = run;
  }
  if (!next || value == 0.0) return std::nullopt;
  const double larger = fidelities[*next].time_step_fraction - finest.time_step_fraction;
  return std::abs(rows[*next].values.front().value_or(0.0) - value) / std::abs(value) * finest.time_step_fraction / larger;
}

}  // namespace menger::evolution
