#pragma once

#include <filesystem>
#include <functional>
#include <string>

class vtkRenderWindow;  // NOLINT(cppcoreguidelines-virtual-class-destructor): as the library has it

namespace menger::io {

/// Size of a picture.
struct PictureStyle {
  int width_px = 1600;
  int height_px = 1000;
};

/// Whether a picture was written.
struct [[nodiscard]] PictureOutcome {
  bool written = false;
  std::string missing{};  ///< what is missing if none was written, and how to get it
};

/// The factor by which a picture is rendered larger along each side. It is averaged afterwards, so that edges are smooth.
inline constexpr int supersampling = 2;

/// Renders a window off-screen and writes it as a PNG file, whole or not at all.
///
/// Renders on the X display in use, or on a virtual one that is started for this. If nothing can be rendered, the outcome says
/// what is missing. The bytes of a picture depend on the graphics library, so compare pictures by eye.
/// @param fill adds the renderers to the window, whose sides have `supersampling` times the pixels of the picture; it is called
/// only if a display is available
/// @throws InputError if the file cannot be written
PictureOutcome write_picture(const std::filesystem::path& file, const PictureStyle& style,
                             const std::function<void(vtkRenderWindow&)>& fill);

}  // namespace menger::io
