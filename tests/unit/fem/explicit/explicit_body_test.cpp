#include "fem/explicit/explicit_body.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "tests/support/input_error_message.h"
#include "tests/unit/fem/explicit/explicit_samples.h"

namespace menger::fem {
namespace {

using tests::message_of;

TEST(ExplicitBody, MassIsThatOfTheWall) {
  const meshes::HexahedralMesh mesh = hollow_cube();
  const ExplicitBody body(mesh, silicone_options(mesh));
  EXPECT_NEAR(body.mass_kg(), 1070.0 * (8e-6 - 16e-3 * 16e-3 * 16e-3), 1e-15);
  // an eighth of one element
  EXPECT_NEAR(body.masses_kg()[node_at(mesh, {0.0, 0.0, 0.0})], 1070.0 * 8e-9 / 8.0, 1e-18);
}

TEST(ExplicitBody, HeldComponentsHaveNoInverseMass) {
  const meshes::HexahedralMesh mesh = hollow_cube();
  ExplicitBodyOptions options = silicone_options(mesh);
  options.supports = {{meshes::label_index(mesh, "ground"), {false, false, true}}};
  options.point_supports = {{{0.0, 0.0, 0.0}, {true, false, false}}};
  const ExplicitBody body(mesh, options);
  for (std::size_t n = 0; n < mesh.points.size(); ++n)
    EXPECT_EQ(body.inverse_masses_per_kg()[3 * n + 2] == 0.0, mesh.points[n][2] == 0.0);
  const std::size_t corner = node_at(mesh, {0.0, 0.0, 0.0});
  EXPECT_EQ(body.inverse_masses_per_kg()[3 * corner], 0.0);
  EXPECT_GT(body.inverse_masses_per_kg()[3 * corner + 1], 0.0);
}

TEST(ExplicitBody, RegionsKeepTheirMaterials) {
  meshes::HexahedralMesh mesh = meshes::box({1.0, 1.0, 1.0}, {3, 1, 1});
  mesh.region_names = {"light", "heavy"};
  mesh.regions = {0, 1, 0};
  ExplicitBodyOptions options = silicone_options(mesh);
  options.regions[0].density_kg_per_m3 = 600.0;
  options.regions[1].density_kg_per_m3 = 1200.0;
  EXPECT_NEAR(ExplicitBody(mesh, options).mass_kg(), 800.0, 1e-10);
}

// Forces and energy of a body of two materials are those of its elements, each computed as a body of its own.
TEST(ExplicitBody, RegionsKeepTheirLaws) {
  meshes::HexahedralMesh mesh = meshes::box({6e-3, 2e-3, 2e-3}, {3, 1, 1});
  mesh.region_names = {"neo-Hooke", "Yeoh"};
  mesh.regions = {0, 1, 0};
  ExplicitBodyOptions options = silicone_options(mesh);
  options.regions[1].material = {materials::Yeoh{25e3, 5e3, 3e3}, materials::SimoTaylorVolume{1e6}, 3.0};
  const ExplicitBody body(mesh, options);
  const std::vector<double> u = random_numbers(3 * mesh.points.size(), 2e-4, 11);
  const std::vector<double> v = random_numbers(3 * mesh.points.size(), 1.0, 12);
  const meshes::HexahedralMesh single = meshes::box({2e-3, 2e-3, 2e-3}, {1, 1, 1});
  std::vector<double> wanted(u.size(), 0.0);
  double energy = 0.0;
  for (std::size_t e = 0; e < 3; ++e) {
    ExplicitBodyOptions alone;
    alone.regions = {options.regions[mesh.regions[e]]};
    const ExplicitBody element(single, alone);
    std::vector<double> own_u(24);
    std::vector<double> own_v(24);
    const auto component = [&](std::size_t n) { return 3 * mesh.elements[e][n / 3] + n % 3; };
    const auto own_component = [&](std::size_t n) { return 3 * single.elements[0][n / 3] + n % 3; };
    for (std::size_t n = 0; n < 24; ++n) {
      own_u[own_component(n)] = u[component(n)];
      own_v[own_component(n)] = v[component(n)];
    }
    const std::vector<double> forces = internal_forces(element, {own_u.data(), own_v.data()});
    for (std::size_t n = 0; n < 24; ++n) wanted[component(n)] += forces[own_component(n)];
    energy += strain_energy_J(element, own_u);
  }
  const std::vector<double> forces = internal_forces(body, {u.data(), v.data()});
  double largest = 0.0;
  for (const double force : wanted) largest = std::max(largest, std::abs(force));
  for (std::size_t n = 0; n < u.size(); ++n) EXPECT_NEAR(forces[n], wanted[n], 1e-11 * largest);  // rounding
  EXPECT_NEAR(strain_energy_J(body, u), energy, 1e-12 * energy);
}

TEST(ExplicitBody, RefusesWhatItCannotCompute) {
  const meshes::HexahedralMesh membrane = meshes::cooks_membrane(1e-3, 1e-3, {4, 4, 1});
  EXPECT_NE(message_of([&] { ExplicitBody(membrane, silicone_options(membrane)); }).find("element 0 at "), std::string::npos);
  const meshes::HexahedralMesh mesh = hollow_cube();
  EXPECT_NE(message_of([&] { ExplicitBody(mesh, {}); }).find("0 materials for 1 regions"), std::string::npos);
  ExplicitBodyOptions weightless = silicone_options(mesh);
  weightless.regions[0].density_kg_per_m3 = 0.0;
  EXPECT_NE(message_of([&] { ExplicitBody(mesh, weightless); }).find("\"wall\": density_kg_per_m3"), std::string::npos);
  EXPECT_NE(message_of([&] { ExplicitBody(mesh, silicone_options(mesh, -1.0)); }).find("viscosity_Pa_s"), std::string::npos);
  meshes::HexahedralMesh loose = meshes::box({1.0, 1.0, 1.0}, {1, 1, 1});
  loose.points.push_back({2.0, 2.0, 2.0});
  EXPECT_NE(message_of([&] { ExplicitBody(loose, silicone_options(loose)); }).find("node 8 at "), std::string::npos);
  meshes::HexahedralMesh lost = meshes::box({1.0, 1.0, 1.0}, {1, 1, 1});
  lost.regions = {3};
  EXPECT_NE(message_of([&] { ExplicitBody(lost, silicone_options(lost)); }).find("element 0: has region 3"), std::string::npos);
}

}  // namespace
}  // namespace menger::fem
