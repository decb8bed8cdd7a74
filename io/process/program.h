#pragma once

#include <functional>
#include <optional>
#include <string_view>

namespace CLI {
class App;
}

namespace menger::io {

/// Runs the body of a program. An exception becomes a message `name: error: ...` on standard error and an exit code.
/// @param body returns the exit code of the program
/// @return the exit code of the body; exit_code::bad_input after InputError or if memory ran out; 1 after any other exception (a
/// fault of menger)
int run_program(std::string_view name, const std::function<int()>& body);

/// Parses the arguments of a program and adds the option --version.
/// @return the exit code if the program ends here, exit_code::done after --help or --version; otherwise nothing
/// @throws InputError for invalid arguments
std::optional<int> parse_arguments(CLI::App& app, int argc, const char* const* argv);

}  // namespace menger::io
