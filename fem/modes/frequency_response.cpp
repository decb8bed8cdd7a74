#include "fem/modes/frequency_response.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <utility>

namespace menger::fem {

namespace {

using Complex = std::complex<double>;

/// Smallest relative distance from an undamped natural frequency at which an amplitude is given.
constexpr double smallest_detuning = 1e-9;

constexpr int correction_terms = 3;

double dot_of_owned(const Space& space, std::span<const double> a, std::span<const double> b) {
  double sum = 0.0;
  for (std::size_t n = 0; n < 3 * static_cast<std::size_t>(space.owned_count); ++n) sum += a[n] * b[n];
  MPI_Allreduce(MPI_IN_PLACE, &sum, 1, MPI_DOUBLE, MPI_SUM, space.communicator);
  return sum;
}

/// The contribution of a mode to an observable: the product of the mode with load and observable, and its omega^2.
struct ModeShare {
  double weight;
  double eigenvalue;
};

/// The response of an observable as a function of frequency.
struct Superposition {
  double shift;
  /// Coefficients of the powers of z - shift: the contribution of the modes that are not given.
  std::vector<double> others{};
  std::vector<ModeShare> modes{};

  [[nodiscard]] std::optional<Complex> at(double eigenvalue, double loss_factor) const {
    const Complex damped(1.0, loss_factor);
    const Complex z = eigenvalue / damped;
    Complex amplitude = 0.0;
    for (auto coefficient = others.rbegin(); coefficient != others.rend(); ++coefficient)
      amplitude = amplitude * (z - shift) + *coefficient;
    for (const ModeShare& mode : modes) {
      const Complex difference = mode.eigenvalue - z;
      if (std::abs(difference) <= 2.0 * smallest_detuning * mode.eigenvalue) return std::nullopt;
      amplitude += mode.weight / difference;
    }
    return amplitude / damped;
  }
};

double eigenvalue_of(double frequency_Hz) {
  const double omega = 2.0 * std::numbers::pi * frequency_Hz;
  return omega * omega;
}

/// Removes vectors that are orthonormal in the mass from a vector.
class Projection {
 public:
  explicit Projection(const LinearisedBody& body) : mass_(body.mass()), product_(body.make_vector()) {}

  void add(VectorHandle direction) { directions_.push_back(std::move(direction)); }
  void apply(Vec x) const {
    for (const VectorHandle& direction : directions_) {
      double part = 0.0;
      petsc(MatMult(mass_, direction, product_));
      petsc(VecDot(product_, x, &part));
      petsc(VecAXPY(x, -part, direction));
    }
  }

 private:
  Mat mass_;
  VectorHandle product_;
  std::vector<VectorHandle> directions_;
};

/// Returns (A^-1 M)^m P A^-1 f, m = 0, 1, 2, as fields; nothing if a system could not be solved.
std::optional<std::vector<std::vector<double>>> responses_of_others(LinearisedBody& body, const VibrationReport& modes,
                                                                    std::span<const double> load) {
  Projection projection(body);
  for (VectorHandle& motion : body.free_rigid_motions()) projection.add(std::move(motion));
  for (const std::vector<double>& mode : modes.modes) projection.add(body.vector_of(mode));
  VectorHandle force = body.vector_of(load);
  const VectorHandle response = body.make_vector();
  std::vector<std::vector<double>> responses;
  for (int term = 0; term < correction_terms; ++term) {
    if (!body.solve(force, response)) return std::nullopt;
    projection.apply(response);  // again in every term, because rounding grows along the lowest modes
    responses.push_back(body.field_of(response));
    petsc(MatMult(body.mass(), response, force));
  }
  return responses;
}

}  // namespace

FrequencyResponse frequency_response(LinearisedBody& body, const VibrationReport& modes, std::span<const double> load,
                                     std::span<const std::vector<double>> observables, const FrequencyResponseOptions& options) {
  assert(options.loss_factor >= 0.0);
  assert(std::all_of(options.frequencies_Hz.begin(), options.frequencies_Hz.end(), [](double f) { return f >= 0.0; }));
  FrequencyResponse response;
  if (modes.status != io::RunStatus::completed) {
    response.status = modes.status;
    response.reason = modes.reason;
    return response;
  }
  const Space& space = body.assembly().space();
  const auto others = responses_of_others(body, modes, load);
  if (!others) {
    response.reason = "the static response to the load was not found";
    return response;
  }
  const double highest_Hz = modes.frequencies_Hz.empty() ? 0.0 : modes.frequencies_Hz.back();
  for (const std::vector<double>& observable : observables) {
    Superposition superposition{.shift = body.shift()};
    for (const std::vector<double>& field : *others) superposition.others.push_back(dot_of_owned(space, observable, field));
    for (std::size_t k = 0; k < modes.modes.size(); ++k) {
      superposition.modes.push_back({dot_of_owned(space, observable, modes.modes[k]) * dot_of_owned(space, modes.modes[k], load),
                                     eigenvalue_of(modes.frequencies_Hz[k])});
    }
    auto& amplitudes = response.amplitudes.emplace_back();
    for (const double frequency_Hz : options.frequencies_Hz) {
      const bool is_covered = frequency_Hz < highest_Hz;
      amplitudes.push_back(is_covered ? superposition.at(eigenvalue_of(frequency_Hz), options.loss_factor) : std::nullopt);
    }
  }
  response.status = io::RunStatus::completed;
  return response;
}

}  // namespace menger::fem
