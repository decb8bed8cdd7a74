#pragma once

#include <vtkUnstructuredGrid.h>

#include <filesystem>

namespace menger::io {

/// Width of the indices of a file.
enum class IndexWidth { bits_32, bits_64 };

/// Writes a grid as VTK's XML file (.vtu) that ParaView opens, whole or not at all. Each array stands in the element that
/// describes it, compressed by zlib in blocks and in base64, which takes a third more room than raw bytes; never in an appended
/// section, which is no XML and stops the ParaView of an up-to-date Debian 12. Values come back bit for bit.
///
/// The text is made in memory and then written.
/// @param indices bits_32 for files of at most 2^31 - 1 points, half as large
/// @throws InputError naming the target if the file was not written to its end
void write_vtu(const std::filesystem::path& target, vtkUnstructuredGrid& grid, IndexWidth indices = IndexWidth::bits_32);

}  // namespace menger::io
