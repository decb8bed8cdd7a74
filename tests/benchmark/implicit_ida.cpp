// Implicit dynamics beside IDA of SUNDIALS: the same equations of motion of the driven module, by generalised alpha with its
// error control and by BDF of variable order and step, both with the factorisation of LinearSolver. Process CPU time, one thread.
//
// The error is the largest of the root mean square by mass of the displacements' difference to a run of generalised alpha at a
// thousandth of the default tolerance, over thirty times of the period. The last row of each case, `ratio`, is what this is for:
// the seconds of IDA, at the error of generalised alpha with the default tolerance, by those of generalised alpha.

#include <benchmark/benchmark.h>
#include <ida/ida.h>
#include <nvector/nvector_serial.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "fem/implicit/implicit_dynamics.h"
#include "fem/modes/mass_matrix.h"
#include "fem/space/parallel_session.h"
#include "fem/space/space_diameter.h"
#include "io/sundials/handle.h"
#include "meshes/hexahedra/hollow_polycube.h"

namespace fem = menger::fem;
namespace io = menger::io;
namespace materials = menger::materials;
namespace meshes = menger::meshes;

namespace {

constexpr double period_s = 1.0 / 3.0;
constexpr int samples = 30;
constexpr double viscosity_Pa_s = 10.0;
/// A walk whose steps have become so short does not exist in a time that matters.
constexpr long most_steps = 20'000;
/// Of velocities in IDA's norm, by that of displacements: so loose that displacements decide, as in generalised alpha.
constexpr double velocity_tolerance_per_s = 1e3;

struct Case {
  const char* name;
  double friction;
  double regularisation_speed_m_per_s;
};

/// The hollow cube of 20 mm of bench-implicit: walls of 2 mm, one element thick, elements of degree 1.
class Module {
 public:
  explicit Module(const Case& c)
      : mesh_(make_mesh()), body_(make_body(mesh_)), space_(fem::make_space(mesh_, 1, 0, MPI_COMM_SELF)), friction_(c) {}

  [[nodiscard]] const fem::Space& space() const { return space_; }
  [[nodiscard]] const fem::Body& body() const { return body_; }

  /// Friction by velocity, smooth but at its two kinks: IDA knows no nodes that stick.
  [[nodiscard]] fem::ImplicitOptions options(double tolerance) const {
    fem::ImplicitOptions options;
    options.schedules.assign(body_.plenum_count,
                             {fem::SinePressure{.low_Pa = 0.0, .high_Pa = 6e3, .frequency_Hz = 1.0 / period_s}});
    options.viscosities_Pa_s.assign(body_.regions.size(), viscosity_Pa_s);
    options.ground = fem::RigidGround{.height_m = 0.0,
                                      .stiffness_Pa_per_m = fem::ground_stiffness_Pa_per_m(2.5e6, 2e-3),
                                      .friction = {.static_coefficient = friction_.friction,
                                                   .kinetic_coefficient = friction_.friction,
                                                   .regularisation_speed_m_per_s = friction_.regularisation_speed_m_per_s}};
    options.tolerance = tolerance;
    return options;
  }

 private:
  static meshes::HexahedralMesh make_mesh() {
    meshes::HollowBodyOptions options;
    options.wall_thickness_m = 2e-3;
    return meshes::hollow_polycube(meshes::hollow_cube_design(20e-3), options).mesh;
  }

  static fem::Body make_body(const meshes::HexahedralMesh& mesh) {
    fem::Body body;
    body.regions.assign(mesh.region_names.size(), {materials::NeoHookean{50e3}, materials::SimoTaylorVolume{2.5e6}, 1070.0});
    for (const meshes::Chamber& chamber : mesh.chambers) body.chambers.push_back({chamber.labels, chamber.plenum});
    body.plenum_count = mesh.plenum_names.size();
    body.gravity_m_per_s2 = {0.0, 0.0, -9.81};
    return body;
  }

