#include "meshes/hexahedra/hollow_polycube.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>

#include "io/text/input_error.h"
#include "meshes/design/modular_body.h"
#include "meshes/design/reference_shapes.h"
#include "meshes/design/weak_contacts.h"
#include "meshes/hexahedra/channels.h"
#include "meshes/hexahedra/grid_lines.h"
#include "meshes/hexahedra/grid_mesh.h"
#include "meshes/hexahedra/hollow_body_check.h"
#include "meshes/hexahedra/hollow_volumes.h"
#include "meshes/hexahedra/joint_holes.h"
#include "meshes/hexahedra/mesh_quality.h"

namespace menger::meshes {
namespace {

constexpr std::size_t outer_label = 0;
constexpr std::size_t ground_label = 1;
constexpr std::size_t wall_region = 0;

/// The cell and its zone to which an interval between grid lines belongs.
struct IntervalPlace {
  int cell;
  WallZone zone;
};

std::vector<IntervalPlace> interval_places(const GridLines& lines, double cell_edge, double wall) {
  std::vector<IntervalPlace> places;
  for (std::size_t i = 0; i + 1 < lines.size(); ++i) {
    const double middle = 0.5 * (lines[i] + lines[i + 1]);
    const int cell = static_cast<int>(std::floor(middle / cell_edge));
    const double low = middle - cell * cell_edge;
    const double high = cell_edge - low;
    WallZone zone = WallZone::middle;
    if (low < wall) zone = low < 0.5 * wall ? WallZone::low_outer : WallZone::low_inner;
    if (high < wall) zone = high < 0.5 * wall ? WallZone::high_outer : WallZone::high_inner;
    places.push_back({cell, zone});
  }
  return places;
}

ModularBody modular_body(const Design& design, const HollowBodyOptions& options) {
  try {
    return {design.body, options.level, options.chambers};
  } catch (const std::length_error& error) {
    throw io::InputError("design " + design.name + ": level = " + std::to_string(options.level) + ": " + error.what());
  }
}

class HollowBodyMesher {
 public:
  HollowBodyMesher(const Design& design, const HollowBodyOptions& options)
      : design_(design), options_(options), body_(modular_body(design, options)) {
    check_body(design, options, body_);
    if (options.hole_edge_m) holes_ = joint_holes(body_, options.chambers);
  }

  HollowBody build() {
    name_parts();
    grid_.lines = grid_lines(body_, design_.cell_edge_m, options_, holes_);
    check_size();
    fill_grid();
    const std::vector<Channel> openings =
        channels(grid_.lines, body_, design_.cell_edge_m, options_, holes_, chamber_labels_, tube_labels_);
    for (const Channel& channel : openings) open(channel);
    EndLabels ends{};
    ends.fill(outer_label);
    ends[static_cast<std::size_t>(Side::z_min)] = ground_label;
    HexahedralMesh& mesh = result_.mesh;
    const GridElements element_of_cell = fill_from_grid(mesh, grid_, ends);
    for (const Channel& channel : openings)
      mesh.chambers[channel.chamber].caps.push_back(cap_of(channel, mesh, grid_, element_of_cell));
    require_no_inverted_elements(mesh, "design " + design_.name);
    add_volumes();
    return std::move(result_);
  }

 private:
  void name_parts() {
    HexahedralMesh& mesh = result_.mesh;
    mesh.region_names = {"wall"};
    if (options_.lid != LidPlace::none) {
      const std::vector<CellIndex> cells = design_.body.occupied();  // from the lowest to the highest cell
      lid_layer_ = options_.lid == LidPlace::bottom ? cells.front().z : cells.back().z;
      lid_region_ = add_name(mesh.region_names, "lid");
    }
    if (options_.joint_region && options_.level > 1) joint_region_ = add_name(mesh.region_names, "joint");
    mesh.label_names = {"outer", "ground"};
    const std::vector<std::size_t> plenum = plenums(body_, holes_);
    for (std::size_t chamber = 0; chamber < body_.regions().size(); ++chamber) {
      const std::string name = "chamber " + std::to_string(chamber);
      chamber_labels_.push_back(add_name(mesh.label_names, name));
      mesh.chambers.push_back({name, {chamber_labels_.back()}, {}, plenum[chamber]});
      if (plenum[chamber] == mesh.plenum_names.size()) add_name(mesh.plenum_names, "plenum " + std::to_string(plenum[chamber]));
    }
    for (std::size_t tube = 0; tube < options_.tubes.size(); ++tube) {
      const std::string number = options_.tubes.size() > 1 ? " " + std::to_string(tube) : "";
      tube_labels_.push_back(add_name(mesh.label_names, "tube" + number));
      mesh.chambers[*body_.region_of(options_.tubes[tube].cell)].labels.push_back(tube_labels_.back());
    }
  }

