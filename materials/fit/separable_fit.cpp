#include "materials/fit/separable_fit.h"

#include <ceres/ceres.h>
#include <glog/logging.h>

#include <Eigen/Core>
#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>

#include "materials/laws/homogeneous_deformations.h"

namespace menger::materials {

namespace {

using Eigen::Index;

constexpr std::size_t most_rows = 256;     // on which every start is tried
constexpr std::size_t grid_starts = 8;     // of the closest choices of a grid, and again of those that do not cancel
constexpr std::size_t finished_count = 4;  // results that are finished on all rows

/// The linear part of the problem: the moduli for given shape parameters. Stresses are scaled by the largest one.
class LinearPart {
 public:
  LinearPart(const LawFamily& family, const std::vector<double>& stretch, const std::vector<double>& stress_Pa)
      : family_(family), stress_(Eigen::Map<const Eigen::VectorXd>(stress_Pa.data(), size(stress_Pa))) {
    stretches_.stretch = stretch;
    for (const double l : stretch) stretches_.logarithm.push_back(std::log(l));
    scale_Pa_ = stress_.cwiseAbs().maxCoeff();
    stress_ /= scale_Pa_;
  }

  static Index size(const auto& values) { return static_cast<Index>(values.size()); }

  [[nodiscard]] Index row_count() const { return stress_.size(); }
  [[nodiscard]] double scale_Pa() const { return scale_Pa_; }
  [[nodiscard]] const Eigen::VectorXd& stress() const { return stress_; }

  /// A solution of the linear part.
  struct Solution {
    Eigen::VectorXd moduli;
    Eigen::VectorXd residual;
    Eigen::MatrixXd jacobian;  ///< of the residual with respect to the shape parameters, if asked for
  };

  /// Computes moduli and residual. Returns false if a law is not valid at some stretch.
  bool solve(std::span<const double> shape, bool with_jacobian, Solution& solution) const {
    Eigen::MatrixXd columns;
    Eigen::MatrixXd slopes;
    if (!fill(shape, columns, with_jacobian ? &slopes : nullptr)) return false;
    const std::vector<Index> chosen = family_.non_negative ? non_negative_choice(columns) : all_of(columns);
    solution.moduli = Eigen::VectorXd::Zero(columns.cols());
    if (chosen.empty()) {  // all moduli are held at zero
      solution.residual = -stress_;
      solution.jacobian = Eigen::MatrixXd::Zero(row_count(), columns.cols());
      return true;
    }
    const Eigen::MatrixXd part = columns(Eigen::all, chosen);
    const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(part);
    solution.moduli(chosen) = qr.solve(stress_);
    solution.residual = columns * solution.moduli - stress_;
    if (with_jacobian) set_jacobian(solution, slopes, chosen, qr);
    return solution.residual.allFinite() && solution.moduli.allFinite();
  }

  /// Computes the columns of the moduli, and their derivatives with respect to the shape parameters where `slopes` is given.
  bool fill(std::span<const double> shape, Eigen::MatrixXd& columns, Eigen::MatrixXd* slopes) const {
    if (family_.column) {
      columns.resize(row_count(), size(shape));
      Eigen::MatrixXd unused;
      Eigen::MatrixXd& of_shape = slopes != nullptr ? *slopes : unused;
      of_shape.resize(row_count(), size(shape));
      const auto rows = static_cast<std::size_t>(row_count());
      for (Index k = 0; k < columns.cols(); ++k)
        family_.column(shape[static_cast<std::size_t>(k)], stretches_, {columns.col(k).data(), rows},
                       {of_shape.col(k).data(), rows});
      return columns.allFinite() && of_shape.allFinite();
    }
    if (!fill_from_basis(shape, columns)) return false;
    return slopes == nullptr || fill_slopes(shape, *slopes);
  }

 private:
  static std::vector<Index> all_of(const Eigen::MatrixXd& columns) {
    std::vector<Index> all(static_cast<std::size_t>(columns.cols()));
    std::iota(all.begin(), all.end(), Index{0});
    return all;
  }

