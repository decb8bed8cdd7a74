#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkStringArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "io/process/child_reading.h"
#include "io/text/input_error.h"
#include "io/text/number_text.h"
#include "io/text/whole_file.h"
#include "meshes/files/mesh_bytes.h"
#include "meshes/files/vtu_mesh.h"
#include "meshes/hexahedra/boundary_check.h"
#include "meshes/hexahedra/chamber_surface.h"
#include "meshes/hexahedra/circular_corners.h"
#include "meshes/hexahedra/element_geometry.h"
#include "meshes/hexahedra/mesh_quality.h"

namespace menger::meshes {
namespace {

/// Keeps VTK from printing errors in a file; they are reported as InputError.
class QuietVtk {
 public:
  QuietVtk() : before_(vtkObject::GetGlobalWarningDisplay()) { vtkObject::GlobalWarningDisplayOff(); }
  ~QuietVtk() { vtkObject::SetGlobalWarningDisplay(before_); }
  QuietVtk(const QuietVtk&) = delete;
  QuietVtk& operator=(const QuietVtk&) = delete;

 private:
  int before_;
};

class VtuMeshReader {
 public:
  /// @param content of the file
  VtuMeshReader(const std::filesystem::path& file, const std::string& content) : file_(file) {
    const QuietVtk quiet;
    reader_->ReadFromInputStringOn();
    reader_->SetInputString(content);
    if (reader_->CanReadFile(file.c_str()) == 0) refuse("is not a VTK file of unstructured cells (.vtu)");
    reader_->Update();
    grid_ = reader_->GetOutput();
    if (reader_->GetErrorCode() != 0 || grid_->GetNumberOfCells() == 0) refuse("cannot be read, or contains no cells");
  }

  /// Returns what the file says. Whether it is a mesh that can be used is not checked.
  HexahedralMesh read() {
    mesh_.region_names = names("region_names");
    mesh_.label_names = names("label_names");
    read_points();
    read_cells();
    if (grid_->GetFieldData()->HasArray("chamber_names") != 0) read_chambers();
    read_geometry();
    return std::move(mesh_);
  }

 private:
  [[noreturn]] void refuse(const std::string& reason) const { throw io::InputError(file_.string() + ": " + reason); }

  [[nodiscard]] std::vector<std::string> names(const char* name) const {
    auto* array = vtkStringArray::SafeDownCast(grid_->GetFieldData()->GetAbstractArray(name));
    if (array == nullptr) refuse(std::string("has no field data ") + name + ", so menger did not write this mesh");
    std::vector<std::string> result;
    for (vtkIdType i = 0; i < array->GetNumberOfValues(); ++i) result.push_back(array->GetValue(i));
    return result;
  }

  /// Returns a number of an array as an index. It must be a whole number below `limit`.
  [[nodiscard]] std::size_t index(const char* name, double value, std::size_t limit) const {
    if (value >= 0.0 && value < static_cast<double>(limit) && value == std::floor(value)) return static_cast<std::size_t>(value);
    refuse(std::string(name) + " holds " + io::number_text(value) + ", which must be a whole number in 0 .. " +
           std::to_string(limit) + " - 1");
  }

  /// Returns all numbers of an array of field data, row by row, each below the limit of its column. Empty if the array is
  /// missing.
  [[nodiscard]] std::vector<std::size_t> rows(const char* name, int width, const std::vector<std::size_t>& limits) const {
    std::vector<std::size_t> result;
    vtkDataArray* array = grid_->GetFieldData()->GetArray(name);
    if (array == nullptr) return result;
    if (array->GetNumberOfComponents() != width) refuse(std::string(name) + " must have rows of " + std::to_string(width));
    for (vtkIdType row = 0; row < array->GetNumberOfTuples(); ++row) {
      for (int column = 0; column < width; ++column)
        result.push_back(index(name, array->GetComponent(row, column), limits[static_cast<std::size_t>(column)]));
    }
    return result;
  }

  [[nodiscard]] vtkDataArray& cell_data(const char* name) const {
    vtkDataArray* array = grid_->GetCellData()->GetArray(name);
    if (array == nullptr) refuse(std::string("has no cell data ") + name + ", so menger did not write this mesh");
    return *array;
  }

  void read_points() {
    for (vtkIdType i = 0; i < grid_->GetNumberOfPoints(); ++i) {
      Point point{};
      grid_->GetPoint(i, point.data());
      if (!is_finite(point)) refuse("point " + std::to_string(i) + " has a coordinate that is not a finite number");
      mesh_.points.push_back(point);
    }
  }

