#pragma once

namespace menger::io {

/// Exit codes of every menger program.
namespace exit_code {
inline constexpr int done = 0;           ///< the job is complete
inline constexpr int bad_input = 2;      ///< wrong input; nothing was overwritten
inline constexpr int numerical = 3;      ///< a numerical outcome, which the run status names
inline constexpr int interrupted = 130;  ///< stopped by Ctrl-C or SIGTERM; finished results are kept
}  // namespace exit_code

}  // namespace menger::io
