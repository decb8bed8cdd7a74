#pragma once

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace menger::voxel {

/// The collection with the finite element fields of a curve, `fields/CASE/fields.pvd` beside the curve; nothing if there is none.
std::optional<std::filesystem::path> field_collection(const std::filesystem::path& curve_file, const std::string& case_name);

/// Files of fields, by the row of the curve that they belong to.
using FieldsByRow = std::map<std::size_t, std::filesystem::path>;

/// Assigns the files of a collection of fields to the rows of a curve. The collection has one step per row of the curve.
/// Otherwise, if only pressure is applied, each row gets the step with the nearest plenum_pressures_Pa, if it is near. @param
/// states rows of abscissae of the curve
/// @throws io::InputError if a file is missing or holds no fields
FieldsByRow fields_by_row(const std::filesystem::path& collection, const std::vector<std::vector<double>>& states);

/// Reads the surface of a file of fields (.vtu, .pvtu), whose points are those of the deformed body.
/// @throws io::InputError if it is missing or has no displacements
vtkSmartPointer<vtkPolyData> deformed_surface(const std::filesystem::path& file);

}  // namespace menger::voxel
