#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "io/vtk/collection.h"
#include "voxel/engine/frame.h"

namespace menger::voxel {

using io::CollectionEntry;
using io::read_collection;
using io::write_collection;

/// Writes a frame for ParaView (.vtu, compressed), whole or not at all, by the convention of io/vtk/README.md. The origin is that
/// of the design, the corner of its first cell, half an edge away from that of a Frame.
///
/// Every voxel is a hexahedron with eight points of its own: the cube of its driven size around its centre, or the box of its
/// reaches, rotated by its orientation. Point data: displacement_m, from the corners of the cell. Cell data: centre_m (position
/// of the voxel's mass, in general not the middle of a box with unequal reaches), material, phase, size_m, volume_ratio
/// (the active scalars), strain, speed_m_s, contact (bits of namespace contact). Field data: TimeValue. Centres are float64;
/// points and other real data are float32.
/// @throws io::InputError if the place cannot be written
void write_frame(const std::filesystem::path& file, const Frame& frame);

/// The frames of one run in a folder: `<name>/frame_0000.vtu`, ... and `<name>.pvd`.
class FrameSeries {
 public:
  explicit FrameSeries(std::filesystem::path folder, std::string name = "frames");

  /// Removes what an earlier run wrote under the same name: `<name>.pvd` and all `<name>/frame_<digits>.vtu`. No other file goes.
  /// @throws io::InputError if one cannot be removed
  void remove_earlier() const;

  /// Writes the next frame.
  void add(const Frame& frame);

  /// Writes the collection of all frames.
  void finish() const;

 private:
  [[nodiscard]] std::filesystem::path collection_file() const;
  [[nodiscard]] std::filesystem::path frame_file(std::size_t index) const;  ///< relative to the folder

  std::filesystem::path folder_;
  std::string name_;
  std::vector<CollectionEntry> entries_;
};

}  // namespace menger::voxel