  meshes::HexahedralMesh mesh_;
  fem::Body body_;
  fem::Space space_;
  Case friction_;
};

/// What a run gave and what it cost.
struct Run {
  double cpu_s = 0.0;
  double reached_s = period_s;
  double steps = 0.0;
  double rejected = 0.0;
  double iterations = 0.0;
  double residuals = 0.0;  ///< of IDA; 0: not counted
  double factorisations = 0.0;
  std::vector<std::vector<double>> displacements_m{};  ///< at the sampled times
};

double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

Run run_alpha(const Module& module, double tolerance) {
  Run run;
  const double start = cpu_seconds();
  fem::ImplicitDynamics dynamics(module.space(), module.body(), module.options(tolerance));
  for (int n = 1; n <= samples; ++n) {
    const fem::ImplicitReport& report = dynamics.advance_to(n * period_s / samples);
    if (report.status != io::RunStatus::completed) throw std::runtime_error(report.reason);
    run.displacements_m.push_back(dynamics.state().displacements_m);
  }
  run.cpu_s = cpu_seconds() - start;
  run.steps = static_cast<double>(dynamics.state().steps);
  run.rejected = static_cast<double>(dynamics.state().rejected_steps);
  run.iterations = static_cast<double>(dynamics.state().iterations);
  run.factorisations = dynamics.factorisations();
  return run;
}

/// M v' + S(u, v, t) = 0 and u' = v, with y = (u, v): S of ImplicitDynamics, put together from its parts.
class FirstOrderMotion {
 public:
  FirstOrderMotion(const Module& module, const fem::ImplicitOptions& options)
      : body_(module.body()),
        options_(options),
        assembly_(module.space(), module.body()),
        viscosity_(module.space(), options.viscosities_Pa_s),
        contact_(assembly_, module.body(), *options.ground, 1.0),
        linear_(assembly_, {}),
        mass_(assembly_.make_matrix(true)),
        stiffness_(assembly_.make_matrix(true)),
        in_(linear_.make_vector()),
        out_(linear_.make_vector()),
        nodes_(contact_.free_nodes()),
        count_(3 * module.space().positions.size()) {
    fem::assemble_mass(assembly_, body_, mass_);
  }

  [[nodiscard]] std::size_t count() const { return count_; }

  int residual(double time_s, const double* y, const double* rate, double* result) {
    const std::span<const double> u(y, count_);
    const std::span<const double> v(y + count_, count_);
    const std::vector<double> pressures = pressures_at(time_s);
    force_.assign(count_, 0.0);
    assembly_.elements().forget_prediction();
    const fem::BodyTotals totals = assembly_.assemble(u, {.plenum_pressures_Pa = pressures}, force_, {}, nullptr);
    if (!(totals.smallest_ratio > 0.0) || !std::isfinite(totals.strain_energy_J)) return 1;  // a shorter step may do
    viscosity_.add_forces(u, v, force_);
    std::vector<fem::GroundNode> after = nodes_;
    contact_.add_forces({u, u, v, 0.0}, nodes_, after, force_);
    multiply(mass_, rate + count_);
    const fem::VectorReader inertia(out_);
    for (std::size_t n = 0; n < count_; ++n) {
      result[n] = rate[n] - v[n];
      result[count_ + n] = inertia[n] + force_[n];
    }
    return 0;
  }

  /// Of the Jacobian [c I, -I; K, c M + D] the matrix that is left of it for v, K + c D + c^2 M, symmetric like K.
  int assemble(double time_s, double c, const double* y) {
    const std::span<const double> u(y, count_);
    const std::span<const double> v(y + count_, count_);
    const std::vector<double> pressures = pressures_at(time_s);
    rate_per_s_ = c;
    assembly_.elements().forget_prediction();
    assembly_.assemble(u, {.plenum_pressures_Pa = pressures}, {}, {}, linear_.matrix());
    fem::petsc(MatCopy(linear_.matrix(), stiffness_, SAME_NONZERO_PATTERN));
    contact_.add_matrix({u, u, v, 0.0}, nodes_, stiffness_);
    fem::petsc(MatAssemblyBegin(stiffness_, MAT_FINAL_ASSEMBLY));
    fem::petsc(MatAssemblyEnd(stiffness_, MAT_FINAL_ASSEMBLY));
    viscosity_.add_matrix(assembly_, u, c, linear_.matrix());
    contact_.add_matrix({u, u, v, c}, nodes_, linear_.matrix());
    fem::add_mass(assembly_, body_, c * c, linear_.matrix());
    return 0;
  }

