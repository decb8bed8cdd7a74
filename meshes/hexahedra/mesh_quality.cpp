#include "meshes/hexahedra/mesh_quality.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "io/text/formatted.h"
#include "io/text/input_error.h"
#include "io/text/joined_text.h"
#include "meshes/hexahedra/chamber_surface.h"
#include "meshes/hexahedra/element_geometry.h"

namespace menger::meshes {
namespace {

Point centre(const CornerPoints& corners) {
  Point sum{};
  for (const Point& corner : corners) {
    for (std::size_t i = 0; i < 3; ++i) sum[i] += 0.125 * corner[i];
  }
  return sum;
}

}  // namespace

void require_no_inverted_elements(const HexahedralMesh& mesh, const std::string& source) {
  std::size_t count = 0;
  std::size_t first = 0;
  for (std::size_t element = 0; element < mesh.elements.size(); ++element) {
    if (smallest_determinant(corner_points(mesh, element)) > 0.0) continue;
    if (count++ == 0) first = element;
  }
  if (count == 0) return;
  const Point at = centre(corner_points(mesh, first));
  throw io::InputError(source + ": " + std::to_string(count) + " of " + std::to_string(mesh.elements.size()) +
                       " elements are inverted; the first is element " + std::to_string(first) + " around " +
                       millimetre_text(at));
}

MeshQuality mesh_quality(const HexahedralMesh& mesh) {
  assert(!mesh.elements.empty());
  MeshQuality quality;
  quality.points = mesh.points.size();
  quality.elements = mesh.elements.size();
  quality.boundary_faces = mesh.faces.size();
  quality.chambers = mesh.chambers.size();
  quality.plenums = mesh.plenum_names.size();
  quality.scaled_jacobian_min = std::numeric_limits<double>::max();
  quality.shortest_edge_m = std::numeric_limits<double>::max();
  // With double, half a million terms would lose the last digits in which the closed form is compared.
  long double volume_m3 = 0.0L;
  long double jacobian_sum = 0.0L;
  for (std::size_t element = 0; element < mesh.elements.size(); ++element) {
    const CornerPoints corners = corner_points(mesh, element);
    const double scaled = scaled_jacobian(corners);
    quality.scaled_jacobian_min = std::min(quality.scaled_jacobian_min, scaled);
    jacobian_sum += scaled;
    const auto [shortest, longest] = edge_range(corners);
    quality.aspect_ratio_max = std::max(quality.aspect_ratio_max, longest / shortest);
    quality.shortest_edge_m = std::min(quality.shortest_edge_m, shortest);
    quality.longest_edge_m = std::max(quality.longest_edge_m, longest);
    volume_m3 += element_volume(corners);
  }
  quality.scaled_jacobian_mean = static_cast<double>(jacobian_sum) / static_cast<double>(quality.elements);
  quality.volumes.push_back({"solid", static_cast<double>(volume_m3), {}});
  for (const Chamber& chamber : mesh.chambers) quality.volumes.push_back({chamber.name, enclosed_volume(mesh, chamber), {}});
  return quality;
}

MeshQuality mesh_quality(const HollowBody& body) {
  MeshQuality quality = mesh_quality(body.mesh);
  quality.body = HollowBodyCounts{body.module_count, body.hole_count, body.edge_contact_count};
  quality.volumes.front().closed_form_m3 = body.wall_volume_m3;
  for (std::size_t chamber = 0; chamber < body.chambers.size(); ++chamber)
    quality.volumes[chamber + 1].closed_form_m3 = body.chambers[chamber].volume_m3;
  return quality;
}

io::CsvTable quality_table(const MeshQuality& quality) {
  io::CsvTable table({"quantity", "value", "closed_form"});
  const std::optional<double> none;
  const auto count = [&](const char* name, std::size_t value) { table.add_row(name, std::uint64_t{value}, none); };
  const auto number = [&](const char* name, double value) { table.add_row(name, value, none); };
  count("points", quality.points);
  count("elements", quality.elements);
  count("boundary_faces", quality.boundary_faces);
  count("chambers", quality.chambers);
  count("plenums", quality.plenums);
  if (quality.body) {
    count("modules", quality.body->modules);
    count("joint_holes", quality.body->holes);
    count("edge_contacts", quality.body->edge_contacts);
  }
  number("scaled_jacobian_min", quality.scaled_jacobian_min);
  number("scaled_jacobian_mean", quality.scaled_jacobian_mean);
  number("aspect_ratio_max", quality.aspect_ratio_max);
  number("shortest_edge_m", quality.shortest_edge_m);
  number("longest_edge_m", quality.longest_edge_m);
  for (const MeasuredVolume& volume : quality.volumes)
    table.add_row(volume.part + " volume_m3", volume.mesh_m3, volume.closed_form_m3);
  return table;
}

std::string quality_text(const MeshQuality& quality) {
  const std::vector<std::string> counts{
      io::counted(quality.elements, "element"), io::counted(quality.points, "point"),
      io::counted(quality.boundary_faces, "boundary face"),
      io::counted(quality.chambers, "chamber") + " in " + io::counted(quality.plenums, "plenum")};
  std::string text = io::joined(counts) + "\n";
  if (quality.body)
    text += io::counted(quality.body->modules, "module") + ", " + io::counted(quality.body->holes, "hole") + " in joints, " +
            io::counted(quality.body->edge_contacts, "contact") + " of modules along an edge only (not bonded)\n";
  text += io::formatted("edges %.4g to %.4g mm, aspect ratio up to %.4g, scaled Jacobian at least %.4g, on average %.4g\n",
                        1e3 * quality.shortest_edge_m, 1e3 * quality.longest_edge_m, quality.aspect_ratio_max,
                        quality.scaled_jacobian_min, quality.scaled_jacobian_mean);
  // Bodies of level 3 have hundreds of chambers; the table lists them all.
  constexpr std::size_t most_lines = 8;
  for (std::size_t i = 0; i < std::min(most_lines, quality.volumes.size()); ++i) {
    const MeasuredVolume& volume = quality.volumes[i];
    text += io::formatted("%s: %.6g cm^3", volume.part.c_str(), 1e6 * volume.mesh_m3);
    if (volume.closed_form_m3)
      text += io::formatted(" (relative difference to the closed form %.1e)",
                            std::abs(volume.mesh_m3 - *volume.closed_form_m3) / *volume.closed_form_m3);
    text += '\n';
  }
  if (quality.volumes.size() > most_lines)
    text += io::formatted("... and %zu more chambers\n", quality.volumes.size() - most_lines);
  return text;
}

}  // namespace menger::meshes
