#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "voxel/engine/frame.h"

namespace menger::voxel {

/// Writes a frame for ParaView (.vtu, compressed), whole or not at all.
///
/// Every voxel is a hexahedron with eight points of its own: the cube of its driven size around its centre, or the box of its
/// reaches, rotated by its orientation. Cell data: centre_m (position of the voxel's mass, in general not the middle of a box
/// with unequal reaches), material, phase, size_m, strain, speed_m_s, contact (bits of namespace contact). Field data: TimeValue.
/// Centres are float64; points and other real cell data are float32.
/// @throws io::InputError if the place cannot be written
void write_frame(const std::filesystem::path& file, const Frame& frame);

/// A file of a collection and its time.
struct CollectionEntry {
  double time_s = 0.0;
  std::filesystem::path file;  ///< relative to the collection
  int part = 0;                ///< number among the parts shown together at that time

  bool operator==(const CollectionEntry&) const = default;
};

/// Writes a ParaView collection (.pvd), whole or not at all. @throws io::InputError if the place cannot be written
void write_collection(const std::filesystem::path& file, const std::vector<CollectionEntry>& entries);

/// Reads the entries of a collection. @throws io::InputError if the file is missing or is no collection
std::vector<CollectionEntry> read_collection(const std::filesystem::path& file);

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
