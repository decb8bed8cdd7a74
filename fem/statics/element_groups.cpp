#include "fem/statics/element_groups.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace menger::fem {

ElementGroups::ElementGroups(const Space& space, const Body& body, ElementKernels kernels) : space_(space), kernels_(kernels) {
  if (body.thin_walls) {
    thin_walls_.emplace(space, body);
    return;
  }
  for (const RegionMaterial& region : body.regions)
    materials_.push_back({space.degree, body.formulation, region.law, region.volume});
  const std::size_t width = kernels_.width;
  const std::size_t nodes = space.nodes_per_element();
  for (std::size_t region = 0; region < body.regions.size(); ++region) {
    for (std::size_t e = 0; e < space.local_element_count(); ++e) {
      if (space.element_regions[e] != region) continue;
      if (batches_.empty() || batches_.back().region != region || batches_.back().elements.size() == width)
        batches_.push_back({region, {}, {}, {}});
      batches_.back().elements.push_back(e);
    }
  }
  for (Batch& batch : batches_) {
    batch.positions.resize(3 * nodes * width);
    for (std::size_t lane = 0; lane < width; ++lane) {
      const auto element = nodes_of(batch.elements[std::min(lane, batch.elements.size() - 1)]);
      for (std::size_t a = 0; a < nodes; ++a) {
        for (std::size_t i = 0; i < 3; ++i)
          batch.positions[(3 * a + i) * width + lane] = space.positions[static_cast<std::size_t>(element[a])][i];
      }
    }
  }
  const ElementShape shape{space.degree};
  displacements_.resize(3 * nodes * width);
  step_.resize(3 * nodes * width);
  residual_.resize(3 * nodes * width);
  stiffness_.resize(9 * shape.pairs() * width);
  energy_.resize(width);
  ratio_.resize(width);
  element_residual_.resize(3 * nodes);
  element_stiffness_.resize(9 * nodes * nodes);
}

std::span<const Index> ElementGroups::nodes_of(std::size_t element) const {
  const std::size_t nodes = space_.nodes_per_element();
  return std::span(space_.element_nodes).subspan(element * nodes, nodes);
}

void ElementGroups::gather(const Batch& batch, std::span<const double> values, PackedDoubles& packed) const {
  const std::size_t width = kernels_.width;
  for (std::size_t lane = 0; lane < width; ++lane) {
    const auto element = nodes_of(batch.elements[std::min(lane, batch.elements.size() - 1)]);
    for (std::size_t a = 0; a < element.size(); ++a) {
      for (std::size_t i = 0; i < 3; ++i)
        packed[(3 * a + i) * width + lane] = values[3 * static_cast<std::size_t>(element[a]) + i];
    }
  }
}

ElementSums ElementGroups::evaluate(std::span<const double> displacements, const ElementWanted& wanted, const Receiver& receive) {
  if (thin_walls_) return thin_walls_->evaluate(displacements, wanted, receive);
  ElementSums sums;
  for (const Batch& batch : batches_) {
    gather(batch, displacements, displacements_);
    kernels_.evaluate(materials_[batch.region],
                      {.positions = batch.positions.data(),
                       .displacements = displacements_.data(),
                       .predicted_pressure = has_prediction_ ? batch.predicted_pressure.data() : nullptr,
                       .residual = wanted.residual ? residual_.data() : nullptr,
                       .stiffness = wanted.stiffness ? stiffness_.data() : nullptr,
                       .energy = energy_.data(),
                       .smallest_ratio = ratio_.data()});
    for (std::size_t lane = 0; lane < batch.elements.size(); ++lane) {
      sums.energy_J += energy_[lane];
      // The comparison is written so that a NaN counts, too.
      if (!(ratio_[lane] >= sums.smallest_ratio)) sums.smallest_ratio = std::isnan(ratio_[lane]) ? -1.0 : ratio_[lane];
    }
    if (wanted.residual || wanted.stiffness) hand_over(batch, wanted, receive);
  }
  return sums;
}

