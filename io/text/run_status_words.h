#pragma once

#include <string_view>

#include "io/text/run_status.h"
#include "io/text/toml_document.h"

namespace menger::io {

/// All statuses with the words that files have for them.
const Words<RunStatus>& run_status_words();

/// The status of a word. @throws InputError if it is none
RunStatus run_status_of(std::string_view word);

}  // namespace menger::io
