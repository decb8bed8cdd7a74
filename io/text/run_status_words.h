#pragma once

#include <string_view>

#include "io/text/run_status.h"
#include "io/text/toml_document.h"

namespace menger::io {

/// Returns all statuses with their words in files.
const Words<RunStatus>& run_status_words();

/// Returns the status of a number, as checkpoints hold it. @throws InputError if there is no such status
RunStatus run_status_of(int number);

/// Returns the status for a word. @throws InputError if there is no such status
RunStatus run_status_of(std::string_view word);

}  // namespace menger::io
