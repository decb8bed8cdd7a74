#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "io/process/exit_code.h"
#include "io/process/program.h"
#include "io/process/progress.h"
#include "io/process/run_folder.h"
#include "io/text/content_hash.h"
#include "io/text/formatted.h"
#include "io/text/input_error.h"
#include "io/text/is_file.h"
#include "io/text/joined_text.h"
#include "io/text/number_text.h"
#include "io/text/whole_file.h"
#include "materials/fit/fit_chart.h"
#include "materials/fit/tensile_cleaning.h"

namespace {

using namespace menger;

struct Arguments {
  std::filesystem::path test;
  std::filesystem::path folder;
  std::pair<double, double> range{0.0, 1.0};
  bool has_range = false;  ///< whether the range was given
  std::optional<double> crosshead_correction;
  std::optional<double> density_kg_per_m3;
  bool raw = false;
  bool no_pictures = false;
};

constexpr const char* record_name = "silicone.toml";

/// Parses the arguments. For a range that is not two numbers CLI11 says how many are missing, but not what they are.
std::optional<int> parse_with_range(CLI::App& app, int argc, const char* const* argv) {
  try {
    return io::parse_arguments(app, argc, argv);
  } catch (const io::InputError& error) {
    const std::string_view message = error.what();
    if (!message.starts_with("--range:") && !message.starts_with("Could not convert: --range")) throw;
    throw io::InputError("--range LOW HIGH: needs two strains with a space between them, such as --range 0 3 (see --help)");
  }
}

std::optional<int> parse(int argc, const char* const* argv, Arguments& arguments) {
  CLI::App app("Fits hyperelastic laws to a uniaxial tensile test and ranks them.", "menger fit");
  app.footer(
      "Example:\n  menger fit 'Dragon Skin 10 MEDIUM.csv' --range 0 1 -o fits\n"
      "writes fits/fits.toml, curves.csv, fits.png and manifest.json, and with --density also silicone.toml, a record\n"
      "that studies can name: silicone = \"fits/silicone.toml\".\n"
      "The test is a file of the Soft Robotics Materials Database or has two columns with units in the header, such as\n"
      "strain,stress_kPa. Unless --raw is given, known faults of a record are repaired, and each repair is printed.\n"
      "Exit codes: 0 done, 2 wrong input, 3 no law is stable, plausible, determined by the test and close to\n"
      "the test at the same time.");
  app.add_option("test", arguments.test, "tensile test (CSV)")->required();
  app.add_option("-o,--output", arguments.folder, "folder of the results (default: the name of the test)");
  const CLI::Option* range =
      app.add_option("--range", arguments.range,
                     "lowest and highest strain for the fit, as fractions (default: 0 1; rows beyond are left out)")
          ->type_name("LOW HIGH");
  app.add_flag("--raw", arguments.raw, "do not repair the record");
  app.add_flag("--no-pictures", arguments.no_pictures, "make no PNG picture");
  app.add_option(
      "--crosshead-correction", arguments.crosshead_correction,
      "divide the strain by this factor, because crosshead travel overstates it; an estimate, such as 1.71 for the die C "
      "specimens of the database (default: none)");
  app.add_option("--density", arguments.density_kg_per_m3,
                 "density of the silicone; also writes a record of it, silicone.toml, with the recommended law")
      ->type_name("KG_PER_M3");
  const std::optional<int> code = parse_with_range(app, argc, argv);
  arguments.has_range = range->count() > 0;
  return code;
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
  if (arguments.density_kg_per_m3 && !(*arguments.density_kg_per_m3 >= 10.0 && *arguments.density_kg_per_m3 <= 3e4)) {
    throw io::InputError("--density " + io::number_text(*arguments.density_kg_per_m3) +
                         ": must be in kg/m3, from 10 to 30000; silicones have about 1000");
  }
}

/// Refuses a folder whose place a file has, or that of a folder above it.
void require_no_file(const std::filesystem::path& folder) {
  std::error_code ignored;
  for (std::filesystem::path part = folder; !part.empty() && part != part.root_path(); part = part.parent_path()) {
    if (std::filesystem::exists(part, ignored) && !std::filesystem::is_directory(part, ignored))
      throw io::InputError(part.string() + ": is a file, not a folder: choose another -o");
  }
}

/// Whether the folder has a record that menger fit wrote. One by hand is neither replaced nor removed.
bool has_own_record(const std::filesystem::path& folder) {
  constexpr std::string_view start = materials::silicone_text_start;
  const std::filesystem::path record = folder / record_name;
  return io::is_file(record) && io::read_start(record, start.size()) == start;
}

void require_no_foreign_record(const std::filesystem::path& folder) {
  const std::filesystem::path record = folder / record_name;
  std::error_code ignored;
  if (std::filesystem::exists(record, ignored) && !has_own_record(folder))
    throw io::InputError(record.string() + ": was not written by menger fit and is not replaced: choose another -o");
}

/// Returns which rows are fitted, and the range that takes all if some are left out.
std::string text_of_rows(const materials::TensileTest& test, const materials::StrainRange& range) {
  const materials::FittedRows rows = materials::fitted_rows(test, range);
  std::string text = "fitted to strains of " + io::shown(rows.lowest_strain) + " to " + io::shown(rows.highest_strain) + " (" +
                     std::to_string(rows.count) + " of " + std::to_string(test.strain.size()) + " rows";
  if (rows.count == test.strain.size()) return text + ")";
  const auto [lowest, highest] = std::ranges::minmax(test.strain);
  const bool goes_on = highest > range.highest;
  // Rounded outwards, so that the range still takes all.
  const double low = lowest < range.lowest ? 1e-3 * std::floor(1e3 * lowest) : range.lowest;
  const double high = goes_on ? 1e-3 * std::ceil(1e3 * highest) : range.highest;
  text += goes_on ? "; the test goes to " + io::shown(highest) : "; the test begins at " + io::shown(lowest);
  return text + ": --range " + io::shown(low, 7) + " " + io::shown(high, 7) + " takes all)";
}

/// Returns a warning if the range that was given ends beyond the test, by more than a hundredth of it; otherwise nothing.
std::string warning_of_range(const Arguments& arguments, const materials::TensileTest& test) {
  const auto [low, high] = arguments.range;
  const double end = std::ranges::max(test.strain);
  if (!arguments.has_range || high - end <= 0.01 * (high - low)) return "";
  return "warning: the range ends at a strain of " + io::shown(high) + ", the test at " + io::shown(end);
}

void print(const materials::FitReport& report) {
  std::cout << io::formatted("%-27s %10s %10s %9s %9s  %-8s %-17s %s\n", "law", "mu (kPa)", "rmse (kPa)", "R2", "AIC", "stable",
                             "biaxial/uniaxial", "usable");
  for (const materials::LawFit& fit : report.ranking) {
    const std::string ratio = fit.equibiaxial_ratio ? io::shown(*fit.equibiaxial_ratio) : "-";
    const char* stable = !fit.stable ? "no" : fit.stable_with_margin ? "yes" : "barely";
    const std::vector<std::string> shortcomings = materials::shortcomings_of(fit);
    const std::string usable = shortcomings.empty() ? "yes" : "no: " + io::joined(shortcomings);
    std::cout << io::formatted("%-27s %10.4g %10.4g %9.6f %9.1f  %-8s %-17s %s\n", fit.name.c_str(),
                               1e-3 * materials::shear_modulus_at_rest_Pa(fit.law), 1e-3 * fit.rmse_Pa, fit.r_squared, fit.aic,
                               stable, ratio.c_str(), usable.c_str());
  }
}

std::string parameter_text(const Arguments& arguments) {
  std::string text =
      "range = [" + io::number_text(arguments.range.first) + ", " + io::number_text(arguments.range.second) + "]\n";
  text += std::string("raw = ") + (arguments.raw ? "true" : "false") + "\n";
  if (arguments.crosshead_correction) text += "crosshead_correction = " + io::number_text(*arguments.crosshead_correction) + "\n";
  if (arguments.density_kg_per_m3) text += "density_kg_per_m3 = " + io::number_text(*arguments.density_kg_per_m3) + "\n";
  return text;
}

/// Writes a record of the silicone if a density was given. Returns a sentence that says so, or why there is none.
std::string write_record(const Arguments& arguments, const materials::FitReport& report, const materials::TensileTest& test) {
  if (!arguments.density_kg_per_m3) return "";
  const std::string none = std::string("no ") + record_name + ": ";
  const materials::LawFit* best = materials::recommended_fit(report.ranking);
  if (best == nullptr) return none + "no law is recommended";
  if (!(materials::fitted_rows(test, report.range).highest_strain > 0.0)) return none + "the test has no tension";
  const std::filesystem::path record = arguments.folder / record_name;
  io::write_whole(record, materials::silicone_text(report, test, *best, *arguments.density_kg_per_m3));
  return "a record of the silicone for studies: " + record.string();
}

int run(int argc, const char* const* argv) {
  Arguments arguments;
  if (const auto code = parse(argc, argv, arguments)) return *code;
  check(arguments);
  if (arguments.folder.empty()) arguments.folder = arguments.test.stem();
  require_no_file(arguments.folder);
  if (arguments.density_kg_per_m3) require_no_foreign_record(arguments.folder);
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
  if (has_own_record(arguments.folder)) folder.remove({record_name});
  materials::write_fits(arguments.folder, report, test);
  const io::PictureOutcome chart = arguments.no_pictures
                                       ? io::PictureOutcome{.written = true}
                                       : materials::write_fit_chart(arguments.folder / "fits.png", report, test);
  const std::string record = write_record(arguments, report, test);
  folder.finish(parameter_text(arguments), {{arguments.test.string(), hash}});

  std::cout << text_of_rows(test, report.range) << '\n';
  if (const std::string warning = warning_of_range(arguments, test); !warning.empty()) std::cout << warning << '\n';
  print(report);
  for (const std::string& note : materials::cancelling_notes(report.ranking)) std::cout << "  " << note << '\n';
  if (!record.empty()) std::cout << record << '\n';
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
