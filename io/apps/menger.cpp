// `menger evolve study.toml` runs menger-evolve, so that no program loads the libraries of another.
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <filesystem>
#include <iomanip>
#include <iostream>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "io/process/exit_code.h"
#include "io/process/interrupt.h"
#include "io/process/program.h"
#include "io/study/installed_folders.h"
#include "io/text/input_error.h"
#include "io/text/is_file.h"
#include "io/text/near_miss.h"
#include "io/text/version.h"

namespace {

namespace fs = std::filesystem;
namespace io = menger::io;

struct Command {
  std::string_view name;
  std::string_view purpose;
  std::string_view example;
};

constexpr std::array commands{
    Command{"init", "write the file of a robot to begin with", "menger init my_robot"},
    Command{"loop", "compute everything that a robot's file asks for", "menger loop my_robot/robot.toml"},
    Command{"fit", "fit a hyperelastic law to tensile tests", "menger fit tensile.csv"},
    Command{"mesh", "mesh a design as a hollow silicone body", "menger mesh mesh.toml"},
    Command{"inflate", "inflate the chambers of a finite-element body", "menger inflate inflate.toml"},
    Command{"modes", "compute natural frequencies and modes of a finite-element body", "menger modes inflate.toml"},
    Command{"stall-map", "compute the pressure for each piston stroke and line resistance", "menger stall-map study.toml"},
    Command{"locomote", "move a silicone robot over the ground by finite elements", "menger locomote locomotion.toml"},
    Command{"load-cases", "compute finite-element responses to a set of load cases", "menger load-cases set.toml"},
    Command{"calibrate", "calibrate voxel parameters to finite-element response curves", "menger calibrate study.toml"},
    Command{"validate", "compare voxel and finite-element responses", "menger validate validate.toml"},
    Command{"tradeoff", "compute one design at all fidelities: error against cost", "menger tradeoff design.toml"},
    Command{"extremes", "run cases at the limits of the models", "menger extremes --part voxel"},
    Command{"simulate", "simulate one design and write its trajectory", "menger simulate scene.toml"},
    Command{"evolve", "evolve fractal robots; resumes from its archive", "menger evolve study.toml"},
    Command{"export", "write designs and tables from the archive of a run", "menger export run.sqlite"},
    Command{"confirm", "let the best robots of a search walk as another study says", "menger confirm run.sqlite study.toml"},
    Command{"compare-searches", "compare results of searches on finite elements, and their costs", "menger compare-searches a b"},
    Command{"reevaluate", "evaluate the winners of a run again with finite elements", "menger reevaluate run.sqlite --top 5"},
    Command{"report", "write one page on the results in a folder", "menger report demo"},
};

bool is_program(const fs::path& file) { return io::is_file(file) && ::access(file.c_str(), X_OK) == 0; }

fs::path program_of(std::string_view command) { return io::own_program_folder() / ("menger-" + std::string(command)); }

/// The commands that are run by other programs in the folder of this one.
std::vector<Command> present_commands() {
  std::vector<Command> present;
  std::copy_if(commands.begin(), commands.end(), std::back_inserter(present),
               [](const Command& command) { return is_program(program_of(command.name)); });
  return present;
}

void print_help(std::ostream& out) {
  out << "menger " << io::version() << ": evolve, simulate and evaluate pneumatic soft robots\n\n"
      << "usage: menger <command> [arguments]   (menger <command> --help explains a command, --template prints its "
         "study, if it reads one)\n\ncommands:\n";
  const std::vector<Command> present = present_commands();
  if (present.empty()) out << "  none found in " << io::own_program_folder().string() << '\n';
  std::size_t width = 0;
  for (const Command& command : present) width = std::max(width, command.name.size());
  const int column = static_cast<int>(width) + 2;
  for (const Command& command : present) {
    out << "  " << std::left << std::setw(column) << command.name << command.purpose << '\n'
        << "  " << std::setw(column) << ""
        << "e.g. " << command.example << '\n';
  }
}

/// Returns a suggestion for a mistyped command: ", did you mean evolve?", or nothing.
std::string meant(std::string_view command) {
  std::vector<std::string> names;
  for (const Command& known : present_commands()) names.emplace_back(known.name);
  const auto name = io::near_miss(command, names);
  return name ? ", did you mean " + *name + "?" : "";
}

int dispatch(int argc, char** argv) {
  if (argc < 2) {
    print_help(std::cerr);
    return io::exit_code::bad_input;
  }
  const std::string command = argv[1];
  if (command == "--help" || command == "-h" || command == "help") {
    print_help(std::cout);
    return io::exit_code::done;
  }
  if (command == "--version") {
    std::cout << io::version() << '\n';
    return io::exit_code::done;
  }
  const fs::path program = program_of(command);
  if (command.find('/') != std::string::npos || !is_program(program)) {
    std::cerr << "menger: error: unknown command " << command << meant(command) << "\n\n";
    print_help(std::cerr);
    return io::exit_code::bad_input;
  }
  io::hold_interrupts();  // until the program has loaded its libraries
  ::execv(program.c_str(), argv + 1);
  throw io::InputError(program.string() + ": cannot be run: " + std::generic_category().message(errno));
}

}  // namespace

int main(int argc, char** argv) {
  return io::run_program("menger", [&] { return dispatch(argc, argv); });
}
