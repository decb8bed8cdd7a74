// menger init NAME: writes the file of a robot to begin with.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "io/process/exit_code.h"
#include "io/process/program.h"
#include "io/text/input_error.h"
#include "io/text/joined_text.h"
#include "io/text/near_miss.h"
#include "io/text/whole_file.h"
#include "meshes/robot/robot_file.h"
#include "meshes/robot/starting_points.h"

namespace {

namespace fs = std::filesystem;
namespace io = menger::io;
using namespace menger::meshes;

struct Arguments {
  std::string name;
  std::string start;  ///< empty: none is asked for
  bool list = false;
};

std::optional<int> parse(Arguments& arguments, int argc, char** argv) {
  CLI::App app("Makes a folder with robot.toml, the file of a robot to begin with. Nothing is ever written over.", "menger init");
  app.footer(
      "Example:\n  menger init my_robot --from crawler\n  menger loop my_robot/robot.toml\n"
      "Exit codes: 0 done, 2 wrong input.");
  app.add_option("name", arguments.name, "Name of the robot and its folder");
  app.add_option("--from", arguments.start,
                 "Robot to begin with; --list shows them (default: the one of the same name, or else crawler)");
  app.add_flag("--list", arguments.list, "Show the robots to begin with");
  return io::parse_arguments(app, argc, argv);
}

void print_list() {
  std::size_t width = 0;
  for (const StartingPoint& start : starting_points()) width = std::max(width, start.name.size());
  for (const StartingPoint& start : starting_points())
    std::cout << start.name << std::string(width + 2 - start.name.size(), ' ') << start.purpose << '\n';
  std::cout << "Begin with one of them: menger init NAME --from " << starting_points().front().name << '\n';
}

/// The robot to begin with where none is asked for: nobody who writes "menger init finger" wants another one.
const StartingPoint& start_for(const std::string& robot_name) {
  for (const StartingPoint& start : starting_points())
    if (start.name == robot_name) return start;
  return starting_points().front();
}

const StartingPoint& start_named(const std::string& name) {
  std::vector<std::string> names;
  for (const StartingPoint& start : starting_points()) {
    if (start.name == name) return start;
    names.emplace_back(start.name);
  }
  const std::optional<std::string> meant = io::near_miss(name, names);
  throw io::InputError("--from " + name + ": there is no such robot" + (meant ? ", did you mean " + *meant + "?" : ".") +
                       " There are: " + io::joined(names));
}

/// Returns a text as one word of a command line: in quotes if it has other characters than those of plain names.
std::string shell_word(const std::string& text) {
  constexpr std::string_view plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+./";
  if (text.find_first_not_of(plain) == std::string::npos) return text;
  std::string word = "'";
  for (const char letter : text) word += letter == '\'' ? std::string("'\\''") : std::string(1, letter);
  return word + "'";
}

int run(const Arguments& arguments) {
  if (arguments.list) {
    print_list();
    return io::exit_code::done;
  }
  if (arguments.name.empty()) throw io::InputError("name is missing: menger init NAME, or menger init --list");
  const fs::path folder(arguments.name);
  const fs::path file = folder / "robot.toml";
  std::error_code ignored;
  if (fs::exists(fs::symlink_status(file, ignored)))
    throw io::InputError(file.string() + ": is there already, and is not written over");
  fs::path whole = fs::absolute(folder).lexically_normal();  // "." has a name, too
  if (!whole.has_filename()) whole = whole.parent_path();
  const std::string name = whole.filename().string();
  const StartingPoint& start = arguments.start.empty() ? start_for(name) : start_named(arguments.start);
  io::write_whole(file, robot_template(start, name));
  const Robot robot = read_robot(file);
  std::cout << "wrote " << file.string() << " from " << start.name << ": " << summary_of(robot) << "\n"
            << "Next: change it to your robot, then\n";
  const std::string command = "  menger loop " + shell_word(file.string());
  if (robot.evolves) {
    std::cout << command << "                 (a quarter of an hour: the search, and all about the body that it finds)\n";
    return io::exit_code::done;
  }
  std::cout << command << " --until limit   (seconds: its mesh, and the pressure that it bears)\n"
            << command << "                 (minutes: everything that the file asks for)\n";
  return io::exit_code::done;
}

}  // namespace

int main(int argc, char** argv) {
  return io::run_program("menger-init", [&]() -> int {
    Arguments arguments;
    if (const auto code = parse(arguments, argc, argv)) return *code;
    return run(arguments);
  });
}
