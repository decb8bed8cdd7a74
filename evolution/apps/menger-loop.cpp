// menger loop robot.toml: from one file of a robot to all results, by the other programs.
#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <iostream>
#include <optional>

#include "evolution/loop/loop_run.h"
#include "io/process/child_program.h"
#include "io/process/interrupt.h"
#include "io/process/program.h"
#include "io/process/study_help.h"
#include "io/study/installed_folders.h"
#include "meshes/robot/robot_file.h"

namespace {

namespace io = menger::io;
using menger::evolution::LoopRequest;

constexpr const char* description =
    "Computes what a robot's file asks for: its mesh, its inflation and limit pressure, the voxels of its silicone, their error "
    "on\n"
    "this very body, its walk as voxels and on finite elements, a search for a better body, and a report.";

constexpr const char* example =
    "Example:\n"
    "  menger init crawler\n"
    "  menger loop crawler/robot.toml\n"
    "writes crawler/results, with a folder and a log for each stage. The same command again repeats only what a change of the "
    "file\n"
    "decides, and goes on after Ctrl-C. mesh, inflate, load-cases, calibrate, validate, simulate\n"
    "and locomote take robot.toml, too: menger locomote crawler/robot.toml -o walk.\n"
    "Exit codes: 0 done, 2 wrong input, 3 a stage ended with a numerical outcome, 130 interrupted.";

std::optional<int> parse(LoopRequest& request, int argc, char** argv) {
  CLI::App app(description, "menger loop");
  app.footer(example);
  io::add_study_help(app, [](io::StudyVisitor& visitor) {
    menger::meshes::Robot robot;
    describe(visitor, robot);
  });
  app.add_option("robot", request.robot, "File of a robot (TOML), or its folder; menger init writes one")->required();
  app.add_option("-o,--output", request.results, "Folder of the results (default: results, beside the robot)");
  CLI::Option* until = app.add_option("--until", request.until,
                                      "Last stage to run. Stages: mesh, inflate, limit, load_cases, calibrate, validate, "
                                      "simulate, locomote, locomote_finer, evolve, "
                                      "export, reevaluate, report, those that the robot asks for");
  app.add_option("--only", request.only, "The one stage to run")->excludes(until);
  app.add_flag("--fit", request.fits_anew, "Fit the voxels, although menger comes with parameters for these cells (minutes)");
  app.add_flag("--write-studies", request.only_studies,
               "Write the study of every stage, which the other commands take, and run nothing");
  return io::parse_arguments(app, argc, argv);
}

}  // namespace

int main(int argc, char** argv) {
  return io::run_program("menger-loop", [&]() -> int {
    LoopRequest request;
    if (const auto code = parse(request, argc, argv)) return *code;
    request.programs = io::own_program_folder();
    request.stop = &io::interrupted();
    return menger::evolution::run_loop(request, std::cout);
  });
}
