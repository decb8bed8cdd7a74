#include "fem/inflation/inflation_problem.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <tuple>
#include <utility>

#include "fem/inflation/coarse_walls.h"
#include "fem/memory/memory_estimate.h"
#include "fem/statics/free_supports.h"
#include "io/process/machine_memory.h"
#include "io/text/input_error.h"
#include "io/text/number_text.h"
#include "meshes/files/gmsh_mesh.h"
#include "meshes/files/vtu_mesh.h"
#include "meshes/hexahedra/boundary_labels.h"
#include "meshes/hexahedra/chamber_surface.h"
#include "meshes/hexahedra/hollow_polycube.h"
#include "meshes/hexahedra/mesh_quality.h"

namespace menger::fem {
namespace {

meshes::HexahedralMesh make_mesh(const InflationStudy& study) {
  if (const auto* design = std::get_if<DesignSource>(&study.source)) {
    meshes::HollowBodyOptions options = design->options;
    set_elements(study.elements, options);
    try {
      return meshes::hollow_polycube(design->design, options).mesh;
    } catch (const io::InputError& error) {
      throw io::InputError(design->file.value_or(study.file).string() + ": " + error.what());
    }
  }
  const auto& source = std::get<MeshSource>(study.source);
  return source.file.extension() == ".msh" ? meshes::read_gmsh_mesh(source.file, source.length_unit_m)
                                           : meshes::read_vtu_mesh(source.file);
}

struct Box {
  Point low;
  Point high;
  [[nodiscard]] Point centre() const { return scaled(0.5, sum(low, high)); }
};

Box bounding_box(const meshes::HexahedralMesh& mesh) {
  constexpr double huge = std::numeric_limits<double>::max();
  Box box{{huge, huge, huge}, {-huge, -huge, -huge}};
  for (const Point& point : mesh.points) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      box.low[axis] = std::min(box.low[axis], point[axis]);
      box.high[axis] = std::max(box.high[axis], point[axis]);
    }
  }
  return box;
}

/// Returns the point with the smallest key; of equal ones the first.
template <class Key>
Point least(const std::vector<Point>& points, const Key& key) {
  return *std::min_element(points.begin(), points.end(), [&](const Point& a, const Point& b) { return key(a) < key(b); });
}

class ProblemBuilder {
 public:
  explicit ProblemBuilder(const InflationStudy& study) : study_(study), file_(study.file.string()) {
    problem_.mesh = make_mesh(study);
    box_ = bounding_box(problem_.mesh);
    problem_.low = box_.low;
    problem_.high = box_.high;
    length_ = norm(difference(box_.high, box_.low));
    problem_.solid_volume_m3 = meshes::mesh_quality(problem_.mesh).volumes.front().mesh_m3;
  }

  InflationProblem build() {
    problem_.body.formulation = study_.formulation;
    if (study_.has_thin_walls()) problem_.body.thin_walls = ThinWallBody{.places = thin_wall_places(problem_.mesh)};
    add_regions();
    for (const meshes::Chamber& chamber : problem_.mesh.chambers)
      problem_.body.chambers.push_back({chamber.labels, chamber.plenum});
    problem_.body.plenum_count = problem_.mesh.plenum_names.size();
    add_supports();
    problem_.body.gravity_m_per_s2 = {0.0, 0.0, -study_.gravity_m_per_s2};
    add_drives();
    add_plates();
    add_points();
    if (std::string note = note_on_coarse_walls(study_); !note.empty()) problem_.notes.push_back(std::move(note));
    return std::move(problem_);
  }

 private:
  [[nodiscard]] std::size_t label(const std::string& name) const {
    try {
      return meshes::label_index(problem_.mesh, name);
    } catch (const io::InputError& error) {
      throw io::InputError(file_ + ": " + error.what());
    }
  }

  void add_regions() {
    for (const auto& [region, material] : study_.region_materials) {
      try {
        meshes::region_index(problem_.mesh, region);
      } catch (const io::InputError& error) {
        throw io::InputError(file_ + ": " + error.what());
      }
    }
    for (const std::string& region : problem_.mesh.region_names) {
      const auto own = study_.region_materials.find(region);
      const StudyMaterial& material = own != study_.region_materials.end() ? own->second : study_.material;
      problem_.body.regions.push_back({material.law, material.volume, material.density_kg_per_m3.value_or(0.0)});
    }
  }