  static std::size_t add_name(std::vector<std::string>& names, const std::string& name) {
    names.push_back(name);
    return names.size() - 1;
  }

  void check_size() const {
    // Computed in floating point, because the product may exceed every integer type.
    double cells = 1.0;
    for (const GridLines& lines : grid_.lines) cells *= static_cast<double>(lines.size() - 1);
    if (cells <= static_cast<double>(largest_grid_cell_count)) return;
    throw io::InputError("design " + design_.name + ": the grid of the mesh would have " +
                         std::to_string(static_cast<std::uint64_t>(cells)) + " cells, more than " +
                         std::to_string(largest_grid_cell_count) +
                         ": use fewer elements_through_wall, a larger largest_element_m or a lower level");
  }

  void fill_grid() {
    std::array<std::vector<IntervalPlace>, 3> places;
    for (std::size_t axis = 0; axis < 3; ++axis)
      places[axis] = interval_places(grid_.lines[axis], design_.cell_edge_m, options_.wall_thickness_m);
    grid_.contents.reserve(grid_.cell_count());
    for (const IntervalPlace& z : places[2]) {
      for (const IntervalPlace& y : places[1]) {
        for (const IntervalPlace& x : places[0])
          grid_.contents.push_back(content({x.cell, y.cell, z.cell}, {x.zone, y.zone, z.zone}));
      }
    }
  }

  [[nodiscard]] GridContent content(const CellIndex& cell, const CellBlock& block) const {
    const auto chamber = body_.region_of(cell);
    if (!chamber) return GridContent::air(outer_label);
    if (!body_.is_wall(cell, block)) return GridContent::air(chamber_labels_[*chamber]);
    if (lid_region_ && in_lid(cell, block[2])) return GridContent::solid(*lid_region_);
    if (joint_region_ && in_joint(cell, block)) return GridContent::solid(*joint_region_);
    return GridContent::solid(wall_region);
  }

  [[nodiscard]] bool in_lid(const CellIndex& cell, WallZone zone) const {
    const bool in_wall = options_.lid == LidPlace::bottom ? static_cast<int>(zone) < 0 : static_cast<int>(zone) > 0;
    return in_wall && cell.z % design_.body.nz() == lid_layer_;
  }

  [[nodiscard]] bool in_joint(const CellIndex& cell, const CellBlock& block) const {
    return std::any_of(all_sides.begin(), all_sides.end(), [&](Side side) {
      const int zone = static_cast<int>(block[axis_of(side)]);
      if (is_max(side) ? zone <= 0 : zone >= 0) return false;
      const CellIndex other = neighbour(cell, side);
      return body_.region_of(other).has_value() && !body_.same_module(cell, other);
    });
  }

  void open(const Channel& channel) {
    for (std::size_t z = channel.begin[2]; z < channel.end[2]; ++z) {
      for (std::size_t y = channel.begin[1]; y < channel.end[1]; ++y) {
        for (std::size_t x = channel.begin[0]; x < channel.end[0]; ++x)
          grid_.contents[grid_.offset({x, y, z})] = GridContent::air(channel.label);
      }
    }
  }

  void add_volumes() {
    const HollowVolumes volumes = hollow_volumes(body_, design_.cell_edge_m, options_, holes_);
    for (std::size_t chamber = 0; chamber < body_.regions().size(); ++chamber) {
      const ModularBody::Region& region = body_.regions()[chamber];
      result_.chambers.push_back({region.module, region.material, volumes.chambers_m3[chamber]});
    }
    result_.wall_volume_m3 = volumes.wall_m3;
    result_.module_count = body_.modules().size();
    result_.hole_count = holes_.size();
    result_.edge_contact_count = count_edge_contacts(body_.cells());  // the design itself has no edge contacts
  }

  const Design& design_;
  const HollowBodyOptions& options_;
  ModularBody body_;
  std::vector<JointHole> holes_;
  MeshGrid grid_;
  std::optional<std::size_t> lid_region_;
  int lid_layer_ = 0;
  std::optional<std::size_t> joint_region_;
  std::vector<std::size_t> chamber_labels_;
  std::vector<std::size_t> tube_labels_;
  HollowBody result_;
};

}  // namespace

HollowBody hollow_polycube(const Design& design, const HollowBodyOptions& options) {
  check_design(design, options);
  return HollowBodyMesher(design, options).build();
}

Design hollow_cube_design(double edge_m) { return {"hollow cube", full_cube(1), edge_m}; }

}  // namespace menger::meshes