  int factorise() {
    ++factorisations_;
    return linear_.prepare() ? 0 : 1;
  }

  /// (K + c D + c^2 M) x_v = c b_v - K b_u, x_u = (b_u + x_v) / c
  int solve(const double* b, double* x) {
    multiply(stiffness_, b);
    {
      const fem::VectorReader by_displacement(out_);
      const fem::VectorWriter right(in_);
      for (std::size_t n = 0; n < count_; ++n) right[n] = rate_per_s_ * b[count_ + n] - by_displacement[n];
    }
    if (!linear_.solve(in_, out_)) return 1;
    const fem::VectorReader velocity(out_);
    for (std::size_t n = 0; n < count_; ++n) {
      x[n] = (b[n] + velocity[n]) / rate_per_s_;
      x[count_ + n] = velocity[n];
    }
    return 0;
  }

  [[nodiscard]] int factorisations() const { return factorisations_; }

 private:
  [[nodiscard]] std::vector<double> pressures_at(double time_s) const {
    std::vector<double> pressures;
    for (const fem::PlenumSchedule& schedule : options_.schedules) pressures.push_back(fem::pressure_Pa(schedule, time_s));
    return pressures;
  }

  void multiply(Mat matrix, const double* vector) {
    std::copy_n(vector, count_, fem::VectorWriter{in_}.data());
    fem::petsc(MatMult(matrix, in_, out_));
  }

