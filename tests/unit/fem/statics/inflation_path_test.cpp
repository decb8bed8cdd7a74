#include "fem/statics/inflation_path.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>

#include "meshes/hexahedra/verification_shapes.h"
#include "tests/unit/fem/statics/body_samples.h"

namespace menger::fem {
namespace {

/// A body with its solver, and what its paths have seen.
class PathRun {
 public:
  PathRun(const meshes::HexahedralMesh& mesh, const Body& body, int degree = 1, const EquilibriumOptions& options = {})
      : space_(make_space(mesh, degree, 0, MPI_COMM_SELF)), body_(body), equilibrium_(space_, body_, options) {}

  PathReport follow(const PlenumDrive& drive, const PathOptions& options, const PathRestart* restart = nullptr) {
    return follow_path(
        equilibrium_, {drive}, options,
        [this](const PathPoint& point, const BodyState& state, const PathRestart& next) {
          states.push_back(state);
          restarts.push_back(next);
          if (point.step == stop_at_step) stop = true;
        },
        &stop, restart);
  }

  [[nodiscard]] Equilibrium& equilibrium() { return equilibrium_; }

  std::vector<BodyState> states;
  std::vector<PathRestart> restarts;
  std::atomic<bool> stop = false;
  int stop_at_step = -1;

