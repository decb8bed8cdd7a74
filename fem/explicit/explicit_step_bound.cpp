#include "fem/explicit/explicit_step_bound.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "fem/elements/element_kernel.h"

namespace menger::fem {
namespace {

/// The arrays of ElementBounds for all batches of a body.
struct AllBounds {
  AlignedNumbers gradients;
  AlignedNumbers bulk_moduli;
  AlignedNumbers deviatoric_squares;
  AlignedNumbers branch_squares;
};

constexpr std::size_t batches_per_block = 16;
constexpr std::size_t nodes_per_block = 256;

/// Calls work(group, first batch, end) for the parts of groups that lie in a range of batches.
template <class Work>
void for_each_part(const BoxMesh& boxes, std::size_t begin, std::size_t end, const Work& work) {
  for (const BoxGroup& group : boxes.groups()) {
    const std::size_t first = std::max(begin, group.first_batch);
    const std::size_t last = std::min(end, group.first_batch + group.batch_count);
    if (first < last) work(group, first, last);
  }
}

AllBounds element_bounds(const ExplicitBody& body, std::span<const double> displacements, std::span<const double> branch,
                         const BlockLoop& loop) {
  const BoxMesh& boxes = body.boxes();
  const std::size_t width = boxes.width();
  const std::size_t lanes = width * boxes.batch_count();
  AllBounds all{AlignedNumbers(24 * lanes), AlignedNumbers(lanes), AlignedNumbers(lanes), AlignedNumbers(lanes)};
  loop.run(boxes.batch_count(), batches_per_block, [&](std::size_t, std::size_t begin, std::size_t end) {
    for_each_part(boxes, begin, end, [&](const BoxGroup& group, std::size_t first, std::size_t last) {
      const std::size_t lane = first * width;
      body.kernels().bounds(body.region(group.region).material, boxes.batches(first, last - first), {displacements.data()},
                            branch.empty() ? nullptr : branch.data() + branch_numbers_per_lane * lane,
                            {all.gradients.data() + 24 * lane, all.bulk_moduli.data() + lane,
                             all.deviatoric_squares.data() + lane, all.branch_squares.data() + lane});
    });
  });
  return all;
}

/// Returns the implicit kernels with the same packs as the kernels of the body.
ElementKernels implicit_kernels(const ExplicitBody& body) {
  for (const ElementKernels& kernels : available_element_kernels())
    if (kernels.instruction_set == body.kernels().instruction_set) return kernels;
  return best_element_kernels();
}

/// Computes the Frobenius norms of K_rest, N/m, of the elements of one batch.
class RestStiffness {
 public:
  explicit RestStiffness(const ExplicitBody& body)
      : body_(body),
        kernels_(implicit_kernels(body)),
        positions_(24 * kernels_.width),
        displacements_(24 * kernels_.width),
        stiffness_(std::size_t{324} * kernels_.width),
        ratios_(kernels_.width) {
    assert(kernels_.width == body.boxes().width());
  }

  /// Computes the norms of one batch.
  /// @param norms one per lane of the body
  void set_norms(const BoxGroup& group, std::size_t batch, std::span<const double> displacements, const AllBounds& bounds,
                 std::span<double> norms) {
    const BoxMesh& boxes = body_.boxes();
    const std::size_t width = boxes.width();
    for (std::size_t lane = 0; lane < width; ++lane) {
      const auto nodes = boxes.first_components(batch * width + lane);
      for (std::size_t n = 0; n < 24; ++n) {
        positions_[n * width + lane] = body_.reference_positions_m()[nodes[n / 3] + n % 3];
        displacements_[n * width + lane] = displacements[nodes[n / 3] + n % 3];
      }
    }
    const ExplicitRegion& region = body_.region(group.region);
    ElementBatch task{positions_.data(), displacements_.data()};
    task.stiffness = stiffness_.data();
    task.smallest_ratio = ratios_.data();
    kernels_.evaluate({1, Formulation::three_field, region.material.law, region.material.volume}, task);
    for (std::size_t lane = 0; lane < width; ++lane) {
      const std::size_t of_body = batch * width + lane;
      if (boxes.volume_m3(of_body) == 0.0) continue;
      const double bulk = bounds.bulk_moduli[of_body] / boxes.volume_m3(of_body);
      norms[of_body] = std::sqrt(norm_square(bounds.gradients.data() + 24 * width * batch + lane, bulk, lane, width));
    }
  }

