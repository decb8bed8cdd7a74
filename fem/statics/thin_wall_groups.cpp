#include "fem/statics/thin_wall_groups.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>
#include <tuple>

#include "fem/thin_walls/wall_volume.h"

namespace menger::fem {
namespace {

std::span<const Index> nodes_of(const Space& space, std::size_t element) {
  return std::span(space.element_nodes).subspan(8 * element, 8);
}

double bulk_modulus_Pa_of(const VolumetricLaw& law) {
  return std::visit([](const auto& any) { return any.bulk_modulus_Pa; }, law);
}

/// Three by three numbers, row by row.
using Tensor9 = std::array<double, 9>;

Tensor9 tensor_of(const std::array<GradientColumn, 3>& columns) {
  Tensor9 F{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) F[3 * i + j] = columns[j][i];
  return F;
}

double determinant(const Tensor9& F) {
  return F[0] * (F[4] * F[8] - F[5] * F[7]) - F[1] * (F[3] * F[8] - F[5] * F[6]) + F[2] * (F[3] * F[7] - F[4] * F[6]);
}

/// The place of a corner from the middle of a box.
std::array<double, 3> arm(const std::array<double, 3>& edges_m, std::size_t corner) {
  std::array<double, 3> X{};
  for (std::size_t axis = 0; axis < 3; ++axis) X[axis] = (corner >> axis & 1U) != 0U ? 0.5 * edges_m[axis] : -0.5 * edges_m[axis];
  return X;
}

/// The displacements of the corners under a gradient that is the same everywhere.
BoxNumbers uniform(const std::array<double, 3>& edges_m, const Tensor9& F) {
  BoxNumbers u{};
  for (std::size_t corner = 0; corner < 8; ++corner) {
    const std::array<double, 3> X = arm(edges_m, corner);
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) u[3 * corner + i] += (F[3 * i + j] - (i == j ? 1.0 : 0.0)) * X[j];
    }
  }
  return u;
}

/// sigma = P F^T / J with P = sum f X^T / V, from the forces of an element under a uniform F.
Tensor9 cauchy_stress(const std::array<double, 3>& edges_m, const Tensor9& F, const BoxNumbers& forces_N) {
  Tensor9 P{};
  for (std::size_t corner = 0; corner < 8; ++corner) {
    const std::array<double, 3> X = arm(edges_m, corner);
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) P[3 * i + j] += forces_N[3 * corner + i] * X[j];
  }
  const double factor = 1.0 / (edges_m[0] * edges_m[1] * edges_m[2] * determinant(F));
  Tensor9 stress{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      for (std::size_t k = 0; k < 3; ++k) stress[3 * i + j] += factor * P[3 * i + k] * F[3 * j + k];
    }
  }
  return stress;
}

/// The gradients of an element at the upper (1) or lower (0) points across its normal; the same for a block.
Tensor9 point_gradient(const ThinWallBatch& shape, std::size_t n, const BoxNumbers& u, std::size_t side) {
  const std::array<double, 3>& edges = shape.edges_m[n];
  std::array<GradientColumn, 3> f = centre_gradient(edges, u);
  if (shape.element == ThinWallElement::block) return tensor_of(f);
  const double zeta = (side == 0 ? -1.0 : 1.0) / std::sqrt(3.0);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (axis == shape.normal) continue;
    for (std::size_t corner = 0; corner < 8; ++corner) {
      const bool is_even = (corner >> axis & 1U) == (corner >> shape.normal & 1U);
      for (std::size_t i = 0; i < 3; ++i) f[axis][i] += zeta * (is_even ? 0.25 : -0.25) / edges[axis] * u[3 * corner + i];
    }
  }
  return tensor_of(f);
}

}  // namespace

std::array<double, 3> box_edges_m(const Space& space, std::size_t element) {
  const auto nodes = nodes_of(space, element);
  const Point& low = space.positions[static_cast<std::size_t>(nodes[0])];
  const Point& high = space.positions[static_cast<std::size_t>(nodes[7])];
  return difference(high, low);
}

BoxNumbers corner_displacements(const Space& space, std::size_t element, std::span<const double> displacements_m) {
  BoxNumbers u{};
  const auto nodes = nodes_of(space, element);
  for (std::size_t corner = 0; corner < 8; ++corner)
    std::copy_n(displacements_m.begin() + 3 * static_cast<std::ptrdiff_t>(nodes[corner]), 3,
                u.begin() + static_cast<std::ptrdiff_t>(3 * corner));
  return u;
}

