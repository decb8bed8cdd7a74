#include "fem/explicit/material_damping.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace menger::fem {
namespace {

/// The fastest branch over the highest frequency of the data.
constexpr double fastest_over_highest = 1.5;

/// Returns relaxation times of branches for data of several frequencies.
std::vector<double> relaxation_times_s(const std::vector<materials::LossPoint>& points) {
  const std::size_t count = std::min(points.size(), most_branches);
  const double lowest_Hz = points.front().frequency_Hz;
  const double highest_Hz = fastest_over_highest * points.back().frequency_Hz;
  std::vector<double> times_s;
  for (std::size_t k = 0; k < count; ++k) {
    const double share = static_cast<double>(k) / static_cast<double>(count - 1);
    times_s.push_back(1.0 / (2.0 * std::numbers::pi * lowest_Hz * std::pow(highest_Hz / lowest_Hz, share)));
  }
  return times_s;
}

/// Returns the x >= 0 that comes nearest to A x = b. With so few unknowns all choices of those that are not zero are tried.
Eigen::VectorXd nearest_non_negative(const Eigen::MatrixXd& A, const Eigen::VectorXd& b) {
  Eigen::VectorXd best = Eigen::VectorXd::Zero(A.cols());
  for (unsigned choice = 1; choice < 1U << A.cols(); ++choice) {
    std::vector<Eigen::Index> chosen;
    for (Eigen::Index k = 0; k < A.cols(); ++k)
      if ((choice >> k & 1U) != 0) chosen.push_back(k);
    const Eigen::VectorXd found = A(Eigen::all, chosen).colPivHouseholderQr().solve(b);
    if (!(found.minCoeff() >= 0.0)) continue;
    Eigen::VectorXd x = Eigen::VectorXd::Zero(A.cols());
    x(chosen) = found;
    if ((A * x - b).squaredNorm() < (A * best - b).squaredNorm()) best = x;
  }
  return best;
}

/// What a branch of modulus mu adds to the storage modulus and to the loss modulus, over mu.
struct BranchShares {
  double storage;
  double loss;
};

BranchShares shares_of(double relaxation_time_s, double frequency_Hz) {
  const double x = 2.0 * std::numbers::pi * frequency_Hz * relaxation_time_s;
  return {x * x / (1.0 + x * x), x / (1.0 + x * x)};
}

}  // namespace

materials::LossData assumed_silicone_loss() {
  return {.source = "assumed, because damping was not measured", .tan_delta = 0.1, .frequency_Hz = 30.0};
}

double viscosity_Pa_s(double shear_modulus_Pa, const materials::LossData& loss) {
  return shear_modulus_Pa * loss.tan_delta / (2.0 * std::numbers::pi * loss.frequency_Hz);
}

MaxwellBranch maxwell_branch(double shear_modulus_Pa, const materials::LossData& loss) {
  const double ratio = 2.0 * loss.tan_delta * (loss.tan_delta + std::sqrt(1.0 + loss.tan_delta * loss.tan_delta));
  return {.shear_modulus_Pa = ratio * shear_modulus_Pa,
          .relaxation_time_s = 1.0 / (2.0 * std::numbers::pi * loss.frequency_Hz * std::sqrt(1.0 + ratio))};
}

std::vector<MaxwellBranch> maxwell_branches(double shear_modulus_Pa, const materials::LossData& loss) {
  const std::vector<materials::LossPoint> points = loss.points();
  if (points.size() == 1) return acting({maxwell_branch(shear_modulus_Pa, loss)});
  const std::vector<double> times_s = relaxation_times_s(points);
  // t (1 + sum g_k storage_k) = sum g_k loss_k at each frequency, over t
  Eigen::MatrixXd A(points.size(), times_s.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t k = 0; k < times_s.size(); ++k) {
      const BranchShares shares = shares_of(times_s[k], points[i].frequency_Hz);
      A(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) = shares.loss / points[i].tan_delta - shares.storage;
    }
  }
  const Eigen::VectorXd ratios = nearest_non_negative(A, Eigen::VectorXd::Ones(A.rows()));
  std::vector<MaxwellBranch> branches;
  for (std::size_t k = 0; k < times_s.size(); ++k)
    branches.push_back(
        {.shear_modulus_Pa = ratios(static_cast<Eigen::Index>(k)) * shear_modulus_Pa, .relaxation_time_s = times_s[k]});
  return acting(branches);
}

double loss_factor(double shear_modulus_Pa, const std::vector<MaxwellBranch>& branches, double frequency_Hz) {
  double storage = 1.0;
  double loss = 0.0;
  for (const MaxwellBranch& branch : branches) {
    const BranchShares shares = shares_of(branch.relaxation_time_s, frequency_Hz);
    storage += branch.shear_modulus_Pa / shear_modulus_Pa * shares.storage;
    loss += branch.shear_modulus_Pa / shear_modulus_Pa * shares.loss;
  }
  return loss / storage;
}

}  // namespace menger::fem
