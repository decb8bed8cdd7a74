#include "fem_model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "fem/statics/supports.h"
#include "meshes/hexahedra/boundary_labels.h"

namespace menger::fem {

Model::Model(meshes::HexahedralMesh the_mesh, int degree, Body the_body, const EquilibriumOptions& options)
    : mesh(std::move(the_mesh)),
      body(std::move(the_body)),
      space(make_space(mesh, degree, 0, MPI_COMM_WORLD)),
      equilibrium(space, body, options),
      state(equilibrium.rest()) {}

const PathReport& Model::follow(const std::vector<PlenumDrive>& drives, const PathOptions& options,
                                const std::function<void(const PathPoint&)>& observe, io::RunStatus expected) {
  report = follow_path(equilibrium, drives, options, [&](const PathPoint& point, const BodyState& reached, const PathRestart&) {
    state = reached;
    if (observe) observe(point);
  });
  EXPECT_EQ(report.status, expected) << report.reason;
  if (report.points.empty()) throw std::runtime_error("a path without a state");
  return report;
}

Point Model::displacement_at(const Point& point) const {
  const NearestNode node = nearest_node(space, point);
  Point displacement{};
  if (node.local >= 0)
    for (std::size_t i = 0; i < 3; ++i) displacement[i] = state.displacements_m[3 * static_cast<std::size_t>(node.local) + i];
  MPI_Bcast(displacement.data(), 3, MPI_DOUBLE, node.rank, space.communicator);
  return displacement;
}

double Model::distance_to(const Model& other) const {
  double largest = 0.0;
  for (std::size_t n = 0; n < state.displacements_m.size(); ++n)
    largest = std::max(largest, std::abs(state.displacements_m[n] - other.state.displacements_m[n]));
  MPI_Allreduce(MPI_IN_PLACE, &largest, 1, MPI_DOUBLE, MPI_MAX, space.communicator);
  return largest;
}

double Model::plenum_volume_ratio(std::size_t plenum) const {
  return report.points.back().plenum_volumes_m3[plenum] / report.points.front().plenum_volumes_m3[plenum];
}

Body body_of(const materials::HyperelasticLaw& law, const VolumetricLaw& volume, Formulation formulation) {
  Body body;
  body.formulation = formulation;
  body.regions.push_back({law, volume, 0.0});
  return body;
}

void hold(Body& body, const meshes::HexahedralMesh& mesh, std::string_view label, const std::array<bool, 3>& held) {
  body.supports.push_back({meshes::label_index(mesh, label), held});
}

void hold_symmetry(Body& body, const meshes::HexahedralMesh& mesh) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::array<bool, 3> held{};
    held[axis] = true;
    for (std::size_t label = 0; label < mesh.label_names.size(); ++label)
      if (mesh.label_names[label] == std::string("symmetry ") + "xyz"[axis]) body.supports.push_back({label, held});
  }
}

void add_chambers(Body& body, const meshes::HexahedralMesh& mesh) {
  for (const meshes::Chamber& chamber : mesh.chambers) body.chambers.push_back({chamber.labels, chamber.plenum});
  body.plenum_count = mesh.plenum_names.size();
}

PathOptions equal_steps(int count) {
  PathOptions options;
  options.first_step = options.largest_step = 1.0 / count;
  options.desired_iterations = 1000;
  return options;
}

}  // namespace menger::fem
