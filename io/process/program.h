#pragma once

#include <functional>
#include <optional>
#include <string_view>

namespace CLI {
class App;
}

namespace menger::io {

/// Runs the body of a program. An exception becomes a message `name: error: ...` on standard error and an exit code. Meanwhile
/// all that is written to std::cout and std::cerr is printable (PlainOutput).
///
/// Ctrl-C is caught from the start (see catch_interrupts). A run goes on if nobody reads its output any more, and a file that
/// grows beyond the limit of the process is an error like a full disk, not the end of the process.
/// @param body returns the exit code of the program
/// @return the exit code of the body; exit_code::bad_input after InputError, if memory ran out, or if printed text was lost, as
/// on a full disk; exit_code::interrupted instead of done or numerical after Ctrl-C; 1 after any other exception (a fault of
/// menger)
int run_program(std::string_view name, const std::function<int()>& body);

/// Parses the arguments of a program and adds the option --version.
/// @return the exit code if the program ends here, exit_code::done after --help or --version; otherwise nothing
/// @throws InputError for invalid arguments
std::optional<int> parse_arguments(CLI::App& app, int argc, const char* const* argv);

}  // namespace menger::io
