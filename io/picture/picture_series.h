#pragma once

#include <functional>
#include <string>

#include "io/picture/picture.h"

class vtkRenderWindow;  // NOLINT(cppcoreguidelines-virtual-class-destructor): as the library has it

namespace menger::io {

/// Renders a window off-screen several times, as for the frames of an animation, with one connection to a display.
/// @param fill adds the renderers to the window, whose sides have `supersampling` times the pixels of the pictures; it is called
/// only if a display is available
/// @param next changes the scene for the next picture; false ends the series
/// @param done gets every picture as the bytes of a PNG file
/// @return whether the pictures were made, or what is missing
PictureOutcome draw_pictures(const PictureStyle& style, const std::function<void(vtkRenderWindow&)>& fill,
                             const std::function<bool()>& next, const std::function<void(const std::string& png)>& done);

}  // namespace menger::io