  bool fill_from_basis(std::span<const double> shape, Eigen::MatrixXd& columns) const {
    const std::vector<HyperelasticLaw> laws = family_.basis(shape);
    columns.resize(row_count(), size(laws));
    for (std::size_t column = 0; column < laws.size(); ++column) {
      for (std::size_t row = 0; row < stretches_.stretch.size(); ++row) {
        const NominalStress unit = nominal_stress(laws[column], LoadingMode::uniaxial, stretches_.stretch[row]);
        if (unit.status != LawStatus::valid) return false;
        columns(static_cast<Index>(row), static_cast<Index>(column)) = unit.stress_Pa;
      }
    }
    return columns.allFinite();
  }

  /// By central differences: the column of each modulus with respect to its own shape parameter.
  bool fill_slopes(std::span<const double> shape, Eigen::MatrixXd& slopes) const {
    slopes.resize(row_count(), size(shape));
    std::vector<double> moved(shape.begin(), shape.end());
    Eigen::MatrixXd above;
    Eigen::MatrixXd below;
    for (std::size_t k = 0; k < shape.size(); ++k) {
      const double step = 1e-6 * std::max(1.0, std::abs(shape[k]));
      moved[k] = shape[k] + step;
      if (!fill_from_basis(moved, above)) return false;
      moved[k] = shape[k] - step;
      if (!fill_from_basis(moved, below)) return false;
      moved[k] = shape[k];
      slopes.col(static_cast<Index>(k)) = (above.col(static_cast<Index>(k)) - below.col(static_cast<Index>(k))) / (2.0 * step);
    }
    return slopes.allFinite();
  }

  /// The derivatives of variable projection. With the columns A, moduli c and residual r = A c - b, a column a_k that depends on
  /// shape parameter k gives dr = (1 - A A^+) a_k' c_k - (A^+)^T e_k (a_k' . r).
  static void set_jacobian(Solution& solution, const Eigen::MatrixXd& slopes, const std::vector<Index>& chosen,
                           const Eigen::ColPivHouseholderQR<Eigen::MatrixXd>& qr) {
    const Index rows = solution.residual.size();
    solution.jacobian = Eigen::MatrixXd::Zero(rows, slopes.cols());
    const Index rank = qr.rank();
    if (rank == 0) return;
    const Eigen::MatrixXd q = qr.householderQ() * Eigen::MatrixXd::Identity(rows, rank);
    const Eigen::MatrixXd inverse =
        qr.matrixR().topLeftCorner(rank, rank).triangularView<Eigen::Upper>().solve(Eigen::MatrixXd::Identity(rank, rank));
    for (Index j = 0; j < rank; ++j) {
      const Index k = chosen[static_cast<std::size_t>(qr.colsPermutation().indices()[j])];
      const Eigen::VectorXd slope = slopes.col(k);
      solution.jacobian.col(k) = solution.moduli[k] * (slope - q * (q.transpose() * slope)) -
                                 slope.dot(solution.residual) * (q * inverse.row(j).transpose());
    }
  }

  /// The columns with moduli that are not zero, if none may be negative. It tries all choices of columns, of which there are at
  /// most three.
  [[nodiscard]] std::vector<Index> non_negative_choice(const Eigen::MatrixXd& columns) const {
    std::vector<Index> best;
    double best_square = stress_.squaredNorm();
    for (unsigned choice = 1; choice < 1U << columns.cols(); ++choice) {
      std::vector<Index> chosen;
      for (Index column = 0; column < columns.cols(); ++column)
        if ((choice >> column & 1U) != 0) chosen.push_back(column);
      const Eigen::MatrixXd part = columns(Eigen::all, chosen);
      const Eigen::VectorXd moduli = part.colPivHouseholderQr().solve(stress_);
      if (!(moduli.minCoeff() >= 0.0)) continue;
      const double square = (part * moduli - stress_).squaredNorm();
      if (square >= best_square) continue;
      best_square = square;
      best = chosen;
    }
    return best;
  }

