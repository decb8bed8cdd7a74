#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <optional>
#include <string>
#include <vector>

#include "io/process/exit_code.h"
#include "io/process/interrupt.h"
#include "io/process/program.h"
#include "io/process/progress.h"
#include "io/process/run_folder.h"
#include "io/process/study_help.h"
#include "io/text/formatted.h"
#include "meshes/robot/command_study.h"
#include "voxel/calibration/calibration_report.h"
#include "voxel/calibration/calibration_run.h"
#include "voxel/calibration/calibration_tables.h"
#include "voxel/statics/load_case_slopes.h"

namespace {

using namespace menger;

struct Arguments {
  std::filesystem::path study;
  std::filesystem::path folder;
  std::vector<std::filesystem::path> curves;
  int identifiability_fits = 0;
  bool no_pictures = false;
};

std::optional<int> parse(int argc, const char* const* argv, Arguments& arguments) {
  CLI::App app("Fits the parameters of the voxel surrogate to response curves of finite elements.", "menger calibrate");
  app.footer(
      "Example:\n  menger calibrate voxel/studies/dragon_skin_10_1cm.toml -o calibration\n"
      "writes calibration/parameters.toml (for [surrogate] of scenes and searches), result.toml, details.csv, parameters.csv,\n"
      "correlation.csv, residuals.csv, responses.csv, a picture of every curve, agreement.png and manifest.json.\n"
      "Exit codes: 0 done, 2 wrong input, 3 the fit did not converge (the best parameters found are written, with\n"
      "this status), 130 interrupted (nothing is written).");
  io::add_study_help(app, [](io::StudyVisitor& visitor) {
    voxel::CalibrationStudy study;
    describe(visitor, study);
  });
  app.add_option("study", arguments.study, "study file, or robot.toml of menger init or its folder")->required();
  app.add_option("-o,--output", arguments.folder,
                 "folder of the results (default: the name of the study file; of a robot, its folder in results)");
  app.add_option("--curves", arguments.curves, "files or folders of response curves, instead of those of the study");
  app.add_option("--identifiability", arguments.identifiability_fits,
                 "test the confidence intervals, too: make this many sets of curves from the fitted parameters, with noise, fit "
                 "each from a distant start, and count how often the intervals contain the true values")
      ->check(CLI::Range(1, 100000));
  app.add_flag("--no-pictures", arguments.no_pictures, "make no PNG pictures");
  return io::parse_arguments(app, argc, argv);
}

template <class... Values>
void print_row(const char* format, Values... values) {
  std::cout << io::formatted(format, values...) << '\n';
}

void print_details(const voxel::CalibrationRunResult& result) {
  print_row("%-14s %10s %12s %12s %10s  %s", "detail", "parameters", "reduced chi2", "AIC", "RMS (%)", "status");
  for (const voxel::CalibrationStep& step : result.calibration.steps) {
    const voxel::CalibrationFit& fit = step.fit;
    if (fit.residual_count == 0) {
      print_row("%-14s %10s %12s %12s %10s  %s", std::string(voxel::to_string(step.detail)).c_str(), "-", "-", "-", "-",
                std::string(io::to_string(fit.status)).c_str());
      continue;
    }
    const double rms = voxel::relative_error_of(std::nullopt, result.curves, fit).value_or(0.0);
    print_row("%-14s %10zu %12.4g %12.1f %10.3g  %s%s",
              ((step.kept_before.empty() ? "" : "+ ") + std::string(voxel::to_string(step.detail))).c_str(), fit.parameter_count,
              fit.reduced_chi2(), fit.aic, 100.0 * rms, std::string(io::to_string(fit.status)).c_str(),
              step.is_kept ? ", kept" : ", dropped");
  }
}

void print_parameters(const voxel::CalibrationFit& fit) {
  print_row("%-40s %12s %27s  %s", "parameter", "value", "95 % interval", "");
  for (const voxel::FittedValue& value : fit.values) {
    const auto& bounds = value.confidence_95;
    const std::string interval = bounds ? io::formatted("%.4g ... %.4g", bounds->first, bounds->second) : "-";
    const bool is_determined = value.determination == voxel::Determination::determined;
    print_row("%-40s %12.5g %27s  %s", value.parameter.name.c_str(), value.value, interval.c_str(),
              is_determined ? "" : std::string(voxel::to_string(value.determination)).c_str());
  }
}

void print_frequency_response(const std::vector<voxel::FrequencyGain>& gains) {
  if (gains.empty()) return;
  double worst = 0.0;
  std::size_t computed = 0;
  for (const voxel::FrequencyGain& gain : gains) {
    if (!gain.surrogate_m_per_Pa) continue;
    ++computed;
    worst = std::max(worst, std::abs(*gain.surrogate_m_per_Pa / gain.reference_m_per_Pa - 1.0));
  }
  if (computed > 0) print_row("frequency response: largest error %.3g %%", 100.0 * worst);
  if (computed < gains.size())
    print_row("frequency response: not computed at %zu of %zu frequencies", gains.size() - computed, gains.size());
}

void print(const voxel::CalibrationRunResult& result, const std::filesystem::path& folder) {
  const voxel::CalibrationFit& fit = result.calibration.fit();
  for (const std::string& note : result.notes) std::cout << "  " << note << '\n';
  for (const std::string& note : voxel::class_notes(result.calibration.classes)) std::cout << "  " << note << '\n';
  print_details(result);
  for (const std::string& note : voxel::failed_details(result.calibration)) std::cout << "  " << note << '\n';
  print_parameters(fit);
  for (const voxel::Outlier& outlier : voxel::outliers_of(result.curves, fit)) {
    print_row("outlier: %s, %s, row %zu: %+.3g standard deviations", result.curves[outlier.curve].load_case.name.c_str(),
              outlier.ordinate.c_str(), outlier.row + 1, outlier.residual);
  }
  if (!fit.explained) std::cout << "the stated uncertainties of the curves do not explain the residuals\n";
  if (result.identifiability) {
    for (const voxel::Coverage& coverage : result.identifiability->coverage) {
      const auto [lowest, highest] = voxel::likely_hits(coverage.interval_count, 0.95);
      print_row("interval of %s contained the true value %d of %d times (likely by chance: %d to %d)", coverage.name.c_str(),
                coverage.hit_count, coverage.interval_count, lowest, highest);
    }
  }
  print_frequency_response(result.frequency_response);
  const voxel::CalibrationFit& ended = result.calibration.ended();
  std::cout << io::to_string(ended.status);
  if (!ended.reason.empty()) std::cout << ": " << ended.reason;
  std::cout << "; results in " << folder.string() << '\n';
}

int exit_code_of(const voxel::CalibrationRunResult& result) {
  if (io::interrupted()) return io::exit_code::interrupted;
  const bool is_done = result.calibration.ended().status == io::RunStatus::completed;
  return is_done ? io::exit_code::done : io::exit_code::numerical;
}

int run(int argc, const char* const* argv) {
  Arguments arguments;
  if (const auto code = parse(argc, argv, arguments)) return *code;
  const meshes::CommandStudy command =
      meshes::command_study(arguments.study, meshes::RobotStudy::calibrate, arguments.folder, !arguments.curves.empty());
  arguments.study = command.study;
  arguments.folder = command.folder;
  const voxel::CalibrationStudy study = voxel::read_calibration_study(arguments.study, arguments.curves);

  io::Progress progress(arguments.study.stem().string(), 1.0);
  voxel::CalibrationRunOptions options{
      .pictures = !arguments.no_pictures, .identifiability_fits = arguments.identifiability_fits, .stop = &io::interrupted()};
  options.progress = [&](double done, const std::string& note) { progress.update(done, note); };
  const voxel::CalibrationRunResult result =
      voxel::run_calibration(study, voxel::equilibrium_responder(), arguments.folder, options);
  progress.clear();
  if (const io::RunStatus status = result.calibration.ended().status; status == io::RunStatus::stopped) {
    std::cout << "Stopped. Nothing was written.\n";
    return io::exit_code_of(status);
  }
  print(result, arguments.folder);
  return exit_code_of(result);
}

}  // namespace

int main(int argc, char** argv) {
  return menger::io::run_program("menger-calibrate", [&] { return run(argc, argv); });
}