  const fem::Body& body_;
  const fem::ImplicitOptions& options_;
  fem::Assembly assembly_;
  fem::ImplicitViscosity viscosity_;
  fem::ImplicitContact contact_;
  fem::LinearSolver linear_;
  fem::MatrixHandle mass_;
  fem::MatrixHandle stiffness_;
  fem::VectorHandle in_;
  fem::VectorHandle out_;
  std::vector<fem::GroundNode> nodes_;
  std::size_t count_;
  std::vector<double> force_;
  double rate_per_s_ = 0.0;
  int factorisations_ = 0;
};

FirstOrderMotion& motion_in(void* content) { return *static_cast<FirstOrderMotion*>(content); }

/// Its matrix is that of LinearSolver; IDA only decides when it is made anew.
io::SundialsMatrix custom_matrix(FirstOrderMotion& motion, SUNContext context) {
  auto matrix = io::sundials_made<io::SundialsMatrix>(SUNMatNewEmpty(context));
  matrix->content = &motion;
  matrix->ops->getid = [](SUNMatrix) { return SUNMATRIX_CUSTOM; };
  matrix->ops->zero = [](SUNMatrix) { return 0; };
  matrix->ops->destroy = [](SUNMatrix self) { SUNMatFreeEmpty(self); };
  return matrix;
}

io::SundialsLinearSolver custom_solver(FirstOrderMotion& motion, SUNContext context) {
  auto solver = io::sundials_made<io::SundialsLinearSolver>(SUNLinSolNewEmpty(context));
  solver->content = &motion;
  solver->ops->gettype = [](SUNLinearSolver) { return SUNLINEARSOLVER_DIRECT; };
  solver->ops->getid = [](SUNLinearSolver) { return SUNLINEARSOLVER_CUSTOM; };
  solver->ops->setup = [](SUNLinearSolver self, SUNMatrix) { return motion_in(self->content).factorise(); };
  solver->ops->solve = [](SUNLinearSolver self, SUNMatrix, N_Vector x, N_Vector b, realtype) {
    return motion_in(self->content).solve(N_VGetArrayPointer(b), N_VGetArrayPointer(x));
  };
  solver->ops->free = [](SUNLinearSolver self) {
    SUNLinSolFreeEmpty(self);
    return 0;
  };
  return solver;
}

int residual_of(realtype time_s, N_Vector y, N_Vector rate, N_Vector result, void* data) {
  return motion_in(data).residual(time_s, N_VGetArrayPointer(y), N_VGetArrayPointer(rate), N_VGetArrayPointer(result));
}

int jacobian_of(realtype time_s, realtype c, N_Vector y, N_Vector, N_Vector, SUNMatrix, void* data, N_Vector, N_Vector,
                N_Vector) {
  return motion_in(data).assemble(time_s, c, N_VGetArrayPointer(y));
}

void demand(int code, const char* what) {
  if (code < 0) throw std::runtime_error(std::string("IDA: ") + what + " (" + std::to_string(code) + ")");
}

/// At rest, with the accelerations that the forces give.
void start(const std::vector<double>& accelerations, std::size_t count, N_Vector y, N_Vector rate) {
  N_VConst(0.0, y);
  N_VConst(0.0, rate);
  std::copy_n(accelerations.begin(), count, N_VGetArrayPointer(rate) + count);
}

Run run_ida(const Module& module, double tolerance) {
  const fem::ImplicitOptions options = module.options(tolerance);
  const std::vector<double> accelerations =
      fem::ImplicitDynamics(module.space(), module.body(), options).state().accelerations_m_per_s2;
  Run run;
  const double start_s = cpu_seconds();
  FirstOrderMotion motion(module, options);
  const std::size_t count = motion.count();
  const io::SundialsContext context = io::make_sundials_context();
  const auto make_vector = [&] {
    return io::sundials_made<io::SundialsVector>(N_VNew_Serial(static_cast<sunindextype>(2 * count), context.get()));
  };
  const io::SundialsVector y = make_vector();
  const io::SundialsVector rate = make_vector();
  const io::SundialsVector tolerances = make_vector();
  start(accelerations, count, y.get(), rate.get());
  const double tolerance_m = tolerance * fem::diameter_m(module.space());
  for (std::size_t n = 0; n < 2 * count; ++n)
    N_VGetArrayPointer(tolerances.get())[n] = n < count ? tolerance_m : velocity_tolerance_per_s * tolerance_m;
  const io::SundialsMatrix matrix = custom_matrix(motion, context.get());
  const io::SundialsLinearSolver solver = custom_solver(motion, context.get());
  const auto ida = io::sundials_made<io::SundialsHandle<void*, IDAFree>>(IDACreate(context.get()));
  demand(IDASetErrHandlerFn(ida.get(), io::print_no_sundials_error, nullptr), "error handler");
  demand(IDAInit(ida.get(), residual_of, 0.0, y.get(), rate.get()), "start");
  demand(IDASVtolerances(ida.get(), 0.0, tolerances.get()), "tolerances");
  demand(IDASetUserData(ida.get(), &motion), "data");
  demand(IDASetLinearSolver(ida.get(), solver.get(), matrix.get()), "linear solver");
  demand(IDASetJacFn(ida.get(), jacobian_of), "Jacobian");
  demand(IDASetMaxNumSteps(ida.get(), most_steps), "limit of steps");
  for (int n = 1; n <= samples; ++n) {
    double reached_s = 0.0;
    const int code = IDASolve(ida.get(), n * period_s / samples, &reached_s, y.get(), rate.get(), IDA_NORMAL);
    if (code < 0) {
      IDAGetCurrentTime(ida.get(), &run.reached_s);
      break;
    }
    run.displacements_m.emplace_back(N_VGetArrayPointer(y.get()), N_VGetArrayPointer(y.get()) + count);
  }
  run.cpu_s = cpu_seconds() - start_s;
  const auto counted = [&](auto read) {
    long value = 0;
    demand(read(ida.get(), &value), "counts");
    return static_cast<double>(value);
  };
  run.steps = counted(IDAGetNumSteps);
  run.rejected = counted(IDAGetNumErrTestFails) + counted(IDAGetNumStepSolveFails);
  run.iterations = counted(IDAGetNumNonlinSolvIters);
  run.residuals = counted(IDAGetNumResEvals);
  run.factorisations = motion.factorisations();
  return run;
}

/// One case and what its rows share.
struct Comparison {
  explicit Comparison(const Case& c) : module(c), masses_kg(masses_of(module)) {}

  static std::vector<double> masses_of(const Module& module) {
    return fem::ImplicitDynamics(module.space(), module.body(), module.options(1.0)).masses_kg();
  }

