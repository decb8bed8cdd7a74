#include "meshes/hexahedra/mesh_assembly.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>
#include <utility>

#include "io/text/input_error.h"
#include "meshes/hexahedra/chamber_surface.h"
#include "meshes/hexahedra/element_geometry.h"
#include "meshes/hexahedra/mesh_quality.h"

namespace menger::meshes {
namespace {

using Edge = std::array<std::size_t, 2>;

struct ElementFace {
  std::size_t element;
  std::size_t side;
};

/// The one or two elements at each face. A face is named by its corners in increasing order.
using FaceElements = std::map<FaceCorners, std::vector<ElementFace>>;

FaceElements elements_at_faces(const NamedHexahedra& input, const std::string& source) {
  FaceElements elements;
  for (std::size_t element = 0; element < input.elements.size(); ++element) {
    for (std::size_t side = 0; side < face_corners.size(); ++side) {
      auto& here = elements[sorted(face_of_element(input.elements[element], side))];
      here.push_back({element, side});
      if (here.size() <= 2) continue;
      throw io::InputError(source + ": elements " + std::to_string(here[0].element) + ", " + std::to_string(here[1].element) +
                           " and " + std::to_string(element) + " share one face, but only two elements can share a face");
    }
  }
  return elements;
}

/// Returns whether two elements have opposite directions around their shared face, as neighbours of the same handedness do.
bool agree(const FaceCorners& a, const FaceCorners& b) {
  const auto start = static_cast<std::size_t>(std::find(b.begin(), b.end(), a[0]) - b.begin());
  return b[(start + 3) % 4] == a[1];
}

/// Reverses the handedness of an element by mirroring it along its first direction.
void mirror(ElementCorners& corners) {
  for (std::size_t corner = 0; corner < corners.size(); corner += 2) std::swap(corners[corner], corners[corner + 1]);
}

/// The neighbours of every element, and whether their numberings agree.
using Neighbours = std::vector<std::vector<std::pair<std::size_t, bool>>>;

Neighbours neighbours_of(const NamedHexahedra& input, const FaceElements& at_faces) {
  Neighbours neighbours(input.elements.size());
  for (const auto& [face, elements] : at_faces) {
    if (elements.size() < 2) continue;
    const ElementFace& a = elements[0];
    const ElementFace& b = elements[1];
    const bool same_way =
        agree(face_of_element(input.elements[a.element], a.side), face_of_element(input.elements[b.element], b.side));
    neighbours[a.element].emplace_back(b.element, same_way);
    neighbours[b.element].emplace_back(a.element, same_way);
  }
  return neighbours;
}

/// Mirrors elements until all agree with the first one.
void make_consistent(NamedHexahedra& input, const Neighbours& neighbours, const std::string& source) {
  std::vector<bool> mirrored(input.elements.size(), false);
  std::vector<bool> reached(input.elements.size(), false);
  std::vector<std::size_t> order{0};
  reached[0] = true;
  for (std::size_t next = 0; next < order.size(); ++next) {
    for (const auto& [neighbour, same_way] : neighbours[order[next]]) {
      if (reached[neighbour]) continue;
      reached[neighbour] = true;
      mirrored[neighbour] = mirrored[order[next]] != !same_way;
      order.push_back(neighbour);
    }
  }
  if (order.size() < input.elements.size()) {
    throw io::InputError(source + ": only " + std::to_string(order.size()) + " of " + std::to_string(input.elements.size()) +
                         " elements are connected through faces; parts must share their points where they meet");
  }
  for (std::size_t element = 0; element < mirrored.size(); ++element) {
    if (mirrored[element]) mirror(input.elements[element]);
  }
}

void make_volume_positive(const std::vector<Point>& points, std::vector<ElementCorners>& elements) {
  double volume = 0.0;
  for (const ElementCorners& element : elements) {
    CornerPoints corners{};
    std::transform(element.begin(), element.end(), corners.begin(), [&](std::size_t corner) { return points[corner]; });
    volume += element_volume(corners);
  }
  if (volume < 0.0) std::for_each(elements.begin(), elements.end(), mirror);
}

std::string face_text(const NamedHexahedra& input, const NamedFace& face) {
  Point middle{};
  for (const std::size_t corner : face.corners) {
    for (std::size_t i = 0; i < 3; ++i) middle[i] += 0.25 * input.points[corner][i];
  }
  return "a face of \"" + input.label_names[face.label] + "\" around " + millimetre_text(middle);
}

/// Returns the label of each named face, keyed by its corners in increasing order.
std::map<FaceCorners, std::size_t> labels_by_face(const NamedHexahedra& input, const FaceElements& at_faces,
                                                  const std::string& source) {
  std::map<FaceCorners, std::size_t> labels;
  for (const NamedFace& face : input.faces) {
    const FaceCorners key = sorted(face.corners);
    const auto elements = at_faces.find(key);
    if (elements == at_faces.end()) throw io::InputError(source + ": " + face_text(input, face) + " belongs to no element");
    if (elements->second.size() > 1) throw io::InputError(source + ": " + face_text(input, face) + " lies inside the solid");
    if (const auto [entry, is_new] = labels.emplace(key, face.label); !is_new && entry->second != face.label) {
      throw io::InputError(source + ": " + face_text(input, face) + " also belongs to \"" + input.label_names[entry->second] +
                           "\"");
    }
  }
  return labels;
}

void add_faces(HexahedralMesh& mesh, const FaceElements& at_faces, const std::map<FaceCorners, std::size_t>& labels) {
  const auto outer = std::find(mesh.label_names.begin(), mesh.label_names.end(), "outer");
  const auto outer_number = static_cast<std::size_t>(outer - mesh.label_names.begin());
  if (outer == mesh.label_names.end()) mesh.label_names.emplace_back("outer");
  for (const auto& [face, elements] : at_faces) {
    if (elements.size() > 1) continue;
    const auto label = labels.find(face);
    // The numbering may have been mirrored in the meantime, so the face is found by its corners.
    for (std::size_t side = 0; side < face_corners.size(); ++side) {
      const FaceCorners corners = face_of_element(mesh.elements[elements[0].element], side);
      if (sorted(corners) == face) mesh.faces.push_back({corners, label == labels.end() ? outer_number : label->second});
    }
  }
}

Point centre_of(const HexahedralMesh& mesh, const BoundaryFace& face) {
  Point centre{};
  for (const std::size_t corner : face.corners)
    for (std::size_t axis = 0; axis < 3; ++axis) centre[axis] += 0.25 * mesh.points[corner][axis];
  return centre;
}

/// Whether each corner of a face lies at one of another face.
bool coincide(const HexahedralMesh& mesh, const BoundaryFace& a, const BoundaryFace& b, double tolerance) {
  return std::ranges::all_of(a.corners, [&](std::size_t at) {
    return std::ranges::any_of(
        b.corners, [&](std::size_t other) { return length(difference(mesh.points[at], mesh.points[other])) <= tolerance; });
  });
}

/// Refuses two faces of the boundary in the same place, unless both have a label: the parts on both sides are not bonded there,
/// and programs that make meshes leave that to the user. @param labels of the named faces
void require_no_cracks(const HexahedralMesh& mesh, const std::map<FaceCorners, std::size_t>& labels, const std::string& source) {
  const double tolerance = coincidence_tolerance_m(mesh.points);
  const double unit = 4.0 * tolerance;
  using Key = std::array<std::int64_t, 3>;
  std::map<Key, std::vector<std::size_t>> faces_at;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const Point centre = centre_of(mesh, mesh.faces[f]);
    const bool is_named = labels.contains(sorted(mesh.faces[f].corners));
    Key key{};
    for (std::size_t axis = 0; axis < 3; ++axis) key[axis] = std::llround(centre[axis] / unit);
    for (std::int64_t n = 0; n < 27; ++n) {  // rounding may have moved either over the border between two units
      const auto near = faces_at.find({key[0] + n % 3 - 1, key[1] + n / 3 % 3 - 1, key[2] + n / 9 - 1});
      if (near == faces_at.end()) continue;
      for (const std::size_t other : near->second) {
        if (is_named && labels.contains(sorted(mesh.faces[other].corners))) continue;
        if (!coincide(mesh, mesh.faces[f], mesh.faces[other], tolerance)) continue;
        throw io::InputError(source + ": two faces lie in the same place, at " + millimetre_text(centre) +
                             ", and share no points: the solid has a crack there; merge the points of parts that are bonded, or "
                             "give both faces a label");
      }
    }
    faces_at[key].push_back(f);
  }
}

void add_chambers(HexahedralMesh& mesh) {
  for (std::size_t label = 0; label < mesh.label_names.size(); ++label) {
    if (!mesh.label_names[label].starts_with("chamber")) continue;
    const std::size_t plenum = mesh.plenum_names.size();
    mesh.chambers.push_back({mesh.label_names[label], {label}, {}, plenum});
    mesh.plenum_names.push_back("plenum " + std::to_string(plenum));
  }
}

Edge undirected(const Edge& edge) { return {std::min(edge[0], edge[1]), std::max(edge[0], edge[1])}; }

void add_cap(HexahedralMesh& mesh, const NamedCap& cap, const std::string& source) {
  std::set<Edge> rim;
  for (const Edge& edge : cap.rim) rim.insert(undirected(edge));
  for (Chamber& chamber : mesh.chambers) {
    std::vector<Edge> open = open_edges(mesh, chamber);
    std::erase_if(open, [&](const Edge& edge) { return !rim.contains(undirected(edge)); });
    if (open.empty() || open.size() < rim.size()) continue;
    chamber.caps.push_back({std::move(open)});
    return;
  }
  throw io::InputError(source + ": \"" + cap.name + "\" closes no chamber: no surface of a chamber ends at all of its edges");
}

/// Returns whether an edge lies in a plane of symmetry. Such an edge may bound a cap without being an edge of an element.
bool in_coordinate_plane(const Point& a, const Point& b, double tolerance) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (std::max(std::abs(a[axis]), std::abs(b[axis])) <= tolerance) return true;
  }
  return false;
}