 private:
  Space space_;
  Body body_;
  Equilibrium equilibrium_;
};

PlenumDrive pressure_drive(const std::vector<double>& values_Pa) { return {.kind = DriveKind::pressure, .values = values_Pa}; }
PlenumDrive volume_drive(const std::vector<double>& ratios) { return {.kind = DriveKind::volume, .values = ratios}; }

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  EXPECT_EQ(a.size(), b.size());
  double largest = 0.0;
  for (std::size_t n = 0; n < a.size(); ++n) largest = std::max(largest, std::abs(a[n] - b[n]));
  return largest;
}

bool has_point_at(const PathReport& report, double s) {
  return std::any_of(report.points.begin(), report.points.end(), [s](const PathPoint& point) { return point.s == s; });
}

/// Gauge pressure in an incompressible neo-Hookean thick sphere whose inner radius is stretched by `inner`: with x(l) = 4/l +
/// 1/l^4, p = mu/2 (x(outer) - x(inner)), the outer stretch following from the constant volume of the wall.
double sphere_pressure_Pa(double shear_modulus_Pa, double radius_ratio, double inner) {
  const double outer = std::cbrt(1.0 + (inner * inner * inner - 1.0) / (radius_ratio * radius_ratio * radius_ratio));
  const auto x = [](double stretch) { return 4.0 / stretch + std::pow(stretch, -4.0); };
  return 0.5 * shear_modulus_Pa * (x(outer) - x(inner));
}

/// The largest pressure of that sphere and the stretch there, by a search over the stretch.
std::array<double, 2> sphere_limit(double shear_modulus_Pa, double radius_ratio) {
  std::array<double, 2> best{0.0, 1.0};
  for (double inner = 1.0; inner < 3.0; inner += 1e-4) {
    const double pressure_Pa = sphere_pressure_Pa(shear_modulus_Pa, radius_ratio, inner);
    if (pressure_Pa > best[0]) best = {pressure_Pa, inner};
  }
  return best;
}

constexpr double sphere_inner_m = 10e-3;
constexpr double sphere_outer_m = 15e-3;
constexpr double sphere_modulus_Pa = 50e3;

meshes::HexahedralMesh sphere() { return meshes::thick_sphere_octant(sphere_inner_m, sphere_outer_m, 1, 2); }

Body sphere_body(const meshes::HexahedralMesh& mesh) {
  const auto label = [&](const char* name) {
    return static_cast<std::size_t>(std::find(mesh.label_names.begin(), mesh.label_names.end(), name) - mesh.label_names.begin());
  };
  Body body = quarter_body(materials::NeoHookean{sphere_modulus_Pa});
  body.regions[0].volume = materials::SimoTaylorVolume{1e8};  // the closed form is that of an incompressible wall
  body.chambers = {{{label("chamber 0")}, 0}};
  body.supports = {{label("symmetry x"), {true, false, false}},
                   {label("symmetry y"), {false, true, false}},
                   {label("symmetry z"), {false, false, true}}};
  return body;
}

TEST(InflationPath, MeetsStationsAndKnotsExactly) {
  PathRun run(hollow_cube_quarter(), quarter_body());
  PathOptions options;
  options.stations = {0.3, 0.77, 1.5};
  const PathReport report = run.follow(pressure_drive({0.0, 5e3, 8e3}), options);
  EXPECT_EQ(report.status, io::RunStatus::completed) << report.reason;
  for (const double s : {0.0, 0.3, 0.77, 1.0, 1.5, 2.0}) EXPECT_TRUE(has_point_at(report, s)) << s;
  for (std::size_t n = 0; n < report.points.size(); ++n) {
    const PathPoint& point = report.points[n];
    EXPECT_EQ(point.step, static_cast<int>(n));
    if (n > 0) {
      EXPECT_GT(point.s, report.points[n - 1].s);
    }
    const double given_Pa = point.s < 1.0 ? 5e3 * point.s : 5e3 + 3e3 * (point.s - 1.0);
    EXPECT_NEAR(point.pressures_Pa[0], given_Pa, 1e-9);
    EXPECT_GT(point.smallest_ratio, 0.9);
  }
  EXPECT_EQ(run.states.size(), report.points.size());
}

TEST(InflationPath, StartsAtRest) {
  PathRun run(hollow_cube_quarter(), quarter_body(), 2);
  const PathReport report = run.follow(pressure_drive({0.0, 1e3}), {});
  ASSERT_EQ(report.status, io::RunStatus::completed) << report.reason;
  const PathPoint& first = report.points.front();
  EXPECT_EQ(first.s, 0.0);
  EXPECT_EQ(first.pressures_Pa[0], 0.0);
  EXPECT_NEAR(first.plenum_volumes_m3[0], 2e-3 * 2e-3 * 4e-3, 1e-20);
  EXPECT_LT(first.strain_energy_J, 1e-30);  // rounding
  for (const double u : run.states.front().displacements_m) EXPECT_EQ(u, 0.0);
}

// Up and down again: an elastic body ends at rest, and the pressures have done no work. Tolerance of the displacement: what the
// tolerance of forces, 1e-7 of the smallest load counted, allows.
TEST(InflationPath, ReturnsToRest) {
  PathRun run(hollow_cube_quarter(), quarter_body());
  const PathReport report = run.follow(pressure_drive({0.0, 8e3, 0.0}), {});
  ASSERT_EQ(report.status, io::RunStatus::completed) << report.reason;
  double largest = 0.0;
  for (const double u : run.states.back().displacements_m) largest = std::max(largest, std::abs(u));
  EXPECT_LT(largest, 1e-8);
  EXPECT_NEAR(report.points.back().strain_energy_J, 0.0, 1e-14);
  EXPECT_TRUE(report.limit_points.empty());
}

// Work of the pressure is stored as strain energy. The trapezoidal rule is of second order: with half the steps a quarter is
// left.
TEST(InflationPath, WorkOfThePressureIsTheStrainEnergy) {
  std::vector<double> errors;
  for (const double step : {0.2, 0.1}) {
    PathRun run(hollow_cube_quarter(), quarter_body());
    PathOptions options;
    options.first_step = options.largest_step = step;
    options.desired_iterations = 100;
    const PathReport report = run.follow(pressure_drive({0.0, 1.2e4}), options);
    ASSERT_EQ(report.status, io::RunStatus::completed) << report.reason;
    const PathPoint& last = report.points.back();
    errors.push_back((last.work_J - last.strain_energy_J) / last.strain_energy_J);
  }
  EXPECT_LT(std::abs(errors[0]), 0.02);
  EXPECT_NEAR(errors[0] / errors[1], 4.0, 0.5);
}

TEST(InflationPath, EveryDriveReachesTheSameStates) {
  PathRun by_pressure(hollow_cube_quarter(), quarter_body());
  const PathReport pressure = by_pressure.follow(pressure_drive({0.0, 8e3}), {});
  ASSERT_EQ(pressure.status, io::RunStatus::completed) << pressure.reason;
  const double rest_m3 = pressure.points.front().plenum_volumes_m3[0];
  const double end_m3 = pressure.points.back().plenum_volumes_m3[0];

  PathRun by_volume(hollow_cube_quarter(), quarter_body());
  const PathReport volume = by_volume.follow(volume_drive({1.0, end_m3 / rest_m3}), {});
  ASSERT_EQ(volume.status, io::RunStatus::completed) << volume.reason;
  EXPECT_NEAR(volume.points.back().pressures_Pa[0], 8e3, 1e-3);
  EXPECT_LT(largest_difference(by_volume.states.back().displacements_m, by_pressure.states.back().displacements_m), 1e-10);

  // P V = a P0 V0
  const double amount = (standard_atmosphere_Pa + 8e3) * end_m3 / (standard_atmosphere_Pa * rest_m3);
  PathRun by_gas(hollow_cube_quarter(), quarter_body());
  const PathReport gas = by_gas.follow({.kind = DriveKind::gas, .values = {1.0, amount}}, {});
  ASSERT_EQ(gas.status, io::RunStatus::completed) << gas.reason;
  EXPECT_NEAR(gas.points.back().pressures_Pa[0], 8e3, 1e-3);
  for (const PathPoint& point : gas.points) {
    const double part = 1.0 + (amount - 1.0) * point.s;
    const double product = (standard_atmosphere_Pa + point.pressures_Pa[0]) * point.plenum_volumes_m3[0];
    EXPECT_NEAR(product / (part * standard_atmosphere_Pa * rest_m3), 1.0, 1e-8);
  }
}

// The first step under control by volume has no pressure to start from.
TEST(InflationPath, BeginsUnderControlByVolume) {
  for (const int degree : {1, 2}) {
    PathRun run(hollow_cube_quarter(), quarter_body(), degree);
    PathOptions options;
    options.first_step = options.largest_step = 1.0;
    const PathReport report = run.follow(volume_drive({1.0, 1.1}), options);
    ASSERT_EQ(report.status, io::RunStatus::completed) << report.reason;
    ASSERT_EQ(report.points.size(), 2U);
    EXPECT_EQ(report.rejected_steps, 0);
    EXPECT_GT(report.points[1].pressures_Pa[0], 0.0);
    EXPECT_NEAR(report.points[1].plenum_volumes_m3[0] / report.points[0].plenum_volumes_m3[0], 1.1, 1e-8);
  }
}

// Few iterations do not reach so high a pressure from rest; shorter steps get there, and to the same state.
TEST(InflationPath, CutsStepsBackUntilTheySucceed) {
  EquilibriumOptions few;
  few.largest_iteration_count = 6;
  PathRun run(hollow_cube_quarter(), quarter_body(), 2, few);
  PathOptions options;
  options.first_step = options.largest_step = 1.0;
  const PathReport report = run.follow(pressure_drive({0.0, 3.5e4}), options);
  ASSERT_EQ(report.status, io::RunStatus::completed) << report.reason;
  EXPECT_GT(report.rejected_steps, 0);
  EXPECT_GT(report.points.size(), 2U);
  EXPECT_EQ(report.points.back().s, 1.0);

  PathRun careful(hollow_cube_quarter(), quarter_body(), 2);
  options.first_step = options.largest_step = 0.1;
  const PathReport reference = careful.follow(pressure_drive({0.0, 3.5e4}), options);
  ASSERT_EQ(reference.status, io::RunStatus::completed) << reference.reason;
  EXPECT_NEAR(report.points.back().strain_energy_J / reference.points.back().strain_energy_J, 1.0, 1e-6);
}

// Twelve quadratic elements to the octant are well within 0.5 % of the closed form.
TEST(InflationPath, EndsAtTheLimitPointUnderControlByPressure) {
  const auto [limit_Pa, stretch] = sphere_limit(sphere_modulus_Pa, sphere_outer_m / sphere_inner_m);
  const meshes::HexahedralMesh mesh = sphere();
  PathRun run(mesh, sphere_body(mesh), 2);
  const PathReport report = run.follow(pressure_drive({0.0, 2.0 * limit_Pa}), {});
  EXPECT_EQ(report.status, io::RunStatus::limit_point) << report.reason;
  EXPECT_FALSE(report.reason.empty());
  EXPECT_LT(report.points.back().pressures_Pa[0], 1.01 * limit_Pa);
  ASSERT_EQ(report.limit_points.size(), 1U);
  const LimitPoint& limit = report.limit_points[0];
  EXPECT_EQ(limit.plenum, 0U);
  EXPECT_FALSE(limit.passed);
  EXPECT_NEAR(limit.pressure_Pa / limit_Pa, 1.0, 0.005);
  EXPECT_NEAR(std::cbrt(limit.volume_m3 / report.points.front().plenum_volumes_m3[0]), stretch, 0.05);
  EXPECT_GE(limit.pressure_Pa, report.points.back().pressures_Pa[0]);
  for (const PathPoint& point : report.points) EXPECT_EQ(point.negative_pivots.value_or(0), 0);
}

// Beyond its limit a sphere is in equilibrium, but not in a stable one. At the same pressure the search has nothing to do, and
// needs no factorisation that would tell.
TEST(InflationPath, TellsAnUnstableStateAlsoWhereTheSearchNeedsNoFactorisation) {
  const meshes::HexahedralMesh mesh = sphere();
  PathRun run(mesh, sphere_body(mesh));
  const PathReport beyond = run.follow(volume_drive({1.0, 20.0}), {});
  ASSERT_EQ(beyond.status, io::RunStatus::completed) << beyond.reason;
  ASSERT_EQ(beyond.limit_points.size(), 1U);
  PathPoint point = beyond.points.back();
  point.s = 0.0;
  const double pressure_Pa = point.pressures_Pa[0];
  ASSERT_LT(pressure_Pa, beyond.limit_points[0].pressure_Pa);
  const PathRestart restart{.s = {0.0}, .states = {run.states.back()}, .points = {point}, .next_step = 1.0};
  const PathReport held = run.follow(pressure_drive({pressure_Pa, pressure_Pa}), {}, &restart);
  EXPECT_EQ(held.status, io::RunStatus::limit_point) << held.reason;
}

TEST(InflationPath, PassesTheLimitPointUnderControlByVolume) {
  const auto [limit_Pa, stretch] = sphere_limit(sphere_modulus_Pa, sphere_outer_m / sphere_inner_m);
  const meshes::HexahedralMesh mesh = sphere();
  PathRun run(mesh, sphere_body(mesh), 2);
  PathOptions options;
  options.largest_step = 0.05;
  const PathReport report = run.follow(volume_drive({1.0, 10.0}), options);
  ASSERT_EQ(report.status, io::RunStatus::completed) << report.reason;
  ASSERT_EQ(report.limit_points.size(), 1U);
  const LimitPoint& limit = report.limit_points[0];
  EXPECT_TRUE(limit.passed);
  EXPECT_NEAR(limit.pressure_Pa / limit_Pa, 1.0, 0.005);
  EXPECT_NEAR(std::cbrt(limit.volume_m3 / report.points.front().plenum_volumes_m3[0]), stretch, 0.05);
  const double last = std::cbrt(10.0);
  EXPECT_NEAR(report.points.back().pressures_Pa[0] / sphere_pressure_Pa(sphere_modulus_Pa, 1.5, last), 1.0, 0.005);
}

TEST(InflationPath, EndsWhereWallsTouchUnderVacuum) {
  PathRun run(flat_box_quarter(), quarter_body(), 2);
  PathOptions options;
  options.first_step = options.largest_step = 0.1;
  const PathReport report = run.follow(pressure_drive({0.0, -2e4}), options);
  EXPECT_EQ(report.status, io::RunStatus::wall_contact) << report.reason;
  EXPECT_FALSE(report.reason.empty());
  const PathPoint& last = report.points.back();
  EXPECT_LT(last.s, 1.0);
  ASSERT_TRUE(last.smallest_gap_m);
  EXPECT_GE(*last.smallest_gap_m, 0.0);
  EXPECT_LT(*last.smallest_gap_m, 0.3e-3);  // of 3 mm at rest
  for (std::size_t n = 2; n < report.points.size(); ++n)
    EXPECT_LT(*report.points[n].smallest_gap_m, *report.points[n - 1].smallest_gap_m);
}

TEST(InflationPath, DoesNotLookForContactIfNotAsked) {
  PathRun run(flat_box_quarter(), quarter_body(), 2);
  PathOptions options;
  options.touching_gap = 0.0;
  const PathReport report = run.follow(pressure_drive({0.0, -2e2}), options);
  EXPECT_EQ(report.status, io::RunStatus::completed) << report.reason;
  for (const PathPoint& point : report.points) EXPECT_FALSE(point.smallest_gap_m);
}

TEST(InflationPath, StopsWhenAskedAndKeepsItsPoints) {
  PathRun run(hollow_cube_quarter(), quarter_body());
  run.stop_at_step = 2;
  PathOptions options;
  options.largest_step = 0.1;
  const PathReport report = run.follow(pressure_drive({0.0, 8e3}), options);
  EXPECT_EQ(report.status, io::RunStatus::stopped);
  EXPECT_EQ(report.points.size(), 3U);
  EXPECT_FALSE(report.reason.empty());
}

TEST(InflationPath, EndsWhereItIsTold) {
  PathRun run(hollow_cube_quarter(), quarter_body());
  PathOptions options;
  options.largest_step = 0.1;
  options.ends_at = [](const PathPoint& point, const std::vector<LimitPoint>&) { return point.pressures_Pa[0] >= 2e3; };
  const PathReport report = run.follow(pressure_drive({0.0, 8e3}), options);
  EXPECT_EQ(report.status, io::RunStatus::completed) << report.reason;
  ASSERT_GE(report.points.size(), 2U);
  EXPECT_GE(report.points.back().pressures_Pa[0], 2e3);
  EXPECT_LT(report.points.back().s, 1.0);
  EXPECT_LT(report.points[report.points.size() - 2].pressures_Pa[0], 2e3);
}

// From rest on no residual is as small as this, so that every step is rejected, and none is too small to be tried.
TEST(InflationPath, IsStoppedBetweenStepsThatAreRejected) {
  PathRun rest(hollow_cube_quarter(), quarter_body());
  ASSERT_FALSE(rest.follow(volume_drive({1.0, 1.01}), {}).points.empty());
  EquilibriumOptions never;
  never.largest_iteration_count = 1;
  never.relative_force_tolerance = 1e-300;
  PathRun run(hollow_cube_quarter(), quarter_body(), 1, never);
  PathOptions options;
  options.smallest_step = 0.0;
  options.ends_at = [](const PathPoint&, const std::vector<LimitPoint>&) { return true; };
  std::thread user([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    run.stop = true;
  });
  const PathReport report = run.follow(volume_drive({1.0, 40.0}), options, &rest.restarts.front());
  user.join();
  EXPECT_EQ(report.status, io::RunStatus::stopped);
  EXPECT_GT(report.rejected_steps, 0);
  EXPECT_EQ(report.points.size(), 1U) << "the one at rest";
}

void expect_same_points(const PathReport& report, const PathReport& whole) {
  EXPECT_EQ(report.status, whole.status);
  EXPECT_EQ(report.reason, whole.reason);
  ASSERT_EQ(report.points.size(), whole.points.size());
  for (std::size_t n = 0; n < whole.points.size(); ++n) {
    const PathPoint& a = report.points[n];
    const PathPoint& b = whole.points[n];
    EXPECT_NEAR(a.s, b.s, 1e-12) << n;
    EXPECT_EQ(a.step, b.step);
    EXPECT_NEAR(a.pressures_Pa[0], b.pressures_Pa[0], 1e-9 * std::abs(b.pressures_Pa[0])) << n;
    EXPECT_NEAR(a.plenum_volumes_m3[0], b.plenum_volumes_m3[0], 1e-9 * b.plenum_volumes_m3[0]) << n;
    EXPECT_NEAR(a.strain_energy_J, b.strain_energy_J, 1e-9 * std::abs(b.strain_energy_J)) << n;
    EXPECT_NEAR(a.work_J, b.work_J, 1e-9 * std::abs(b.work_J)) << n;
    EXPECT_EQ(a.iterations, b.iterations) << n;
  }
  ASSERT_EQ(report.limit_points.size(), whole.limit_points.size());
  for (std::size_t n = 0; n < whole.limit_points.size(); ++n)
    EXPECT_NEAR(report.limit_points[n].pressure_Pa, whole.limit_points[n].pressure_Pa, 1e-9 * whole.limit_points[n].pressure_Pa);
}

// Wherever the first run was interrupted, its continuation by a new program goes through the points of a run that was not.
TEST(InflationPath, ContinuesAfterAnInterruptionAsIfThereHadBeenNone) {
  PathOptions options;
  options.first_step = 0.05;
  options.stations = {0.4};
  for (const PlenumDrive& drive : {pressure_drive({0.0, 1.5e4, 5e3}), volume_drive({1.0, 6.0})}) {
    PathRun first(hollow_cube_quarter(), quarter_body());
    const PathReport whole = first.follow(drive, options);
    ASSERT_EQ(whole.status, io::RunStatus::completed) << whole.reason;
    ASSERT_GT(first.restarts.size(), 4U);
    for (const std::size_t interruption : {std::size_t{0}, std::size_t{1}, std::size_t{3}, first.restarts.size() - 1}) {
      PathRun second(hollow_cube_quarter(), quarter_body());
      const PathReport continued = second.follow(drive, options, &first.restarts[interruption]);
      SCOPED_TRACE("interrupted after point " + std::to_string(interruption));
      expect_same_points(continued, whole);
    }
  }
}

TEST(InflationPath, ContinuesToItsLimitPointWithTheSameReason) {
  const meshes::HexahedralMesh mesh = sphere();
  const double limit_Pa = sphere_limit(sphere_modulus_Pa, sphere_outer_m / sphere_inner_m)[0];
  const PlenumDrive drive = pressure_drive({0.0, 2.0 * limit_Pa});
  PathRun first(mesh, sphere_body(mesh));
  const PathReport whole = first.follow(drive, {});
  ASSERT_EQ(whole.status, io::RunStatus::limit_point) << whole.reason;
  for (const PathRestart& restart : first.restarts) {
    PathRun second(mesh, sphere_body(mesh));
    expect_same_points(second.follow(drive, {}, &restart), whole);
  }
}

TEST(InflationPath, TheSameRunTwiceGivesTheSameNumbers) {
  PathRun run(hollow_cube_quarter(), quarter_body());
  const PathReport first = run.follow(pressure_drive({0.0, 1.5e4}), {});
  const std::vector<double> first_end = run.states.back().displacements_m;
  const PathReport second = run.follow(pressure_drive({0.0, 1.5e4}), {});
  expect_same_points(second, first);
  EXPECT_EQ(run.states.back().displacements_m, first_end);
}

TEST(InflationPath, BodyThatIsNotHeldIsToldSo) {
  Body body = quarter_body();
  body.supports.clear();
  PathRun run(hollow_cube(), body);
  PathOptions options;
  options.smallest_step = 0.1;
  const PathReport report = run.follow(volume_drive({1.0, 1.5}), options);
  EXPECT_EQ(report.status, io::RunStatus::not_converged);
  EXPECT_NE(report.reason.find("held"), std::string::npos) << report.reason;
}

// One stride to five times the volume is too long for a law that locks at I1 = 3.1, and shorter ones are not allowed.
TEST(InflationPath, LawWithoutAnAnswerEndsWithItsStatus) {
  PathRun run(hollow_cube_quarter(), quarter_body(materials::Gent{50e3, 0.1}));
  PathOptions options;
  options.first_step = options.largest_step = 1.0;
  options.smallest_step = 0.6;
  const PathReport report = run.follow(volume_drive({1.0, 5.0}), options);
  EXPECT_TRUE(report.status == io::RunStatus::inverted_element || report.status == io::RunStatus::not_converged)
      << to_string(report.status);
  EXPECT_FALSE(report.reason.empty());
  EXPECT_TRUE(report.limit_points.empty());
  EXPECT_EQ(report.points.size(), 1U);
  for (const PathPoint& point : report.points) {
    EXPECT_GT(point.smallest_ratio, 0.0);
    EXPECT_TRUE(std::isfinite(point.strain_energy_J));
  }
}

// The weight is taken up first, at zero pressure; its work is counted apart.
TEST(InflationPath, TakesUpDeadLoadsBeforeThePressure) {
  Body body = quarter_body();
  body.gravity_m_per_s2 = {0.0, 0.0, -9.81};
  PathRun run(hollow_cube_quarter(), body);
  const PathReport report = run.follow(pressure_drive({0.0, 5e3}), {});
  ASSERT_EQ(report.status, io::RunStatus::completed) << report.reason;
  ASSERT_TRUE(has_point_at(report, 0.0));
  for (const PathPoint& point : report.points) {
    if (point.s > 0.0) continue;
    EXPECT_EQ(point.pressures_Pa[0], 0.0);
    EXPECT_EQ(point.work_J, 0.0);
  }
  const auto start =
      std::find_if(report.points.begin(), report.points.end(), [](const PathPoint& point) { return point.s == 0.0; });
  EXPECT_GT(start->dead_load_work_J, 0.0);
  // nearly linear: the work of a load that grows from zero is half of what it would do at full size
  EXPECT_NEAR(start->strain_energy_J / (0.5 * start->dead_load_work_J), 1.0, 0.01);
}

// Where the pressure has come to rest, a step of the dead load that fails says nothing about the pressure's limit, however near.
TEST(InflationPath, TakesAFailedStepOfOneLegForNoLimitOfTheLegBefore) {
  EquilibriumOptions few;
  few.largest_iteration_count = 6;
  Body body = quarter_body();
  body.tractions = {{z_max, {0.0, 0.0, -2e4}}};
  Space space = make_space(hollow_cube_quarter(), 2, 0, MPI_COMM_SELF);
  Equilibrium equilibrium(space, body, few);
  PathOptions options;
  options.first_step = options.largest_step = 1.0;
  options.stations = {0.8, 0.85, 0.9, 0.95};  // states near enough to one another to see the limit 0.2 % ahead of the last one
  const PathDrives drives{.plena = {pressure_drive({0.0, 3.5e4, 3.5e4})}, .plates = {}, .dead_load_factors = {0.0, 0.0, 1.0}};
  const PathReport report = follow_path(equilibrium, drives, options, {});
  EXPECT_EQ(report.status, io::RunStatus::completed) << report.reason;
  EXPECT_EQ(report.points.back().s, 2.0);
  int points_on_the_second_leg = 0;
  for (const PathPoint& point : report.points) points_on_the_second_leg += point.s > 1.0 ? 1 : 0;
  EXPECT_GT(points_on_the_second_leg, 1) << "a step was cut back";
}

}  // namespace
}  // namespace menger::fem
