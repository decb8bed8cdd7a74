#include "meshes/files/gmsh_mesh.h"

#include <gmsh.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <initializer_list>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "io/process/child_reading.h"
#include "io/text/input_error.h"
#include "io/text/whole_file.h"
#include "meshes/files/mesh_bytes.h"
#include "meshes/hexahedra/circular_corners.h"
#include "meshes/hexahedra/element_geometry.h"
#include "meshes/hexahedra/mesh_assembly.h"

namespace menger::meshes {
namespace {

// Gmsh's numbers for the kinds of elements that are read.
constexpr int triangle_3 = 2;
constexpr int quadrilateral_4 = 3;
constexpr int hexahedron_8 = 5;
constexpr int triangle_6 = 9;
constexpr int quadrilateral_9 = 10;
constexpr int hexahedron_27 = 12;

class GmshSession {
 public:
  GmshSession() {
    gmsh::initialize(0, nullptr, false);
    gmsh::option::setNumber("General.Terminal", 0);
  }
  ~GmshSession() { gmsh::finalize(); }
  GmshSession(const GmshSession&) = delete;
  GmshSession& operator=(const GmshSession&) = delete;
};

class GmshMeshReader {
 public:
  GmshMeshReader(std::filesystem::path file, double length_unit_m) : file_(std::move(file)), length_unit_m_(length_unit_m) {}

  HexahedralMesh read() {
    check_content(io::read_whole(file_));
    const std::string bytes = io::read_in_child(file_, "Gmsh", [&] {
      const GmshSession session;
      open();
      read_points();
      read_volumes();
      read_surfaces();
      return mesh_bytes(result_);
    });
    return assemble_mesh(mesh_of_bytes<NamedHexahedra>(bytes), file_.string());
  }

 private:
  [[noreturn]] void refuse(const std::string& reason) const { throw io::InputError(file_.string() + ": " + reason); }

  /// Checks the start and the end of a file before Gmsh opens it. Gmsh would run a file without the header of a mesh as a script,
  /// and would read an incomplete file without an error.
  void check_content(const std::string& text) const {
    if (file_.extension() != ".msh") refuse("is not a mesh of Gmsh: its name must end in .msh");
    if (!text.starts_with("$MeshFormat") && !text.starts_with("$Comments"))
      refuse("is not a mesh of Gmsh: it must begin with $MeshFormat");
    if (text.find("$EndNodes") == std::string::npos || text.find("$EndElements") == std::string::npos)
      refuse("is cut off, or contains no mesh: $EndNodes or $EndElements is missing");
  }

  void open() const {
    try {
      gmsh::open(file_.string());
    } catch (const std::exception& error) {
      refuse(std::string("cannot be read as a mesh of Gmsh: ") + error.what());
    } catch (...) {
      refuse("cannot be read as a mesh of Gmsh");
    }
  }

  void read_points() {
    std::vector<std::size_t> tags;
    std::vector<double> coordinates;
    std::vector<double> unused;
    gmsh::model::mesh::getNodes(tags, coordinates, unused);
    if (tags.empty()) refuse("cannot be read as a mesh of Gmsh, or contains no points");
    for (std::size_t i = 0; i < tags.size(); ++i) {
      point_of_tag_[tags[i]] = i;
      Point point{};
      for (std::size_t axis = 0; axis < 3; ++axis) point[axis] = length_unit_m_ * coordinates[3 * i + axis];
      if (!is_finite(point)) refuse("point " + std::to_string(tags[i]) + " has a coordinate that is not a finite number");
      result_.points.push_back(point);
    }
  }

  [[nodiscard]] std::size_t point(std::size_t tag) const {
    const auto found = point_of_tag_.find(tag);
    if (found == point_of_tag_.end()) refuse("has an element with point " + std::to_string(tag) + ", which is not in the file");
    return found->second;
  }

  /// Returns the name of the physical group of an entity; nothing if it belongs to none.
  [[nodiscard]] std::optional<std::string> physical_name(const std::pair<int, int>& entity) const {
    std::vector<int> groups;
    gmsh::model::getPhysicalGroupsForEntity(entity.first, entity.second, groups);
    if (groups.empty()) return std::nullopt;
    if (groups.size() > 1)
      refuse((entity.first == 3 ? "volume " : "surface ") + std::to_string(entity.second) +
             " belongs to several physical groups");
    std::string name;
    // The number is negative if the surface has the opposite orientation of its group.
    gmsh::model::getPhysicalName(entity.first, std::abs(groups[0]), name);
    return name.empty() ? std::to_string(std::abs(groups[0])) : name;
  }

  static std::size_t index_of(std::vector<std::string>& names, const std::string& name) {
    const auto found = std::find(names.begin(), names.end(), name);
    const auto index = static_cast<std::size_t>(found - names.begin());
    if (found == names.end()) names.push_back(name);
    return index;
  }

