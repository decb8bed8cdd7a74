#pragma once

#include <functional>
#include <optional>
#include <string_view>

namespace CLI {
class App;
}

namespace menger::io {

/// Runs the body of a program and turns what it throws into a message `name: error: ...` on standard error and an exit code.
/// @param body returns the exit code of the program
/// @return that exit code; exit_code::bad_input after InputError or when memory ran out, 1 after any other exception (a fault of
/// menger)
int run_program(std::string_view name, const std::function<int()>& body);

/// Parses the arguments of a program, with --version added.
/// @return an exit code if the program ends here: exit_code::done after --help and --version; nothing otherwise
/// @throws InputError for arguments that do not fit
std::optional<int> parse_arguments(CLI::App& app, int argc, const char* const* argv);

}  // namespace menger::io
