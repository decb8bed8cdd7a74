#pragma once

#include <vtkRenderWindow.h>

#include <filesystem>
#include <functional>

#include "voxel/preview.h"

namespace menger::voxel {

/// Pictures are rendered this many times larger along each side and averaged, so that edges are smooth.
inline constexpr int supersampling = 2;

/// Renders a window off-screen and writes it as PNG, whole or not at all; says what is missing where nothing can be rendered.
/// @param fill adds the renderers to the window; it is called only if there is something to render on
PictureOutcome write_picture(const std::filesystem::path& file, const PictureStyle& style,
                             const std::function<void(vtkRenderWindow&)>& fill);

}  // namespace menger::voxel
