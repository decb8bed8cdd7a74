#include "evolution/posture/frame_grid.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDataArray.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkObject.h>
#include <vtkPointData.h>
#include <vtkUnsignedCharArray.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLPUnstructuredGridReader.h>
#include <vtkXMLUnstructuredGridReader.h>
#include <vtkXMLUtilities.h>

#include <array>
#include <cmath>
#include <string>
#include <system_error>

#include "io/text/input_error.h"
#include "io/text/is_file.h"
#include "io/text/number_text.h"
#include "io/text/whole_file.h"

namespace menger::evolution {
namespace {

namespace fs = std::filesystem;

constexpr double farthest_m = 1e6;  ///< a point farther away is no place of a body, and sums of such points may overflow

/// Checks the parts of a grid.
class FrameCheck {
 public:
  FrameCheck(const fs::path& file, vtkUnstructuredGrid& grid) : file_(file), grid_(grid) {}

  void require_points() const {
    vtkDataArray* data = grid_.GetPoints()->GetData();
    if (data->GetNumberOfComponents() != 3) refuse("has points without three coordinates");
    for (vtkIdType n = 0; n < grid_.GetNumberOfPoints(); ++n) {
      std::array<double, 3> place{};
      grid_.GetPoint(n, place.data());
      for (const double x : place) require_place(x, "a point");
    }
  }

  void require_cells() const {
    vtkCellArray* cells = grid_.GetCells();
    vtkUnsignedCharArray* types = grid_.GetCellTypesArray();
    const vtkIdType count = grid_.GetNumberOfCells();
    if (cells == nullptr || types == nullptr || cells->GetNumberOfCells() != count || types->GetNumberOfValues() != count ||
        !cells->IsValid())
      refuse("has offsets or types of cells that do not fit their corners");
    vtkNew<vtkIdList> corners;
    for (vtkIdType cell = 0; cell < count; ++cell) {
      grid_.GetCellPoints(cell, corners);
      require_corner_count(cell, corners->GetNumberOfIds());
      for (vtkIdType n = 0; n < corners->GetNumberOfIds(); ++n) {
        if (corners->GetId(n) < 0 || corners->GetId(n) >= grid_.GetNumberOfPoints())
          refuse("cell " + std::to_string(cell) + " has the point " + std::to_string(corners->GetId(n)) + " of " +
                 std::to_string(grid_.GetNumberOfPoints()));
      }
    }
  }

  void require_cell_data() const {
    require_whole_numbers("material", 0.0, 255.0);
    require_whole_numbers("chamber", -1e6, 1e6);
    if (vtkDataArray* pressures = array_of(*grid_.GetCellData(), "chamber_pressure_Pa", 1, grid_.GetNumberOfCells())) {
      for (vtkIdType cell = 0; cell < pressures->GetNumberOfTuples(); ++cell)
        if (!std::isfinite(pressures->GetComponent(cell, 0))) refuse("has a pressure that is not finite");
    }
  }

  void require_displacements() const {
    vtkDataArray* moved = array_of(*grid_.GetPointData(), "displacement_m", 3, grid_.GetNumberOfPoints());
    if (moved == nullptr) return;
    for (vtkIdType n = 0; n < moved->GetNumberOfTuples(); ++n)
      for (int axis = 0; axis < 3; ++axis) require_place(moved->GetComponent(n, axis), "a displacement");
  }

  [[noreturn]] void refuse(const std::string& reason) const { throw io::InputError(file_.string() + ": " + reason); }

 private:
  void require_place(double x, const char* of) const {
    if (!std::isfinite(x)) refuse("has " + std::string(of) + " that is not finite");
    if (std::abs(x) > farthest_m) refuse("has " + std::string(of) + " of " + io::number_text(x) + " m");
  }

  void require_corner_count(vtkIdType cell, vtkIdType found) const {
    vtkIdType wanted = found;
    switch (grid_.GetCellType(cell)) {
      case VTK_POLYGON:
        break;
      case VTK_TRIANGLE:
        wanted = 3;
        break;
      case VTK_QUAD:
        wanted = 4;
        break;
      case VTK_QUADRATIC_TRIANGLE:
        wanted = 6;
        break;
      case VTK_HEXAHEDRON:
      case VTK_QUADRATIC_QUAD:
        wanted = 8;
        break;
      case VTK_BIQUADRATIC_QUAD:
        wanted = 9;
        break;
      case VTK_QUADRATIC_HEXAHEDRON:
        wanted = 20;
        break;
      case VTK_TRIQUADRATIC_HEXAHEDRON:
        wanted = 27;
        break;
      default:
        refuse("cell " + std::to_string(cell) + " is neither a hexahedron nor a polygon");
    }
    if (found != wanted)
      refuse("cell " + std::to_string(cell) + " has " + std::to_string(found) + " corners, its type has " +
             std::to_string(wanted));
  }

