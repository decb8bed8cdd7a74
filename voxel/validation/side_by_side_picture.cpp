#include "voxel/validation/side_by_side_picture.h"

#include <vtkCamera.h>
#include <vtkNew.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include <algorithm>
#include <vector>

#include "voxel/picture/picture_parts.h"
#include "voxel/picture/picture_view.h"

namespace menger::voxel {

namespace {

void fill(vtkRenderWindow& window, const std::vector<vtkSmartPointer<vtkPolyData>>& bodies, const std::string& caption,
          const io::PictureStyle& style) {
  const View view = isometric_view();
  vtkNew<vtkRenderer> renderer;
  renderer->SetBackground(1.0, 1.0, 1.0);
  add_light(*renderer);
  double widest = 0.0;
  for (const auto& body : bodies) widest = std::max(widest, view_extent(*body, view).size(0));
  Extent seen;
  std::vector<double> middles;
  double left = 0.0;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const Extent own = view_extent(*bodies[i], view);
    const auto body = moved(*bodies[i], view.across(left - own.low[0], -own.low[1]));
    const bool is_surrogate = i + 1 == bodies.size();
    if (is_surrogate) add_robot(*renderer, *body, 1.5 * io::supersampling);
    if (!is_surrogate) add_elements(*renderer, *body, 0.0);
    const Extent placed = view_extent(*body, view);
    seen.unite(placed);
    middles.push_back(placed.centre(0));
    left = placed.high[0] + 0.3 * widest;
  }
  window.AddRenderer(renderer);
  const double aspect = static_cast<double>(style.width_px) / style.height_px;
  constexpr double margin = 0.10;  // for the captions
  aim(*renderer, view, seen, aspect, margin);
  const double picture_width = 2.0 * renderer->GetActiveCamera()->GetParallelScale() * aspect;
  for (std::size_t i = 0; i < middles.size(); ++i) {
    std::string text = i + 1 == middles.size() ? "surrogate" : "finite elements";
    text.append(", ").append(caption);
    add_caption(*renderer, text, 0.5 + (middles[i] - seen.centre(0)) / picture_width, style.height_px / 36);
  }
}

}  // namespace

io::PictureOutcome draw_side_by_side(const std::filesystem::path& file, vtkPolyData* elements, const BodyBoxes& surrogate,
                                     const std::string& caption, const io::PictureStyle& style) {
  std::vector<vtkSmartPointer<vtkPolyData>> bodies;
  if (elements != nullptr) bodies.emplace_back(elements);
  // One colour for all boxes, because the body is of one silicone.
  bodies.push_back(box_surface(surrogate.corners_m, std::vector<meshes::Material>(surrogate.corners_m.size(), 1)));
  return io::write_picture(file, style, [&](vtkRenderWindow& window) { fill(window, bodies, caption, style); });
}

}  // namespace menger::voxel
