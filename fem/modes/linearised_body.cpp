#include "fem/modes/linearised_body.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cassert>

#include "fem/modes/mass_matrix.h"
#include "fem/space/space_diameter.h"

namespace menger::fem {

namespace {

/// A rigid motion is free if its eigenvalue and the residual of K r = 0 are below this part of the elastic scale. It is far above
/// rounding and the tolerance of forces (about 1e-7), and far below the lowest values of even slender bodies.
constexpr double rigid_tolerance = 1e-5;

/// Returns mu V / (m L^2); V/m is one over the mean density.
double elastic_scale_of(const Space& space, const Body& body, double mass_kg, double diameter_m) {
  double modulus_Pa = 0.0;
  Body of_unit_density = body;
  for (RegionMaterial& region : of_unit_density.regions) {
    modulus_Pa = std::max(modulus_Pa, materials::shear_modulus_at_rest_Pa(region.law));
    region.density_kg_per_m3 = 1.0;
  }
  const double volume_m3 = mass_of(space, of_unit_density);
  return modulus_Pa * volume_m3 / (mass_kg * diameter_m * diameter_m);
}

LinearOptions always_direct() {
  LinearOptions options;
  options.method = LinearMethod::direct;
  return options;
}

double inner_product(Vec a, Vec b) {
  double value = 0.0;
  petsc(VecDot(a, b, &value));
  return value;
}

VectorHandle product(Mat matrix, Vec x) {
  VectorHandle y;
  petsc(VecDuplicate(x, y.receive()));
  petsc(MatMult(matrix, x, y));
  return y;
}

}  // namespace

LinearisedBody::LinearisedBody(Equilibrium& equilibrium, const BodyState& state, double dead_load_factor)
    : assembly_(equilibrium.assembly()),
      solver_(equilibrium.assembly(), always_direct()),
      stiffness_(equilibrium.assembly().make_matrix(true)),
      mass_(equilibrium.assembly().make_matrix(true)),
      displacements_(state.displacements_m),
      volume_gradients_(equilibrium.body().plenum_count),
      diameter_m_(diameter_m(equilibrium.space())) {
  const double mass_kg = mass_of(equilibrium.space(), equilibrium.body());
  assert(mass_kg > 0.0);
  elastic_scale_ = elastic_scale_of(equilibrium.space(), equilibrium.body(), mass_kg, diameter_m_);
  Assembly& assembly = equilibrium.assembly();
  // The pressures that elements predicted belong to the search. The tangent here is that of the displacements.
  assembly.elements().forget_prediction();
  assembly.assemble(displacements_, {state.plenum_pressures_Pa, dead_load_factor}, {}, volume_gradients_, stiffness_);
  assemble_mass(assembly, equilibrium.body(), mass_);
  petsc(MatCopy(stiffness_, solver_.matrix(), SAME_NONZERO_PATTERN));
  // Summed again, because MatAXPY of PETSc 3.18 loses part of a symmetric block matrix that is shared among ranks.
  add_mass(assembly, equilibrium.body(), -shift(), solver_.matrix());
  if (solver_.prepare()) below_shift_ = solver_.negative_pivots();
}

VectorHandle LinearisedBody::vector_of(std::span<const double> field) const {
  VectorHandle vector = make_vector();
  double* data = nullptr;
  petsc(VecGetArrayWrite(vector, &data));
  std::copy_n(field.begin(), 3 * assembly_.space().owned_count, data);
  petsc(VecRestoreArrayWrite(vector, &data));
  return vector;
}

std::vector<double> LinearisedBody::field_of(Vec vector) const {
  std::vector<double> field(3 * assembly_.space().positions.size());
  const double* data = nullptr;
  petsc(VecGetArrayRead(vector, &data));
  std::copy_n(data, 3 * assembly_.space().owned_count, field.begin());
  petsc(VecRestoreArrayRead(vector, &data));
  assembly_.exchange().update_ghosts(field);
  return field;
}

/// Returns the rigid motions of the present shape that leave held components at zero, of unit size at the body's ends.
std::vector<VectorHandle> LinearisedBody::unheld_rigid_motions() const {
  const Space& space = assembly_.space();
  Point origin = space.positions.empty() ? Point{} : space.positions.front();
  MPI_Bcast(origin.data(), 3, MPI_DOUBLE, 0, space.communicator);
  using Row = Eigen::Vector<double, 6>;
  // The six motions at component i of a node. Rotations are about the origin; lengths are relative to the diameter.
  const auto row_of = [&](std::size_t node, std::size_t i) {
    const Point u{displacements_[3 * node], displacements_[3 * node + 1], displacements_[3 * node + 2]};
    const Point arm = scaled(1.0 / diameter_m_, difference(sum(space.positions[node], u), origin));
    Point axis{};
    axis[i] = 1.0;
    const Point lever = cross(arm, axis);
    return Row(axis[0], axis[1], axis[2], lever[0], lever[1], lever[2]);
  };
  Eigen::Matrix<double, 6, 6> squares = Eigen::Matrix<double, 6, 6>::Zero();
  for (std::size_t n = 0; n < 3 * static_cast<std::size_t>(space.owned_count); ++n) {
    if (assembly_.held()[n] == 0) continue;
    const Row row = row_of(n / 3, n % 3);
    squares += row * row.transpose();
  }
  MPI_Allreduce(MPI_IN_PLACE, squares.data(), 36, MPI_DOUBLE, MPI_SUM, space.communicator);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>> parts(squares);

  std::vector<VectorHandle> motions;
  for (Eigen::Index m = 0; m < 6; ++m) {
    if (parts.eigenvalues()[m] > 1e-10 * parts.eigenvalues()[5]) continue;
    std::vector<double> motion(3 * space.positions.size(), 0.0);
    for (std::size_t n = 0; n < motion.size(); ++n)
      if (assembly_.held()[n] == 0) motion[n] = row_of(n / 3, n % 3).dot(parts.eigenvectors().col(m));
    motions.push_back(vector_of(motion));
  }
  return motions;
}

std::vector<VectorHandle> LinearisedBody::free_rigid_motions() const {
  const std::vector<VectorHandle> motions = unheld_rigid_motions();
  const auto count = static_cast<Eigen::Index>(motions.size());
  Eigen::MatrixXd energies(count, count);
  Eigen::MatrixXd masses(count, count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const VectorHandle force = product(stiffness_, motions[static_cast<std::size_t>(i)]);
    const VectorHandle momentum = product(mass_, motions[static_cast<std::size_t>(i)]);
    for (Eigen::Index j = 0; j < count; ++j) {
      energies(j, i) = inner_product(force, motions[static_cast<std::size_t>(j)]);
      masses(j, i) = inner_product(momentum, motions[static_cast<std::size_t>(j)]);
    }
  }
  std::vector<VectorHandle> free;
  if (count == 0) return free;
  // The chamber pressure or the ground may resist some of the motions.
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> pairs(energies, masses);
  for (Eigen::Index m = 0; m < count; ++m) {
    VectorHandle motion = make_vector();
    petsc(VecZeroEntries(motion));
    for (Eigen::Index i = 0; i < count; ++i)
      petsc(VecAXPY(motion, pairs.eigenvectors()(i, m), motions[static_cast<std::size_t>(i)]));
    double force = 0.0;
    double momentum = 0.0;
    petsc(VecNorm(product(stiffness_, motion), NORM_2, &force));
    petsc(VecNorm(product(mass_, motion), NORM_2, &momentum));
    const double limit = rigid_tolerance * elastic_scale_;
    if (std::abs(pairs.eigenvalues()[m]) <= limit && force <= limit * momentum) free.push_back(std::move(motion));
  }
  return free;
}

}  // namespace menger::fem