  const LawFamily& family_;
  Stretches stretches_;
  Eigen::VectorXd stress_;
  double scale_Pa_ = 1.0;
};

/// The residuals in the form that Ceres requires.
class Residuals : public ceres::CostFunction {
 public:
  Residuals(const LinearPart& part, std::size_t shape_count) : part_(part), shape_count_(shape_count) {
    set_num_residuals(static_cast<int>(part.row_count()));
    mutable_parameter_block_sizes()->push_back(static_cast<int>(shape_count));
  }

  bool Evaluate(double const* const* shape, double* residuals, double** jacobians) const override {
    const bool with_jacobian = jacobians != nullptr && jacobians[0] != nullptr;
    LinearPart::Solution solution;
    if (!part_.solve({shape[0], shape_count_}, with_jacobian, solution)) return false;
    Eigen::Map<Eigen::VectorXd>(residuals, solution.residual.size()) = solution.residual;
    if (with_jacobian) {
      using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
      Eigen::Map<RowMajor>(jacobians[0], part_.row_count(), static_cast<Index>(shape_count_)) = solution.jacobian;
    }
    return true;
  }

 private:
  const LinearPart& part_;
  std::size_t shape_count_;
};

ceres::Solver::Summary improve(const LawFamily& family, const LinearPart& part, std::vector<double>& shape) {
  ceres::Problem problem;  // owns the residuals
  problem.AddResidualBlock(new Residuals(part, shape.size()), nullptr, shape.data());
  for (std::size_t i = 0; i < shape.size(); ++i) {
    problem.SetParameterLowerBound(shape.data(), static_cast<int>(i), family.lowest_shape[i]);
    problem.SetParameterUpperBound(shape.data(), static_cast<int>(i), family.highest_shape[i]);
  }
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.max_num_iterations = 200;
  options.function_tolerance = 1e-13;
  options.parameter_tolerance = 1e-11;
  options.gradient_tolerance = 1e-16;
  options.logging_type = ceres::SILENT;
  options.num_threads = 1;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  return summary;
}

std::vector<std::string> names_at_bound(const LawFamily& family, const std::vector<double>& shape) {
  constexpr double near = 1e-6;  // of the width of the search
  std::vector<std::string> names;
  for (std::size_t i = 0; i < shape.size(); ++i) {
    const double tolerance = near * (family.highest_shape[i] - family.lowest_shape[i]);
    if (shape[i] <= family.lowest_shape[i] + tolerance || shape[i] >= family.highest_shape[i] - tolerance)
      names.push_back(family.shape_names[i]);
  }
  return names;
}

/// A choice of values of a grid, by their places.
struct GridChoice {
  std::vector<std::size_t> places;
  double square = 0.0;
  bool cancels = false;  ///< more is cancelled than left
};

/// The part cancelled among parts of a modulus, see cancelled_part.
double cancelled_among(std::span<const double> parts) {
  double positive = 0.0;
  double negative = 0.0;
  for (const double part : parts) (part > 0.0 ? positive : negative) += std::abs(part);
  const double smaller = std::min(positive, negative);
  if (smaller == 0.0) return 0.0;
  const double left = std::abs(positive - negative);
  return left > 0.0 ? smaller / left : std::numeric_limits<double>::infinity();
}

bool are_neighbours(const GridChoice& a, const GridChoice& b) {
  for (std::size_t i = 0; i < a.places.size(); ++i) {
    if (std::max(a.places[i], b.places[i]) - std::min(a.places[i], b.places[i]) > 1) return false;
  }
  return true;
}

/// Compares all choices of the values of a grid by their least squares.
///
/// All columns of the grid together span what any choice of them can follow. So the rows are first replaced by their coordinates
/// in an orthogonal basis of these columns (QR), which are as many as columns, however many rows the test has.
class Grid {
 public:
  Grid(const LawFamily& family, const LinearPart& part) : family_(family) {
    Eigen::MatrixXd columns;
    if (family.grid.empty() || !part.fill(family.grid, columns, nullptr)) return;
    lengths_ = columns.colwise().norm();
    if (!(lengths_.minCoeff() > 0.0)) return;
    columns = columns * lengths_.cwiseInverse().asDiagonal();
    const Index width = std::min(columns.rows(), columns.cols());
    const Eigen::HouseholderQR<Eigen::MatrixXd> qr(columns);
    columns_ = qr.matrixQR().topRows(width).triangularView<Eigen::Upper>();
    stress_ = (qr.householderQ().transpose() * part.stress()).head(width);
    std::vector<std::size_t> places;
    compare(places, 0);
    std::sort(choices_.begin(), choices_.end(), [](const GridChoice& a, const GridChoice& b) { return a.square < b.square; });
  }

