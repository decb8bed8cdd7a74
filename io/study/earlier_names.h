#pragma once

#include <functional>

#include "io/study/study_visitor.h"

namespace menger::io {

/// Refuses a file with keys that have other names now. People learn the present names once, and others can read their files.
/// Keys are found wherever the study has them, and in lists of keys of the study.
/// @param top the top table of the file; counts as if no key had been asked for
/// @param describe_default describes a study that has its defaults; each call uses a new study
/// @throws InputError with a line for every such key, in the order of the description, which gives its present name
void refuse_earlier_names(const TomlTable& top, const std::function<void(StudyVisitor&)>& describe_default);

}  // namespace menger::io
