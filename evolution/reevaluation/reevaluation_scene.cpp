#include "evolution/reevaluation/reevaluation_scene.h"

#include <algorithm>
#include <cmath>

#include "evolution/reevaluation/reevaluation_strip.h"
#include "io/text/formatted.h"
#include "io/text/is_file.h"
#include "io/text/whole_file.h"
#include "voxel/picture/vtk_output.h"

namespace menger::evolution {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t strip_columns = 5;

std::string voxel_file(std::size_t number) { return "voxels_" + io::padded(number, 4) + ".vtu"; }

void remove_earlier(const fs::path& folder) { io::remove_files(folder, {"both.pvd", "strip.png", "voxels_*.vtu"}); }

/// Returns pairs of frames of both models at about the same time.
std::vector<FramePair> frame_pairs(const ReevaluatedDesign& design) {
  std::vector<FramePair> pairs;
  const fs::path collection = design.elements.folder / "frames.pvd";
  if (!io::is_file(collection) || design.surrogate.frames.empty()) return pairs;
  const std::vector<voxel::Frame>& frames = design.surrogate.frames;
  // Frames of both models that belong together differ in time by less than a step; successive frames are several records apart.
  const double near_s = frames.size() > 1 ? 0.25 * (frames[1].time_s - frames[0].time_s) : 1e-3;
  for (const voxel::CollectionEntry& entry : voxel::read_collection(collection)) {
    const auto nearest =
        std::ranges::min_element(frames, {}, [&](const voxel::Frame& frame) { return std::abs(frame.time_s - entry.time_s); });
    if (std::abs(nearest->time_s - entry.time_s) > near_s) continue;
    pairs.push_back({.time_s = entry.time_s, .elements = design.elements.folder / entry.file, .surrogate = *nearest});
  }
  return pairs;
}

void write_collection(const fs::path& folder, const std::vector<FramePair>& pairs) {
  std::vector<voxel::CollectionEntry> entries;
  for (std::size_t n = 0; n < pairs.size(); ++n) {
    voxel::write_frame(folder / voxel_file(n), pairs[n].surrogate);
    const fs::path elements = fs::relative(fs::absolute(pairs[n].elements), fs::absolute(folder));
    entries.push_back({.time_s = pairs[n].time_s, .file = elements, .part = 0, .name = "finite elements"});
    entries.push_back({.time_s = pairs[n].time_s, .file = voxel_file(n), .part = 1, .name = "voxels"});
  }
  voxel::write_collection(folder / "both.pvd", entries);
}

/// Returns as many pairs as a strip has columns, evenly spaced in time, with the first and the last.
std::vector<FramePair> some_of(const std::vector<FramePair>& pairs) {
  if (pairs.size() <= strip_columns) return pairs;
  std::vector<FramePair> some;
  for (std::size_t n = 0; n < strip_columns; ++n) some.push_back(pairs[n * (pairs.size() - 1) / (strip_columns - 1)]);
  return some;
}

}  // namespace

SceneOutcome write_both_models(const fs::path& folder, const ReevaluatedDesign& design, bool with_picture) {
  remove_earlier(folder);
  SceneOutcome outcome;
  const std::vector<FramePair> pairs = frame_pairs(design);
  outcome.frames = pairs.size();
  if (pairs.empty()) {
    outcome.notes.push_back("rank " + std::to_string(design.design.rank) +
                            ": there are no frames of both models, so both.pvd and strip.png are not written");
    return outcome;
  }
  write_collection(folder, pairs);
  if (with_picture) outcome.picture = draw_strip(folder / "strip.png", some_of(pairs));
  return outcome;
}

}  // namespace menger::evolution
