#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace menger::evolution {

/// A robot in both models.
struct JudgedScore {
  std::vector<std::string> poses;  ///< robot_poses of its body
  double surrogate = 0.0;          ///< score by the evaluator, >= 0
  double judge = 0.0;              ///< score by the judge, >= 0
};

/// How scores of the evaluator are brought to those of the judge.
enum class Correction {
  none,             ///< not at all: nothing was judged
  median_ratio,     ///< r s, with r the median of judge by surrogate
  gaussian_process  ///< r s, and what robots of like shape differ from that by
};
std::string_view to_string(Correction correction);  ///< "none", "median ratio" or "Gaussian process"

/// What is learnt from robots that both models know: the score s of the evaluator becomes the one expected of the judge.
///
/// The median ratio r = median(j_i / s_i) bears outliers, and orders the robots that were not judged as the evaluator does. The
/// Gaussian process adds k^T (K + noise I)^-1 (j - r s) to r s, from the residuals of the judged robots, with the kernel
/// k(a, b) = mean over all poses of a and of b of exp(-(cells that differ) / length), normalised to k(a, a) = 1. As a mean over
/// poses of a positive definite kernel it is one itself, and it does not see how a robot stands. Its length and noise are those
/// of a few values with the least error.
///
/// The error is the mean over the judged robots of |score expected from all others - score of the judge|. The Gaussian process is
/// taken from four robots on, and only where it makes that error less than nine tenths of the median ratio's: as the best of
/// several choices it would look a little better by chance alone. No score comes out negative.
/// @cite rasmussen2006gaussian
class Discrepancy {
 public:
  Discrepancy() = default;

  /// @param judged in an order of no consequence but for rounding
  explicit Discrepancy(std::vector<JudgedScore> judged);

  [[nodiscard]] double corrected(const std::vector<std::string>& poses, double surrogate) const;

  [[nodiscard]] Correction kind() const { return kind_; }
  [[nodiscard]] double ratio() const { return ratio_; }                 ///< r; 1 where nothing was judged
  [[nodiscard]] double length_cells() const { return length_; }         ///< of the Gaussian process
  [[nodiscard]] double noise() const { return noise_; }                 ///< variance by that of the process
  [[nodiscard]] std::optional<double> error() const { return error_; }  ///< from two robots on
  [[nodiscard]] std::optional<double> error_of_ratio() const { return error_of_ratio_; }

 private:
  std::vector<JudgedScore> judged_;
  Correction kind_ = Correction::none;
  double ratio_ = 1.0;
  double length_ = 0.0;
  double noise_ = 0.0;
  std::vector<double> weights_;  ///< (K + noise I)^-1 (j - r s)
  std::optional<double> error_;
  std::optional<double> error_of_ratio_;
};

}  // namespace menger::evolution
