#pragma once

#include <functional>
#include <string>

#include "io/study/study_visitor.h"

namespace CLI {
class App;
}

namespace menger::io {

/// Adds to a program that reads a study what people can ask about it: --template prints a study that explains itself, --schema a
/// JSON Schema for editors, --keys a table of its keys. After each the program ends.
/// @param describe_default goes through a study that has its defaults; a new one at each call
void add_study_help(CLI::App& app, const std::function<void(StudyVisitor&)>& describe_default);

}  // namespace menger::io
