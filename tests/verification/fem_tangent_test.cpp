// Every term of the assembled equations at a random deformed state: residual against central differences of the potential energy,
// matrix against those of the residual, symmetry, invariance. A term other than the strain energy is taken alone by giving the
// body next to no stiffness, so that an error of it cannot hide.
//
// The difference step of 1e-6 element edges leaves an error of rounding, about 1e-16 / 1e-6 of the largest terms, and one of
// truncation, about 1e-12: 1e-7 of the derivative's norm is asked for.

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>

#include "fem_model.h"
#include "meshes/hexahedra/boundary_labels.h"
#include "meshes/hexahedra/hollow_polycube.h"
#include "meshes/hexahedra/verification_shapes.h"
#include "tests/unit/materials/laws/law_samples.h"

namespace menger::fem {
namespace {

constexpr double element_edge_m = 2e-3;
constexpr double tolerance = 1e-7;

using Field = std::vector<double>;

double product(const Field& a, const Field& b) { return std::inner_product(a.begin(), a.end(), b.begin(), 0.0); }
Field combination(const Field& a, double factor, const Field& b) {
  Field result = a;
  for (std::size_t n = 0; n < a.size(); ++n) result[n] += factor * b[n];
  return result;
}

/// The equations of a body at some loads, on one rank.
class Equations {
 public:
  Equations(const meshes::HexahedralMesh& mesh, int degree, const Body& body, double pressure_Pa)
      : body_(body),
        space_(make_space(mesh, degree, 0, MPI_COMM_SELF)),
        assembly_(space_, body_),
        pressures_Pa_(body.plenum_count, pressure_Pa) {}

  const Space& space() const { return space_; }
  Assembly& assembly() { return assembly_; }

  /// Random numbers in [-1, 1], zero where the body is held.
  Field direction(unsigned seed) const {
    std::mt19937 generator(seed);
    Field field(3 * space_.positions.size());
    for (std::size_t n = 0; n < field.size(); ++n) {
      const double value = 2.0 * static_cast<double>(generator()) / 4294967295.0 - 1.0;
      field[n] = assembly_.held()[n] != 0 ? 0.0 : value;
    }
    return field;
  }

  double potential_J(const Field& u) {
    const BodyTotals totals = assembly_.assemble(u, loads(), {}, {}, nullptr);
    EXPECT_GT(totals.smallest_ratio, 0.0);
    double potential = totals.strain_energy_J + totals.ground_energy_J - totals.dead_load_work_J;
    for (std::size_t c = 0; c < totals.chamber_volumes_m3.size(); ++c)
      potential -= pressures_Pa_[body_.chambers[c].plenum] * totals.chamber_volumes_m3[c];
    return potential;
  }

  Field residual(const Field& u) {
    Field result(u.size());
    assembly_.assemble(u, loads(), result, {}, nullptr);
    return result;
  }

  Field matrix_times(const Field& u, const Field& d, bool symmetric_storage) {
    const MatrixHandle matrix = assembly_.make_matrix(symmetric_storage);
    assembly_.assemble(u, loads(), {}, {}, matrix);
    VectorHandle in;
    VectorHandle out;
    petsc(MatCreateVecs(matrix, in.receive(), out.receive()));
    double* data = nullptr;
    petsc(VecGetArrayWrite(in, &data));
    std::copy(d.begin(), d.end(), data);
    petsc(VecRestoreArrayWrite(in, &data));
    petsc(MatMult(matrix, in, out));
    petsc(VecGetArrayWrite(out, &data));
    Field result(data, data + d.size());
    petsc(VecRestoreArrayWrite(out, &data));
    return result;
  }