  [[nodiscard]] double error_m(const Run& run) const {
    double largest = 0.0;
    for (std::size_t sample = 0; sample < run.displacements_m.size(); ++sample) {
      double square = 0.0;
      double mass_kg = 0.0;
      for (std::size_t n = 0; n < 3 * masses_kg.size(); ++n) {
        const double difference = run.displacements_m[sample][n] - reference->displacements_m[sample][n];
        square += masses_kg[n / 3] * difference * difference;
        mass_kg += masses_kg[n / 3] / 3.0;
      }
      largest = std::max(largest, std::sqrt(square / mass_kg));
    }
    return largest;
  }

  Module module;
  std::vector<double> masses_kg;
  std::optional<Run> reference;
  std::optional<Run> alpha;  ///< with the default tolerance
  std::vector<Run> ida;      ///< that reached the end, from loose to tight
};

void report(benchmark::State& state, const Comparison& comparison, const Run& run) {
  state.counters["seconds"] = run.cpu_s;
  state.counters["reached"] = run.reached_s / period_s;
  state.counters["steps"] = run.steps;
  state.counters["rejected"] = run.rejected;
  state.counters["iterations"] = run.iterations;
  if (run.residuals > 0.0) state.counters["residuals"] = run.residuals;
  state.counters["factorisations"] = run.factorisations;
  state.counters["error_um"] = 1e6 * comparison.error_m(run);
}

/// Seconds that IDA takes for an error, on the line through the two runs nearest to it in logarithms.
std::optional<double> seconds_of_ida(const Comparison& comparison, double error_m) {
  const std::vector<Run>& runs = comparison.ida;
  if (runs.size() < 2) return std::nullopt;
  std::size_t upper = 1;
  while (upper + 1 < runs.size() && comparison.error_m(runs[upper]) > error_m) ++upper;
  const double loose = std::log(comparison.error_m(runs[upper - 1]));
  const double tight = std::log(comparison.error_m(runs[upper]));
  const double part = (std::log(error_m) - loose) / (tight - loose);
  return std::exp((1.0 - part) * std::log(runs[upper - 1].cpu_s) + part * std::log(runs[upper].cpu_s));
}

void register_case(Comparison& comparison, const std::string& name) {
  constexpr double standard = fem::ImplicitOptions{}.tolerance;
  const auto add = [&](const std::string& row, const std::function<void(benchmark::State&)>& measure) {
    benchmark::RegisterBenchmark((name + "/" + row).c_str(),
                                 [measure](benchmark::State& state) {
                                   for (auto unused : state) {
                                     (void)unused;
                                     try {
                                       measure(state);
                                     } catch (const std::runtime_error& error) {
                                       state.SkipWithError(error.what());
                                     }
                                   }
                                 })
        ->Unit(benchmark::kSecond)
        ->MeasureProcessCPUTime()
        ->Iterations(1);
  };
  add("reference", [&](benchmark::State& state) {
    comparison.reference = run_alpha(comparison.module, 1e-3 * standard);
    report(state, comparison, *comparison.reference);
  });
  for (const double part : {1.0, 0.1, 0.01}) {
    add("alpha/tolerance " + std::to_string(part).substr(0, 4), [&, part](benchmark::State& state) {
      const Run run = run_alpha(comparison.module, part * standard);
      report(state, comparison, run);
      if (part == 1.0) comparison.alpha = run;
    });
    add("ida/tolerance " + std::to_string(part).substr(0, 4), [&, part](benchmark::State& state) {
      const Run run = run_ida(comparison.module, part * standard);
      report(state, comparison, run);
      if (run.reached_s == period_s) comparison.ida.push_back(run);
    });
  }
  add("ratio", [&](benchmark::State& state) {
    const std::optional<double> seconds = seconds_of_ida(comparison, comparison.error_m(*comparison.alpha));
    if (!seconds) throw std::runtime_error("IDA did not reach the end of the period");
    state.counters["ida_by_alpha"] = *seconds / comparison.alpha->cpu_s;
  });
}

}  // namespace

int main(int argc, char** argv) {
  const fem::ParallelSession session(argc, argv);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  std::vector<std::unique_ptr<Comparison>> comparisons;
  for (const Case& c :
       {Case{"no friction", 0.0, 1.0}, Case{"friction from 50 mm/s", 0.5, 0.05}, Case{"friction from 1 mm/s", 0.5, 0.001}}) {
    comparisons.push_back(std::make_unique<Comparison>(c));
    register_case(*comparisons.back(), c.name);
  }
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