  void add_supports() {
    Body& body = problem_.body;
    add_symmetries();
    for (const LabelSupport& support : study_.supports.labels) body.supports.push_back({label(support.label), support.held});
    switch (study_.supports.kind) {
      case SupportKind::ground_guided:
        body.supports.push_back({label("ground"), {false, false, true}});
        // A bonded plate holds the body already. Two further held points would carry forces that are then missing from those of
        // the plate.
        if (std::all_of(study_.plates.begin(), study_.plates.end(), [](const StudyPlate& plate) { return plate.slides; }))
          hold_horizontal_motion();
        break;
      case SupportKind::ground_held:
        body.supports.push_back({label("ground"), {true, true, true}});
        break;
      case SupportKind::resting:
        rest_on_ground();
        hold_horizontal_motion();
        break;
      case SupportKind::free:
        if (symmetric_ != std::array<bool, 3>{})
          throw io::InputError(
              file_ + ": supports.kind \"free\": planes of symmetry also hold the body; choose \"labels\" to hold it by them");
        body.point_supports = free_supports(problem_.mesh.points);
        break;
      case SupportKind::labels:
        break;
    }
  }

  void add_symmetries() {
    const auto& names = problem_.mesh.label_names;
    for (std::size_t l = 0; l < names.size(); ++l) {
      if (!names[l].starts_with("symmetry")) continue;
      const std::size_t axis = symmetry_axis(names[l]);
      for (const meshes::BoundaryFace& face : problem_.mesh.faces) {
        if (face.label == l) require_at_zero(names[l], face, axis);
      }
      std::array<bool, 3> held{};
      held[axis] = true;
      problem_.body.supports.push_back({l, held});
      symmetric_[axis] = true;
    }
  }

