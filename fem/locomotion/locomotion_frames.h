#pragma once

#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "meshes/hexahedra/hexahedral_mesh.h"

namespace menger::fem {

/// A body at one time; component i of node a at 3 a + i.
struct MovedBody {
  double time_s = 0.0;
  std::span<const double> displacements_m;
  std::span<const double> velocities_m_per_s;
  std::span<const double> plenum_pressures_Pa;  ///< gauge, one per plenum
};

/// The body where it is: its elements as hexahedra and the walls of its chambers as quadrilaterals.
///
/// Point data: displacement_m, velocity_m_per_s. Cell data: region (of elements, -1 on walls), chamber (of walls, -1 elsewhere),
/// chamber_pressure_Pa (on walls, 0 elsewhere). Field data: TimeValue, plenum_pressures_Pa.
vtkSmartPointer<vtkUnstructuredGrid> moved_body_grid(const meshes::HexahedralMesh& mesh, const MovedBody& body);

/// Frames of a run for ParaView: frames/frame_0000.vtu, ... and the collection frames.pvd in a folder, each file written whole or
/// not at all. Throws io::InputError where the place cannot be written.
class LocomotionFrames {
 public:
  explicit LocomotionFrames(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// Prepares the folder for a run that is resumed: keeps its first frames, removes all later ones, and lists those that are left
  /// for ParaView.
  /// @param times_s of the frames that stay
  void keep_only(const std::vector<double>& times_s);

  /// Adds the next frame.
  void add(const meshes::HexahedralMesh& mesh, const MovedBody& body);

 private:
  void write_collection() const;
  std::filesystem::path folder_;
  std::vector<double> times_s_;
};

}  // namespace menger::fem
