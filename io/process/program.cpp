#include "io/process/program.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <exception>
#include <filesystem>
#include <iostream>
#include <new>

#include "io/process/exit_code.h"
#include "io/text/input_error.h"
#include "io/text/version.h"

namespace menger::io {

int run_program(std::string_view name, const std::function<int()>& body) {
  try {
    return body();
  } catch (const InputError& error) {
    std::cerr << name << ": error: " << error.what() << '\n';
    return exit_code::bad_input;
  } catch (const std::filesystem::filesystem_error& error) {
    // A name too long, a folder that may not be entered: the error names the path.
    std::cerr << name << ": error: " << error.what() << '\n';
    return exit_code::bad_input;
  } catch (const std::bad_alloc&) {
    std::cerr << name << ": error: not enough memory for this input\n";
    return exit_code::bad_input;
  } catch (const std::exception& error) {
    std::cerr << name << ": internal error: " << error.what() << '\n';
    return 1;
  }
}

std::optional<int> parse_arguments(CLI::App& app, int argc, const char* const* argv) {
  if (app.get_version_ptr() == nullptr) app.set_version_flag("--version", std::string(version()), "Print the version and exit");
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& success) {
    return app.exit(success, std::cout, std::cerr);
  } catch (const CLI::ParseError& error) {
    throw InputError(std::string(error.what()) + " (see --help)");
  }
  return std::nullopt;
}

}  // namespace menger::io