  [[nodiscard]] std::size_t symmetry_axis(const std::string& name) const {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (name == std::string("symmetry ") + "xyz"[axis]) return axis;
    }
    throw io::InputError(file_ + ": the body has faces labelled \"" + name +
                         "\"; planes of symmetry are \"symmetry x\", \"symmetry y\" and \"symmetry z\"");
  }

  /// Checks that a face lies in the plane where the coordinate is 0: the volume of a part of a chamber is right only if the
  /// planes that cut it go through the origin.
  void require_at_zero(const std::string& name, const meshes::BoundaryFace& face, std::size_t axis) const {
    for (const std::size_t corner : face.corners) {
      const double coordinate = problem_.mesh.points[corner][axis];
      if (std::abs(coordinate) <= 1e-9 * length_) continue;
      throw io::InputError(file_ + ": faces labelled \"" + name + "\" must lie in the plane " + "xyz"[axis] + " = 0, not at " +
                           io::number_text(coordinate) + " m");
    }
  }

  /// Holds the shifts in x and y and the turn about z, as far as planes of symmetry leave them free.
  void hold_horizontal_motion() {
    const auto [has_x, has_y, has_z] = symmetric_;
    const std::vector<Point> nodes = surface_nodes();
    const Point middle = box_.centre();
    const double grain = 1e-9 * length_;  // so that the choice does not depend on rounding of positions
    const auto rounded = [&](double value) { return std::round(value / grain); };
    const Point first = least(nodes, [&](const Point& x) {
      return std::tuple(rounded(std::hypot(x[0] - middle[0], x[1] - middle[1])), rounded(x[2]), rounded(x[0]), rounded(x[1]));
    });
    if (!has_x || !has_y) problem_.body.point_supports.push_back({first, {!has_x, !has_y, false}});
    if (has_x || has_y) return;  // a plane of symmetry holds the turn, too

    // The node farthest from the first along an axis, and nearest to it across that axis.
    const auto farthest = [&](std::size_t along) {
      const std::size_t across = 1 - along;
      return least(nodes, [&](const Point& x) {
        return std::tuple(rounded(std::abs(x[across] - first[across])), -rounded(std::abs(x[along] - first[along])),
                          rounded(x[2]), rounded(x[along]));
      });
    };
    // Both points of a symmetric body must move alike in the direction that is held, or it would turn. So both lie in its plane
    // of symmetry, or they are mirror images.
    const std::array<bool, 2> off{rounded(first[0] - middle[0]) != 0.0, rounded(first[1] - middle[1]) != 0.0};
    const Point image{2.0 * middle[0] - first[0], first[1], first[2]};
    const Point nearest_image = least(nodes, [&](const Point& x) { return rounded(norm(difference(x, image))); });
    PointSupport second{farthest(0), {false, true, false}};
    if (off[0] && off[1] && rounded(norm(difference(nearest_image, image))) == 0.0) {
      second.position = nearest_image;
    } else if (off[1] && !off[0]) {
      second = {farthest(1), {true, false, false}};
    }
    problem_.body.point_supports.push_back(second);
  }

  /// Returns the positions on the surface at which the space will have nodes: the corners, and the points between them for
  /// elements of degree 2 and refined ones.
  [[nodiscard]] std::vector<Point> surface_nodes() const {
    const bool has_middles = study_.space_degree() > 1 || study_.refinements > 0;
    std::vector<Point> nodes;
    for (const meshes::BoundaryFace& face : problem_.mesh.faces) {
      Point middle{};
      for (std::size_t c = 0; c < 4; ++c) {
        const Point& corner = problem_.mesh.points[face.corners[c]];
        nodes.push_back(corner);
        middle = sum(middle, scaled(0.25, corner));
        if (has_middles) nodes.push_back(scaled(0.5, sum(corner, problem_.mesh.points[face.corners[(c + 1) % 4]])));
      }
      if (has_middles) nodes.push_back(middle);
    }
    return nodes;
  }

  void rest_on_ground() {
    const std::size_t ground = label("ground");
    double area_m2 = 0.0;
    for (const meshes::BoundaryFace& face : problem_.mesh.faces) {
      if (face.label != ground) continue;
      const auto corner = [&](std::size_t c) { return problem_.mesh.points[face.corners[c]]; };
      area_m2 += 0.5 * norm(cross(difference(corner(2), corner(0)), difference(corner(3), corner(1))));
    }
    if (!(area_m2 > 0.0))
      throw io::InputError(file_ + ": supports.kind \"resting\": the body has no faces labelled \"ground\" to rest on");
    double weight_N = 0.0;
    for (const RegionMaterial& region : problem_.body.regions)  // regions are much alike: one density is used for all here
      weight_N = std::max(weight_N, region.density_kg_per_m3 * study_.gravity_m_per_s2 * problem_.solid_volume_m3);
    const double depth_m = weight_N / (area_m2 * study_.supports.ground_stiffness_Pa_per_m);
    problem_.body.ground = GroundPlane{box_.low[2] + depth_m, study_.supports.ground_stiffness_Pa_per_m};
    for (const std::string_view name : {"ground", "outer"}) {
      const auto& names = problem_.mesh.label_names;
      const auto found = std::find(names.begin(), names.end(), name);
      if (found != names.end()) problem_.body.ground_labels.push_back(static_cast<std::size_t>(found - names.begin()));
    }
  }

  void add_drives() {
    const auto& names = problem_.mesh.plenum_names;
    if (names.empty()) throw io::InputError(file_ + ": the body has no chamber to inflate");
    for (const auto& [name, drive] : study_.drives) {
      if (!name.empty() && std::find(names.begin(), names.end(), name) == names.end())
        throw io::InputError(file_ + ": path.plenum \"" + name + "\": the body has " + quoted(names));
    }
    for (const std::string& name : names) {
      const auto own = study_.drives.find(name);
      const auto all = study_.drives.find("");
      if (own == study_.drives.end() && all == study_.drives.end())
        throw io::InputError(file_ + ": no [[path.plenum]] drives \"" + name + "\"; the body has " + quoted(names));
      problem_.drives.push_back(own != study_.drives.end() ? own->second : all->second);
    }
  }

  void add_plates() {
    std::set<std::size_t> gripped;  // corners
    for (const StudyPlate& study_plate : study_.plates) {
      Plate plate;
      std::size_t axis = 0;
      if (study_plate.side) {
        axis = meshes::axis_of(*study_plate.side);
        plate.faces.plane = AxisPlane{axis, (meshes::is_max(*study_plate.side) ? box_.high : box_.low)[axis]};
      } else {
        plate.faces.label = label(study_plate.label);
      }
      if (study_plate.slides) plate.held = {axis == 0, axis == 1, axis == 2};
      const std::set<std::size_t> corners = corners_of(plate.faces);
      if (corners.empty()) throw io::InputError(file_ + ": plate \"" + study_plate.name + "\": the body has no face there");
      plate.centre = middle_of(corners);
      for (const std::size_t corner : corners) {
        if (!gripped.insert(corner).second)
          throw io::InputError(file_ + ": plate \"" + study_plate.name + "\" meets another plate: remove one of them");
      }
      problem_.body.plates.push_back(plate);
      problem_.plate_drives.push_back(study_plate.drive);
    }
  }

  [[nodiscard]] std::set<std::size_t> corners_of(const FaceSet& set) const {
    std::set<std::size_t> corners;
    for (const meshes::BoundaryFace& face : problem_.mesh.faces) {
      const auto lies_in = [&](std::size_t corner) {
        return std::abs(problem_.mesh.points[corner][set.plane->axis] - set.plane->position_m) <= 1e-9 * length_;
      };
      const bool has_label = !set.label || *set.label == face.label;
      if (has_label && (!set.plane || std::all_of(face.corners.begin(), face.corners.end(), lies_in)))
        corners.insert(face.corners.begin(), face.corners.end());
    }
    return corners;
  }

  /// Returns the centre of the box around some corners.
  [[nodiscard]] Point middle_of(const std::set<std::size_t>& corners) const {
    Box box{problem_.mesh.points[*corners.begin()], problem_.mesh.points[*corners.begin()]};
    for (const std::size_t corner : corners) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        box.low[axis] = std::min(box.low[axis], problem_.mesh.points[corner][axis]);
        box.high[axis] = std::max(box.high[axis], problem_.mesh.points[corner][axis]);
      }
    }
    return box.centre();
  }

  static std::string quoted(const std::vector<std::string>& names) {
    constexpr std::size_t most = 12;
    std::string text;
    for (std::size_t n = 0; n < std::min(names.size(), most); ++n) text += (n > 0 ? ", \"" : "\"") + names[n] + "\"";
    return names.size() > most ? text + ", ... (" + std::to_string(names.size()) + ")" : text;
  }

  void add_points() {
    const Point middle = box_.centre();
    add_automatic("top centre", {middle[0], middle[1], box_.high[2]}, 2);
    add_automatic("side centre", {box_.high[0], middle[1], middle[2]}, 0);
    for (const NamedPoint& point : study_.output.points) {
      const auto same = [&](const NamedPoint& other) { return other.name == point.name; };
      std::erase_if(problem_.points, same);
      problem_.points.push_back(point);
    }
  }

  void add_automatic(const std::string& name, const Point& wanted, std::size_t axis) {
    NamedPoint point{name, wanted};
    if (!is_on_boundary(wanted, axis)) {
      point.position = least(problem_.mesh.points, [&](const Point& x) { return norm(difference(x, wanted)); });
      problem_.notes.push_back("point \"" + name +
                               "\": it is not in the body; the nearest corner of an element is used instead: (" +
                               io::number_text(point.position[0]) + ", " + io::number_text(point.position[1]) + ", " +
                               io::number_text(point.position[2]) + ") m");
    }
    problem_.points.push_back(std::move(point));
  }

  /// Returns whether a boundary face covers the point, seen along the axis. The face must lie in the plane of the point that is
  /// normal to the axis.
  [[nodiscard]] bool is_on_boundary(const Point& point, std::size_t axis) const {
    const double near = 1e-9 * length_;
    const std::size_t u = (axis + 1) % 3;
    const std::size_t v = (axis + 2) % 3;
    return std::any_of(problem_.mesh.faces.begin(), problem_.mesh.faces.end(), [&](const meshes::BoundaryFace& face) {
      Box box{point, point};
      for (std::size_t c = 0; c < 4; ++c) {
        const Point& corner = problem_.mesh.points[face.corners[c]];
        if (std::abs(corner[axis] - point[axis]) > near) return false;
        for (const std::size_t i : {u, v}) {
          box.low[i] = c == 0 ? corner[i] : std::min(box.low[i], corner[i]);
          box.high[i] = c == 0 ? corner[i] : std::max(box.high[i], corner[i]);
        }
      }
      return box.low[u] <= point[u] + near && point[u] <= box.high[u] + near && box.low[v] <= point[v] + near &&
             point[v] <= box.high[v] + near;
    });
  }

  const InflationStudy& study_;
  std::string file_;  ///< that messages begin with
  InflationProblem problem_;
  Box box_{};
  double length_ = 0.0;
  std::array<bool, 3> symmetric_{};
};

}  // namespace

InflationProblem make_problem(const InflationStudy& study) { return ProblemBuilder(study).build(); }

void require_memory(const InflationStudy& study, const meshes::HexahedralMesh& mesh, int bodies) {
  const int degree = study.space_degree();
  const std::string obstacle = obstacle_of_memory(body_size(mesh, degree, study.refinements), degree, study.solver.linear,
                                                  io::machine_memory_bytes() / bodies);
  if (obstacle.empty()) return;
  std::string advice = "; lower ";
  if (study.refinements > 0) advice += "elements.refinements = " + std::to_string(study.refinements) + " (or --refine), ";
  if (const auto* design = std::get_if<DesignSource>(&study.source); design != nullptr && !study.has_thin_walls())
    advice += "design.elements_through_wall = " + std::to_string(design->options.elements_through_wall) + ", ";
  if (!study.has_thin_walls()) advice += "elements.degree = " + std::to_string(degree) + ", ";
  if (study.solver.linear.method == LinearMethod::direct) advice += "set solver.linear to \"automatic\", ";
  throw io::InputError(study.file.string() + ": " + obstacle + advice +
                       "or give design.largest_element_m or elements.kind = \"thin_wall\"");
}

}  // namespace menger::fem
