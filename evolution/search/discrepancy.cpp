#include "evolution/search/discrepancy.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <utility>

namespace menger::evolution {
namespace {

using Eigen::Index;

constexpr std::size_t fewest_for_process = 4;
constexpr double needed_gain = 0.9;
constexpr std::array lengths{2.0, 5.0, 12.0};  ///< cells, of 27
constexpr std::array noises{0.1, 1.0};

double differing_cells(const std::string& a, const std::string& b) {
  assert(a.size() == b.size());
  std::size_t count = 0;
  for (std::size_t n = 0; n < a.size(); ++n) count += a[n] == b[n] ? 0U : 1U;
  return static_cast<double>(count);
}

double mean_over_poses(const std::vector<std::string>& a, const std::vector<std::string>& b, double length) {
  double sum = 0.0;
  for (const std::string& pose : a) {
    for (const std::string& other : b) sum += std::exp(-differing_cells(pose, other) / length);
  }
  return sum / static_cast<double>(a.size() * b.size());
}

double likeness(const std::vector<std::string>& a, const std::vector<std::string>& b, double length) {
  return mean_over_poses(a, b, length) / std::sqrt(mean_over_poses(a, a, length) * mean_over_poses(b, b, length));
}

Eigen::MatrixXd kernel_of(const std::vector<ScorePair>& robots, double length) {
  const auto count = static_cast<Index>(robots.size());
  Eigen::MatrixXd kernel(count, count);
  for (Index i = 0; i < count; ++i) {
    for (Index j = 0; j <= i; ++j) {
      kernel(i, j) = likeness(robots[static_cast<std::size_t>(i)].poses, robots[static_cast<std::size_t>(j)].poses, length);
      kernel(j, i) = kernel(i, j);
    }
  }
  return kernel;
}

/// Returns the median of reference score / surrogate score without robot `left_out`; 1 if no robot moves on the surrogate.
double median_ratio(const std::vector<ScorePair>& robots, std::size_t left_out) {
  std::vector<double> ratios;
  for (std::size_t n = 0; n < robots.size(); ++n) {
    if (n != left_out && robots[n].surrogate > 0.0) ratios.push_back(robots[n].reference / robots[n].surrogate);
  }
  if (ratios.empty()) return 1.0;
  std::ranges::sort(ratios);
  const std::size_t middle = ratios.size() / 2;
  return ratios.size() % 2 == 1 ? ratios[middle] : 0.5 * (ratios[middle - 1] + ratios[middle]);
}

Eigen::VectorXd residuals(const std::vector<ScorePair>& robots, double ratio) {
  Eigen::VectorXd result(static_cast<Index>(robots.size()));
  for (std::size_t n = 0; n < robots.size(); ++n)
    result[static_cast<Index>(n)] = robots[n].reference - ratio * robots[n].surrogate;
  return result;
}

double mean_error(const std::vector<ScorePair>& robots, const std::vector<double>& expected) {
  double sum = 0.0;
  for (std::size_t n = 0; n < robots.size(); ++n) sum += std::abs(std::max(0.0, expected[n]) - robots[n].reference);
  return sum / static_cast<double>(robots.size());
}

/// Returns the score of every robot that the median ratio of the others predicts.
std::vector<double> expected_by_ratio(const std::vector<ScorePair>& robots) {
  std::vector<double> expected;
  for (std::size_t n = 0; n < robots.size(); ++n) expected.push_back(median_ratio(robots, n) * robots[n].surrogate);
  return expected;
}

/// Returns the score of every robot that the Gaussian process on the others predicts.
std::vector<double> expected_by_process(const std::vector<ScorePair>& robots, const Eigen::MatrixXd& kernel, double noise) {
  const auto count = static_cast<Index>(robots.size());
  std::vector<double> expected;
  for (Index n = 0; n < count; ++n) {
    const double ratio = median_ratio(robots, static_cast<std::size_t>(n));
    Eigen::MatrixXd others = kernel;
    Eigen::VectorXd difference = residuals(robots, ratio);
    Eigen::VectorXd towards = kernel.col(n);
    // The robot itself stays in the system of equations, but without coupling and with residual 0.
    others.row(n).setZero();
    others.col(n).setZero();
    difference[n] = 0.0;
    towards[n] = 0.0;
    others.diagonal().array() += noise;
    const Eigen::VectorXd weights = others.llt().solve(difference);
    expected.push_back(ratio * robots[static_cast<std::size_t>(n)].surrogate + towards.dot(weights));
  }
  return expected;
}

}  // namespace

std::string_view to_string(Correction correction) {
  switch (correction) {
    case Correction::none:
      return "none";
    case Correction::median_ratio:
      return "median ratio";
    case Correction::gaussian_process:
      return "Gaussian process";
  }
  return {};
}

Discrepancy::Discrepancy(std::vector<ScorePair> robots) : robots_(std::move(robots)) {
  if (robots_.empty()) return;
  kind_ = Correction::median_ratio;
  ratio_ = median_ratio(robots_, robots_.size());
  if (robots_.size() < 2) return;
  error_of_ratio_ = mean_error(robots_, expected_by_ratio(robots_));
  error_ = error_of_ratio_;
  if (robots_.size() < fewest_for_process) return;
  double bound = needed_gain * *error_of_ratio_;
  for (const double length : lengths) {
    const Eigen::MatrixXd kernel = kernel_of(robots_, length);
    for (const double noise : noises) {
      const double error = mean_error(robots_, expected_by_process(robots_, kernel, noise));
      if (error >= bound) continue;
      bound = error;
      error_ = error;
      kind_ = Correction::gaussian_process;
      length_ = length;
      noise_ = noise;
    }
  }
  if (kind_ != Correction::gaussian_process) return;
  Eigen::MatrixXd kernel = kernel_of(robots_, length_);
  kernel.diagonal().array() += noise_;
  const Eigen::VectorXd weights = kernel.llt().solve(residuals(robots_, ratio_));
  weights_.assign(weights.begin(), weights.end());
}

double Discrepancy::corrected(const std::vector<std::string>& poses, double surrogate) const {
  double score = ratio_ * surrogate;
  for (std::size_t n = 0; n < weights_.size(); ++n) score += weights_[n] * likeness(poses, robots_[n].poses, length_);
  return std::max(0.0, score);
}

}  // namespace menger::evolution
