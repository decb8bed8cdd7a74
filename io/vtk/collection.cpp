#include "io/vtk/collection.h"

#include <vtkSmartPointer.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLUtilities.h>

#include <sstream>

#include "io/text/input_error.h"
#include "io/text/number_text.h"
#include "io/text/whole_file.h"

namespace menger::io {
namespace {

/// Returns text as it stands in an attribute of XML.
std::string escaped(const std::string& text) {
  std::ostringstream out;
  vtkXMLUtilities::EncodeString(text.c_str(), VTK_ENCODING_UTF_8, out, VTK_ENCODING_UTF_8, 1);
  return out.str();
}

}  // namespace

void write_collection(const std::filesystem::path& file, const std::vector<CollectionEntry>& entries) {
  std::string text = "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n  <Collection>\n";
  for (const CollectionEntry& entry : entries) {
    text += "    <DataSet timestep=\"" + number_text(entry.time_s) + "\" part=\"" + std::to_string(entry.part) + "\" file=\"" +
            escaped(entry.file.generic_string()) + "\"";
    if (!entry.name.empty()) text += " name=\"" + escaped(entry.name) + "\"";
    text += "/>\n";
  }
  write_whole(file, text + "  </Collection>\n</VTKFile>\n");
}

std::vector<CollectionEntry> read_collection(const std::filesystem::path& file) {
  const std::string text = read_whole(file);
  const auto root = vtkSmartPointer<vtkXMLDataElement>::Take(vtkXMLUtilities::ReadElementFromString(text.c_str()));
  vtkXMLDataElement* collection = root == nullptr ? nullptr : root->FindNestedElementWithName("Collection");
  if (collection == nullptr) throw InputError(file.string() + ": is not a ParaView collection");

  std::vector<CollectionEntry> entries;
  for (int i = 0; i < collection->GetNumberOfNestedElements(); ++i) {
    vtkXMLDataElement* element = collection->GetNestedElement(i);
    CollectionEntry entry;
    const char* name = element->GetAttribute("file");
    if (name == nullptr || element->GetScalarAttribute("timestep", entry.time_s) == 0) {
      throw InputError(file.string() + ": data set " + std::to_string(i + 1) + ": file or timestep is missing");
    }
    entry.file = name;
    element->GetScalarAttribute("part", entry.part);  // stays 0 if there is none
    if (const char* part_name = element->GetAttribute("name")) entry.name = part_name;
    entries.push_back(entry);
  }
  return entries;
}

}  // namespace menger::io
