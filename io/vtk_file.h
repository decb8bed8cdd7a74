#pragma once

#include <filesystem>

#include "io/whole_file.h"

namespace menger::io {

/// What a writer of VTK said about the file that it wrote.
struct VtkOutcome {
  int written = 0;               ///< of Write(), not 0 if all went well
  unsigned long error_code = 0;  ///< of GetErrorCode(), 0 if all went well
};

/// Gives a file of VTK's XML formats its name if it is whole. On a full disk a writer may call its work done all the same, so
/// that the end of the file is looked at, too.
/// @param pending that the writer has written to, @param target the name that it will have, for the message
/// @throws InputError naming the target if the file was not written to its end
void commit_vtk_file(PendingFile& pending, const std::filesystem::path& target, const VtkOutcome& outcome);

}  // namespace menger::io
