#include "fem/statics/supports.h"

#include <Eigen/Dense>
#include <algorithm>
#include <limits>
#include <numeric>

#include "fem/statics/grips.h"

namespace menger::fem {

std::vector<std::uint8_t> held_components(const Space& space, const Body& body, const NodeExchange& exchange) {
  std::vector<double> marks(3 * space.positions.size(), 0.0);
  const auto mark = [&](Index node, const std::array<bool, 3>& held) {
    for (std::size_t i = 0; i < 3; ++i)
      if (held[i]) marks[3 * static_cast<std::size_t>(node) + i] = 1.0;
  };
  for (const SpaceFace& face : space.faces) {
    for (const Support& support : body.supports) {
      if (support.label != face.label) continue;
      for (std::size_t n = 0; n < space.nodes_per_face(); ++n) mark(face.nodes[n], support.held);
    }
    for (const Plate& plate : body.plates) {
      if (!contains(plate.faces, space, face)) continue;
      for (std::size_t n = 0; n < space.nodes_per_face(); ++n) mark(face.nodes[n], plate.held);
    }
  }
  for (const PointSupport& support : body.point_supports) {
    const NearestNode node = nearest_node(space, support.position);
    if (node.local >= 0) mark(node.local, support.held);
  }
  // A node may lie on a supported face of another rank's element.
  exchange.add_from_ghosts(marks);
  exchange.update_ghosts(marks);
  std::vector<std::uint8_t> held(marks.size());
  for (std::size_t n = 0; n < marks.size(); ++n) held[n] = marks[n] > 0.0 ? 1 : 0;
  return held;
}

bool is_held(const Space& space, const Body& body, std::span<const std::uint8_t> held) {
  std::vector<std::uint8_t> all(held.begin(), held.end());
  for (const SpaceFace& face : space.faces) {
    if (!body.ground || std::find(body.ground_labels.begin(), body.ground_labels.end(), face.label) == body.ground_labels.end())
      continue;
    for (std::size_t n = 0; n < space.nodes_per_face(); ++n) all[3 * static_cast<std::size_t>(face.nodes[n]) + 2] = 1;
  }
  // Lengths are relative to the extent, so that translations and rotations have equal weight.
  Point origin = space.positions.empty() ? Point{} : space.positions.front();
  MPI_Bcast(origin.data(), 3, MPI_DOUBLE, 0, space.communicator);
  double extent = 0.0;
  for (const Point& x : space.positions) extent = std::max(extent, norm(difference(x, origin)));
  MPI_Allreduce(MPI_IN_PLACE, &extent, 1, MPI_DOUBLE, MPI_MAX, space.communicator);

  // The components of the rigid motions at the held components. The sum of the squares of these rows has full rank if no rigid
  // motion is left free.
  Eigen::Matrix<double, 6, 6> squares = Eigen::Matrix<double, 6, 6>::Zero();
  for (std::size_t n = 0; n < all.size(); ++n) {
    if (all[n] == 0) continue;
    Point axis{};
    axis[n % 3] = 1.0;
    const Point lever = cross(scaled(1.0 / extent, difference(space.positions[n / 3], origin)), axis);
    const Eigen::Vector<double, 6> row{axis[0], axis[1], axis[2], lever[0], lever[1], lever[2]};
    squares += row * row.transpose();
  }
  MPI_Allreduce(MPI_IN_PLACE, squares.data(), 36, MPI_DOUBLE, MPI_SUM, space.communicator);
  const Eigen::Vector<double, 6> parts = Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>>(squares).eigenvalues();
  return parts[0] > 1e-10 * parts[5];
}

NearestNode nearest_node(const Space& space, const Point& point) {
  const auto position = [&](Index node) -> const Point& { return space.positions[static_cast<std::size_t>(node)]; };
  std::vector<Index> nodes(static_cast<std::size_t>(space.owned_count));
  std::iota(nodes.begin(), nodes.end(), Index{0});
  const auto least = [&](const auto& value) {
    double result = std::numeric_limits<double>::max();
    for (const Index node : nodes) result = std::min(result, value(node));
    MPI_Allreduce(MPI_IN_PLACE, &result, 1, MPI_DOUBLE, MPI_MIN, space.communicator);
    return result;
  };
  const auto distance = [&](Index node) { return norm(difference(position(node), point)); };
  const double least_distance = least(distance);
  // Rounding of positions may differ with the partition. It must not decide between nodes that are equally near.
  const double grain = 1e-9 * least_distance;
  std::erase_if(nodes, [&](Index node) { return distance(node) > least_distance + grain; });
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double lowest = least([&](Index node) { return position(node)[axis]; });
    std::erase_if(nodes, [&](Index node) { return position(node)[axis] > lowest + grain; });
  }
  int this_rank = 0;
  int rank_count = 0;
  MPI_Comm_rank(space.communicator, &this_rank);
  MPI_Comm_size(space.communicator, &rank_count);
  int rank = nodes.empty() ? rank_count : this_rank;
  MPI_Allreduce(MPI_IN_PLACE, &rank, 1, MPI_INT, MPI_MIN, space.communicator);
  NearestNode result{rank, rank == this_rank ? nodes.front() : -1, {}};
  if (result.local >= 0) result.position = position(result.local);
  MPI_Bcast(result.position.data(), 3, MPI_DOUBLE, result.rank, space.communicator);
  return result;
}

}  // namespace menger::fem
