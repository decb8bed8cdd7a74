#pragma once

#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "materials/laws/hyperelastic_law.h"
#include "meshes/hexahedra/hexahedral_mesh.h"

namespace menger::fem {

/// The motion of a body at one time; component i of node a at 3 a + i.
struct MovedBody {
  double time_s = 0.0;
  std::span<const double> displacements_m;
  std::span<const double> velocities_m_per_s;
  std::span<const double> plenum_pressures_Pa;  ///< gauge, one per plenum
};

/// Shows a walking body as a grid of VTK, by the convention of io/vtk/README.md.
///
/// Cells are the elements as hexahedra, then the walls of the chambers as quadrilaterals, at their current positions. Point data:
/// displacement_m, velocity_m_per_s. Cell data: region (of elements; -1 for walls), chamber (of walls; -1 for elements),
/// chamber_pressure_Pa (of the chamber; for an element, that of the chamber it is next to), and those of ElementState (for a
/// wall, those of its element), with largest_stretch as active scalars. Field data: TimeValue, plenum_pressures_Pa, plenum_names,
/// chamber_names, region_names.
class WalkGrid {
 public:
  /// Keeps a reference to the mesh. @param law of all elements
  WalkGrid(const meshes::HexahedralMesh& mesh, materials::HyperelasticLaw law);

  [[nodiscard]] vtkSmartPointer<vtkUnstructuredGrid> at(const MovedBody& body) const;

  /// Returns the chamber that each element is next to: one of which it has a corner, otherwise that of the elements between. Of
  /// several it is the one with most corners. Empty if the body has no chambers.
  [[nodiscard]] const std::vector<std::size_t>& chambers_of_elements() const { return chambers_of_elements_; }

 private:
  /// A face of an element that is the wall of a chamber.
  struct Wall {
    std::array<std::size_t, 4> corners;
    std::size_t chamber;
    std::size_t element;
  };
  void find_walls();
  void find_chambers_of_elements();
  [[nodiscard]] double pressure_Pa(const MovedBody& body, std::size_t chamber) const;
  void add_points(vtkUnstructuredGrid& grid, const MovedBody& body) const;
  void add_cells(vtkUnstructuredGrid& grid) const;
  void add_cell_data(vtkUnstructuredGrid& grid, const MovedBody& body) const;

  const meshes::HexahedralMesh& mesh_;
  materials::HyperelasticLaw law_;
  std::vector<Wall> walls_;
  std::vector<std::size_t> chambers_of_elements_;
};

}  // namespace menger::fem
