#include "fem/inflation/observables.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "fem/space/rank_agreement.h"
#include "fem/surfaces/face.h"
#include "io/text/number_text.h"

namespace menger::fem {
namespace {

constexpr double outside_tolerance = 1e-4;  ///< part of the edge of an element, for points on the boundary of a curved body

/// Computes the shape functions of an element, and their derivatives, at a point of the unit cube.
template <std::size_t degree>
struct ShapeAt {
  static constexpr std::size_t side = degree + 1;
  std::array<double, side * side * side> value;
  std::array<Point, side * side * side> derivative;

  explicit ShapeAt(const Point& xi) {
    std::array<std::array<double, side>, 3> N;
    std::array<std::array<double, side>, 3> slope;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      N[axis] = shape_values<degree>(xi[axis]);
      slope[axis] = shape_derivatives<degree>(xi[axis]);
    }
    for (std::size_t a = 0; a < value.size(); ++a) {
      const std::size_t i = a % side;
      const std::size_t j = a / side % side;
      const std::size_t k = a / (side * side);
      value[a] = N[0][i] * N[1][j] * N[2][k];
      derivative[a] = {slope[0][i] * N[1][j] * N[2][k], N[0][i] * slope[1][j] * N[2][k], N[0][i] * N[1][j] * slope[2][k]};
    }
  }
};

/// A point in the coordinates of an element, and its distance outside of it, in edges of the element.
struct LocalPoint {
  Point xi{};
  double outside = std::numeric_limits<double>::max();
};

template <std::size_t degree>
LocalPoint local_point(const Space& space, std::span<const Index> nodes, const Point& position) {
  constexpr int largest_iteration_count = 20;
  constexpr double converged = 1e-12;
  const auto node = [&](std::size_t a) -> const Point& { return space.positions[static_cast<std::size_t>(nodes[a])]; };
  LocalPoint result{{0.5, 0.5, 0.5}, std::numeric_limits<double>::max()};
  for (int iteration = 0; iteration < largest_iteration_count; ++iteration) {
    const ShapeAt<degree> shape(result.xi);
    Eigen::Vector3d residual(position[0], position[1], position[2]);
    Eigen::Matrix3d jacobian = Eigen::Matrix3d::Zero();
    for (std::size_t a = 0; a < shape.value.size(); ++a) {
      const Eigen::Vector3d x(node(a)[0], node(a)[1], node(a)[2]);
      residual -= shape.value[a] * x;
      jacobian += x * Eigen::RowVector3d(shape.derivative[a][0], shape.derivative[a][1], shape.derivative[a][2]);
    }
    const Eigen::Vector3d step = jacobian.inverse() * residual;
    if (!step.allFinite()) return {};
    for (std::size_t i = 0; i < 3; ++i) {
      // the iteration diverges for points far from the element: clamped, they end up outside
      result.xi[i] = std::clamp(result.xi[i] + step[static_cast<Eigen::Index>(i)], -1.0, 2.0);
    }
    if (step.norm() > converged) continue;
    result.outside = 0.0;
    for (const double x : result.xi) result.outside = std::max({result.outside, -x, x - 1.0});
    return result;
  }
  return result;
}

/// Returns whether a point lies in the box of some nodes, made larger by a tenth of its size.
bool is_near(const Space& space, std::span<const Index> nodes, const Point& position) {
  Point low = space.positions[static_cast<std::size_t>(nodes[0])];
  Point high = low;
  for (const Index n : nodes) {
    const Point& x = space.positions[static_cast<std::size_t>(n)];
    for (std::size_t i = 0; i < 3; ++i) {
      low[i] = std::min(low[i], x[i]);
      high[i] = std::max(high[i], x[i]);
    }
  }
  const double margin = 0.1 * norm(difference(high, low));
  for (std::size_t i = 0; i < 3; ++i) {
    if (position[i] < low[i] - margin || position[i] > high[i] + margin) return false;
  }
  return true;
}

/// Returns the element of this rank that contains a point best.
template <std::size_t degree>
LocatedPoint locate_here(const Space& space, const NamedPoint& point, double& outside) {
  LocatedPoint located{point, 0, {}, {}, 0};
  outside = std::numeric_limits<double>::max();
  const std::size_t count = space.nodes_per_element();
  for (std::size_t e = 0; e < space.local_element_count() && outside > 0.0; ++e) {
    const auto nodes = std::span(space.element_nodes).subspan(e * count, count);
    if (!is_near(space, nodes, point.position)) continue;
    LocalPoint local = local_point<degree>(space, nodes, point.position);
    if (local.outside >= outside) continue;
    outside = local.outside;
    for (double& x : local.xi) x = std::clamp(x, 0.0, 1.0);
    const ShapeAt<degree> shape(local.xi);
    located.nodes.assign(nodes.begin(), nodes.end());
    located.weights.assign(shape.value.begin(), shape.value.end());
    located.region = space.element_regions[e];
  }
  return located;
}

}  // namespace

std::vector<LocatedPoint> locate_points(const Space& space, const std::vector<NamedPoint>& points) {
  std::vector<LocatedPoint> located;
  int this_rank = 0;
  MPI_Comm_rank(space.communicator, &this_rank);
  for (const NamedPoint& point : points) {
    struct {
      double outside;
      int rank;
    } best{0.0, this_rank};
    located.push_back(space.degree == 1 ? locate_here<1>(space, point, best.outside)
                                        : locate_here<2>(space, point, best.outside));
    MPI_Allreduce(MPI_IN_PLACE, &best, 1, MPI_DOUBLE_INT, MPI_MINLOC, space.communicator);
    if (best.outside > outside_tolerance) {
      throw AgreedInputError("point \"" + point.name + "\": position_m = [" + io::number_text(point.position[0]) + ", " +
                             io::number_text(point.position[1]) + ", " + io::number_text(point.position[2]) +
                             "] does not lie in the body");
    }
    located.back().rank = best.rank;
    auto region = static_cast<std::uint64_t>(located.back().region);
    MPI_Bcast(&region, 1, MPI_UINT64_T, best.rank, space.communicator);
    located.back().region = region;
    if (best.rank == this_rank) continue;
    located.back().nodes.clear();
    located.back().weights.clear();
  }
  return located;
}

std::vector<PointObservation> observe(const Space& space, const std::vector<LocatedPoint>& points,
                                      std::span<const double> displacements, const NodalFields& fields) {
  std::vector<PointObservation> observations;
  for (const LocatedPoint& point : points) {
    std::array<double, 4> values{};
    std::array<double, 9> F{};
    for (std::size_t a = 0; a < point.nodes.size(); ++a) {
      const auto node = static_cast<std::size_t>(point.nodes[a]);
      for (std::size_t i = 0; i < 3; ++i) values[i] += point.weights[a] * displacements[3 * node + i];
      for (std::size_t c = 0; c < 9; ++c) F[c] += point.weights[a] * fields.deformation_gradient[node][c];
    }
    if (!point.nodes.empty()) values[3] = principal_stretches(F)[0];
    MPI_Bcast(values.data(), static_cast<int>(values.size()), MPI_DOUBLE, point.rank, space.communicator);
    observations.push_back({{values[0], values[1], values[2]}, values[3]});
  }
  return observations;
}

}  // namespace menger::fem
