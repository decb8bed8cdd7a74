#pragma once

#include <vtkUnstructuredGrid.h>

#include <filesystem>

namespace menger::io {

/// Width of the integer indices in a file.
enum class IndexWidth { bits_32, bits_64 };

/// Writes a grid as a VTK XML file (.vtu) for ParaView, whole or not at all.
///
/// Each array is inside the XML element that describes it, compressed by zlib in blocks and encoded in base64. This takes a third
/// more space than raw bytes. There is no appended section, because it is not XML and the ParaView of an up-to-date Debian 12
/// cannot read it. Values read back bit for bit. The whole text is made in memory and then written.
/// @param indices bits_32 for files of at most 2^31 - 1 points; the indices then take half the space
/// @throws InputError naming the target if the file could not be written completely
void write_vtu(const std::filesystem::path& target, vtkUnstructuredGrid& grid, IndexWidth indices = IndexWidth::bits_32);

}  // namespace menger::io
