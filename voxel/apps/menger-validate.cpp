#include <unistd.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "io/process/child_program.h"
#include "io/process/exit_code.h"
#include "io/process/interrupt.h"
#include "io/process/program.h"
#include "io/process/progress.h"
#include "io/process/run_folder.h"
#include "io/process/study_help.h"
#include "io/study/installed_folders.h"
#include "io/text/content_hash.h"
#include "io/text/formatted.h"
#include "io/text/input_error.h"
#include "io/text/toml_text.h"
#include "io/text/whole_file.h"
#include "meshes/robot/command_study.h"
#include "voxel/model/surrogate_file.h"
#include "voxel/validation/validation_run.h"

namespace {

using namespace menger;
namespace fs = std::filesystem;

struct Arguments {
  fs::path study;
  fs::path folder;
  voxel::ValidationPlaces places;
  bool explain = false;
  bool no_pictures = false;
  bool keep = false;
};

std::optional<int> parse(int argc, const char* const* argv, Arguments& arguments) {
  CLI::App app("Compares voxel parameters with response curves of finite elements that no fit has seen.", "menger validate");
  app.footer(
      "Example:\n  menger validate voxel/studies/held_out.toml --parameters calibration/parameters.toml -o validation\n"
      "uses the parameters of menger calibrate. The study names the held-out load cases, or folders of curves. menger "
      "load-cases\n"
      "first computes the curves of the load cases; existing curves are kept. It writes validation/errors.csv, "
      "summary.csv, signs.csv,\n"
      "expected_errors.csv, volume_actuation.csv, report.txt, errors.png, a picture of every curve, manifest.json, and the body "
      "that is\n"
      "furthest off, in millimetres over its length, in both models: worst.pvd (open it in ParaView) and worst.png.\n"
      "Exit codes: 0 done, 2 wrong input, 3 the surrogate has no equilibrium in some state (the tables are written),\n"
      "130 interrupted.");
  io::add_study_help(app, [](io::StudyVisitor& visitor) {
    voxel::ValidationStudy study;
    describe(visitor, study);
  });
  app.add_option("study", arguments.study, "study file, or robot.toml of menger init or its folder")->required();
  app.add_option("-o,--output", arguments.folder,
                 "folder of the results (default: the name of the study file; of a robot, its folder in results)");
  app.add_option("--parameters", arguments.places.parameters, "voxel parameters, instead of the study's");
  app.add_option("--curves", arguments.places.curves, "folders or files of response curves, instead of the study's");
  app.add_flag("--explain", arguments.explain,
               "fit sizes, stiffnesses and both to each body alone, to find which of them cause its error");
  app.add_flag("--no-pictures", arguments.no_pictures, "make no PNG pictures");
  app.add_flag("--keep", arguments.keep,
               "also write the expected errors by kind of body beside the parameters, from where menger simulate and menger "
               "evolve tell users of them; kinds that were not compared keep what is there of the same parameters");
  return io::parse_arguments(app, argc, argv);
}

/// Runs menger-load-cases. @return false if the user stopped it
/// @throws io::InputError if it refuses its input
bool make_curves(const fs::path& set, const fs::path& folder, const fs::path& logs) {
  io::require_writable_folder(logs);
  io::ChildProgram child;
  child.program = io::program_in(io::own_program_folder(), "menger-load-cases");
  child.arguments = {fs::absolute(set).string(), "-o", fs::absolute(folder).string(), "--fields"};
  child.out = logs / "load_cases.txt";
  // Its progress messages belong on the terminal, if there is one.
  child.err = ::isatty(STDERR_FILENO) != 0 ? fs::path("/dev/stderr") : logs / "load_cases_errors.txt";
  child.stop = &io::interrupted();
  const io::ChildOutcome outcome = io::run_child(child);
  if (outcome.end == io::ChildEnd::stopped || outcome.exit_code == io::exit_code::interrupted) return false;
  if (outcome.exit_code == io::exit_code::done || outcome.exit_code == io::exit_code::numerical) return true;
  throw io::InputError(set.string() + ": menger-load-cases ended " +
                       (outcome.end == io::ChildEnd::signalled ? "by signal " + std::to_string(outcome.signal)
                                                               : "with exit code " + std::to_string(outcome.exit_code)) +
                       "; the reason is in " + child.err.string());
}

std::string parameter_text(const voxel::ValidationStudy& study, const voxel::SurrogateParameters& parameters) {
  io::TomlText text;
  text.add("aim", study.aim);
  text.add("actuation_pressure_Pa", study.actuation_pressure_Pa).add("actuation_amplitude", study.actuation_amplitude);
  return text.text() + voxel::surrogate_text(parameters);
}

/// Every input file with the hash of its content.
std::map<std::string, std::string> inputs_of(const voxel::ValidationStudy& study,
                                             const std::vector<voxel::HeldOutCurve>& curves) {
  std::map<std::string, std::string> inputs;
  const auto add = [&](const std::filesystem::path& file) { io::note_input(inputs, file); };
  add(study.file);
  add(study.parameters);
  for (const voxel::HeldOutCurve& curve : curves) add(curve.file);
  if (study.load_cases) add(*study.load_cases);
  return inputs;
}

int run(int argc, const char* const* argv) {
  Arguments arguments;
  if (const auto code = parse(argc, argv, arguments)) return *code;
  const meshes::CommandStudy command = meshes::command_study(arguments.study, meshes::RobotStudy::validate, arguments.folder,
                                                             arguments.places.parameters.has_value());
  arguments.study = command.study;
  arguments.folder = command.folder;
  voxel::ValidationStudy study = voxel::read_validation_study(arguments.study, arguments.places);
  const voxel::SurrogateParameters parameters = voxel::read_surrogate(study.parameters);
  const voxel::FitRecord record = voxel::read_fit_record(study.parameters);

  const auto earlier = arguments.keep ? voxel::read_expected_errors(study.parameters) : std::nullopt;

  const io::RunFolder folder("menger-validate", arguments.folder);
  if (study.load_cases) {
    const fs::path curves = voxel::load_case_folder(study, arguments.folder / "curves");
    if (!make_curves(*study.load_cases, curves, arguments.folder)) return io::exit_code::interrupted;
  }
  const std::vector<voxel::HeldOutCurve> curves = voxel::read_held_out_curves(study, parameters, record);
  const std::map<std::string, std::string> inputs = inputs_of(study, curves);
  io::require_writable_folder(arguments.folder);

  io::Progress progress(arguments.study.stem().string(), 1.0);
  voxel::ValidationRunOptions options{
      .pictures = !arguments.no_pictures, .explain = arguments.explain, .stop = &io::interrupted()};
  options.progress = [&](double done, const std::string& note) { progress.update(done, note); };
  const voxel::ValidationResult result = voxel::run_validation(study, parameters, record, curves, arguments.folder, options);
  progress.clear();
  if (result.status == io::RunStatus::stopped) {
    std::cout << "Stopped. Nothing was written.\n";
    return io::exit_code_of(result.status);
  }
  folder.finish(parameter_text(study, parameters), inputs);
  if (arguments.keep) {
    const voxel::ExpectedErrors all = voxel::together_with(result.expected, earlier);
    voxel::expected_errors_table(all).write(voxel::expected_errors_file(study.parameters));
  }
  for (const std::string& line : voxel::report_lines(result, study.aim)) std::cout << line << '\n';
  std::cout << io::to_string(result.status) << ": " << io::counted(result.comparisons.size(), "curve") << "; results in "
            << arguments.folder.string() << '\n';
  return io::exit_code_of(result.status);
}

}  // namespace

int main(int argc, char** argv) {
  return menger::io::run_program("menger-validate", [&] { return run(argc, argv); });
}
