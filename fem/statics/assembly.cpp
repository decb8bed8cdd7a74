#include "fem/statics/assembly.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include "fem/statics/dead_load.h"
#include "fem/statics/supports.h"
#include "fem/surfaces/cap_volume.h"
#include "fem/surfaces/chamber_volume.h"

namespace menger::fem {

namespace {

std::size_t offset(Index node) { return 3 * static_cast<std::size_t>(node); }

Point current_position(const Space& space, std::span<const double> u, Index node) {
  const Point& X = space.positions[static_cast<std::size_t>(node)];
  return {X[0] + u[offset(node)], X[1] + u[offset(node) + 1], X[2] + u[offset(node) + 2]};
}

void add_nodal(std::span<double> field, std::span<const Index> nodes, std::span<const double> values, double factor) {
  for (std::size_t a = 0; a < nodes.size(); ++a)
    for (std::size_t i = 0; i < 3; ++i) field[offset(nodes[a]) + i] += factor * values[3 * a + i];
}

}  // namespace

Assembly::Assembly(const Space& space, const Body& body)
    : space_(space),
      body_(body),
      elements_(space, body),
      walls_(space, body),
      exchange_(space),
      held_(held_components(space, body, exchange_)),
      dead_load_(dead_load_of(space, body)) {
  const auto enter = [](auto& table, std::size_t label) -> decltype(auto) {
    if (table.size() <= label) table.resize(label + 1);
    return table[label];
  };
  for (const Plate& plate : body.plates) plate_nodes_.push_back(owned_nodes_of(plate.faces, space, exchange_));
  for (std::size_t c = 0; c < body.chambers.size(); ++c)
    for (const std::size_t label : body.chambers[c].labels) enter(chambers_of_label_, label).push_back(c);
  if (body.ground) {
    for (const std::size_t label : body.ground_labels) {
      if (is_ground_label_.size() <= label) is_ground_label_.resize(label + 1, false);
      is_ground_label_[label] = true;
    }
  }
}

MatrixHandle Assembly::make_matrix(bool symmetric_storage) const {
  const PetscInt rows = 3 * space_.owned_count;
  const auto prepare = [&](Mat matrix) {
    petsc(MatSetSizes(matrix, rows, rows, PETSC_DETERMINE, PETSC_DETERMINE));
    petsc(MatSetBlockSize(matrix, 3));
  };
  MatrixHandle pattern;
  petsc(MatCreate(space_.communicator, pattern.receive()));
  petsc(MatSetType(pattern, MATPREALLOCATOR));
  prepare(pattern);
  petsc(MatSetUp(pattern));
  const std::size_t nodes = space_.nodes_per_element();
  std::vector<double> nothing(9 * nodes * nodes, 0.0);
  for (std::size_t e = 0; e < space_.local_element_count(); ++e)
    add_to_matrix(pattern, std::span(space_.element_nodes).subspan(e * nodes, nodes), nothing);
  for (const SpaceCap& cap : space_.caps) {
    const std::vector<Index> rim = rim_nodes(cap);
    std::vector<double> block(9 * rim.size() * rim.size(), 0.0);
    add_to_matrix(pattern, rim, block);
  }
  petsc(MatAssemblyBegin(pattern, MAT_FINAL_ASSEMBLY));
  petsc(MatAssemblyEnd(pattern, MAT_FINAL_ASSEMBLY));

  MatrixHandle matrix;
  petsc(MatCreate(space_.communicator, matrix.receive()));
  petsc(MatSetType(matrix, symmetric_storage ? MATSBAIJ : MATAIJ));
  prepare(matrix);
  petsc(MatPreallocatorPreallocate(pattern, PETSC_TRUE, matrix));
  if (symmetric_storage) petsc(MatSetOption(matrix, MAT_IGNORE_LOWER_TRIANGULAR, PETSC_TRUE));
  petsc(MatSetOption(matrix, MAT_SYMMETRIC, PETSC_TRUE));
  petsc(MatSetOption(matrix, MAT_SYMMETRY_ETERNAL, PETSC_TRUE));
  return matrix;
}

/// Adds the columns of held components, which the matrix leaves out, times the change of these components to its forces.
void Assembly::add_held_change(std::span<const Index> nodes, std::span<const double> block, const HeldChange& held_change) const {
  const std::size_t columns = 3 * nodes.size();
  for (std::size_t m = 0; m < columns; ++m) {
    const double change_m = held_change.change_m[offset(nodes[m / 3]) + m % 3];
    if (change_m == 0.0) continue;
    for (std::size_t row = 0; row < columns; ++row)
      held_change.force_N[offset(nodes[row / 3]) + row % 3] += change_m * block[row * columns + m];
  }
}

void Assembly::add_to_matrix(Mat stiffness, std::span<const Index> nodes, std::span<double> block,
                             const HeldChange* held_change) const {
  const std::size_t columns = 3 * nodes.size();
  if (held_change != nullptr) add_held_change(nodes, block, *held_change);
  std::vector<PetscInt> global(nodes.size());
  for (std::size_t a = 0; a < nodes.size(); ++a) {
    global[a] = space_.global_node(nodes[a]);
    for (std::size_t i = 0; i < 3; ++i) {
      if (held_[offset(nodes[a]) + i] == 0) continue;
      for (std::size_t m = 0; m < columns; ++m) block[(3 * a + i) * columns + m] = block[m * columns + 3 * a + i] = 0.0;
    }
  }
  const auto count = static_cast<PetscInt>(nodes.size());
  petsc(MatSetValuesBlocked(stiffness, count, global.data(), count, global.data(), block.data(), ADD_VALUES));
}

void Assembly::hold_diagonal(Mat stiffness) const {
  for (Index node = 0; node < space_.owned_count; ++node) {
    std::array<double, 9> block{};
    bool any = false;
    for (std::size_t i = 0; i < 3; ++i) {
      if (held_[offset(node) + i] == 0) continue;
      block[4 * i] = 1.0;
      any = true;
    }
    if (!any) continue;
    const PetscInt global = space_.first_owned + node;
    petsc(MatSetValuesBlocked(stiffness, 1, &global, 1, &global, block.data(), ADD_VALUES));
  }
}

BodyTotals Assembly::assemble(std::span<const double> displacements, const Loads& loads, std::span<double> residual,
                              std::span<std::vector<double>> volume_gradients, Mat stiffness, const HeldChange* held_change) {
  if (stiffness != nullptr) petsc(MatZeroEntries(stiffness));
  std::fill(residual.begin(), residual.end(), 0.0);
  for (auto& gradient : volume_gradients) gradient.assign(held_.size(), 0.0);

  BodyTotals totals;
  totals.chamber_volumes_m3.assign(body_.chambers.size(), 0.0);
  totals.work_volumes_m3.assign(body_.plenum_count, 0.0);
  std::vector<double> block;
  const ElementSums sums = elements_.evaluate(displacements, {!residual.empty(), stiffness != nullptr},
                                              [&](const ElementGroups::ElementResult& element) {
                                                if (!residual.empty()) add_nodal(residual, element.nodes, element.residual, 1.0);
                                                if (stiffness == nullptr) return;
                                                block.assign(element.stiffness.begin(), element.stiffness.end());
                                                add_to_matrix(stiffness, element.nodes, block, held_change);
                                              });
  totals.strain_energy_J = sums.energy_J;
  totals.smallest_ratio = sums.smallest_ratio;
  if (space_.degree == 1) {
    add_faces<4>(displacements, loads, residual, volume_gradients, stiffness, held_change, totals);
    add_caps<2>(displacements, loads, residual, volume_gradients, stiffness, held_change, totals);
  } else {
    add_faces<9>(displacements, loads, residual, volume_gradients, stiffness, held_change, totals);
    add_caps<3>(displacements, loads, residual, volume_gradients, stiffness, held_change, totals);
  }
  add_walls(displacements, loads, residual, volume_gradients, stiffness, held_change, totals);
  add_dead_loads(displacements, loads.dead_load_factor, residual, totals);

  if (stiffness != nullptr) {
    hold_diagonal(stiffness);
    petsc(MatAssemblyBegin(stiffness, MAT_FINAL_ASSEMBLY));
    petsc(MatAssemblyEnd(stiffness, MAT_FINAL_ASSEMBLY));
  }
  if (!residual.empty()) {
    exchange_.add_from_ghosts(residual);
    add_plates(displacements, loads, residual, totals);
    let_go(residual);
  }
  for (auto& gradient : volume_gradients) {
    exchange_.add_from_ghosts(gradient);
    let_go(gradient);
  }
  if (held_change != nullptr) {
    exchange_.add_from_ghosts(held_change->force_N);
    let_go(held_change->force_N);
  }
  sum_over_ranks(totals);
  return totals;
}

template <std::size_t n>
void Assembly::add_faces(std::span<const double> displacements, const Loads& loads, std::span<double> residual,
                         std::span<std::vector<double>> volume_gradients, Mat stiffness, const HeldChange* held_change,
                         BodyTotals& totals) const {
  for (const SpaceFace& face : space_.faces) {
    const bool has_chambers = face.label < chambers_of_label_.size() && !chambers_of_label_[face.label].empty();
    const bool may_touch = face.label < is_ground_label_.size() && is_ground_label_[face.label];
    if (!has_chambers && !may_touch) continue;
    const auto nodes = std::span(face.nodes).first(n);
    FaceNodes<n> current;
    for (std::size_t a = 0; a < n; ++a) current[a] = current_position(space_, displacements, nodes[a]);
    if (has_chambers) {
      const double volume = chamber_volume<n>(current);
      const auto gradient = chamber_volume_gradient<n>(current);
      for (const std::size_t c : chambers_of_label_[face.label]) {
        const std::size_t plenum = body_.chambers[c].plenum;
        const double pressure_Pa = loads.plenum_pressures_Pa[plenum];
        totals.chamber_volumes_m3[c] += volume;
        if (!residual.empty()) add_nodal(residual, nodes, gradient, -pressure_Pa);
        if (!volume_gradients.empty()) add_nodal(volume_gradients[plenum], nodes, gradient, 1.0);
        if (stiffness == nullptr || pressure_Pa == 0.0) continue;
        auto hessian = chamber_volume_hessian<n>(current);
        for (double& entry : hessian) entry *= -pressure_Pa;
        add_to_matrix(stiffness, nodes, hessian, held_change);
      }
    }
    if (may_touch) {
      FaceNodes<n> reference;
      for (std::size_t a = 0; a < n; ++a) reference[a] = space_.positions[static_cast<std::size_t>(nodes[a])];
      const double energy_J = ground_energy_J<n>(*body_.ground, reference, current);
      if (energy_J == 0.0) continue;
      totals.ground_energy_J += energy_J;
      totals.ground_force_N += ground_force_N<n>(*body_.ground, reference, current);
      if (!residual.empty()) {
        const auto gradient = ground_gradient_N<n>(*body_.ground, reference, current);
        for (std::size_t a = 0; a < n; ++a) residual[offset(nodes[a]) + 2] += gradient[a];
      }
      if (stiffness != nullptr) {
        const auto hessian = ground_hessian<n>(*body_.ground, reference, current);
        std::vector<double> block(9 * n * n, 0.0);
        for (std::size_t a = 0; a < n; ++a)
          for (std::size_t b = 0; b < n; ++b) block[(3 * a + 2) * 3 * n + 3 * b + 2] = hessian[a * n + b];
        add_to_matrix(stiffness, nodes, block, held_change);
      }
    }
  }
}

void Assembly::let_go(std::span<double> field) const {
  for (std::size_t n = 0; n < field.size(); ++n)
    if (held_[n] != 0) field[n] = 0.0;
}

/// What the pressures do to walls across their thickness, and what the faces of walls hide of a chamber's volume.
void Assembly::add_walls(std::span<const double> displacements, const Loads& loads, std::span<double> residual,
                         std::span<std::vector<double>> volume_gradients, Mat stiffness, const HeldChange* held_change,
                         BodyTotals& totals) const {
  std::vector<double> bulges_m3(body_.chambers.size(), 0.0);
  walls_.add_bulges(displacements, loads.plenum_pressures_Pa, bulges_m3);
  for (std::size_t c = 0; c < bulges_m3.size(); ++c) {
    totals.chamber_volumes_m3[c] += bulges_m3[c];
    totals.work_volumes_m3[body_.chambers[c].plenum] -= bulges_m3[c];  // no force does work on it
  }
  for (const PressedWall& wall : walls_.walls()) {
    const auto nodes = std::span(space_.element_nodes).subspan(8 * wall.element, 8);
    const BoxNumbers u = corner_displacements(space_, wall.element, displacements);
    const double change_m3 = wall_volume_change(wall.edges_m, u);
    const BoxNumbers gradient = wall_volume_gradient(wall.edges_m, u);
    double pressure_Pa = 0.0;  // mean of both faces
    for (const int side : wall.plena) {
      if (side < 0) continue;
      const auto plenum = static_cast<std::size_t>(side);
      totals.work_volumes_m3[plenum] += 0.5 * change_m3;
      if (!volume_gradients.empty()) add_nodal(volume_gradients[plenum], nodes, gradient, 0.5);
      pressure_Pa += 0.5 * loads.plenum_pressures_Pa[plenum];
    }
    if (!residual.empty()) add_nodal(residual, nodes, gradient, -pressure_Pa);
    if (stiffness == nullptr || pressure_Pa == 0.0) continue;
    std::vector<double> hessian = wall_volume_hessian(wall.edges_m, u);
    for (double& entry : hessian) entry *= -pressure_Pa;
    add_to_matrix(stiffness, nodes, hessian, held_change);
  }
}

void Assembly::read_volume_gradients(std::span<const double> displacements, std::span<std::vector<double>> gradients) const {
  if (!body_.thin_walls) return;
  std::vector<std::vector<double>> changes(gradients.size(), std::vector<double>(held_.size(), 0.0));
  for (const PressedWall& wall : walls_.walls()) {
    const auto nodes = std::span(space_.element_nodes).subspan(8 * wall.element, 8);
    const BoxNumbers u = corner_displacements(space_, wall.element, displacements);
    const BoxNumbers work = wall_volume_gradient(wall.edges_m, u);
    const BoxNumbers bulge = wall_bulge_gradient(wall.edges_m, wall.normal, u);
    for (std::size_t side = 0; side < 2; ++side) {
      if (wall.plena[side] < 0) continue;
      std::vector<double>& change = changes[static_cast<std::size_t>(wall.plena[side])];
      add_nodal(change, nodes, work, -0.5);
      add_nodal(change, nodes, bulge, PressedWalls::sign(side));
    }
  }
  for (std::size_t p = 0; p < gradients.size(); ++p) {
    exchange_.add_from_ghosts(changes[p]);
    let_go(changes[p]);
    for (std::size_t n = 0; n < changes[p].size(); ++n) gradients[p][n] += changes[p][n];
  }
}

/// The directions normal to the planes of symmetry that cut a cap. An open rim ends at such a plane, at nodes that are held in
/// it.
std::array<bool, 3> Assembly::mirrored_directions(const SpaceCap& cap) const {
  std::map<Index, int> ends;  // how often a node begins or ends a segment
  for (const RimSegment& segment : cap.rim) {
    ++ends[segment.first];
    ++ends[segment.last];
  }
  std::array<bool, 3> mirrored{};
  for (const auto& [node, count] : ends) {
    if (count != 1) continue;
    const Point& position = space_.positions[static_cast<std::size_t>(node)];
    for (std::size_t i = 0; i < 3; ++i)
      if (held_[offset(node) + i] != 0 && std::abs(position[i]) <= 1e-9 * norm(position)) mirrored[i] = true;
  }
  return mirrored;
}

template <std::size_t k>
void Assembly::add_caps(std::span<const double> displacements, const Loads& loads, std::span<double> residual,
                        std::span<std::vector<double>> volume_gradients, Mat stiffness, const HeldChange* held_change,
                        BodyTotals& totals) const {
  for (const SpaceCap& cap : space_.caps) {
    const std::vector<Index> nodes = rim_nodes(cap);
    const auto number = [&](Index node) {
      return static_cast<std::size_t>(std::lower_bound(nodes.begin(), nodes.end(), node) - nodes.begin());
    };
    Rim<k> rim;
    rim.mirrored = mirrored_directions(cap);
    for (const RimSegment& segment : cap.rim) {
      if constexpr (k == 2) {
        rim.segments.push_back({number(segment.first), number(segment.last)});
      } else {
        rim.segments.push_back({number(segment.first), number(segment.middle), number(segment.last)});
      }
    }
    std::vector<Point> positions;
    positions.reserve(nodes.size());
    for (const Index node : nodes) positions.push_back(current_position(space_, displacements, node));
    const std::size_t plenum = body_.chambers[cap.chamber].plenum;
    const double pressure_Pa = loads.plenum_pressures_Pa[plenum];
    totals.chamber_volumes_m3[cap.chamber] += cap_volume<k>(rim, positions);
    const std::vector<double> gradient = cap_volume_gradient<k>(rim, positions);
    if (!residual.empty()) add_nodal(residual, nodes, gradient, -pressure_Pa);
    if (!volume_gradients.empty()) add_nodal(volume_gradients[plenum], nodes, gradient, 1.0);
    if (stiffness == nullptr || pressure_Pa == 0.0) continue;
    std::vector<double> hessian = cap_volume_hessian<k>(rim, positions);
    for (double& entry : hessian) entry *= -pressure_Pa;
    add_to_matrix(stiffness, nodes, hessian, held_change);
  }
}

void Assembly::add_dead_loads(std::span<const double> displacements, double factor, std::span<double> residual,
                              BodyTotals& totals) const {
  for (std::size_t n = 0; n < dead_load_.size(); ++n) {
    totals.dead_load_work_J += dead_load_[n] * displacements[n];
    if (!residual.empty()) residual[n] -= factor * dead_load_[n];
  }
}

/// Sums the forces and moments of the plates on the body: the residual at the components that a plate holds.
void Assembly::add_plates(std::span<const double> displacements, const Loads& loads, std::span<const double> residual,
                          BodyTotals& totals) const {
  double square = 0.0;
  std::vector<double> sums;
  for (std::size_t p = 0; p < body_.plates.size(); ++p) {
    const Plate& plate = body_.plates[p];
    const Point shift = loads.plates.empty() ? Point{} : loads.plates[p].displacement_m;
    const Point centre = sum(plate.centre, shift);
    Point force{};
    Point moment{};
    for (const Index node : plate_nodes_[p]) {
      Point nodal{};
      for (std::size_t i = 0; i < 3; ++i)
        if (plate.held[i]) nodal[i] = residual[offset(node) + i];
      force = sum(force, nodal);
      moment = sum(moment, cross(difference(current_position(space_, displacements, node), centre), nodal));
      square += dot(nodal, nodal);
    }
    sums.insert(sums.end(), force.begin(), force.end());
    sums.insert(sums.end(), moment.begin(), moment.end());
  }
  if (sums.empty()) return;
  sums.push_back(square);
  MPI_Allreduce(MPI_IN_PLACE, sums.data(), static_cast<int>(sums.size()), MPI_DOUBLE, MPI_SUM, space_.communicator);
  for (std::size_t p = 0; p < body_.plates.size(); ++p) {
    const double* of_plate = &sums[6 * p];
    totals.plates.push_back({{of_plate[0], of_plate[1], of_plate[2]}, {of_plate[3], of_plate[4], of_plate[5]}});
  }
  totals.plate_force_norm_N = std::sqrt(sums.back());
}

void Assembly::sum_over_ranks(BodyTotals& totals) const {
  std::vector<double> sums{totals.strain_energy_J, totals.ground_force_N, totals.ground_energy_J, totals.dead_load_work_J};
  sums.insert(sums.end(), totals.chamber_volumes_m3.begin(), totals.chamber_volumes_m3.end());
  sums.insert(sums.end(), totals.work_volumes_m3.begin(), totals.work_volumes_m3.end());
  MPI_Allreduce(MPI_IN_PLACE, sums.data(), static_cast<int>(sums.size()), MPI_DOUBLE, MPI_SUM, space_.communicator);
  MPI_Allreduce(MPI_IN_PLACE, &totals.smallest_ratio, 1, MPI_DOUBLE, MPI_MIN, space_.communicator);
  totals.strain_energy_J = sums[0];
  totals.ground_force_N = sums[1];
  totals.ground_energy_J = sums[2];
  totals.dead_load_work_J = sums[3];
  const auto chambers = sums.begin() + 4;
  std::copy_n(chambers, totals.chamber_volumes_m3.size(), totals.chamber_volumes_m3.begin());
  std::copy_n(chambers + static_cast<std::ptrdiff_t>(totals.chamber_volumes_m3.size()), totals.work_volumes_m3.size(),
              totals.work_volumes_m3.begin());
  for (std::size_t c = 0; c < body_.chambers.size(); ++c)
    totals.work_volumes_m3[body_.chambers[c].plenum] += totals.chamber_volumes_m3[c];
}

}  // namespace menger::fem