  vtkDataArray* array_of(vtkDataSetAttributes& data, const char* name, int components, vtkIdType count) const {
    vtkDataArray* array = data.GetArray(name);
    if (array != nullptr && (array->GetNumberOfComponents() != components || array->GetNumberOfTuples() != count))
      refuse(std::string(name) + " must have " + std::to_string(components) + " x " + std::to_string(count) + " numbers");
    return array;
  }

  void require_whole_numbers(const char* name, double lowest, double highest) const {
    vtkDataArray* array = array_of(*grid_.GetCellData(), name, 1, grid_.GetNumberOfCells());
    if (array == nullptr) return;
    for (vtkIdType cell = 0; cell < array->GetNumberOfTuples(); ++cell) {
      const double value = array->GetComponent(cell, 0);
      if (!(value >= lowest && value <= highest && value == std::floor(value)))
        refuse(std::string(name) + " holds " + io::number_text(value) + ", which must be a whole number from " +
               io::number_text(lowest) + " to " + io::number_text(highest));
    }
  }

  const fs::path& file_;
  vtkUnstructuredGrid& grid_;
};

/// Refuses a grid in pieces (.pvtu) that names pieces in other folders: none leads out of its results.
void require_pieces_beside(const fs::path& file) {
  const std::string text = io::read_whole(file);
  const auto root = vtkSmartPointer<vtkXMLDataElement>::Take(vtkXMLUtilities::ReadElementFromString(text.c_str()));
  vtkXMLDataElement* grid = root == nullptr ? nullptr : root->FindNestedElementWithName("PUnstructuredGrid");
  for (int n = 0; grid != nullptr && n < grid->GetNumberOfNestedElements(); ++n) {
    const char* source = grid->GetNestedElement(n)->GetAttribute("Source");
    if (source != nullptr && fs::path(source).has_parent_path())
      throw io::InputError(file.string() + ": names " + source + ", which does not lie beside it");
  }
}

/// What a reader of VTK makes of a file; null if nothing.
template <class Reader>
vtkSmartPointer<vtkUnstructuredGrid> grid_by(const fs::path& file) {
  vtkNew<Reader> reader;
  if (reader->CanReadFile(file.c_str()) == 0) return nullptr;
  reader->SetFileName(file.c_str());
  reader->Update();
  return reader->GetErrorCode() == 0 ? reader->GetOutput() : nullptr;
}

}  // namespace

bool is_within(const fs::path& file, const fs::path& folder) {
  std::error_code error;
  const fs::path whole = fs::weakly_canonical(file, error);
  if (error) return false;
  const fs::path root = fs::weakly_canonical(folder, error);
  if (error) return false;
  const fs::path way = whole.lexically_relative(root);
  return !way.empty() && *way.begin() != "..";
}

vtkSmartPointer<vtkUnstructuredGrid> read_frame_grid(const fs::path& file) {
  vtkSmartPointer<vtkUnstructuredGrid> grid;
  if (io::is_file(file)) {
    const int shown = vtkObject::GetGlobalWarningDisplay();
    vtkObject::GlobalWarningDisplayOff();  // the message below says it in one line
    const bool has_pieces = file.extension() == ".pvtu";
    if (has_pieces) require_pieces_beside(file);
    grid = has_pieces ? grid_by<vtkXMLPUnstructuredGridReader>(file) : grid_by<vtkXMLUnstructuredGridReader>(file);
    vtkObject::SetGlobalWarningDisplay(shown);
  }
  if (grid == nullptr || grid->GetNumberOfPoints() == 0 || grid->GetNumberOfCells() == 0)
    throw io::InputError(file.string() + ": is no grid of VTK that can be read");
  const FrameCheck check(file, *grid);
  check.require_points();
  check.require_cells();
  check.require_cell_data();
  check.require_displacements();
  return grid;
}

}  // namespace menger::evolution
