#include "io/process/program.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <exception>
#include <filesystem>
#include <iostream>
#include <new>

#include "io/process/exit_code.h"
#include "io/process/interrupt.h"
#include "io/process/plain_output.h"
#include "io/process/standard_streams.h"
#include "io/process/study_command.h"
#include "io/text/formatted.h"
#include "io/text/input_error.h"
#include "io/text/joined_text.h"
#include "io/text/near_miss.h"
#include "io/text/version.h"

namespace menger::io {
namespace {

/// Returns a suggestion for a mistyped option: ", did you mean --refine?", or nothing.
std::string meant_option(const CLI::App& app, int argc, const char* const* argv) {
  std::vector<std::string> known;
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
  }
  for (int n = 1; n < argc; ++n) {
    const std::string given = std::string(argv[n]).substr(0, std::string_view(argv[n]).find('='));
    if (!given.starts_with("--") || std::ranges::find(known, given) != known.end()) continue;
    if (const auto meant = near_miss(given, known)) return ", did you mean " + *meant + "?";
  }
  return "";
}

/// The arguments of the program as its user wrote them, for a message that knows nothing else of the input.
std::vector<std::string>& given_arguments() {
  static std::vector<std::string> arguments;
  return arguments;
}

/// Returns the beginning of the message about wrong input, if a file that the program was given looks like the study of another
/// command: "ch.toml: looks like a study of menger inflate: menger inflate ch.toml runs it. As a study of menger simulate: ".
std::string hint_at_other_command(std::string_view program) {
  for (const std::string& argument : given_arguments()) {
    const std::string command = command_of_study(argument, program);
    if (command.empty()) continue;
    const std::string_view own = program.substr(std::string_view("menger-").size());
    return formatted("%s: looks like a study of menger %s: menger %s %s runs it. As a study of menger %.*s: ", argument.c_str(),
                     command.c_str(), command.c_str(), argument.c_str(), static_cast<int>(own.size()), own.data());
  }
  return {};
}

int guarded(std::string_view name, const std::function<int()>& body) {
  const PlainOutput plain;
  try {
    return body();
  } catch (const InputError& error) {
    std::cerr << name << ": error: " << hint_at_other_command(name) << error.what() << '\n';
    return exit_code::bad_input;
  } catch (const std::filesystem::filesystem_error& error) {
    // For example a name that is too long or a folder without permission. The error names the path.
    std::cerr << name << ": error: " << error.what() << '\n';
    return exit_code::bad_input;
  } catch (const std::bad_alloc&) {
    std::cerr << name << ": error: not enough memory for "
              << (given_arguments().empty() ? "this input" : joined(given_arguments(), " ")) << '\n';
    return exit_code::bad_input;
  } catch (const std::exception& error) {
    std::cerr << name << ": internal error: " << error.what() << '\n';
    return 1;
  }
}

}  // namespace

int run_program(std::string_view name, const std::function<int()>& body) {
  set_up_standard_streams();
  catch_interrupts();
  int code = guarded(name, body);
  if (interrupted() && (code == exit_code::done || code == exit_code::numerical)) code = exit_code::interrupted;
  come_to_stop();
  const std::string lost = lost_output();
  if (lost.empty()) return code;
  std::cerr << name << ": error: standard output: cannot be written: " << lost << '\n';
  return code == exit_code::done ? exit_code::bad_input : code;
}

std::optional<int> parse_arguments(CLI::App& app, int argc, const char* const* argv) {
  if (app.get_version_ptr() == nullptr) app.set_version_flag("--version", std::string(version()), "Print the version and exit");
  given_arguments().assign(argv + std::min(argc, 1), argv + argc);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& success) {
    return app.exit(success, std::cout, std::cerr);
  } catch (const CLI::ParseError& error) {
    throw InputError(std::string(error.what()) + meant_option(app, argc, argv) + " (see --help)");
  }
  return std::nullopt;
}

}  // namespace menger::io
