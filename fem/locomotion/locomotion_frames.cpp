#include "fem/locomotion/locomotion_frames.h"

#include "io/text/formatted.h"
#include "io/text/is_file.h"
#include "io/text/whole_file.h"
#include "io/vtk/collection.h"
#include "io/vtk/vtk_file.h"

namespace menger::fem {
namespace {

namespace fs = std::filesystem;

constexpr const char* collection_name = "frames.pvd";

/// Returns the path of a frame, relative to the folder of the run.
fs::path frame_file(std::size_t number) { return fs::path("frames") / ("frame_" + io::padded(number, 4) + ".vtu"); }

}  // namespace

void LocomotionFrames::keep_only(const std::vector<double>& times_s) {
  times_s_ = times_s;
  // Users may have removed some frames. Frames after the first missing one do not count.
  std::size_t kept = 0;
  while (kept < times_s_.size() && io::is_file(folder_ / frame_file(kept))) ++kept;
  times_s_.resize(kept);
  // The collection is updated before the files are removed, so that it never names one that does not exist.
  if (times_s_.empty())
    io::remove_if_there(folder_ / collection_name);
  else
    write_collection();
  std::vector<fs::path> surplus;
  std::error_code no_such_folder;
  for (const auto& entry : fs::directory_iterator(folder_ / "frames", no_such_folder)) {
    const std::string name = entry.path().filename().string();
    const bool is_frame = name.starts_with("frame_") && name.ends_with(".vtu");
    bool stays = false;
    for (std::size_t n = 0; n < times_s_.size() && !stays; ++n) stays = name == frame_file(n).filename();
    if (is_frame && !stays) surplus.push_back(entry.path());
  }
  for (const fs::path& file : surplus) io::remove_if_there(file);
}

void LocomotionFrames::add(const MovedBody& body) {
  io::write_vtu(folder_ / frame_file(times_s_.size()), *grid_.at(body));
  times_s_.push_back(body.time_s);
  write_collection();
}

void LocomotionFrames::write_collection() const {
  std::vector<io::CollectionEntry> entries;
  for (std::size_t n = 0; n < times_s_.size(); ++n)
    entries.push_back({.time_s = times_s_[n], .file = frame_file(n), .name = "finite elements"});
  io::write_collection(folder_ / collection_name, entries);
}

}  // namespace menger::fem
