#pragma once

#include <filesystem>
#include <vector>

#include "fem/locomotion/walk_grid.h"

namespace menger::fem {

/// Writes frames of a run for ParaView: frames/frame_0000.vtu, ... (see WalkGrid) and the collection frames.pvd in a folder. Each
/// file is written whole or not at all.
/// @throws io::InputError if a file cannot be written
class LocomotionFrames {
 public:
  /// Keeps a reference to the mesh. @param law of all elements
  LocomotionFrames(std::filesystem::path folder, const meshes::HexahedralMesh& mesh, const materials::HyperelasticLaw& law)
      : folder_(std::move(folder)), grid_(mesh, law) {}

  /// Prepares the folder for a run that is resumed: keeps its first frames, removes all later ones, and lists those that are left
  /// for ParaView.
  /// @param times_s of the frames that stay
  void keep_only(const std::vector<double>& times_s);

  /// Adds the next frame.
  void add(const MovedBody& body);

 private:
  void write_collection() const;

  std::filesystem::path folder_;
  WalkGrid grid_;
  std::vector<double> times_s_;
};

}  // namespace menger::fem
