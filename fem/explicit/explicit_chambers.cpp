#include "fem/explicit/explicit_chambers.h"

#include <algorithm>

#include "fem/surfaces/point.h"

namespace menger::fem {
namespace {

Point point_at(std::span<const double> positions, std::size_t first) {
  return {positions[first], positions[first + 1], positions[first + 2]};
}

/// Returns int N_a x_u x x_v du dv over the bilinear face, for corners in cyclic order. With edges e along u (at v = 0 and 1) and
/// along v, the integrand is (e_u0 (1 - v) + e_u1 v) x (e_v0 (1 - u) + e_v1 u), and N_a is a product of 1 - u or u and 1 - v or
/// v.
inline std::array<Point, 4> area_vectors(const std::array<Point, 4>& x) {
  const Point u0 = difference(x[1], x[0]);
  const Point u1 = difference(x[2], x[3]);
  const Point v0 = difference(x[3], x[0]);
  const Point v1 = difference(x[2], x[1]);
  const Point u_low = sum(scaled(2.0, u0), u1);
  const Point u_high = sum(u0, scaled(2.0, u1));
  const Point v_low = scaled(1.0 / 36.0, sum(scaled(2.0, v0), v1));
  const Point v_high = scaled(1.0 / 36.0, sum(v0, scaled(2.0, v1)));
  return {cross(u_low, v_low), cross(u_low, v_high), cross(u_high, v_high), cross(u_high, v_low)};
}

std::vector<Point> rim_points(std::span<const double> positions, const std::vector<std::uint32_t>& nodes) {
  std::vector<Point> points;
  points.reserve(nodes.size());
  for (const std::uint32_t node : nodes) points.push_back(point_at(positions, 3 * std::size_t{node}));
  return points;
}

}  // namespace

ExplicitChambers::ExplicitChambers(const meshes::HexahedralMesh& mesh, const FacePressureKernels<double>& kernels)
    : plenum_count_(mesh.plenum_names.size()), batches_(mesh, FaceValues::positions, kernels) {
  for (std::size_t chamber = 0; chamber < mesh.chambers.size(); ++chamber) {
    plenums_.push_back(mesh.chambers[chamber].plenum);
    add_faces(mesh, chamber);
  }
  std::vector<std::uint32_t> nodes;
  std::vector<std::uint32_t> slots;
  batches_.add_slots(0, nodes, slots);
  number_count_ = batches_.number_count();
  for (std::size_t chamber = 0; chamber < mesh.chambers.size(); ++chamber) {
    for (const meshes::Cap& cap : mesh.chambers[chamber].caps) {
      const auto first_slot = static_cast<std::uint32_t>(number_count_ / 4);
      add_cap(cap, chamber);
      nodes.insert(nodes.end(), caps_.back().nodes.begin(), caps_.back().nodes.end());
      for (std::size_t n = 0; n < caps_.back().nodes.size(); ++n) slots.push_back(first_slot + static_cast<std::uint32_t>(n));
    }
  }
  slots_.emplace(nodes, slots, mesh.points.size(), static_cast<std::uint32_t>(number_count_ / 4));
  number_count_ += 4;
}

void ExplicitChambers::add_faces(const meshes::HexahedralMesh& mesh, std::size_t chamber) {
  for (const meshes::BoundaryFace& boundary : faces_of_chamber(mesh, chamber)) {
    Face face{{}, static_cast<std::uint32_t>(chamber)};
    for (std::size_t a = 0; a < 4; ++a) face.first_components[a] = static_cast<std::uint32_t>(3 * boundary.corners[a]);
    faces_.push_back(face);
  }
}

void ExplicitChambers::add_cap(const meshes::Cap& cap, std::size_t chamber) {
  RimOfCap rim{{}, {}, chamber, number_count_};
  const auto index_of = [&](std::size_t node) {
    const auto found = std::find(rim.nodes.begin(), rim.nodes.end(), static_cast<std::uint32_t>(node));
    if (found == rim.nodes.end()) {
      rim.nodes.push_back(static_cast<std::uint32_t>(node));
      return rim.nodes.size() - 1;
    }
    return static_cast<std::size_t>(found - rim.nodes.begin());
  };
  for (const auto& [first, last] : cap.rim) {
    const std::size_t begin = index_of(first);
    rim.rim.segments.push_back({begin, index_of(last)});
  }
  number_count_ += 4 * rim.nodes.size();
  caps_.push_back(std::move(rim));
}

void ExplicitChambers::set_face_forces(std::span<const double> positions_m, std::span<const double> pressures_Pa,
                                       IndexRange batches, std::span<double> slots_N, std::span<double> volumes_m3) const {
  std::vector<double> by_chamber;
  for (const std::size_t plenum : plenums_) by_chamber.push_back(pressures_Pa[plenum]);
  batches_.compute(batches, positions_m.data(), by_chamber, slots_N.data(), volumes_m3.empty() ? nullptr : volumes_m3.data());
}

void ExplicitChambers::set_cap_forces(std::span<const double> positions_m, std::span<const double> pressures_Pa,
                                      std::span<double> slots_N) const {
  for (const RimOfCap& cap : caps_) {
    const double pressure = pressures_Pa[plenums_[cap.chamber]];
    const std::vector<Point> points = rim_points(positions_m, cap.nodes);
    std::vector<double> gradient = cap_volume_gradient<2>(cap.rim, points);
    // The faces contribute 1/3 int x . n dA to the volume. Its gradient is int N n dA, which the faces' forces are, plus terms of
    // the rim, 1/3 int (x x dx) along it: half of first x last for each end of a segment.
    for (const auto& [first, last] : cap.rim.segments) {
      const Point term = scaled(1.0 / 6.0, cross(points[first], points[last]));
      for (std::size_t i = 0; i < 3; ++i) {
        gradient[3 * first + i] += term[i];
        gradient[3 * last + i] += term[i];
      }
    }
    for (std::size_t n = 0; n < gradient.size(); ++n) slots_N[cap.first_number + n / 3 * 4 + n % 3] = pressure * gradient[n];
  }
}

std::vector<double> ExplicitChambers::plenum_volumes_m3(std::span<const double> positions_m,
                                                        std::span<const double> volumes_m3) const {
  std::vector<double> volumes(plenum_count_, 0.0);
  for (std::size_t batch = 0; batch < volumes_m3.size(); ++batch) volumes[plenums_[batches_.chamber(batch)]] += volumes_m3[batch];
  for (const RimOfCap& cap : caps_) volumes[plenums_[cap.chamber]] += cap_volume<2>(cap.rim, rim_points(positions_m, cap.nodes));
  return volumes;
}

std::vector<double> ExplicitChambers::plenum_sums(const std::vector<double>& of_chambers) const {
  std::vector<double> sums(plenum_count_, 0.0);
  for (std::size_t c = 0; c < of_chambers.size(); ++c) sums[plenums_[c]] += of_chambers[c];
  return sums;
}

std::vector<double> ExplicitChambers::volumes_m3(std::span<const double> positions_m) const {
  std::vector<double> volumes(plenums_.size(), 0.0);
  for (const Face& face : faces_) {
    std::array<Point, 4> x;
    for (std::size_t a = 0; a < 4; ++a) x[a] = point_at(positions_m, face.first_components[a]);
    const std::array<Point, 4> areas = area_vectors(x);
    for (std::size_t a = 0; a < 4; ++a) volumes[face.chamber] -= dot(x[a], areas[a]) / 3.0;
  }
  for (const RimOfCap& cap : caps_) volumes[cap.chamber] += cap_volume<2>(cap.rim, rim_points(positions_m, cap.nodes));
  return volumes;
}

}  // namespace menger::fem