  /// Checks what VTK does not: that the arrays of cells belong together, and that each cell is a part of them.
  void require_cells() const {
    vtkCellArray* cells = grid_->GetCells();
    if (cells == nullptr || cells->GetNumberOfCells() != grid_->GetNumberOfCells() || !cells->IsValid())
      refuse("has offsets of cells that do not fit their corners");
    for (const char* name : {"region", "label"}) {
      const vtkDataArray& data = cell_data(name);
      if (data.GetNumberOfTuples() != grid_->GetNumberOfCells() || data.GetNumberOfComponents() != 1)
        refuse(std::string(name) + " must have one number for each cell");
    }
  }

  void require_corners(vtkIdType cell, vtkIdType found) const {
    const vtkIdType wanted = grid_->GetCellType(cell) == VTK_HEXAHEDRON ? 8 : 4;
    const bool is_known = grid_->GetCellType(cell) == VTK_HEXAHEDRON || grid_->GetCellType(cell) == VTK_QUAD;
    if (is_known && found != wanted)
      refuse("cell " + std::to_string(cell) + " has " + std::to_string(found) + " corners, its type has " +
             std::to_string(wanted));
  }

  void read_cells() {
    vtkDataArray& region = cell_data("region");
    vtkDataArray& label = cell_data("label");
    vtkNew<vtkIdList> corners;
    require_cells();
    for (vtkIdType cell = 0; cell < grid_->GetNumberOfCells(); ++cell) {
      grid_->GetCellPoints(cell, corners);
      require_corners(cell, corners->GetNumberOfIds());
      const auto corner = [&](std::size_t c) {
        return index("a cell", static_cast<double>(corners->GetId(static_cast<vtkIdType>(c))), mesh_.points.size());
      };
      if (grid_->GetCellType(cell) == VTK_HEXAHEDRON) {
        ElementCorners element{};
        for (std::size_t c = 0; c < element.size(); ++c) element[corner_of_circular[c]] = corner(c);
        mesh_.elements.push_back(element);
        mesh_.regions.push_back(index("region", region.GetTuple1(cell), mesh_.region_names.size()));
      } else if (grid_->GetCellType(cell) == VTK_QUAD) {
        BoundaryFace face{{corner(0), corner(1), corner(2), corner(3)}, 0};
        face.label = index("label", label.GetTuple1(cell), mesh_.label_names.size());
        mesh_.faces.push_back(face);
      } else {
        refuse("holds cells of VTK's type " + std::to_string(grid_->GetCellType(cell)) +
               "; a mesh has hexahedra with 8 corners and quadrilaterals with 4");
      }
    }
    if (mesh_.elements.empty()) refuse("holds no hexahedra");
  }

  void read_geometry() {
    const std::vector<std::size_t> geometry = rows("geometry", 1, {3});
    if (geometry.size() != 1) refuse("must have field data geometry with one number, so menger did not write this mesh");
    mesh_.geometry = static_cast<Geometry>(geometry[0]);
  }

  void read_chambers() {
    mesh_.plenum_names = names("plenum_names");
    for (const std::string& name : names("chamber_names")) mesh_.chambers.push_back({name, {}, {}, 0});
    const std::size_t chambers = mesh_.chambers.size();
    const std::vector<std::size_t> plenums = rows("chamber_plenums", 1, {mesh_.plenum_names.size()});
    if (plenums.size() != chambers) refuse("chamber_plenums must have one number for each chamber");
    for (std::size_t chamber = 0; chamber < chambers; ++chamber) mesh_.chambers[chamber].plenum = plenums[chamber];
    const std::vector<std::size_t> labels = rows("chamber_labels", 2, {chambers, mesh_.label_names.size()});
    for (std::size_t i = 0; i < labels.size(); i += 2) mesh_.chambers[labels[i]].labels.push_back(labels[i + 1]);
    const std::size_t points = mesh_.points.size();
    const std::vector<std::size_t> rims = rows("cap_rims", 4, {chambers, points, points, points});
    for (std::size_t i = 0; i < rims.size(); i += 4) {
      std::vector<Cap>& caps = mesh_.chambers[rims[i]].caps;
      if (rims[i + 1] > caps.size()) refuse("cap_rims must number the caps of a chamber consecutively");
      if (rims[i + 1] == caps.size()) caps.emplace_back();
      caps[rims[i + 1]].rim.push_back({rims[i + 2], rims[i + 3]});
    }
  }

  std::filesystem::path file_;
  vtkNew<vtkXMLUnstructuredGridReader> reader_;
  vtkUnstructuredGrid* grid_ = nullptr;
  HexahedralMesh mesh_;
};

}  // namespace

HexahedralMesh read_vtu_mesh(const std::filesystem::path& file) {
  const std::string content = io::read_whole(file);
  auto mesh = mesh_of_bytes<HexahedralMesh>(
      io::read_in_child(file, "VTK", [&] { return mesh_bytes(VtuMeshReader(file, content).read()); }));
  require_no_inverted_elements(mesh, file.string());
  require_whole_boundary(mesh, file.string());
  require_closed_chambers(mesh, file.string());
  return mesh;
}

}  // namespace menger::meshes
