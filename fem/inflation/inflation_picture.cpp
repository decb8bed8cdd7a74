#include "fem/inflation/inflation_picture.h"

#include <vtkCellType.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkTableBasedClipDataSet.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <array>
#include <limits>

#include "fem/picture/cutting_plane.h"
#include "fem/picture/picture_parts.h"
#include "fem/space/rank_gather.h"
#include "io/text/formatted.h"

namespace menger::fem {
namespace {

/// Returns the body as linear hexahedra, eight for each of degree 2, with scalars "stress" (kPa) and "depth" (reference y, m).
vtkSmartPointer<vtkUnstructuredGrid> linear_grid(const DeformedBody& body, bool deformed) {
  auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkDoubleArray> stress;
  stress->SetName("stress");
  vtkNew<vtkDoubleArray> depth;
  depth->SetName("depth");
  for (std::size_t n = 0; n < body.positions.size(); ++n) {
    const Point& X = body.positions[n];
    points->InsertNextPoint((deformed ? sum(X, body.displacements_m[n]) : X).data());
    stress->InsertNextValue(1e-3 * body.von_mises_Pa[n]);
    depth->InsertNextValue(X[1]);
  }
  grid->SetPoints(points);
  grid->GetPointData()->AddArray(stress);
  grid->GetPointData()->AddArray(depth);

  const auto degree = static_cast<std::size_t>(body.degree);
  const std::size_t side = degree + 1;
  const std::size_t nodes = side * side * side;
  for (std::size_t first = 0; first < body.element_nodes.size(); first += nodes) {
    for (std::size_t part = 0; part < degree * degree * degree; ++part) {
      const std::size_t i = part % degree;
      const std::size_t j = part / degree % degree;
      const std::size_t k = part / (degree * degree);
      const auto node = [&](std::size_t u, std::size_t v, std::size_t w) {
        return static_cast<vtkIdType>(body.element_nodes[first + (i + u) + side * ((j + v) + side * (k + w))]);
      };
      const std::array<vtkIdType, 8> corners{node(0, 0, 0), node(1, 0, 0), node(1, 1, 0), node(0, 1, 0),
                                             node(0, 0, 1), node(1, 0, 1), node(1, 1, 1), node(0, 1, 1)};
      grid->InsertNextCell(VTK_HEXAHEDRON, 8, corners.data());
    }
  }
  return grid;
}

/// Returns the part of a grid behind the cut.
vtkSmartPointer<vtkUnstructuredGrid> part_behind(vtkUnstructuredGrid& grid, double cut) {
  grid.GetPointData()->SetActiveScalars("depth");
  vtkNew<vtkTableBasedClipDataSet> clip;
  clip->SetInputData(&grid);
  clip->SetValue(cut);
  clip->Update();
  vtkSmartPointer<vtkUnstructuredGrid> part = clip->GetOutput();
  part->GetPointData()->SetActiveScalars("stress");
  return part;
}

/// Returns the boxes of the elements at rest.
std::vector<ElementBox> boxes_of_elements(const DeformedBody& body) {
  const auto side = static_cast<std::size_t>(body.degree) + 1;
  const std::size_t nodes = side * side * side;
  std::vector<ElementBox> boxes;
  for (std::size_t first = 0; first < body.element_nodes.size(); first += nodes) {
    ElementBox box;
    box[0].fill(std::numeric_limits<double>::max());
    box[1].fill(std::numeric_limits<double>::lowest());
    for (std::size_t n = 0; n < nodes; ++n) {
      const Point& X = body.positions[static_cast<std::size_t>(body.element_nodes[first + n])];
      for (std::size_t i = 0; i < 3; ++i) {
        box[0][i] = std::min(box[0][i], X[i]);
        box[1][i] = std::max(box[1][i], X[i]);
      }
    }
    boxes.push_back(box);
  }
  return boxes;
}

/// Returns the stress that a fiftieth of the nodes exceed, kPa.
double highest_colour(const DeformedBody& body) {
  std::vector<double> stresses = body.von_mises_Pa;
  const auto place = stresses.begin() + static_cast<std::ptrdiff_t>(stresses.size() * 49 / 50);
  std::nth_element(stresses.begin(), place, stresses.end());
  return std::max(1e-3 * *place, std::numeric_limits<double>::min());
}

/// Names the scale, and says what its red end stands for where it does not reach the largest stress.
std::string stress_title(const DeformedBody& body) {
  const double largest = 1e-3 * *std::ranges::max_element(body.von_mises_Pa);
  const std::string title = "von Mises stress (kPa)";
  return largest > highest_colour(body) ? title + "\nred: up to " + io::shown(largest, 3) : title;
}

}  // namespace

DeformedBody gather_deformed_body(const Space& space, std::span<const double> displacements, const NodalFields& fields) {
  std::vector<double> owned;
  constexpr std::size_t numbers = 7;
  for (std::size_t n = 0; n < static_cast<std::size_t>(space.owned_count); ++n) {
    owned.insert(owned.end(), space.positions[n].begin(), space.positions[n].end());
    for (std::size_t i = 0; i < 3; ++i) owned.push_back(displacements[3 * n + i]);
    owned.push_back(von_mises_stress(fields.cauchy_stress[n]));
  }
  const std::vector<double> nodes = gather_on_first(space.communicator, owned);
  std::vector<double> elements;  // as doubles, which hold every index exactly
  for (const Index node : space.element_nodes) elements.push_back(space.global_node(node));
  elements = gather_on_first(space.communicator, elements);

  DeformedBody body{space.degree, {}, {}, {}, {}};
  for (std::size_t n = 0; n < nodes.size(); n += numbers) {
    body.positions.push_back({nodes[n], nodes[n + 1], nodes[n + 2]});
    body.displacements_m.push_back({nodes[n + 3], nodes[n + 4], nodes[n + 5]});
    body.von_mises_Pa.push_back(nodes[n + 6]);
  }
  for (const double node : elements) body.element_nodes.push_back(static_cast<Index>(node));
  return body;
}

io::PictureOutcome draw_deformed_body(const std::filesystem::path& file, const DeformedBody& body, const std::string& caption,
                                      const io::PictureStyle& style) {
  return io::write_picture(file, style, [&](vtkRenderWindow& window) {
    const double cut = cutting_depth(boxes_of_elements(body));
    const auto whole = linear_grid(body, false);
    const auto deformed = part_behind(*linear_grid(body, true), cut);
    const auto reference = part_behind(*whole, cut);
    vtkNew<vtkRenderer> renderer;
    renderer->SetBackground(1.0, 1.0, 1.0);
    window.AddRenderer(renderer);
    add_light(*renderer);
    add_body(*renderer, *deformed, highest_colour(body));
    add_outline(*renderer, *reference);
    whole->GetPointData()->SetActiveScalars("depth");
    add_faint_outline(*renderer, *whole, cut);
    const double pixels_per_m = aim(*renderer, {deformed, whole}, style);
    add_scale_bar(*renderer, pixels_per_m, style);
    add_colour_bar(*renderer, stress_title(body), highest_colour(body), style);
    add_caption(*renderer, caption, style);
  });
}

}  // namespace menger::fem