void ElementGroups::predict_pressure(std::span<const double> displacements, std::span<const double> step) {
  for (Batch& batch : batches_) {
    gather(batch, displacements, displacements_);
    gather(batch, step, step_);
    batch.predicted_pressure.resize(ElementShape{space_.degree}.points() * kernels_.width);
    kernels_.predict_pressure(materials_[batch.region],
                              {.positions = batch.positions.data(), .displacements = displacements_.data()}, step_.data(),
                              batch.predicted_pressure.data());
  }
  has_prediction_ = true;
}

std::vector<double> ElementGroups::predicted_pressures() const {
  std::vector<double> all;
  for (const Batch& batch : batches_) all.insert(all.end(), batch.predicted_pressure.begin(), batch.predicted_pressure.end());
  return all;
}

std::size_t ElementGroups::pressure_count() const {
  return batches_.size() * ElementShape{space_.degree}.points() * kernels_.width;
}

void ElementGroups::set_predicted_pressures(std::span<const double> pressures) {
  assert(pressures.size() == pressure_count());
  for (Batch& batch : batches_) {
    const auto own = pressures.first(ElementShape{space_.degree}.points() * kernels_.width);
    batch.predicted_pressure.assign(own.begin(), own.end());
    pressures = pressures.subspan(own.size());
  }
  has_prediction_ = true;
}

void ElementGroups::hand_over(const Batch& batch, const ElementWanted& wanted, const Receiver& receive) {
  const std::size_t width = kernels_.width;
  const std::size_t nodes = space_.nodes_per_element();
  const std::size_t columns = 3 * nodes;
  for (std::size_t lane = 0; lane < batch.elements.size(); ++lane) {
    ElementResult result{nodes_of(batch.elements[lane]), {}, {}};
    if (wanted.residual) {
      for (std::size_t n = 0; n < columns; ++n) element_residual_[n] = residual_[n * width + lane];
      result.residual = element_residual_;
    }
    if (wanted.stiffness) {
      const double* entry = stiffness_.data() + lane;
      for (std::size_t a = 0; a < nodes; ++a) {
        for (std::size_t b = 0; b <= a; ++b) {
          for (std::size_t i = 0; i < 3; ++i) {
            for (std::size_t k = 0; k < 3; ++k, entry += width) {
              element_stiffness_[(3 * a + i) * columns + 3 * b + k] = *entry;
              element_stiffness_[(3 * b + k) * columns + 3 * a + i] = *entry;
            }
          }
        }
      }
      result.stiffness = element_stiffness_;
    }
    receive(result);
  }
}

void ElementGroups::evaluate_points(std::span<const double> displacements, const PointReceiver& receive,
                                    std::span<const double> plenum_pressures_Pa) {
  if (thin_walls_) {
    thin_walls_->evaluate_points(displacements, plenum_pressures_Pa, receive);
    return;
  }
  const std::size_t width = kernels_.width;
  const std::size_t points = ElementShape{space_.degree}.points();
  PackedDoubles F(9 * points * width);
  PackedDoubles stress(9 * points * width);
  PackedDoubles ratio(points * width);
  PackedDoubles pressure(points * width);
  const auto lane_of = [width](const PackedDoubles& packed, std::size_t lane) {
    std::vector<double> values(packed.size() / width);
    for (std::size_t n = 0; n < values.size(); ++n) values[n] = packed[n * width + lane];
    return values;
  };
  for (const Batch& batch : batches_) {
    gather(batch, displacements, displacements_);
    kernels_.evaluate_points(materials_[batch.region],
                             {.positions = batch.positions.data(), .displacements = displacements_.data()},
                             {F.data(), stress.data(), ratio.data(), pressure.data()});
    for (std::size_t lane = 0; lane < batch.elements.size(); ++lane) {
      const auto F_of = lane_of(F, lane);
      const auto stress_of = lane_of(stress, lane);
      const auto ratio_of = lane_of(ratio, lane);
      const auto pressure_of = lane_of(pressure, lane);
      receive({batch.elements[lane], F_of, stress_of, ratio_of, pressure_of});
    }
  }
}

}  // namespace menger::fem
