#include "io/vtk/vtk_file.h"

#include <vtkNew.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <fstream>
#include <string>
#include <string_view>

#include "io/text/input_error.h"
#include "io/text/whole_file.h"

namespace menger::io {
namespace {

bool is_ended(const std::filesystem::path& file) {
  constexpr std::string_view end_tag = "</VTKFile>";
  constexpr std::streamoff longest_end = 32;  // room for line ends behind the tag
  std::ifstream stream(file, std::ios::binary | std::ios::ate);
  const std::streamoff size = stream.tellg();
  if (!stream || size <= 0) return false;
  stream.seekg(size > longest_end ? size - longest_end : 0);
  const std::string end{std::istreambuf_iterator<char>(stream), {}};
  const std::size_t last = end.find_last_not_of(" \t\r\n");
  return last != std::string::npos && std::string_view(end).substr(0, last + 1).ends_with(end_tag);
}

}  // namespace

void write_vtu(const std::filesystem::path& target, vtkUnstructuredGrid& grid, IndexWidth indices) {
  PendingFile pending(target);
  vtkNew<vtkXMLUnstructuredGridWriter> writer;
  writer->SetInputData(&grid);
  writer->SetFileName(pending.temporary().c_str());
  // An appended section is no XML. VTK stops its parser right before it, too late for Expat since 2.6 and its backport to Debian
  // 12 (2.5.0-1+deb12u2): the parser meets the section, and ParaView 5.11 refuses the file.
  writer->SetDataModeToBinary();
  writer->SetCompressorTypeToZLib();
  writer->SetCompressionLevel(1);
  if (indices == IndexWidth::bits_32) writer->SetIdTypeToInt32();
  if (writer->Write() == 0 || writer->GetErrorCode() != 0 || !is_ended(pending.temporary()))
    throw InputError(target.string() + ": cannot be written to its end; is the disk full?");
  pending.commit();
}

}  // namespace menger::io
