#include "io/vtk/vtk_file.h"

#include <vtkNew.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include "io/text/input_error.h"
#include "io/text/whole_file.h"

namespace menger::io {

void write_vtu(const std::filesystem::path& target, vtkUnstructuredGrid& grid, IndexWidth indices) {
  vtkNew<vtkXMLUnstructuredGridWriter> writer;
  writer->SetInputData(&grid);
  // The text is made in memory: on a full disk, VTK's writer of inline data ends with a segmentation fault.
  writer->WriteToOutputStringOn();
  // An appended section is not XML. VTK stops its parser just before it. Since Expat 2.6 and its backport to Debian 12
  // (2.5.0-1+deb12u2) this is too late: the parser reads the section, and ParaView 5.11 refuses the file.
  writer->SetDataModeToBinary();
  writer->SetCompressorTypeToZLib();
  writer->SetCompressionLevel(1);
  if (indices == IndexWidth::bits_32) writer->SetIdTypeToInt32();
  if (writer->Write() == 0 || writer->GetErrorCode() != 0) throw InputError(target.string() + ": VTK cannot write it");
  write_whole(target, writer->GetOutputString());
}

}  // namespace menger::io
