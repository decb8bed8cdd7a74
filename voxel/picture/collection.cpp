#include <vtkNew.h>
#include <vtkSmartPointer.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLUtilities.h>

#include <sstream>

#include "io/text/input_error.h"
#include "io/text/number_text.h"
#include "io/text/whole_file.h"
#include "voxel/picture/vtk_output.h"

namespace menger::voxel {

void write_collection(const std::filesystem::path& file, const std::vector<CollectionEntry>& entries) {
  vtkNew<vtkXMLDataElement> collection;
  collection->SetName("Collection");
  for (const CollectionEntry& entry : entries) {
    vtkNew<vtkXMLDataElement> element;
    element->SetName("DataSet");
    element->SetAttribute("timestep", io::number_text(entry.time_s).c_str());
    element->SetIntAttribute("part", entry.part);
    element->SetAttribute("file", entry.file.generic_string().c_str());
    collection->AddNestedElement(element);
  }
  vtkNew<vtkXMLDataElement> root;
  root->SetName("VTKFile");
  root->SetAttribute("type", "Collection");
  root->SetAttribute("version", "0.1");
  root->AddNestedElement(collection);

  std::ostringstream text;
  text << "<?xml version=\"1.0\"?>\n";
  vtkXMLUtilities::FlattenElement(root, text);
  io::write_whole(file, text.str());
}

std::vector<CollectionEntry> read_collection(const std::filesystem::path& file) {
  const std::string text = io::read_whole(file);
  const auto root = vtkSmartPointer<vtkXMLDataElement>::Take(vtkXMLUtilities::ReadElementFromString(text.c_str()));
  vtkXMLDataElement* collection = root == nullptr ? nullptr : root->FindNestedElementWithName("Collection");
  if (collection == nullptr) throw io::InputError(file.string() + ": is not a ParaView collection");

  std::vector<CollectionEntry> entries;
  for (int i = 0; i < collection->GetNumberOfNestedElements(); ++i) {
    vtkXMLDataElement* element = collection->GetNestedElement(i);
    CollectionEntry entry;
    const char* name = element->GetAttribute("file");
    if (name == nullptr || element->GetScalarAttribute("timestep", entry.time_s) == 0) {
      throw io::InputError(file.string() + ": data set " + std::to_string(i + 1) + ": file or timestep is missing");
    }
    entry.file = name;
    element->GetScalarAttribute("part", entry.part);  // stays 0 if there is none
    entries.push_back(entry);
  }
  return entries;
}

}  // namespace menger::voxel
