#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace menger::evolution {

/// The scores of one robot by both models.
struct ScorePair {
  std::vector<std::string> poses;  ///< robot_poses of its body
  double surrogate = 0.0;          ///< score by the evaluator of the search, >= 0
  double reference = 0.0;          ///< score by the reference evaluator, >= 0
};

/// How a score s by the surrogate is turned into the expected score by the reference evaluator.
enum class Correction {
  none,             ///< not at all: there is no reference evaluation yet
  median_ratio,     ///< r s, with r the median of reference score / surrogate score
  gaussian_process  ///< r s, plus a Gaussian process over shapes for the remaining difference
};
std::string_view to_string(Correction correction);  ///< "none", "median ratio" or "Gaussian process"

/// Predicts a robot's score by the reference evaluator from its score s by the surrogate. It is learnt from robots i that have
/// both scores: j_i by the reference evaluator and s_i by the surrogate.
///
/// The median ratio r = median(j_i / s_i) is robust to outliers. It keeps the surrogate's order of the robots without a reference
/// evaluation. The Gaussian process adds k^T (K + noise I)^-1 (j - r s) to r s, from the residuals of the robots that have both
/// scores. Its kernel is k(a, b) = mean over all poses of a and of b of exp(-(cells that differ) / length), normalised to k(a, a)
/// = 1. As a mean over poses of a positive definite kernel it is positive definite itself, and it does not depend on the pose of
/// a robot. Length and noise are chosen from a few values, for the least error.
///
/// The error is the mean, over the robots that have both scores, of |score expected from all others - score by the reference
/// evaluator|. The Gaussian process is used from four robots on, and only if it lowers that error below nine tenths of the median
/// ratio's error: as the best of several choices it would look a little better by chance alone. Corrected scores are never
/// negative.
/// @cite rasmussen2006gaussian
class Discrepancy {
 public:
  Discrepancy() = default;

  /// @param robots their order changes results by rounding only
  explicit Discrepancy(std::vector<ScorePair> robots);

  /// Returns the expected score by the reference evaluator, >= 0. @param poses robot_poses of the body
  [[nodiscard]] double corrected(const std::vector<std::string>& poses, double surrogate) const;

  [[nodiscard]] Correction kind() const { return kind_; }
  [[nodiscard]] double ratio() const { return ratio_; }                 ///< r; 1 without reference evaluations
  [[nodiscard]] double length_cells() const { return length_; }         ///< of the Gaussian process
  [[nodiscard]] double noise() const { return noise_; }                 ///< variance of the noise / variance of the process
  [[nodiscard]] std::optional<double> error() const { return error_; }  ///< of the correction in use, from two robots on
  [[nodiscard]] std::optional<double> error_of_ratio() const { return error_of_ratio_; }  ///< of the median ratio, likewise

 private:
  std::vector<ScorePair> robots_;
  Correction kind_ = Correction::none;
  double ratio_ = 1.0;
  double length_ = 0.0;
  double noise_ = 0.0;
  std::vector<double> weights_;  ///< (K + noise I)^-1 (j - r s)
  std::optional<double> error_;
  std::optional<double> error_of_ratio_;
};

}  // namespace menger::evolution
