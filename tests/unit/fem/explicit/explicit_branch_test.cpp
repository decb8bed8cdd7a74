// Maxwell branches of explicit elements.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <string>
#include <vector>

#include "tests/support/input_error_message.h"
#include "tests/unit/fem/explicit/explicit_samples.h"

namespace menger::fem {
namespace {

constexpr double modulus = 50e3;
constexpr MaxwellBranch branch{.shear_modulus_Pa = 20e3, .relaxation_time_s = 5e-3};

/// 27 boxes with edges of 1, 1.1 and 0.9, 1/3 of each: the last batch of any width is not full.
meshes::HexahedralMesh blocks() { return meshes::box({1.0, 1.1, 0.9}, {3, 3, 3}); }
constexpr double volume = 1.0 * 1.1 * 0.9;

/// Of the same modulus in sum.
const std::vector<MaxwellBranch> three_branches{{.shear_modulus_Pa = 4e3, .relaxation_time_s = 50e-3},
                                                {.shear_modulus_Pa = 6e3, .relaxation_time_s = 15e-3},
                                                {.shear_modulus_Pa = 10e3, .relaxation_time_s = 5e-3}};
const std::vector<std::vector<MaxwellBranch>> one_and_three{{branch}, three_branches};

ExplicitBody body_of(const meshes::HexahedralMesh& mesh, const ExplicitKernels& kernels,
                     const std::vector<MaxwellBranch>& branches = {branch},
                     const materials::HyperelasticLaw& law = materials::NeoHookean{modulus}) {
  const ExplicitMaterial material{law, materials::SimoTaylorVolume{1e6}, 0.0, branches};
  return {mesh, {.regions = {{material, 1.0}}, .supports = {}, .point_supports = {}, .elements = ThreeFieldOptions{kernels}}};
}

/// Displacements of a homogeneous deformation.
std::vector<double> mapped(const meshes::HexahedralMesh& mesh, const std::array<Point, 3>& F) {
  std::vector<double> u;
  for (const Point& X : mesh.points)
    for (std::size_t i = 0; i < 3; ++i) u.push_back(dot(F[i], X) - X[i]);
  return u;
}

std::vector<double> sheared(const meshes::HexahedralMesh& mesh, double shear) {
  return mapped(mesh, {Point{1.0, shear, 0.0}, Point{0.0, 1.0, 0.0}, Point{0.0, 0.0, 1.0}});
}

/// Shear force on the face y = 1.1, which pulls it back, N: the sum of the internal forces along x.
double top_force(const meshes::HexahedralMesh& mesh, const std::vector<double>& forces) {
  double force = 0.0;
  for (std::size_t n = 0; n < mesh.points.size(); ++n)
    if (mesh.points[n][1] > 1.0999) force += forces[3 * n];
  return force;
}

double largest(const std::vector<double>& values) {
  double result = 0.0;
  for (const double value : values) result = std::max(result, std::abs(value));
  return result;
}

std::vector<double> forces_of(const ExplicitBody& body, const std::vector<double>& u, AlignedNumbers& tensors) {
  return internal_forces(body, {u.data()}, {tensors.data(), 0.0, three_field(body).sets_apart()});
}

/// What relaxation over a time takes out of the branches, J.
double relax(const ExplicitBody& body, const std::vector<double>& u, AlignedNumbers& tensors, double time_s) {
  AlignedNumbers slots(24 * three_field(body).boxes().width() * three_field(body).boxes().batch_count());
  const NodalMotion motion{u.data()};
  return three_field(body)
      .forces(motion, {0, three_field(body).boxes().batch_count()}, {tensors.data(), time_s, three_field(body).sets_apart()},
              slots.data())
      .relaxed_J;
}

std::vector<materials::HyperelasticLaw> laws() { return {materials::NeoHookean{modulus}, materials::Yeoh{21e3, 2.5e3, 0.1e3}}; }

// A jump to a shear of any size: a branch's stress is linear in its tensor, which goes exponentially to where it is zero, so
// that the shear force on the area of 0.9 is (mu + sum m exp(-t / tau)) gamma, and all of m gamma^2 / 2 is lost in the end.
// Relaxation over one long time is that over many short ones.
TEST(MaxwellBranch, HeldShearRelaxesExponentially) {
  const meshes::HexahedralMesh mesh = blocks();
  constexpr double shear = 0.8;
  const std::vector<double> u = sheared(mesh, shear);
  const std::vector<double> rest(u.size(), 0.0);
  for (const ExplicitKernels& kernels : available_explicit_kernels()) {
    SCOPED_TRACE(kernels.instruction_set);
    for (const std::vector<MaxwellBranch>& branches : one_and_three) {
      const ExplicitBody body = body_of(mesh, kernels, branches);
      AlignedNumbers tensors = branches_at_rest(body, rest);
      double time = 0.0;
      double lost = 0.0;
      for (const double more : {0.0, 0.1e-3, 2e-3, 5e-3, 40e-3, 500e-3}) {
        if (more > 0.0) lost += relax(body, u, tensors, more);
        time += more;
        double stiffness = modulus;
        for (const MaxwellBranch& one : branches) stiffness += one.shear_modulus_Pa * std::exp(-time / one.relaxation_time_s);
        const double force = stiffness * shear * 0.9;
        EXPECT_NEAR(top_force(mesh, forces_of(body, u, tensors)), force, 1e-12 * force) << time;
      }
      const double stored = 0.5 * branch.shear_modulus_Pa * shear * shear * volume;
      EXPECT_NEAR(lost, stored, 1e-8 * stored);  // exp(-2 * 547 / 50) of a fifth are left
    }
  }
}

// What is lost is what the stored energy falls by, and never less than nothing: deformations of some tenths at random, relaxation
// over times from a thousandth to ten times the branch's own.
TEST(MaxwellBranch, LosesWhatItsEnergyFallsBy) {
  const meshes::HexahedralMesh mesh = blocks();
  for (const ExplicitKernels& kernels : available_explicit_kernels()) {
    for (const std::vector<MaxwellBranch>& branches : one_and_three) {
      const ExplicitBody body = body_of(mesh, kernels, branches);
      AlignedNumbers tensors = branches_at_rest(body, std::vector<double>(3 * mesh.points.size(), 0.0));
      for (unsigned n = 0; n < 40; ++n) {
        const std::vector<double> u = random_numbers(3 * mesh.points.size(), 0.06, n);
        const double before = strain_energy_J(body, u, tensors);
        const double lost = relax(body, u, tensors, branch.relaxation_time_s * std::pow(10.0, n % 5 - 3.0));
        const double after = strain_energy_J(body, u, tensors);
        EXPECT_GT(lost, 0.0);
        EXPECT_NEAR(lost, before - after, 1e-12 * before);
        EXPECT_GT(after, strain_energy_J(body, u));
      }
    }
  }
}

TEST(MaxwellBranch, ForceIsTheDerivativeOfTheEnergy) {
  const meshes::HexahedralMesh mesh = blocks();
  const std::vector<double> u = random_numbers(3 * mesh.points.size(), 0.05, 1);
  const std::vector<double> way = random_numbers(3 * mesh.points.size(), 1.0, 2);
  for (const materials::HyperelasticLaw& law : laws()) {
    for (const ExplicitKernels& kernels : available_explicit_kernels()) {
      const ExplicitBody body = body_of(mesh, kernels, three_branches, law);
      AlignedNumbers tensors = branches_at_rest(body, random_numbers(u.size(), 0.05, 3));
      relax(body, random_numbers(u.size(), 0.05, 4), tensors, 7e-3);  // so that each rests elsewhere
      const auto energy = [&](double step) {
        std::vector<double> at = u;
        for (std::size_t n = 0; n < at.size(); ++n) at[n] += step * way[n];
        return strain_energy_J(body, at, tensors);
      };
      const std::vector<double> forces = forces_of(body, u, tensors);
      double power = 0.0;
      for (std::size_t n = 0; n < u.size(); ++n) power += forces[n] * way[n];
      constexpr double step = 1e-5;  // third derivatives and rounding leave about 1e-8 each
      EXPECT_NEAR((energy(step) - energy(-step)) / (2.0 * step), power, 1e-7 * std::abs(power));
    }
  }
}

// A turned body carries turned forces, whatever its branches have been through; at rest in a turned state it carries none, and
// turning it makes it lose none. Where the body is twice as large, too: branches know no pressure.
TEST(MaxwellBranch, IgnoresRotationAndDilation) {
  const meshes::HexahedralMesh mesh = blocks();
  const std::array<Point, 3> turn{Point{0.36, 0.48, -0.8}, Point{-0.8, 0.6, 0.0}, Point{0.48, 0.64, 0.6}};
  const std::vector<double> u = random_numbers(3 * mesh.points.size(), 0.05, 4);
  std::vector<double> turned;
  for (std::size_t n = 0; n < mesh.points.size(); ++n) {
    const Point x = sum(mesh.points[n], {u[3 * n], u[3 * n + 1], u[3 * n + 2]});
    for (std::size_t i = 0; i < 3; ++i) turned.push_back(dot(turn[i], x) - mesh.points[n][i]);
  }
  const std::vector<double> rest(u.size(), 0.0);
  for (const ExplicitKernels& kernels : available_explicit_kernels()) {
    const ExplicitBody body = body_of(mesh, kernels);
    AlignedNumbers tensors = branches_at_rest(body, random_numbers(u.size(), 0.05, 5));
    const std::vector<double> plain = forces_of(body, u, tensors);
    const std::vector<double> after = forces_of(body, turned, tensors);
    for (std::size_t n = 0; n < mesh.points.size(); ++n)
      for (std::size_t i = 0; i < 3; ++i)
        EXPECT_NEAR(after[3 * n + i], dot(turn[i], {plain[3 * n], plain[3 * n + 1], plain[3 * n + 2]}), 1e-12 * largest(plain));

    AlignedNumbers at_rest = branches_at_rest(body, rest);
    const double scale = 2.0;
    const std::vector<double> grown = mapped(mesh, {scaled(scale, turn[0]), scaled(scale, turn[1]), scaled(scale, turn[2])});
    const ExplicitBody elastic = body_of(mesh, kernels, {});
    const std::vector<double> with = forces_of(body, grown, at_rest);
    const std::vector<double> without = internal_forces(elastic, {grown.data()});
    for (std::size_t n = 0; n < with.size(); ++n) EXPECT_NEAR(with[n], without[n], 1e-12 * largest(without));
    EXPECT_NEAR(relax(body, grown, at_rest, branch.relaxation_time_s), 0.0, 1e-12 * branch.shear_modulus_Pa);
  }
}

/// Storage and loss modulus of the standard linear solid.
std::complex<double> dynamic_modulus(double angular_frequency) {
  const std::complex<double> s(0.0, angular_frequency * branch.relaxation_time_s);
  return modulus + branch.shear_modulus_Pa * s / (1.0 + s);
}

/// Time between relaxations over that of the branch.
constexpr double relaxation_share = 0.08;

/// The same from a small shear that is imposed, as ExplicitDynamics moves on: `steps` steps between relaxations. The last of
/// several cycles.
std::complex<double> measured_modulus(double angular_frequency, int steps) {
  const meshes::HexahedralMesh mesh = meshes::box({1.0, 1.1, 0.9}, {1, 1, 1});
  const ExplicitBody body = body_of(mesh, best_explicit_kernels());
  AlignedNumbers tensors = branches_at_rest(body, std::vector<double>(24, 0.0));
  const double period = 2.0 * std::numbers::pi / angular_frequency;
  const auto intervals = static_cast<int>(std::ceil(period / (relaxation_share * branch.relaxation_time_s)));
  const double interval = period / intervals;
  const int cycles = 2 + static_cast<int>(std::ceil(12.0 * branch.relaxation_time_s / period));
  std::complex<double> sum = 0.0;
  for (int n = 0; n < cycles * intervals; ++n) {
    for (int k = 0; k < steps; ++k) {
      const double phase = 2.0 * std::numbers::pi * (n + k / static_cast<double>(steps)) / intervals;
      const std::vector<double> u = sheared(mesh, 1e-3 * std::sin(phase));
      const BranchTensors now{tensors.data(), k == 0 && n > 0 ? interval : 0.0};
      const std::vector<double> forces = internal_forces(body, {u.data()}, now);
      // force = |G| sin(phase + delta): the Fourier component at this frequency
      if (n >= (cycles - 1) * intervals) sum += top_force(mesh, forces) * std::polar(1.0, -phase);
    }
  }
  return std::complex<double>(0.0, 2.0) * sum / (1e-3 * 0.9 * steps * intervals);
}

// At a tenth of, at, and ten times the frequency of the loss peak. Tensors that stand still between relaxations h apart, for the
// middle of that time, are smaller by (w h)^2 / 24, and their relaxation by that midpoint is wrong by as much; behind slow motion
// they lag by h / (1 - exp(-h / tau)) - h / 2, which is tau (1 + (h / tau)^2 / 12).
TEST(MaxwellBranch, DynamicModulusIsThatOfTheStandardLinearSolid) {
  const double peak = 1.0 / (branch.relaxation_time_s * std::sqrt(1.0 + branch.shear_modulus_Pa / modulus));
  for (const double frequency : {0.1 * peak, peak, 10.0 * peak}) {
    const std::complex<double> wanted = dynamic_modulus(frequency);
    const double turn = relaxation_share * branch.relaxation_time_s * frequency;
    // The tensors carry what the branch lacks of its spring.
    const double relaxed = std::abs(modulus + branch.shear_modulus_Pa - wanted);
    const double tolerance =
        relaxed * turn * turn / 6.0 + std::abs(wanted - modulus) * relaxation_share * relaxation_share / 11.0 + 1e-6 * modulus;
    for (const int steps : {1, 5})
      EXPECT_LT(std::abs(measured_modulus(frequency, steps) - wanted), tolerance) << frequency << ' ' << steps;
  }
}

TEST(MaxwellBranch, LossFactorPeaksAsStated) {
  const double ratio = branch.shear_modulus_Pa / modulus;
  const double peak = 1.0 / (branch.relaxation_time_s * std::sqrt(1.0 + ratio));
  const auto loss_factor = [](double frequency) {
    const std::complex<double> wanted = dynamic_modulus(frequency);
    return wanted.imag() / wanted.real();
  };
  EXPECT_NEAR(loss_factor(peak), ratio / (2.0 * std::sqrt(1.0 + ratio)), 1e-12);
  EXPECT_LT(loss_factor(0.9 * peak), loss_factor(peak));
  EXPECT_LT(loss_factor(1.1 * peak), loss_factor(peak));
}

// Same motion, same relaxations; packs differ in the order of their sums and in their logarithms.
TEST(MaxwellBranch, InstructionSetsAgree) {
  const meshes::HexahedralMesh mesh = blocks();
  const std::vector<double> u = random_numbers(3 * mesh.points.size(), 0.06, 6);
  for (const materials::HyperelasticLaw& law : laws()) {
    std::vector<double> first;
    double first_lost = 0.0;
    for (const ExplicitKernels& kernels : available_explicit_kernels()) {
      const ExplicitBody body = body_of(mesh, kernels, three_branches, law);
      AlignedNumbers tensors = branches_at_rest(body, random_numbers(u.size(), 0.06, 7));
      const double lost = relax(body, u, tensors, 1e-3);
      const std::vector<double> forces = forces_of(body, u, tensors);
      if (first.empty()) {
        first = forces;
        first_lost = lost;
      }
      for (std::size_t n = 0; n < forces.size(); ++n) EXPECT_NEAR(forces[n], first[n], 1e-12 * largest(first));
      EXPECT_NEAR(lost, first_lost, 1e-11 * first_lost);
    }
  }
}

/// The hollow cube under everything there is.
ExplicitOptions everything() {
  ExplicitOptions options;
  options.schedules = {{SinePressure{.high_Pa = 4e3, .frequency_Hz = 50.0}, 0.0}};
  options.loads.gravity_m_per_s2 = {1.0, 0.0, -9.81};
  options.loads.ground = RigidGround{.height_m = 0.0,
                                     .stiffness_Pa_per_m = ground_stiffness_Pa_per_m(2.5e6, 2e-3),
                                     .friction = {.static_coefficient = 0.5, .kinetic_coefficient = 0.3}};
  return options;
}

ExplicitBody branched_cube(const meshes::HexahedralMesh& mesh, const std::vector<MaxwellBranch>& branches) {
  ExplicitBodyOptions options = silicone_options(mesh);
  for (ExplicitRegion& region : options.regions) region.material.branches = branches;
  return {mesh, options};
}

TEST(MaxwellBranch, ResultsDoNotDependOnThreads) {
  const meshes::HexahedralMesh mesh = hollow_cube();
  const ExplicitBody body = branched_cube(mesh, three_branches);
  ExplicitOptions options = everything();
  ExplicitDynamics alone(mesh, body, options);
  ASSERT_EQ(alone.advance_to(0.004).status, io::RunStatus::completed);
  EXPECT_GT(alone.state().work.viscous_J, 0.0);
  for (const int threads : {2, 3}) {
    options.threads = threads;
    ExplicitDynamics many(mesh, body, options);
    ASSERT_EQ(many.advance_to(0.004).status, io::RunStatus::completed);
    EXPECT_EQ(many.state().displacements_m, alone.state().displacements_m);
    EXPECT_EQ(many.state().branches, alone.state().branches);
    EXPECT_EQ(many.state().work.viscous_J, alone.state().work.viscous_J);
  }
}

TEST(MaxwellBranch, GoesOnFromAStateAsIfNothingHadHappened) {
  const meshes::HexahedralMesh mesh = hollow_cube();
  const ExplicitBody body = branched_cube(mesh, three_branches);
  ExplicitDynamics first(mesh, body, everything());
  ASSERT_EQ(first.advance_to(0.0021).status, io::RunStatus::completed);
  const ExplicitState middle = first.state();
  EXPECT_GT(middle.branches->age_s, 0.0) << "between two relaxations";
  ASSERT_EQ(first.advance_to(0.004).status, io::RunStatus::completed);
  ExplicitDynamics second(mesh, body, everything());
  second.set_state(middle);
  ASSERT_EQ(second.advance_to(0.004).status, io::RunStatus::completed);
  EXPECT_EQ(first.state().displacements_m, second.state().displacements_m);
  EXPECT_EQ(first.state().branches, second.state().branches);
  EXPECT_EQ(first.energies().imbalance_J(), second.energies().imbalance_J());
}

// No branch, and one of no modulus, are the elastic body to the byte, which has no tensors.
TEST(MaxwellBranch, OfNoModulusIsNone) {
  const meshes::HexahedralMesh mesh = hollow_cube();
  const ExplicitBody elastic = branched_cube(mesh, {});
  const ExplicitBody weak = branched_cube(mesh, {{.shear_modulus_Pa = 0.0, .relaxation_time_s = 1e-3}});
  ExplicitDynamics without(mesh, elastic, everything());
  ExplicitDynamics with(mesh, weak, everything());
  ASSERT_EQ(without.advance_to(0.004).status, io::RunStatus::completed);
  ASSERT_EQ(with.advance_to(0.004).status, io::RunStatus::completed);
  EXPECT_EQ(without.state().displacements_m, with.state().displacements_m);
  EXPECT_EQ(without.state().steps, with.state().steps);
  EXPECT_TRUE(std::get<AlignedNumbers>(with.state().branches->numbers).empty());
}

TEST(MaxwellBranch, RefusesWhatNeverRelaxes) {
  const meshes::HexahedralMesh mesh = hollow_cube();
  using tests::message_of;
  EXPECT_NE(message_of([&] { branched_cube(mesh, {{.shear_modulus_Pa = -1.0}}); }).find("shear_modulus_Pa = -1"),
            std::string::npos);
  EXPECT_NE(message_of([&] { branched_cube(mesh, {{.shear_modulus_Pa = 1.0}}); }).find("relaxation_time_s = 0"),
            std::string::npos);
  EXPECT_NE(message_of([&] {
              branched_cube(mesh, {branch, branch, branch, branch});
            }).find("4 branches: at most 3"),
            std::string::npos);
}

// A branch that relaxes within some 15 steps is followed by steps that are shorter.
TEST(MaxwellBranch, ShortensStepsThatItsRelaxationNeeds) {
  const meshes::HexahedralMesh mesh = hollow_cube();
  const ExplicitBody slow = branched_cube(mesh, {{.shear_modulus_Pa = 1e4, .relaxation_time_s = 1e-2}});
  const ExplicitBody fast = branched_cube(mesh, {{.shear_modulus_Pa = 1e4, .relaxation_time_s = 1e-4}});
  ExplicitDynamics usual(mesh, slow, {});
  ExplicitDynamics short_steps(mesh, fast, {});
  ASSERT_EQ(usual.advance_to(0.001).status, io::RunStatus::completed);
  ASSERT_EQ(short_steps.advance_to(0.001).status, io::RunStatus::completed);
  EXPECT_GT(short_steps.state().steps, 2 * usual.state().steps);
  EXPECT_EQ(short_steps.state().steps, 125U) << "0.08 of the relaxation time each";
}

TEST(MaxwellBranch, RefusesToRelaxFasterThanStepsCanFollow) {
  const meshes::HexahedralMesh mesh = hollow_cube();
  const ExplicitBody body = branched_cube(mesh, {{.shear_modulus_Pa = 1e4, .relaxation_time_s = 1e-6}});
  const std::string message = tests::message_of([&] { ExplicitDynamics(mesh, body, {}); });
  EXPECT_NE(message.find("relaxes within 1e-06 s, which needs steps of "), std::string::npos) << message;
}

}  // namespace
}  // namespace menger::fem