  /// The closest choices that are no neighbours of each other, as starts; and again of those in which no more is cancelled than
  /// left.
  [[nodiscard]] std::vector<std::vector<double>> starts() const {
    std::vector<const GridChoice*> taken;
    for (const bool may_cancel : {true, false}) {
      std::size_t count = 0;
      for (const GridChoice& choice : choices_) {
        if (count == grid_starts) break;
        if (!may_cancel && choice.cancels) continue;
        if (std::any_of(taken.begin(), taken.end(), [&](const GridChoice* other) { return are_neighbours(choice, *other); }))
          continue;
        taken.push_back(&choice);
        ++count;
      }
    }
    std::vector<std::vector<double>> starts;
    for (const GridChoice* choice : taken) {
      std::vector<double>& start = starts.emplace_back();
      for (const std::size_t place : choice->places) start.push_back(family_.grid[place]);
    }
    return starts;
  }

 private:
  void compare(std::vector<std::size_t>& places, std::size_t first) {
    if (places.size() == family_.shape_names.size()) return add(places);
    for (std::size_t place = first; place < family_.grid.size(); ++place) {
      places.push_back(place);
      compare(places, place + 1);
      places.pop_back();
    }
  }

  void add(const std::vector<std::size_t>& places) {
    Eigen::MatrixXd part(columns_.rows(), LinearPart::size(places));
    for (std::size_t i = 0; i < places.size(); ++i) part.col(static_cast<Index>(i)) = columns_.col(static_cast<Index>(places[i]));
    const Eigen::VectorXd scaled = part.colPivHouseholderQr().solve(stress_);
    GridChoice choice{places, (part * scaled - stress_).squaredNorm(), false};
    std::vector<double> moduli;
    for (std::size_t i = 0; i < places.size(); ++i)
      moduli.push_back(scaled[static_cast<Index>(i)] / lengths_[static_cast<Index>(places[i])]);
    // A choice with negative moduli is the same as one of fewer values where these are forbidden.
    if (family_.non_negative && *std::min_element(moduli.begin(), moduli.end()) < 0.0) return;
    choice.cancels = cancelled_among(moduli) > 1.0;
    if (std::isfinite(choice.square)) choices_.push_back(std::move(choice));
  }

