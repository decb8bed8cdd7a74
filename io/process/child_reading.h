#pragma once

#include <filesystem>
#include <functional>
#include <string>

namespace menger::io {

/// Lets a library read a file in a child process and returns what `read` returns there.
///
/// Gmsh and VTK do not check all that they read: a damaged file can end them with a segmentation fault. In a child process such
/// an end is an error of the file, and the state of the library stays there. The child is a copy of this process (fork) and may
/// use as much more memory as a mesh in a file of this size can need.
/// @param library its name, for messages
/// @param read called in the child; its errors are thrown here
/// @throws InputError naming the file: what `read` throws as InputError, if memory runs out, or if the child was ended by a
/// signal
std::string read_in_child(const std::filesystem::path& file, const std::string& library,
                          const std::function<std::string()>& read);

}  // namespace menger::io
