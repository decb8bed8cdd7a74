#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <optional>
#include <string>
#include <utility>

#include "io/process/exit_code.h"
#include "io/process/program.h"
#include "io/process/progress.h"
#include "io/process/run_folder.h"
#include "io/text/content_hash.h"
#include "io/text/formatted.h"
#include "io/text/input_error.h"
#include "io/text/number_text.h"
#include "materials/fit/fit_chart.h"
#include "materials/fit/tensile_cleaning.h"

namespace {

using namespace menger;

struct Arguments {
  std::filesystem::path test;
  std::filesystem::path folder;
  std::pair<double, double> range{0.0, 1.0};
  std::optional<double> crosshead_correction;
  bool raw = false;
  bool no_pictures = false;
};

std::optional<int> parse(int argc, const char* const* argv, Arguments& arguments) {
  CLI::App app("Fits hyperelastic laws to a uniaxial tensile test and ranks them.", "menger fit");
  app.footer(
      "Example:\n  menger fit 'Dragon Skin 10 MEDIUM.csv' --range 0 1 -o fits\n"
      "writes fits/fits.toml, curves.csv, fits.png and manifest.json.\n"
      "The test is a file of the Soft Robotics Materials Database or has two columns with units in the header, such as\n"
      "strain,stress_kPa. Unless --raw is given, known faults of a record are repaired, and each repair is printed.\n"
      "Exit codes: 0 done, 2 wrong input, 3 no law is stable, plausible, determined by the test and close to\n"
      "the test at the same time.");
  app.add_option("test", arguments.test, "tensile test (CSV)")->required();
  app.add_option("-o,--output", arguments.folder, "folder of the results (default: the name of the test)");
  app.add_option("--range", arguments.range, "range of strains for the fit, as fractions (default: 0 1)");
  app.add_flag("--raw", arguments.raw, "do not repair the record");
  app.add_flag("--no-pictures", arguments.no_pictures, "make no PNG picture");
  app.add_option(
      "--crosshead-correction", arguments.crosshead_correction,
      "divide the strain by this factor, because crosshead travel overstates it; an estimate, such as 1.71 for the die C "
      "specimens of the database (default: none)");
  return io::parse_arguments(app, argc, argv);
}

void check(const Arguments& arguments) {
  const auto [low, high] = arguments.range;
  if (!(low >= -1.0 && low < high && high < 1e6)) {
    throw io::InputError("--range " + io::number_text(low) + " " + io::number_text(high) +
                         ": the first strain must be smaller than the second, and both finite and >= -1");
  }
  if (arguments.crosshead_correction && !(*arguments.crosshead_correction >= 1.0 && *arguments.crosshead_correction < 100.0)) {
    throw io::InputError("--crosshead-correction " + io::number_text(*arguments.crosshead_correction) + ": must be in [1, 100)");
  }
}

void print(const materials::FitReport& report) {
  std::cout << io::formatted("%-27s %10s %10s %9s %9s  %-8s %s\n", "law", "mu (kPa)", "rmse (kPa)", "R2", "AIC", "stable",
                             "biaxial/uniaxial");
  for (const materials::LawFit& fit : report.ranking) {
    const std::string ratio = fit.equibiaxial_ratio ? io::shown(*fit.equibiaxial_ratio) : "-";
    const char* stable = !fit.stable ? "no" : fit.stable_with_margin ? "yes" : "barely";
    const char* doubt = !fit.plausible ? " (not of silicone)" : fit.cancelling ? " (terms cancel)" : "";
    std::cout << io::formatted("%-27s %10.4g %10.4g %9.6f %9.1f  %-8s %s%s\n", fit.name.c_str(),
                               1e-3 * materials::shear_modulus_at_rest_Pa(fit.law), 1e-3 * fit.rmse_Pa, fit.r_squared, fit.aic,
                               stable, ratio.c_str(), doubt);
  }
}

std::string parameter_text(const Arguments& arguments) {
  std::string text =
      "range = [" + io::number_text(arguments.range.first) + ", " + io::number_text(arguments.range.second) + "]\n";
  text += std::string("raw = ") + (arguments.raw ? "true" : "false") + "\n";
  if (arguments.crosshead_correction) text += "crosshead_correction = " + io::number_text(*arguments.crosshead_correction) + "\n";
  return text;
}

int run(int argc, const char* const* argv) {
  Arguments arguments;
  if (const auto code = parse(argc, argv, arguments)) return *code;
  check(arguments);
  if (arguments.folder.empty()) arguments.folder = arguments.test.stem();
  const io::RunFolder folder("menger-fit", arguments.folder);

  materials::TensileTest test = materials::read_tensile_test(arguments.test);
  materials::FitReport report;
  if (!arguments.raw) report.repairs = materials::clean(test);
  if (arguments.crosshead_correction) {
    report.repairs.push_back(materials::correct_crosshead_strain(test, *arguments.crosshead_correction));
  }
  for (const std::string& repair : report.repairs) std::cout << "  " << repair << '\n';
  report.file = arguments.test;
  report.material = test.material;
  report.strain_source = test.strain_source;
  report.range = {arguments.range.first, arguments.range.second};
  try {
    io::Progress progress("fit", 1.0);
    report.ranking =
        materials::fit_laws(test, report.range, [&](double done, std::string_view law) { progress.update(done, law); });
  } catch (const io::InputError& error) {
    throw io::InputError(arguments.test.string() + ": " + error.what());
  }

  const std::string hash = io::file_hash(arguments.test);
  folder.begin({"fits.toml", "curves.csv", "fits.png"});
  materials::write_fits(arguments.folder, report, test);
  const io::PictureOutcome chart = arguments.no_pictures
                                       ? io::PictureOutcome{.written = true}
                                       : materials::write_fit_chart(arguments.folder / "fits.png", report, test);
  folder.finish(parameter_text(arguments), {{arguments.test.string(), hash}});

  print(report);
  for (const std::string& note : materials::cancelling_notes(report.ranking)) std::cout << "  " << note << '\n';
  if (!chart.written) std::cout << "no picture: " << chart.missing << '\n';
  const materials::LawFit* best = materials::recommended_fit(report.ranking);
  std::cout
      << (best != nullptr
              ? "recommended: " + best->name
              : std::string(
                    "no law is recommended: no law is stable, plausible, determined and close to the test at the same time"));
  std::cout << "; results in " << arguments.folder.string() << '\n';
  return best != nullptr ? io::exit_code::done : io::exit_code::numerical;
}

}  // namespace

int main(int argc, char** argv) {
  return menger::io::run_program("menger-fit", [&] { return run(argc, argv); });
}
