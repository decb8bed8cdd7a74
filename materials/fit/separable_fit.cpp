#include "materials/fit/separable_fit.h"

#include <ceres/ceres.h>
#include <glog/logging.h>

#include <Eigen/QR>
#include <cmath>
#include <limits>

#include "materials/laws/homogeneous_deformations.h"

namespace menger::materials {

namespace {

using Eigen::Index;

/// The linear part of the problem: the moduli for given shape parameters. Stresses are scaled by the largest one.
class LinearPart {
 public:
  LinearPart(const LawFamily& family, const std::vector<double>& stretch, const std::vector<double>& stress_Pa)
      : family_(family), stretch_(stretch), stress_(Eigen::Map<const Eigen::VectorXd>(stress_Pa.data(), size(stress_Pa))) {
    scale_Pa_ = stress_.cwiseAbs().maxCoeff();
    stress_ /= scale_Pa_;
  }

  static Index size(const auto& values) { return static_cast<Index>(values.size()); }

  [[nodiscard]] Index row_count() const { return stress_.size(); }
  [[nodiscard]] double scale_Pa() const { return scale_Pa_; }

  /// Computes moduli and residual. Returns false if a law is not valid at some stretch.
  bool solve(std::span<const double> shape, Eigen::VectorXd& moduli, Eigen::VectorXd& residual) const {
    Eigen::MatrixXd columns;
    if (!fill(shape, columns)) return false;
    moduli = family_.non_negative ? non_negative_solution(columns) : columns.colPivHouseholderQr().solve(stress_).eval();
    residual = columns * moduli - stress_;
    return residual.allFinite();
  }

 private:
  bool fill(std::span<const double> shape, Eigen::MatrixXd& columns) const {
    const std::vector<HyperelasticLaw> laws = family_.basis(shape);
    columns.resize(row_count(), size(laws));
    for (std::size_t column = 0; column < laws.size(); ++column) {
      for (std::size_t row = 0; row < stretch_.size(); ++row) {
        const NominalStress unit = nominal_stress(laws[column], LoadingMode::uniaxial, stretch_[row]);
        if (unit.status != LawStatus::valid) return false;
        columns(static_cast<Index>(row), static_cast<Index>(column)) = unit.stress_Pa;
      }
    }
    return columns.allFinite();
  }

  /// Solves the least-squares problem without negative moduli. It tries all choices of columns, of which there are at most three.
  [[nodiscard]] Eigen::VectorXd non_negative_solution(const Eigen::MatrixXd& columns) const {
    Eigen::VectorXd best = Eigen::VectorXd::Zero(columns.cols());
    double best_square = stress_.squaredNorm();
    for (unsigned choice = 1; choice < 1U << columns.cols(); ++choice) {
      std::vector<Index> chosen;
      for (Index column = 0; column < columns.cols(); ++column)
        if ((choice >> column & 1U) != 0) chosen.push_back(column);
      Eigen::MatrixXd part(columns.rows(), size(chosen));
      for (Index i = 0; i < part.cols(); ++i) part.col(i) = columns.col(chosen[static_cast<std::size_t>(i)]);
      const Eigen::VectorXd moduli = part.colPivHouseholderQr().solve(stress_);
      if (!(moduli.minCoeff() >= 0.0)) continue;
      const double square = (part * moduli - stress_).squaredNorm();
      if (square >= best_square) continue;
      best_square = square;
      best.setZero();
      for (Index i = 0; i < part.cols(); ++i) best[chosen[static_cast<std::size_t>(i)]] = moduli[i];
    }
    return best;
  }

  const LawFamily& family_;
  const std::vector<double>& stretch_;
  Eigen::VectorXd stress_;
  double scale_Pa_ = 1.0;
};

/// The residuals in the form that Ceres requires.
struct Residuals {
  const LinearPart& part;
  std::size_t shape_count;

  bool operator()(const double* const* shape, double* residuals) const {
    Eigen::VectorXd moduli;
    Eigen::VectorXd residual;
    if (!part.solve({shape[0], shape_count}, moduli, residual)) return false;
    Eigen::Map<Eigen::VectorXd>(residuals, residual.size()) = residual;
    return true;
  }
};

ceres::Solver::Summary improve(const LawFamily& family, const LinearPart& part, std::vector<double>& shape) {
  auto* cost = new ceres::DynamicNumericDiffCostFunction<Residuals, ceres::CENTRAL>(new Residuals{part, shape.size()});
  cost->AddParameterBlock(static_cast<int>(shape.size()));
  cost->SetNumResiduals(static_cast<int>(part.row_count()));
  ceres::Problem problem;  // owns the cost, which owns the residuals
  problem.AddResidualBlock(cost, nullptr, shape.data());
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

}  // namespace

std::optional<SeparableFit> fit_family(const LawFamily& family, const std::vector<double>& stretch,
                                       const std::vector<double>& stress_Pa) {
  // Ceres logs starts that fail, which is expected here.
  FLAGS_minloglevel = google::GLOG_FATAL;
  const LinearPart part(family, stretch, stress_Pa);
  std::optional<SeparableFit> best;
  double best_square = std::numeric_limits<double>::infinity();
  for (std::vector<double> shape : family.starts) {
    io::RunStatus status = io::RunStatus::completed;
    if (!shape.empty()) {
      const ceres::Solver::Summary summary = improve(family, part, shape);
      if (!summary.IsSolutionUsable()) continue;
      if (summary.termination_type != ceres::CONVERGENCE) status = io::RunStatus::not_converged;
    }
    Eigen::VectorXd moduli;
    Eigen::VectorXd residual;
    if (!part.solve(shape, moduli, residual) || residual.squaredNorm() >= best_square) continue;
    best_square = residual.squaredNorm();
    moduli *= part.scale_Pa();
    const HyperelasticLaw law = family.compose(shape, {moduli.data(), static_cast<std::size_t>(moduli.size())});
    best = SeparableFit{law, status, names_at_bound(family, shape)};
  }
  return best;
}

}  // namespace menger::materials
