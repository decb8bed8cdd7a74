#pragma once

#include <string>

#include "io/text/input_error.h"

namespace menger::tests {

/// Returns the message of the InputError that `work` throws, or "no error".
template <class Work>
std::string message_of(const Work& work) {
  try {
    work();
  } catch (const io::InputError& error) {
    return error.what();
  }
  return "no error";
}

}  // namespace menger::tests