ThinWallGroups::ThinWallGroups(const Space& space, const Body& body) : space_(space), body_(body) {
  assert(space.degree == 1 && body.thin_walls);
  const ThinWallConstants& constants = body.thin_walls->constants;
  for (const RegionMaterial& region : body.regions) {
    materials_.push_back({.law = region.law,
                          .bulk_modulus_Pa = bulk_modulus_Pa_of(region.volume),
                          .wall_penalty_ratio = constants.wall_penalty_ratio,
                          .block_stiffness_ratio = constants.block_stiffness_ratio});
  }
  using Key = std::tuple<std::size_t, ThinWallElement, std::size_t>;  // region, kind, normal
  std::map<Key, std::vector<std::size_t>> sets;
  for (std::size_t e = 0; e < space.local_element_count(); ++e) {
    const ThinWallPlace& place = body.thin_walls->places[space.mesh_elements[e]];
    sets[{space.element_regions[e], place.element, place.normal}].push_back(e);
  }
  for (const auto& [key, elements] : sets) {
    const auto& [region, kind, normal] = key;
    for (std::size_t first = 0; first < elements.size(); first += kernel_.width()) {
      Batch batch{region, {kind, normal, {}}, {}};
      for (std::size_t n = first; n < std::min(first + kernel_.width(), elements.size()); ++n) {
        batch.elements.push_back(elements[n]);
        batch.shape.edges_m.push_back(box_edges_m(space, elements[n]));
      }
      batches_.push_back(std::move(batch));
    }
  }
}

void ThinWallGroups::place(const Batch& batch, std::span<const double> displacements_m) {
  corners_m_.clear();
  for (const std::size_t element : batch.elements) {
    const BoxNumbers u = corner_displacements(space_, element, displacements_m);
    corners_m_.insert(corners_m_.end(), u.begin(), u.end());
  }
  kernel_.place(batch.shape, corners_m_);
}

ElementSums ThinWallGroups::evaluate(std::span<const double> displacements_m, const ElementWanted& wanted,
                                     const ElementReceiver& receive) {
  ElementSums sums;
  for (const Batch& batch : batches_) {
    place(batch, displacements_m);
    const ThinWallMaterial& material = materials_[batch.region];
    kernel_.compute_energies(material);
    if (wanted.residual) kernel_.compute_forces(material);
    if (wanted.stiffness) kernel_.compute_stiffness(material);
    for (std::size_t n = 0; n < batch.elements.size(); ++n) {
      sums.energy_J += kernel_.energy_J(n);
      // The comparison is written so that a NaN counts, too.
      const double ratio =
          kernel_.smallest_ratio(n) >= ThinWallOutcome::smallest_allowed_ratio ? kernel_.smallest_ratio(n) : -1.0;
      sums.smallest_ratio = std::min(sums.smallest_ratio, ratio);
      if (!wanted.residual && !wanted.stiffness) continue;
      ElementResult result{nodes_of(space_, batch.elements[n]), {}, {}};
      if (wanted.residual) result.residual = kernel_.forces_N(n);
      if (wanted.stiffness) result.stiffness = kernel_.stiffness(n);
      receive(result);
    }
  }
  return sums;
}

void ThinWallGroups::evaluate_points(std::span<const double> displacements_m, std::span<const double> plenum_pressures_Pa,
                                     const PointReceiver& receive) {
  for (const Batch& batch : batches_) {
    const std::size_t count = batch.elements.size();
    std::array<std::vector<Tensor9>, 2> gradients;
    std::array<std::vector<Tensor9>, 2> stresses;
    for (std::size_t side = 0; side < 2; ++side) {
      corners_m_.clear();
      for (std::size_t n = 0; n < count; ++n) {
        const BoxNumbers u = corner_displacements(space_, batch.elements[n], displacements_m);
        gradients[side].push_back(point_gradient(batch.shape, n, u, side));
        const BoxNumbers same = uniform(batch.shape.edges_m[n], gradients[side].back());
        corners_m_.insert(corners_m_.end(), same.begin(), same.end());
      }
      kernel_.place(batch.shape, corners_m_);
      kernel_.compute_forces(materials_[batch.region]);
      for (std::size_t n = 0; n < count; ++n) {
        stresses[side].push_back(cauchy_stress(batch.shape.edges_m[n], gradients[side][n], kernel_.forces_N(n)));
        double pressure_Pa = 0.0;
        for (const int plenum : body_.thin_walls->places[space_.mesh_elements[batch.elements[n]]].plena)
          if (plenum >= 0 && !plenum_pressures_Pa.empty())
            pressure_Pa += 0.5 * plenum_pressures_Pa[static_cast<std::size_t>(plenum)];
        for (std::size_t i = 0; i < 3; ++i) stresses[side].back()[4 * i] -= pressure_Pa;
      }
    }
    for (std::size_t n = 0; n < count; ++n) {
      std::vector<double> F;
      std::vector<double> stress;
      std::vector<double> ratio;
      std::vector<double> pressure;
      for (std::size_t point = 0; point < 8; ++point) {
        const std::size_t side = point >> batch.shape.normal & 1U;
        const Tensor9& sigma = stresses[side][n];
        F.insert(F.end(), gradients[side][n].begin(), gradients[side][n].end());
        stress.insert(stress.end(), sigma.begin(), sigma.end());
        ratio.push_back(determinant(gradients[side][n]));
        pressure.push_back(-(sigma[0] + sigma[4] + sigma[8]) / 3.0);
      }
      receive({batch.elements[n], F, stress, ratio, pressure});
    }
  }
}

}  // namespace menger::fem
