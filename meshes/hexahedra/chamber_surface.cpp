#include "meshes/hexahedra/chamber_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "io/text/input_error.h"
#include "io/text/number_text.h"
#include "meshes/hexahedra/element_geometry.h"

namespace menger::meshes {
namespace {

constexpr std::array<std::size_t, 3> all_axes{0, 1, 2};

bool bounds(const Chamber& chamber, std::size_t label) {
  return std::find(chamber.labels.begin(), chamber.labels.end(), label) != chamber.labels.end();
}

/// For each edge: how often it is used from its smaller to its larger corner, minus how often in the opposite direction.
using EdgeBalance = std::map<std::array<std::size_t, 2>, int>;

void run_through(EdgeBalance& balance, std::size_t from, std::size_t to) {
  balance[{std::min(from, to), std::max(from, to)}] += from < to ? 1 : -1;
}

EdgeBalance edge_balance(const HexahedralMesh& mesh, const Chamber& chamber) {
  EdgeBalance balance;
  for (const BoundaryFace& face : mesh.faces) {
    if (!bounds(chamber, face.label)) continue;
    // The order is reversed because faces point into the air and rims out of it.
    for (std::size_t i = 0; i < 4; ++i) run_through(balance, face.corners[(i + 1) % 4], face.corners[i]);
  }
  for (const Cap& cap : chamber.caps) {
    for (const auto& [from, to] : cap.rim) run_through(balance, from, to);
  }
  return balance;
}

/// Returns the edges of symmetry faces that lie in a coordinate plane.
std::set<std::array<std::size_t, 2>> symmetry_edges(const HexahedralMesh& mesh) {
  const double tolerance = coincidence_tolerance_m(mesh.points);
  const auto in_one_plane = [&](const Point& a, const Point& b) {
    return std::any_of(all_axes.begin(), all_axes.end(),
                       [&](std::size_t axis) { return std::abs(a[axis]) <= tolerance && std::abs(b[axis]) <= tolerance; });
  };
  std::set<std::array<std::size_t, 2>> edges;
  for (const BoundaryFace& face : mesh.faces) {
    if (!mesh.label_names[face.label].starts_with("symmetry")) continue;
    for (std::size_t i = 0; i < 4; ++i) {
      const std::size_t a = face.corners[i];
      const std::size_t b = face.corners[(i + 1) % 4];
      if (in_one_plane(mesh.points[a], mesh.points[b])) edges.insert({std::min(a, b), std::max(a, b)});
    }
  }
  return edges;
}

void require_closed(const HexahedralMesh& mesh, const Chamber& chamber, const std::set<std::array<std::size_t, 2>>& symmetry,
                    const std::string& name) {
  std::vector<std::array<std::size_t, 2>> open = open_edges(mesh, chamber);
  std::erase_if(open, [&](const auto& edge) {
    return symmetry.contains({std::min(edge[0], edge[1]), std::max(edge[0], edge[1])});
  });
  if (open.empty()) return;
  throw io::InputError(name + " is open: " + std::to_string(open.size()) +
                       " edges of its surface have no neighbour, the first at " + millimetre_text(mesh.points[open.front()[0]]));
}

}  // namespace

Point cap_apex(const HexahedralMesh& mesh, const Cap& cap) {
  Point middle{};
  std::map<std::size_t, int> balance;
  for (const auto& [from, to] : cap.rim) {
    for (std::size_t i = 0; i < 3; ++i)
      middle[i] += 0.5 * (mesh.points[from][i] + mesh.points[to][i]) / static_cast<double>(cap.rim.size());
    --balance[from];
    ++balance[to];
  }
  std::erase_if(balance, [](const auto& end) { return end.second == 0; });
  if (balance.empty()) return middle;
  const double tolerance = coincidence_tolerance_m(mesh.points);
  for (const auto& [corner, ends] : balance) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (std::abs(mesh.points[corner][axis]) <= tolerance) middle[axis] = 0.0;
    }
  }
  return middle;
}

double enclosed_volume(const HexahedralMesh& mesh, const Chamber& chamber) {
  double flux = 0.0;
  for (const BoundaryFace& face : mesh.faces) {
    if (!bounds(chamber, face.label)) continue;
    flux -= flux_of_position(
        {mesh.points[face.corners[0]], mesh.points[face.corners[1]], mesh.points[face.corners[2]], mesh.points[face.corners[3]]});
  }
  for (const Cap& cap : chamber.caps) {
    const Point apex = cap_apex(mesh, cap);
    for (const auto& [from, to] : cap.rim) {
      const Point& a = mesh.points[from];
      const Point& b = mesh.points[to];
      // x . n is constant on a triangle, so any point of it can be used.
      flux += 0.5 * dot(apex, cross(difference(a, apex), difference(b, apex)));
    }
  }
  return flux / 3.0;
}

std::vector<std::array<std::size_t, 2>> open_edges(const HexahedralMesh& mesh, const Chamber& chamber) {
  std::vector<std::array<std::size_t, 2>> open;
  for (const auto& [edge, balance] : edge_balance(mesh, chamber)) {
    if (balance > 0) open.push_back({edge[1], edge[0]});
    if (balance < 0) open.push_back(edge);
  }
  return open;
}

void require_closed_chambers(const HexahedralMesh& mesh, const std::string& source) {
  const std::set<std::array<std::size_t, 2>> symmetry = symmetry_edges(mesh);
  std::set<std::size_t> taken;
  for (const Chamber& chamber : mesh.chambers) {
    const std::string name = source + ": " + chamber.name;
    for (const std::size_t label : chamber.labels) {
      if (!taken.insert(label).second)
        throw io::InputError(name + ": label \"" + mesh.label_names.at(label) + "\" already bounds another chamber");
    }
    if (std::none_of(mesh.faces.begin(), mesh.faces.end(), [&](const BoundaryFace& face) { return bounds(chamber, face.label); }))
      throw io::InputError(name + " has no faces");
    require_closed(mesh, chamber, symmetry, name);
    if (const double volume = enclosed_volume(mesh, chamber); !(volume > 0.0)) {
      throw io::InputError(name + " encloses solid, not air (volume " + io::number_text(volume) +
                           " m^3): its normals point the wrong way, as those of an outer surface do");
    }
  }
}

}  // namespace menger::meshes
