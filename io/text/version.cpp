#include "io/text/version.h"

namespace menger::io {

std::string_view version() { return MENGER_VERSION; }

}  // namespace menger::io
