#include "voxel/calibration/calibration_run.h"

#include <algorithm>
#include <system_error>

#include "io/process/run_folder.h"
#include "io/text/whole_file.h"
#include "voxel/calibration/calibration_chart.h"
#include "voxel/calibration/calibration_report.h"
#include "voxel/calibration/calibration_tables.h"

namespace menger::voxel {
namespace {

namespace fs = std::filesystem;

/// Reports how far the details are, after every iteration. The numbers of fits and of their iterations are not known in advance,
/// so the reported value only approaches the end.
class FitProgress {
 public:
  FitProgress(std::size_t detail_count, const CalibrationRunOptions& options)
      : usual_fits_(1.5 * static_cast<double>(detail_count)), options_(options) {}

  void begin(CalibrationDetail detail) {
    ++begun_;
    name_ = to_string(detail);
    tell(0, 0.0);
  }
  void tell(int iteration, double chi2) {
    if (!options_.progress) return;
    constexpr double usual_iterations = 10.0;
    constexpr double most = 0.95;
    const double fits = static_cast<double>(begun_) - 1.0 + iteration / (iteration + usual_iterations);
    const double share = options_.identifiability_fits > 0 ? 0.5 : 1.0;
    // A fit may begin again from another point.
    told_ = std::max(told_, share * std::min(most, fits / usual_fits_));
    options_.progress(told_, name_ + (iteration > 0 ? ", chi2 " + std::to_string(static_cast<long>(chi2)) : ""));
  }

 private:
  double usual_fits_;
  const CalibrationRunOptions& options_;
  std::size_t begun_ = 0;
  double told_ = 0.0;
  std::string name_;
};

void draw(const fs::path& folder, CalibrationRunResult& result) {
  std::string missing;
  const auto note = [&](const io::PictureOutcome& outcome) {
    if (!outcome.written) missing = outcome.missing;
  };
  note(draw_agreement(folder / "agreement.png", result.calibration, result.curves));
  const CalibrationFit& fit = result.calibration.fit();
  for (std::size_t c = 0; c < fit.residuals.size(); ++c)
    note(draw_curve(folder / ("curve_" + result.curves[c].load_case.name + ".png"), result.curves[c], fit.residuals[c]));
  if (!missing.empty()) result.notes.push_back("no picture: " + missing);
}

Identifiability test_identifiability(const CalibrationProblem& problem, const CalibrationFit& fit,
                                     const CalibrationRunOptions& options) {
  IdentifiabilityOptions test{.fit_count = options.identifiability_fits, .stop = options.stop};
  test.progress = [&](int done) {
    if (options.progress) options.progress(0.5 + 0.5 * done / options.identifiability_fits, "identifiability");
  };
  return identifiability(problem.curves, claimed_parameters(fit), fit.parameters, problem.responder, test);
}

/// Takes the results of an earlier run away, so that none of them passes for one of this run where that has no such result. Only
/// in a folder that this program wrote: others may have files of such names there.
void remove_earlier_results(const io::RunFolder& folder) {
  if (!folder.is_own()) return;
  folder.begin({"parameters.toml", "result.toml", "details.csv", "parameters.csv", "correlation.csv", "residuals.csv",
                "responses.csv", "answers.csv", "identifiability.csv", "frequency_response.csv", "agreement.png", "curve_*.png"});
}

void write_tables(const fs::path& folder, const CalibrationRunResult& result) {
  const CalibrationFit& fit = result.calibration.fit();
  detail_table(result.calibration, result.curves).write(folder / "details.csv");
  parameter_table(fit).write(folder / "parameters.csv");
  correlation_table(fit).write(folder / "correlation.csv");
  residual_table(result.curves, fit).write(folder / "residuals.csv");
  response_table(result.curves, fit).write(folder / "responses.csv");
  if (!result.frequency_response.empty()) frequency_table(result.frequency_response).write(folder / "frequency_response.csv");
  if (result.identifiability) identifiability_table(*result.identifiability).write(folder / "identifiability.csv");
}

}  // namespace

CalibrationRunResult run_calibration(const CalibrationStudy& study, const Responder& responder, const fs::path& folder,
                                     const CalibrationRunOptions& options) {
  const io::RunFolder run("menger-calibrate", folder);
  CalibrationRunResult result;
  if (study.frequency_response) result.frequency_response = read_frequency_gains(*study.frequency_response);
  io::require_writable_folder(folder);
  const CalibrationProblem problem = problem_of(study, responder);
  CalibrationPlan plan = study.plan;
  FitProgress progress(plan.details.size(), options);
  plan.fit.stop = options.stop;
  plan.begin = [&](CalibrationDetail detail) { progress.begin(detail); };
  plan.fit.progress = [&](int iteration, double chi2) { progress.tell(iteration, chi2); };

  result.calibration = calibrate(problem, plan);
  result.curves = problem.curves;
  result.notes = study.notes;
  if (result.calibration.ended().status == io::RunStatus::stopped) {  // what an earlier run found is worth more
    result.frequency_response.clear();
    return result;
  }
  const CalibrationFit& fit = result.calibration.fit();
  if (options.identifiability_fits > 0 && fit.parameter_count > 0)
    result.identifiability = test_identifiability(problem, fit, options);

  if (!result.frequency_response.empty()) {
    compute_frequency_response(result.frequency_response, *study.frequency_response,
                               reported_parameters(result.calibration, study));
  }

  remove_earlier_results(run);
  if (fit.parameter_count > 0) io::write_whole(folder / "parameters.toml", parameters_text(result.calibration, study));
  io::write_whole(folder / "result.toml", result_text(result.calibration, study, result.curves));
  write_tables(folder, result);
  if (options.pictures) draw(folder, result);
  run.finish(study_text(study, problem), study.inputs);
  return result;
}

}  // namespace menger::voxel
