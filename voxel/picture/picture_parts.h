#pragma once

#include <vtkPolyData.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include <array>
#include <span>
#include <string>

#include "meshes/design/polycube.h"
#include "voxel/engine/frame.h"
#include "voxel/picture/picture_view.h"

namespace menger::voxel {

/// Colours of materials 1 and 2: red, green and blue, 0 to 255. The page of a report has the same.
inline constexpr std::array<std::array<unsigned char, 3>, 2> material_colours{{{0, 114, 178}, {213, 94, 0}}};

/// A robot, moved by `shift` in the picture.
struct Placed {
  const Frame* frame;
  Vector shift;
};

/// The sides of boxes, each box in the colour of its material. @param corners_m in the order of VTK_HEXAHEDRON
vtkSmartPointer<vtkPolyData> box_surface(std::span<const std::array<Vector, 8>> corners_m,
                                         std::span<const meshes::Material> materials);

/// The sides of all cubes of a robot, in the colours of their materials.
vtkSmartPointer<vtkPolyData> robot_surface(const Placed& robot);

/// A moved copy of a surface; it shares the data on the surface.
vtkSmartPointer<vtkPolyData> moved(vtkPolyData& surface, const Vector& shift);

/// The shadow of a point on the ground at a given height.
Vector shadow_of(const Vector& point, double ground_height);

/// Adds the light to a renderer. This and the following functions add the parts of a picture. Parts on the ground are drawn at
/// different heights, so that no two surfaces coincide.
void add_light(vtkRenderer& renderer);
void add_robot(vtkRenderer& renderer, vtkPolyData& surface, double line_width);

/// Adds finite elements. @param line_width of their edges; 0: no edges
void add_elements(vtkRenderer& renderer, vtkPolyData& surface, double line_width);
void add_floor(vtkRenderer& renderer, const Extent& ground, double height);
void add_shadow(vtkRenderer& renderer, vtkPolyData& surface, double ground_height, double height);
void add_trail(vtkRenderer& renderer, std::span<const Vector> trail);

/// Adds lines, which are also visible through bodies.
void add_lines(vtkRenderer& renderer, vtkPolyData& lines, double line_width);

/// Adds a bar below what is seen, along the picture. @param seen along the axes of the view
void add_scale_bar(vtkRenderer& renderer, const View& view, const Extent& seen, double length_m);

/// Adds a line on the ground along each of the axes x and y. @param corner where they meet
void add_ground_axes(vtkRenderer& renderer, const Vector& corner, double length_m);

/// Adds a caption. @param across position of its middle, 0 to 1 from left to right @param up of its lower end, 0 to 1 from below
void add_caption(vtkRenderer& renderer, const std::string& caption, double across, int font_size, double up = 0.03);

}  // namespace menger::voxel
