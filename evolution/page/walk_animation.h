#pragma once

#include <atomic>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "evolution/page/report_page.h"

namespace menger::evolution {

/// How a motion is shown in time: a short one, or one with fast strokes, slower than it is, so that it can be followed.
struct AnimationPace {
  int slower = 1;               ///< how many times: 1, 2, 4 or 8
  std::size_t pictures = 0;     ///< 2 to 250
  double pictures_per_s = 0.0;  ///< at most 25; 12.5 unless strokes need more, or a long motion has room for less
  std::optional<double> pictures_per_stroke{};
};
/// @param strokes of the drive in that time, of which each gets least_per_stroke pictures where there is room; 0 without a drive
AnimationPace pace_of(double duration_s, double strokes);

/// Returns the size of the letters of a caption, so that all of it fits across a picture. @param letters how many it has
int caption_size(std::size_t letters);

/// What became of an animation.
struct AnimationOutcome {
  bool written = false;
  bool stopped = false;   ///< by the user; nothing is written then
  std::string missing{};  ///< what is missing if none was written, and how to get it
};

/// Returns the path of ffmpeg in PATH, or nothing.
std::optional<std::filesystem::path> find_ffmpeg();

/// Returns the words below a picture of a walk: how far each body has come at a time, or when it ended before; the time, and the
/// length of the bar; and where there are too few pictures of a stroke to see it.
std::string walk_caption(const PageScene& scene, double time, const AnimationPace& pace, double bar_m);

/// Draws the walk of a scene as an animation (GIF), whole or not at all: its bodies on the ground with shadows and paths, the
/// time, and the length of a bar. Pictures are drawn by VTK without a screen and joined by ffmpeg.
/// @param scene has at least one body and is on the ground, with a clock in seconds
/// @param ffmpeg see find_ffmpeg
/// @throws io::InputError if a file cannot be written
AnimationOutcome write_walk_animation(const std::filesystem::path& file, const PageScene& scene,
                                      const std::optional<std::filesystem::path>& ffmpeg, const std::atomic<bool>* stop = nullptr,
                                      const std::function<void(double share)>& progress = {});

}  // namespace menger::evolution
