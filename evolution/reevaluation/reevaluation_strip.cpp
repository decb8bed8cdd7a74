#include "evolution/reevaluation/reevaluation_strip.h"

#include <vtkCamera.h>
#include <vtkDataSetSurfaceFilter.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <algorithm>
#include <cassert>
#include <string>

#include "io/picture/chart_panel.h"
#include "io/text/formatted.h"
#include "io/text/input_error.h"
#include "io/text/is_file.h"
#include "voxel/picture/picture_parts.h"
#include "voxel/picture/picture_view.h"

namespace menger::evolution {
namespace {

namespace fs = std::filesystem;
using voxel::Extent;
using voxel::Vector;
using voxel::View;
using Surface = vtkSmartPointer<vtkPolyData>;

Surface surface_of(const fs::path& file) {
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  if (io::is_file(file)) {
    reader->SetFileName(file.c_str());
    reader->Update();
  }
  if (reader->GetOutput()->GetNumberOfPoints() == 0) throw io::InputError(file.string() + ": is no grid of finite elements");
  vtkNew<vtkDataSetSurfaceFilter> filter;
  filter->SetInputData(reader->GetOutput());
  filter->Update();
  return filter->GetOutput();
}

/// Returns the extent of a box in the coordinates of the view.
Extent seen_box(const Extent& box, const View& view) {
  Extent seen;
  for (const double x : {box.low[0], box.high[0]}) {
    for (const double y : {box.low[1], box.high[1]}) {
      for (const double z : {box.low[2], box.high[2]}) seen.add(view.coordinates({x, y, z}));
    }
  }
  return seen;
}

/// Draws a strip: two rows of surfaces in the same coordinates.
class Strip {
 public:
  explicit Strip(const std::vector<FramePair>& pairs) : pairs_(pairs) {
    for (const FramePair& pair : pairs) {
      elements_.push_back(surface_of(pair.elements));
      // Its origin is the centre of its first voxel; that of finite elements is the corner of the first cell.
      const double shift_m = 0.5 * pair.surrogate.cell_edge_m;
      surrogates_.push_back(voxel::robot_surface({&pair.surrogate, {shift_m, shift_m, shift_m}}));
      world_.unite(voxel::world_extent(*elements_.back()));
      world_.unite(voxel::world_extent(*surrogates_.back()));
    }
    const double margin = 0.1 * std::max(world_.size(0), world_.size(1));
    for (const std::size_t axis : {0U, 1U}) {
      world_.low.at(axis) -= margin;
      world_.high.at(axis) += margin;
    }
    world_.low[2] = std::min(0.0, world_.low[2]);
    tile_ = seen_box(world_, view_);
  }

  void fill(vtkRenderWindow& window, const io::PictureStyle& style) const {
    vtkNew<vtkRenderer> renderer;
    renderer->SetBackground(1.0, 1.0, 1.0);
    voxel::add_light(*renderer);
    Extent all;
    for (std::size_t column = 0; column < pairs_.size(); ++column) {
      for (const std::size_t row : {0U, 1U}) add_tile(*renderer, column, row, all);
    }
    window.AddRenderer(renderer);
    const double aspect = static_cast<double>(style.width_px) / style.height_px;
    constexpr double margin = 0.08;  // for the captions
    voxel::aim(*renderer, view_, all, aspect, margin);
    add_texts(*renderer, all, aspect, style);
  }

 private:
  [[nodiscard]] Vector shift_of(std::size_t column, std::size_t row) const {
    return view_.across(1.05 * tile_.size(0) * static_cast<double>(column), -1.05 * tile_.size(1) * static_cast<double>(row));
  }

  void add_tile(vtkRenderer& renderer, std::size_t column, std::size_t row, Extent& all) const {
    const Vector shift = shift_of(column, row);
    const Surface body = voxel::moved(*(row == 0 ? elements_ : surrogates_)[column], shift);
    Extent ground = world_;
    for (const std::size_t axis : {0U, 1U}) {
      ground.low.at(axis) += shift.at(axis);
      ground.high.at(axis) += shift.at(axis);
    }
    // The floor and the shadow are drawn at different heights, so that no two surfaces coincide.
    const double layer = 0.002 * std::max(world_.size(0), world_.size(1));
    const double height = shift[2] + world_.low[2];
    voxel::add_floor(renderer, ground, height - 2.0 * layer);
    voxel::add_shadow(renderer, *body, height, height - layer);
    if (row == 0) voxel::add_elements(renderer, *body, 0.5 * io::supersampling);
    if (row == 1) voxel::add_robot(renderer, *body, io::supersampling);
    const Vector in_view = view_.coordinates(shift);
    Extent seen = tile_;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      seen.low.at(axis) += in_view.at(axis);
      seen.high.at(axis) += in_view.at(axis);
    }
    all.unite(seen);
  }

  void add_texts(vtkRenderer& renderer, const Extent& all, double aspect, const io::PictureStyle& style) const {
    const double height = 2.0 * renderer.GetActiveCamera()->GetParallelScale();
    const double pixels = io::supersampling * style.height_px / height;  // per length
    const int font_size = io::supersampling * style.height_px / 40;
    const auto place_x = [&](double across) { return (across - all.centre(0) + 0.5 * height * aspect) * pixels; };
    for (std::size_t column = 0; column < pairs_.size(); ++column) {
      const std::string text = io::formatted("%.2f s", pairs_[column].time_s);
      const double across = tile_.centre(0) + view_.coordinates(shift_of(column, 0))[0];
      io::add_text(renderer, text, place_x(across), 0.02 * io::supersampling * style.height_px, 0, -1, font_size);
    }
    for (const std::size_t row : {0U, 1U}) {
      const double top = tile_.high[1] + view_.coordinates(shift_of(0, row))[1];
      const double y = (top - all.centre(1) + 0.5 * height) * pixels;
      io::add_text(renderer, row == 0 ? "finite elements" : "surrogate", 0.01 * io::supersampling * style.width_px, y, -1, 1,
                   font_size);
    }
  }

  const std::vector<FramePair>& pairs_;
  View view_ = voxel::isometric_view();
  std::vector<Surface> elements_;
  std::vector<Surface> surrogates_;
  Extent world_;
  Extent tile_;  ///< extent of world_ in the coordinates of the view
};

}  // namespace

io::PictureOutcome draw_strip(const fs::path& file, const std::vector<FramePair>& pairs, const io::PictureStyle& style) {
  assert(!pairs.empty());
  const Strip strip(pairs);
  return io::write_picture(file, style, [&](vtkRenderWindow& window) { strip.fill(window, style); });
}

}  // namespace menger::evolution