 private:
  /// Returns |K - bulk g g^T|^2 of one lane.
  [[nodiscard]] double norm_square(const double* gradient, double bulk, std::size_t lane, std::size_t width) const {
    double sum = 0.0;
    for (std::size_t a = 0; a < 8; ++a) {
      for (std::size_t b = 0; b <= a; ++b) {
        double block = 0.0;
        for (std::size_t n = 0; n < 9; ++n) {
          const double entry = stiffness_[(9 * (a * (a + 1) / 2 + b) + n) * width + lane] -
                               bulk * gradient[(3 * a + n / 3) * width] * gradient[(3 * b + n % 3) * width];
          block += entry * entry;
        }
        sum += a == b ? block : 2.0 * block;
      }
    }
    return sum;
  }

  const ExplicitBody& body_;
  ElementKernels kernels_;
  AlignedNumbers positions_;
  AlignedNumbers displacements_;
  AlignedNumbers stiffness_;
  AlignedNumbers ratios_;
};

/// Returns s g_e / sqrt(m) of all elements, where s = sqrt(U'' / V), in the order of the forces.
AlignedNumbers scaled_gradients(const ExplicitBody& body, const AllBounds& bounds, const BlockLoop& loop) {
  const BoxMesh& boxes = body.boxes();
  const std::size_t width = boxes.width();
  AlignedNumbers result(bounds.gradients.size(), 0.0);
  loop.run(body.node_count(), nodes_per_block, [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t node = begin; node < end; ++node) {
      for (const std::uint32_t slot : boxes.slots().of(node)) {
        const std::size_t lane = slot / (24 * width) * width + slot % width;
        const double s = std::sqrt(std::max(bounds.bulk_moduli[lane], 0.0) / boxes.volume_m3(lane));
        for (std::size_t i = 0; i < 3; ++i)
          result[slot + i * width] =
              s * bounds.gradients[slot + i * width] * std::sqrt(body.inverse_masses_per_kg()[3 * node + i]);
      }
    }
  });
  return result;
}

/// Returns (B w)_e for all lanes. Absolute values are taken at every node, not of the sum over the nodes that two elements share.
/// For boxes at rest this is the same, and it is never smaller.
std::vector<double> bulk_product(const BoxMesh& boxes, const AlignedNumbers& gradients, const std::vector<double>& weights,
                                 const BlockLoop& loop) {
  const std::size_t width = boxes.width();
  std::vector<double> result(weights.size(), 0.0);
  loop.run(boxes.batch_count(), batches_per_block, [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t lane = begin * width; lane < end * width; ++lane) {
      if (boxes.volume_m3(lane) == 0.0) continue;
      for (std::size_t corner = 0; corner < 8; ++corner) {
        const double* own = gradients.data() + (24 * (lane / width) + 3 * corner) * width + lane % width;
        for (const std::uint32_t slot : boxes.slots().of(boxes.first_components(lane)[corner] / 3)) {
          const double* other = gradients.data() + slot;
          const double product = own[0] * other[0] + own[width] * other[width] + own[2 * width] * other[2 * width];
          result[lane] += std::abs(product) * weights[slot / (24 * width) * width + slot % width];
        }
      }
    }
  });
  return result;
}

double bulk_bound(const ExplicitBody& body, const AllBounds& bounds, const BlockLoop& loop) {
  constexpr int iterations = 4;
  const AlignedNumbers gradients = scaled_gradients(body, bounds, loop);
  std::vector<double> weights(bounds.bulk_moduli.size(), 1.0);
  double bound = 0.0;
  for (int iteration = 0; iteration < iterations; ++iteration) {
    const std::vector<double> product = bulk_product(body.boxes(), gradients, weights, loop);
    double largest = 0.0;
    for (std::size_t lane = 0; lane < product.size(); ++lane) largest = std::max(largest, product[lane] / weights[lane]);
    if (largest == 0.0) return 0.0;
    bound = iteration == 0 ? largest : std::min(bound, largest);
    // Half of the old weights keeps all weights positive, also those of lanes without an element.
    for (std::size_t lane = 0; lane < product.size(); ++lane) weights[lane] = 0.5 * (weights[lane] + product[lane] / largest);
  }
  return bound;
}

