#include "io/text/input_error.h"

#include "io/text/printable.h"

namespace menger::io {

// Messages hold names and values from files.
InputError::InputError(const std::string& message) : std::runtime_error(printable(message)) {}

}  // namespace menger::io
