#pragma once

#include <string>

namespace menger::io {

/// Prepares the process for streams that are closed, abandoned or full.
///
/// A standard stream that is closed leads to nowhere, so that no result file gets its number and the text that is printed.
/// SIGPIPE and SIGXFSZ are ignored: a run goes on when the reader of its output has gone, and a file that may not grow gives an
/// error with its name.
void set_up_standard_streams();

/// Writes out what is still to be printed on standard output.
/// @return why some of it was lost; empty if nothing was, or if its reader has gone and needs it no more
std::string lost_output();

}  // namespace menger::io