/// The contribution of each element's matrices to each of its nodes: one number per lane.
struct NodeShares {
  std::vector<double> stiffness_N_per_m;
  std::vector<double> damping_kg_per_s;
};

NodeShares node_shares(const ExplicitBody& body, std::span<const double> displacements, const AllBounds& elements,
                       const BlockLoop& loop) {
  const BoxMesh& boxes = body.boxes();
  NodeShares shares{std::vector<double>(elements.bulk_moduli.size(), 0.0), std::vector<double>(elements.bulk_moduli.size(), 0.0)};
  loop.run(boxes.batch_count(), batches_per_block, [&](std::size_t, std::size_t begin, std::size_t end) {
    RestStiffness rest(body);
    for_each_part(boxes, begin, end, [&](const BoxGroup& group, std::size_t first, std::size_t last) {
      const ExplicitMaterial& material = body.region(group.region).material;
      for (std::size_t batch = first; batch < last; ++batch)
        rest.set_norms(group, batch, displacements, elements, shares.stiffness_N_per_m);
      for (std::size_t lane = first * boxes.width(); lane < last * boxes.width(); ++lane) {
        const double edge = boxes.shortest_edge_m(lane);
        const auto share = [&](double modulus, double square) {
          return modulus * square * boxes.volume_m3(lane) / (edge * edge);
        };
        shares.damping_kg_per_s[lane] = share(material.viscosity_Pa_s, elements.deviatoric_squares[lane]);
        shares.stiffness_N_per_m[lane] += share(material.branch.shear_modulus_Pa, elements.branch_squares[lane]);
      }
    });
  });
  return shares;
}

/// Returns the parts of the bounds that come from single elements: the largest sum of shares at a node over its mass.
EigenvalueBounds bounds_of_elements(const ExplicitBody& body, std::span<const double> displacements, const AllBounds& elements,
                                    const BlockLoop& loop) {
  const BoxMesh& boxes = body.boxes();
  const std::size_t width = boxes.width();
  const NodeShares shares = node_shares(body, displacements, elements, loop);
  std::vector<EigenvalueBounds> parts(BlockLoop::block_count(body.node_count(), nodes_per_block));
  loop.run(body.node_count(), nodes_per_block, [&](std::size_t block, std::size_t begin, std::size_t end) {
    for (std::size_t node = begin; node < end; ++node) {
      EigenvalueBounds at_node;
      for (const std::uint32_t slot : boxes.slots().of(node)) {
        const std::size_t lane = slot / (24 * width) * width + slot % width;
        at_node.stiffness_per_s2 += shares.stiffness_N_per_m[lane] / body.masses_kg()[node];
        at_node.damping_per_s += shares.damping_kg_per_s[lane] / body.masses_kg()[node];
      }
      parts[block].stiffness_per_s2 = std::max(parts[block].stiffness_per_s2, at_node.stiffness_per_s2);
      parts[block].damping_per_s = std::max(parts[block].damping_per_s, at_node.damping_per_s);
    }
  });
  EigenvalueBounds largest;
  for (const EigenvalueBounds& part : parts) {
    largest.stiffness_per_s2 = std::max(largest.stiffness_per_s2, part.stiffness_per_s2);
    largest.damping_per_s = std::max(largest.damping_per_s, part.damping_per_s);
  }
  return largest;
}

}  // namespace

EigenvalueBounds eigenvalue_bounds(const ExplicitBody& body, std::span<const double> displacements_m,
                                   std::span<const double> branch, const BlockLoop& loop) {
  const AllBounds elements = element_bounds(body, displacements_m, branch, loop);
  EigenvalueBounds result = bounds_of_elements(body, displacements_m, elements, loop);
  result.stiffness_per_s2 += bulk_bound(body, elements, loop);
  return result;
}

double stable_step_s(const EigenvalueBounds& bounds) {
  const double half = 0.5 * bounds.damping_per_s;
  return 2.0 / (half + std::sqrt(half * half + bounds.stiffness_per_s2));
}

}  // namespace menger::fem
