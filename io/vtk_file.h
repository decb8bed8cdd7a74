#pragma once

#include <vtkUnstructuredGrid.h>

#include <filesystem>

namespace menger::io {

/// Width of the indices of a file.
enum class IndexWidth { bits_32, bits_64 };

/// Writes a grid as VTK's XML file (.vtu), binary and compressed, whole or not at all: on a full disk a writer of VTK may call
/// its work done all the same, so that the end of the file is looked at, too.
/// @param indices bits_32 for files of at most 2^31 - 1 points, half as large
/// @throws InputError naming the target if the file was not written to its end
void write_vtu(const std::filesystem::path& target, vtkUnstructuredGrid& grid, IndexWidth indices = IndexWidth::bits_32);

}  // namespace menger::io