 private:
  [[nodiscard]] Loads loads() const { return {pressures_Pa_, 1.0}; }
  Body body_;
  Space space_;
  Assembly assembly_;
  Field pressures_Pa_;
};

/// Displacements of some per cent of an element's edge.
Field deformed_state(const Equations& equations) {
  return combination(Field(3 * equations.space().positions.size(), 0.0), 0.06 * element_edge_m, equations.direction(1));
}

void expect_consistent(Equations& equations) {
  constexpr double step = 1e-6 * element_edge_m;
  const Field u = deformed_state(equations);
  const Field d = equations.direction(2);
  const Field other = equations.direction(3);
  const Field ahead = combination(u, step, d);
  const Field behind = combination(u, -step, d);

  const Field r = equations.residual(u);
  const double slope = (equations.potential_J(ahead) - equations.potential_J(behind)) / (2.0 * step);
  EXPECT_NEAR(product(r, d), slope, tolerance * std::sqrt(product(r, r) * product(d, d)));

  const Field Kd = equations.matrix_times(u, d, false);
  const Field difference = combination(equations.residual(ahead), -1.0, equations.residual(behind));
  const Field error = combination(Kd, -0.5 / step, difference);
  EXPECT_GT(product(Kd, Kd), 0.0);
  EXPECT_LT(std::sqrt(product(error, error)), tolerance * std::sqrt(product(Kd, Kd)));

  const Field half_stored = combination(equations.matrix_times(u, d, true), -1.0, Kd);
  EXPECT_LT(std::sqrt(product(half_stored, half_stored)), 1e-13 * std::sqrt(product(Kd, Kd)));
  const double mixed = product(other, Kd);
  EXPECT_NEAR(product(d, equations.matrix_times(u, other, false)), mixed,
              1e-12 * std::sqrt(product(Kd, Kd) * product(other, other)));
}

template <class F>
void for_each_kind_of_element(F&& f) {
  for (const int degree : {1, 2})
    for (const Formulation formulation : {Formulation::three_field, Formulation::displacement}) f(degree, formulation);
}

/// The cube with a square hole in its top, which a cap closes.
meshes::HexahedralMesh cube_with_tube() {
  meshes::HollowBodyOptions options;
  options.tubes = {{.cell = {0, 0, 0}, .side = meshes::Side::z_max, .edge_m = 4e-3}};
  return meshes::hollow_polycube(meshes::hollow_cube_design(0.02), options).mesh;
}

Body body_without_stiffness() { return body_of(materials::NeoHookean{1e-9}, materials::SimoTaylorVolume{1e-8}); }

TEST(ElementTangent, MatchesDifferencesForEveryLawAndElement) {
  const meshes::HexahedralMesh mesh = meshes::box({2e-3, 4e-3, 2e-3}, {1, 2, 1});
  materials::for_each_law([&](const auto& law) {
    for_each_kind_of_element([&](int degree, Formulation formulation) {
      SCOPED_TRACE(std::string(materials::name_of(law)) + ", degree " + std::to_string(degree));
      Equations equations(mesh, degree, body_of(law, materials::SimoTaylorVolume{1e6}, formulation), 0.0);
      expect_consistent(equations);
    });
  });
}

TEST(ElementTangent, MatchesDifferencesForEveryVolumetricEnergy) {
  const meshes::HexahedralMesh mesh = meshes::box({2e-3, 4e-3, 2e-3}, {1, 2, 1});
  for (const VolumetricLaw& volume :
       {VolumetricLaw{materials::QuadraticVolume{1e6}}, VolumetricLaw{materials::LogSquaredVolume{1e6}}}) {
    for_each_kind_of_element([&](int degree, Formulation formulation) {
      Equations equations(mesh, degree, body_of(materials::NeoHookean{50e3}, volume, formulation), 0.0);
      expect_consistent(equations);
    });
  }
}

TEST(FollowerPressureTangent, MatchesDifferencesOnAClosedChamber) {
  const meshes::HexahedralMesh mesh = meshes::hollow_cube_quarter(0.02, 2e-3, 1);
  Body body = body_without_stiffness();
  hold_symmetry(body, mesh);
  add_chambers(body, mesh);
  for (const int degree : {1, 2}) {
    Equations equations(mesh, degree, body, 6e3);
    expect_consistent(equations);
  }
}

TEST(FollowerPressureTangent, MatchesDifferencesWithACap) {
  const meshes::HexahedralMesh mesh = cube_with_tube();
  ASSERT_EQ(mesh.chambers[0].caps.size(), 1U);
  Body body = body_without_stiffness();
  add_chambers(body, mesh);
  for (const int degree : {1, 2}) {
    Equations equations(mesh, degree, body, 6e3);
    expect_consistent(equations);
  }
}

TEST(FollowerPressureTangent, MatchesDifferencesWithACapThatSymmetryCuts) {
  const meshes::HexahedralMesh mesh = meshes::thick_cylinder_quarter(8e-3, 10e-3, 4e-3, {1, 4, 2});
  Body body = body_without_stiffness();
  hold_symmetry(body, mesh);
  add_chambers(body, mesh);
  for (const int degree : {1, 2}) {
    Equations equations(mesh, degree, body, 6e3);
    expect_consistent(equations);
  }
}

/// Level with the bottom, so that about half of the random points lie below it.
TEST(GroundTangent, MatchesDifferences) {
  const meshes::HexahedralMesh mesh = meshes::hollow_cube_quarter(0.02, 2e-3, 1);
  Body body = body_without_stiffness();
  body.ground = GroundPlane{0.0, 1e7};
  body.ground_labels = {meshes::label_index(mesh, "ground")};
  for (const int degree : {1, 2}) {
    Equations equations(mesh, degree, body, 0.0);
    expect_consistent(equations);
  }
}

TEST(AssembledTangent, MatchesDifferencesWithEverythingAtOnce) {
  const meshes::HexahedralMesh mesh = cube_with_tube();
  for_each_kind_of_element([&](int degree, Formulation formulation) {
    Body body = body_of(materials::Ogden<1>{{materials::OgdenTerm{25e3, 3.25}}}, materials::SimoTaylorVolume{1e6}, formulation);
    body.regions[0].density_kg_per_m3 = 1070.0;
    body.gravity_m_per_s2 = {0.5, 0.0, -9.81};
    body.tractions = {{meshes::label_index(mesh, "outer"), {10.0, -20.0, 30.0}}};
    body.ground = GroundPlane{0.0, 1e7};
    body.ground_labels = {meshes::label_index(mesh, "ground")};
    body.point_supports = {{{0.0, 0.0, 0.0}, {true, true, false}}, {{0.02, 0.0, 0.0}, {false, true, false}}};
    add_chambers(body, mesh);
    Equations equations(mesh, degree, body, 6e3);
    expect_consistent(equations);
  });
}

TEST(AssembledTangent, HasARowOfTheIdentityForHeldComponents) {
  const meshes::HexahedralMesh mesh = meshes::hollow_cube_quarter(0.02, 2e-3, 1);
  Body body = body_of(materials::NeoHookean{50e3}, materials::SimoTaylorVolume{1e6});
  hold_symmetry(body, mesh);
  Equations equations(mesh, 2, body, 0.0);
  const Field u = deformed_state(equations);
  const Field d(u.size(), 1.0);
  const Field Kd = equations.matrix_times(u, d, true);
  const Field r = equations.residual(u);
  std::size_t held = 0;
  for (std::size_t n = 0; n < u.size(); ++n) {
    if (equations.assembly().held()[n] == 0) continue;
    ++held;
    EXPECT_DOUBLE_EQ(Kd[n], 1.0);
    EXPECT_DOUBLE_EQ(r[n], 0.0);
  }
  EXPECT_GT(held, 0U);
}

/// x -> Q x + c on the deformed body: the energies stay, the forces turn along. Rounding grows with the bulk modulus.
TEST(RigidMotion, LeavesTheEnergyAndTurnsTheForces) {
  const meshes::HexahedralMesh mesh = cube_with_tube();
  const materials::Tensor<double> Q = materials::rotation(2.0);
  const Point c{0.01, -0.03, 0.02};
  for_each_kind_of_element([&](int degree, Formulation formulation) {
    Body body = body_of(materials::MooneyRivlin{20e3, 5e3}, materials::SimoTaylorVolume{2.5e6}, formulation);
    add_chambers(body, mesh);
    Equations equations(mesh, degree, body, 6e3);
    const Field u = deformed_state(equations);
    const auto turned = [&](const Field& field, bool is_position) {
      Field result(field.size());
      for (std::size_t a = 0; a < field.size() / 3; ++a) {
        const Point& X = equations.space().positions[a];
        for (std::size_t i = 0; i < 3; ++i) {
          for (std::size_t j = 0; j < 3; ++j) result[3 * a + i] += Q(i, j) * (field[3 * a + j] + (is_position ? X[j] : 0.0));
          if (is_position) result[3 * a + i] += c[i] - X[i];
        }
      }
      return result;
    };
    const Field moved = turned(u, true);
    EXPECT_NEAR(equations.potential_J(moved), equations.potential_J(u), 1e-11 * std::abs(equations.potential_J(u)));
    const Field expected = turned(equations.residual(u), false);
    EXPECT_LT(materials::distance(equations.residual(moved), expected), 1e-10 * materials::largest(expected));
  });
}

}  // namespace
}  // namespace menger::fem
