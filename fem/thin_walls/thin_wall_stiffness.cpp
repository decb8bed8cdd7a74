#include "fem/thin_walls/thin_wall_stiffness.h"

#include <algorithm>
#include <cassert>

namespace menger::fem {

ThinWallStiffness::ThinWallStiffness(ThinWallKernels<double> kernels) : kernels_(kernels) {
  for (std::size_t normal = 0; normal < 3; ++normal) {
    for (std::size_t lane = 0; lane < width(); ++lane) {
      for (std::size_t c = 0; c < 8; ++c)
        first_components_[normal].push_back(static_cast<std::uint32_t>(24 * lane + 3 * global_corner(normal, c)));
    }
    for (std::size_t c = 0; c < 8; ++c) corner_of_global_[normal][global_corner(normal, c)] = c;
  }
  shapes_.resize(shape_numbers_per_lane * width());
  displacements_.resize(24 * width() + 1);  // kernels may read one more
  slots_.resize(slot_numbers_per_lane * width());
  energies_.resize(width());
  ratios_.resize(width());
  steps_m_.resize(width());
  forces_.resize(width());
  stiffness_.resize(576 * width());
}

void ThinWallStiffness::place(const ThinWallBatch& batch, std::span<const double> displacements_m) {
  assert(!batch.edges_m.empty() && batch.edges_m.size() <= width());
  assert(displacements_m.size() == 24 * batch.edges_m.size());
  element_ = batch.element;
  normal_ = static_cast<std::uint8_t>(batch.normal);
  count_ = batch.edges_m.size();
  for (std::size_t lane = 0; lane < width(); ++lane) {
    const std::size_t element = std::min(lane, count_ - 1);
    const std::array<double, 3>& edges = batch.edges_m[element];
    std::array<double, shape_numbers_per_lane> shape =
        shape_of({edges[(batch.normal + 1) % 3], edges[(batch.normal + 2) % 3], edges[batch.normal]});
    if (lane >= count_) shape[3] = 0.0;
    for (std::size_t n = 0; n < shape.size(); ++n) shapes_[n * width() + lane] = shape[n];
    std::copy_n(displacements_m.begin() + static_cast<std::ptrdiff_t>(24 * element), 24,
                displacements_.begin() + static_cast<std::ptrdiff_t>(24 * lane));
    steps_m_[lane] = difference_step * *std::min_element(edges.begin(), edges.end());
  }
}

ThinWallBatches<double> ThinWallStiffness::batches() const {
  return {.element = element_,
          .count = 1,
          .first_components = first_components_[normal_].data(),
          .shapes = shapes_.data(),
          .normals = &normal_};
}

void ThinWallStiffness::compute_energies(const ThinWallMaterial& material) {
  kernels_.energies(material, batches(), {displacements_.data()}, {}, energies_.data(), ratios_.data());
}

void ThinWallStiffness::call_forces(const ThinWallMaterial& material) {
  static_cast<void>(kernels_.forces(material, batches(), {displacements_.data()}, {}, slots_.data()));
}

void ThinWallStiffness::compute_forces(const ThinWallMaterial& material) {
  call_forces(material);
  for (std::size_t element = 0; element < count_; ++element)
    for (std::size_t n = 0; n < 24; ++n) forces_[element][n] = slot(element, n);
}

void ThinWallStiffness::compute_stiffness(const ThinWallMaterial& material) {
  std::vector<double> before(width());
  std::vector<double> span_m(width());
  for (std::size_t column = 0; column < 24; ++column) {
    for (std::size_t lane = 0; lane < width(); ++lane) {
      double& value = displacements_[24 * lane + column];
      before[lane] = value;
      value = before[lane] + steps_m_[lane];
      span_m[lane] = value;
    }
    call_forces(material);
    for (std::size_t element = 0; element < count_; ++element)
      for (std::size_t row = 0; row < 24; ++row) stiffness_[576 * element + 24 * row + column] = slot(element, row);
    for (std::size_t lane = 0; lane < width(); ++lane) {
      double& value = displacements_[24 * lane + column];
      value = before[lane] - steps_m_[lane];
      span_m[lane] -= value;  // what the steps are after rounding
    }
    call_forces(material);
    for (std::size_t element = 0; element < count_; ++element) {
      for (std::size_t row = 0; row < 24; ++row) {
        double& entry = stiffness_[576 * element + 24 * row + column];
        entry = (entry - slot(element, row)) / span_m[element];
      }
    }
    for (std::size_t lane = 0; lane < width(); ++lane) displacements_[24 * lane + column] = before[lane];
  }
  for (std::size_t element = 0; element < count_; ++element) {
    double* K = stiffness_.data() + 576 * element;
    for (std::size_t row = 0; row < 24; ++row) {
      for (std::size_t column = 0; column < row; ++column) {
        const double mean = 0.5 * (K[24 * row + column] + K[24 * column + row]);
        K[24 * row + column] = K[24 * column + row] = mean;
      }
    }
  }
}

}  // namespace menger::fem