/// Removes points that belong to no element, and numbers the others in the order in which elements use them. Other programs write
/// points of curves, of unused surfaces and in the middle of edges. Edges of caps in a plane of symmetry that are not on the
/// solid are removed, too.
/// @param source text at the start of messages, such as the name of the file
/// @throws io::InputError if a named face or any other edge of a cap has a point of no element
void drop_unused_points(NamedHexahedra& input, const std::string& source) {
  constexpr std::size_t unused = SIZE_MAX;
  std::vector<std::size_t> kept(input.points.size(), unused);
  std::vector<Point> points;
  for (ElementCorners& element : input.elements) {
    for (std::size_t& corner : element) {
      if (kept[corner] == unused) {
        kept[corner] = points.size();
        points.push_back(input.points[corner]);
      }
      corner = kept[corner];
    }
  }
  for (NamedFace& face : input.faces) {
    for (std::size_t& corner : face.corners) {
      if (kept[corner] == unused)
        throw io::InputError(source + ": \"" + input.label_names[face.label] + "\" has points that belong to no hexahedron");
      corner = kept[corner];
    }
  }
  const double tolerance = coincidence_tolerance_m(points);
  for (NamedCap& cap : input.caps) {
    std::erase_if(cap.rim, [&](const std::array<std::size_t, 2>& edge) {
      if (kept[edge[0]] != unused && kept[edge[1]] != unused) return false;
      if (in_coordinate_plane(input.points[edge[0]], input.points[edge[1]], tolerance)) return true;
      throw io::InputError(source + ": the rim of \"" + cap.name + "\" has points that belong to no hexahedron");
    });
    for (std::array<std::size_t, 2>& edge : cap.rim) edge = {kept[edge[0]], kept[edge[1]]};
  }
  input.points = std::move(points);
}

}  // namespace

HexahedralMesh assemble_mesh(NamedHexahedra input, const std::string& source) {
  if (input.elements.empty()) throw io::InputError(source + ": holds no hexahedra");
  drop_unused_points(input, source);
  const FaceElements at_faces = elements_at_faces(input, source);
  make_consistent(input, neighbours_of(input, at_faces), source);
  make_volume_positive(input.points, input.elements);
  const std::map<FaceCorners, std::size_t> labels = labels_by_face(input, at_faces, source);
  HexahedralMesh mesh;
  mesh.points = std::move(input.points);
  mesh.elements = std::move(input.elements);
  mesh.regions = std::move(input.regions);
  mesh.region_names = std::move(input.region_names);
  mesh.label_names = std::move(input.label_names);
  add_faces(mesh, at_faces, labels);
  require_no_cracks(mesh, labels, source);
  add_chambers(mesh);
  for (const NamedCap& cap : input.caps) add_cap(mesh, cap, source);
  require_no_inverted_elements(mesh, source);
  require_closed_chambers(mesh, source);
  return mesh;
}

}  // namespace menger::meshes