  const LawFamily& family_;
  Eigen::RowVectorXd lengths_;
  Eigen::MatrixXd columns_;
  Eigen::VectorXd stress_;
  std::vector<GridChoice> choices_;
};

/// What a start led to.
struct Result {
  std::vector<double> shape;
  io::RunStatus status = io::RunStatus::completed;
  double square = 0.0;
  HyperelasticLaw law;
  double cancelled = 0.0;
};

std::optional<Result> result_from(const LawFamily& family, const LinearPart& part, std::vector<double> shape) {
  Result result{.shape = std::move(shape), .law = {}};
  if (!result.shape.empty()) {
    const ceres::Solver::Summary summary = improve(family, part, result.shape);
    if (!summary.IsSolutionUsable()) return std::nullopt;
    if (summary.termination_type != ceres::CONVERGENCE) result.status = io::RunStatus::not_converged;
  }
  LinearPart::Solution solution;
  if (!part.solve(result.shape, false, solution)) return std::nullopt;
  result.square = solution.residual.squaredNorm();
  solution.moduli *= part.scale_Pa();
  result.law = family.compose(result.shape, {solution.moduli.data(), static_cast<std::size_t>(solution.moduli.size())});
  result.cancelled = cancelled_part(result.law);
  return result;
}

/// Sorts results by their squares; equal ones stay in the order of their starts.
void sort_by_square(std::vector<Result>& results) {
  std::stable_sort(results.begin(), results.end(), [](const Result& a, const Result& b) { return a.square < b.square; });
}

/// Returns the best results that differ: of all, and of those that do not cancel.
std::vector<Result> best_of(std::vector<Result> results) {
  constexpr double same = 1e-9;  // of the square
  sort_by_square(results);
  std::vector<Result> best;
  std::array<std::size_t, 2> counts{};
  const Result* last = nullptr;
  for (const Result& result : results) {
    if (last != nullptr && result.square - last->square <= same * last->square) continue;
    last = &result;
    std::size_t& count = counts.at(result.cancelled > most_cancelled ? 1 : 0);
    if (count++ < finished_count) best.push_back(result);
  }
  return best;
}

/// At most most_rows of the rows, evenly chosen, with the first and the last.
std::vector<double> thinned(const std::vector<double>& values) {
  if (values.size() <= most_rows) return values;
  std::vector<double> kept;
  for (std::size_t i = 0; i < most_rows; ++i) kept.push_back(values[i * (values.size() - 1) / (most_rows - 1)]);
  return kept;
}

}  // namespace

double cancelled_part(const HyperelasticLaw& law) {
  const auto of_terms = [](const auto& ogden) {
    std::vector<double> parts;
    for (const OgdenTerm& term : ogden.terms) parts.push_back(term.part_of_shear_modulus_Pa());
    return cancelled_among(parts);
  };
  if (const auto* two = std::get_if<Ogden<2>>(&law)) return of_terms(*two);
  if (const auto* three = std::get_if<Ogden<3>>(&law)) return of_terms(*three);
  return 0.0;
}

std::optional<SeparableFit> fit_family(const LawFamily& family, const std::vector<double>& stretch,
                                       const std::vector<double>& stress_Pa, const std::function<void(double)>& progress) {
  // Ceres logs starts that fail, which is expected here.
  FLAGS_minloglevel = google::GLOG_FATAL;
  const LinearPart whole(family, stretch, stress_Pa);
  const bool is_thinned = stretch.size() > most_rows && !family.shape_names.empty();
  const LinearPart part(family, is_thinned ? thinned(stretch) : stretch, is_thinned ? thinned(stress_Pa) : stress_Pa);
  std::vector<std::vector<double>> starts = family.starts;
  if (part.stress().size() > 0 && part.stress().squaredNorm() > 0.0) {
    for (std::vector<double>& start : Grid(family, part).starts()) starts.push_back(std::move(start));
  }
  std::vector<Result> results;
  const auto run = [&](const LinearPart& rows, std::vector<double> shape, std::vector<Result>& into) {
    if (std::optional<Result> result = result_from(family, rows, std::move(shape))) into.push_back(std::move(*result));
  };
  constexpr double finishing = 0.3;  // of the time, where rows are thinned
  const double searching = is_thinned ? 1.0 - finishing : 1.0;
  for (std::size_t s = 0; s < starts.size(); ++s) {
    run(part, starts[s], results);
    if (progress) progress(searching * static_cast<double>(s + 1) / static_cast<double>(starts.size()));
  }
  if (is_thinned) {
    const std::vector<Result> best = best_of(std::move(results));
    results.clear();
    for (std::size_t n = 0; n < best.size(); ++n) {
      run(whole, best[n].shape, results);
      if (progress) progress(searching + finishing * static_cast<double>(n + 1) / static_cast<double>(best.size()));
    }
  }
  if (results.empty()) return std::nullopt;
  sort_by_square(results);
  const auto sound =
      std::find_if(results.begin(), results.end(), [](const Result& result) { return result.cancelled <= most_cancelled; });
  const Result& best = sound == results.end() ? results.front() : *sound;
  const std::size_t skipped = sound == results.end() ? 0 : static_cast<std::size_t>(sound - results.begin());
  return SeparableFit{best.law, best.status, names_at_bound(family, best.shape), skipped};
}

}  // namespace menger::materials
