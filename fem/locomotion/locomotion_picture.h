#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "fem/locomotion/locomotion_result.h"
#include "fem/locomotion/walk_grid.h"
#include "io/picture/picture.h"
#include "meshes/hexahedra/hexahedral_mesh.h"

namespace menger::fem {

/// Draws a body at the end of its run, coloured by the displacement of its points, with the edges of the body at the start, the
/// ground, and on it the path of the centre of mass.
/// @return what is missing if nothing can be drawn
/// @throws io::InputError if the file cannot be written
io::PictureOutcome draw_moved_body(const std::filesystem::path& file, const meshes::HexahedralMesh& mesh, const MovedBody& body,
                                   const LocomotionResult& result, const std::string& caption,
                                   const io::PictureStyle& style = {});

/// Plots the displacement over time, the path from above with its start and its end, and the pressures of the plena.
/// @param title of the plot: the name of the design
io::PictureOutcome plot_locomotion(const std::filesystem::path& file, const LocomotionResult& result, const std::string& title,
                                   const io::PictureStyle& style = {});

}  // namespace menger::fem
