#pragma once

#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>

#include <filesystem>

namespace menger::evolution {

/// Reads a frame of a body, a grid of VTK (.vtu, or the .pvtu of several processes, whose pieces lie beside it), and checks what
/// VTK does not:
///
/// - there are points, all finite and within 1,000 km of the origin, and cells, all of which are hexahedra or polygons and have
///   points of the grid as corners, as many as their kind has,
/// - `material`, `chamber` and `chamber_pressure_Pa` have one number per cell, and `displacement_m` three per point,
/// - materials are whole numbers from 0 to 255, chambers whole numbers, and pressures and displacements finite.
///
/// VTK itself may crash on a damaged file: see io/process/child_reading.h.
/// @throws io::InputError if the file cannot be read or is none of this kind
vtkSmartPointer<vtkUnstructuredGrid> read_frame_grid(const std::filesystem::path& file);

/// Returns whether a file lies in a folder or below it, after all links.
bool is_within(const std::filesystem::path& file, const std::filesystem::path& folder);

}  // namespace menger::evolution
