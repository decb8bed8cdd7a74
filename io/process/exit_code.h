#pragma once

namespace menger::io {

/// Exit codes of every menger program.
namespace exit_code {
inline constexpr int done = 0;           ///< the job is done
inline constexpr int bad_input = 2;      ///< wrong input: nothing was written over
inline constexpr int numerical = 3;      ///< a numerical outcome: the status says which
inline constexpr int interrupted = 130;  ///< stopped by Ctrl-C or SIGTERM, what was done is kept
}  // namespace exit_code

}  // namespace menger::io
