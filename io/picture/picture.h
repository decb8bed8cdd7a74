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

/// Whether a picture was made.
struct PictureOutcome {
  bool written = false;
  std::string missing{};  ///< what is missing where none was written, and how to get it
};

/// Pictures are rendered this many times larger along each side and averaged, so that edges are smooth.
inline constexpr int supersampling = 2;

/// Renders a window off-screen and writes it as PNG, whole or not at all; says what is missing where nothing can be rendered.
///
/// Renders on the X display at hand, or on a virtual one that is started for the purpose. Pictures are for looking at: their
/// bytes depend on the graphics library.
/// @param fill adds the renderers to the window, whose sides have `supersampling` times the pixels of the picture; it is called
/// only if there is something to render on @throws InputError if the place cannot be written
PictureOutcome write_picture(const std::filesystem::path& file, const PictureStyle& style,
                             const std::function<void(vtkRenderWindow&)>& fill);

}  // namespace menger::io
