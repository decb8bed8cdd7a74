#pragma once

#include <functional>
#include <string>

#include "io/study/study_visitor.h"

namespace CLI {
class App;
}

namespace menger::io {

/// Adds options about the study to a program that reads one. --template prints a study with explanations, --schema a JSON Schema
/// for editors, --keys a table of the keys. The program ends after each of them.
/// @param describe_default describes a study that has its defaults; each call uses a new study
void add_study_help(CLI::App& app, const std::function<void(StudyVisitor&)>& describe_default);

}  // namespace menger::io