  /// Calls `visit` with the kind and the points of each element of an entity. All elements must be of an allowed kind.
  template <class Visit>
  void for_each_element(const std::pair<int, int>& entity, std::initializer_list<int> allowed, const char* wanted,
                        const Visit& visit) const {
    std::vector<int> kinds;
    std::vector<std::vector<std::size_t>> tags;
    std::vector<std::vector<std::size_t>> nodes;
    gmsh::model::mesh::getElements(kinds, tags, nodes, entity.first, entity.second);
    for (std::size_t i = 0; i < kinds.size(); ++i) {
      if (std::find(allowed.begin(), allowed.end(), kinds[i]) == allowed.end()) {
        refuse("holds " + std::to_string(tags[i].size()) + " elements of the kind \"" + kind_name(kinds[i]) + "\"; only " +
               wanted + " can be used");
      }
      const std::size_t width = nodes[i].size() / std::max<std::size_t>(1, tags[i].size());
      if (nodes[i].size() != width * tags[i].size() || width < kind_points(kinds[i]))
        refuse("has elements without all of their points");
      for (std::size_t element = 0; element < tags[i].size(); ++element) visit(kinds[i], &nodes[i][element * width]);
    }
  }

  static std::string kind_name(int kind) {
    std::string name;
    int dimension = 0, order = 0, count = 0, primary_count = 0;
    std::vector<double> local;
    gmsh::model::mesh::getElementProperties(kind, name, dimension, order, count, local, primary_count);
    return name;
  }

  /// Returns the number of points of an element of a kind that is read.
  static std::size_t kind_points(int kind) {
    static const std::map<int, std::size_t> counts{{triangle_3, 3}, {quadrilateral_4, 4}, {hexahedron_8, 8},
                                                   {triangle_6, 6}, {quadrilateral_9, 9}, {hexahedron_27, 27}};
    return counts.at(kind);
  }

  void read_volumes() {
    gmsh::vectorpair volumes;
    gmsh::model::getEntities(volumes, 3);
    for (const auto& volume : volumes) {
      const std::string name = physical_name(volume).value_or("wall");
      for_each_element(volume, {hexahedron_8, hexahedron_27}, "hexahedra with 8 or 27 points",
                       [&](int /*kind*/, const std::size_t* nodes) {
                         ElementCorners corners{};
                         for (std::size_t c = 0; c < corners.size(); ++c) corners[corner_of_circular[c]] = point(nodes[c]);
                         result_.elements.push_back(corners);
                         result_.regions.push_back(index_of(result_.region_names, name));
                       });
    }
  }

  void read_surfaces() {
    gmsh::vectorpair surfaces;
    gmsh::model::getEntities(surfaces, 2);
    for (const auto& surface : surfaces) {
      const std::optional<std::string> name = physical_name(surface);
      if (!name) continue;
      if (name->starts_with("cap")) {
        read_cap(surface, *name);
        continue;
      }
      const std::size_t label = index_of(result_.label_names, *name);
      for_each_element(surface, {quadrilateral_4, quadrilateral_9}, "quadrilaterals with 4 or 9 points",
                       [&](int /*kind*/, const std::size_t* nodes) {
                         NamedFace face{{}, label};
                         for (std::size_t c = 0; c < 4; ++c) face.corners[c] = point(nodes[c]);
                         result_.faces.push_back(face);
                       });
    }
  }

  /// Adds a surface to the cap of its name. The rim consists of the edges that belong to only one element of the cap.
  void read_cap(const std::pair<int, int>& surface, const std::string& name) {
    const auto has_name = [&](const NamedCap& cap) { return cap.name == name; };
    auto cap = std::find_if(result_.caps.begin(), result_.caps.end(), has_name);
    if (cap == result_.caps.end()) cap = result_.caps.insert(result_.caps.end(), {name, {}});
    std::set<std::array<std::size_t, 2>> rim(cap->rim.begin(), cap->rim.end());
    for_each_element(surface, {triangle_3, triangle_6, quadrilateral_4, quadrilateral_9}, "triangles and quadrilaterals",
                     [&](int kind, const std::size_t* nodes) {
                       const std::size_t count = kind == triangle_3 || kind == triangle_6 ? 3 : 4;
                       for (std::size_t i = 0; i < count; ++i) {
                         const std::size_t a = point(nodes[i]);
                         const std::size_t b = point(nodes[(i + 1) % count]);
                         const std::array edge{std::min(a, b), std::max(a, b)};
                         if (!rim.insert(edge).second) rim.erase(edge);
                       }
                     });
    cap->rim.assign(rim.begin(), rim.end());
  }

  std::filesystem::path file_;
  double length_unit_m_;
  std::map<std::size_t, std::size_t> point_of_tag_;
  NamedHexahedra result_;
};

}  // namespace

HexahedralMesh read_gmsh_mesh(const std::filesystem::path& file, double length_unit_m) {
  return GmshMeshReader(file, length_unit_m).read();
}

}  // namespace menger::meshes
