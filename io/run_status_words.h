#pragma once

#include "io/run_status.h"
#include "io/toml_document.h"

namespace menger::io {

/// All statuses with the words that files have for them.
const Words<RunStatus>& run_status_words();

}  // namespace menger::io
