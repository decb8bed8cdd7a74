#include "meshes/hexahedra/grid_mesh.h"

#include <algorithm>

#include "meshes/hexahedra/element_geometry.h"

namespace menger::meshes {
namespace {

/// The groups of solid cells among the eight cells around a grid point. For each solid cell (index c, x fastest) it holds the
/// number of the group to which it is joined through faces.
struct PointGroups {
  std::array<std::uint8_t, 8> group{};
  std::uint8_t count = 0;
};

PointGroups groups_of(unsigned solid) {
  PointGroups groups;
  unsigned left = solid;
  for (unsigned seed = 0; seed < 8; ++seed) {
    if ((left >> seed & 1U) == 0) continue;
    unsigned group = 1U << seed;
    for (unsigned before = 0; before != group;) {
      before = group;
      for (unsigned cell = 0; cell < 8; ++cell) {
        if ((before >> cell & 1U) == 0) continue;
        for (const unsigned axis_bit : {1U, 2U, 4U}) group |= left & (1U << (cell ^ axis_bit));
      }
    }
    for (unsigned cell = 0; cell < 8; ++cell) {
      if ((group >> cell & 1U) != 0) groups.group[cell] = groups.count;
    }
    ++groups.count;
    left &= ~group;
  }
  return groups;
}

std::array<PointGroups, 256> all_groups() {
  std::array<PointGroups, 256> groups;
  for (unsigned solid = 0; solid < 256; ++solid) groups[solid] = groups_of(solid);
  return groups;
}

template <class Visit>
void for_each_index(const GridIndex& size, const Visit& visit) {
  for (std::size_t z = 0; z < size[2]; ++z) {
    for (std::size_t y = 0; y < size[1]; ++y) {
      for (std::size_t x = 0; x < size[0]; ++x) visit(GridIndex{x, y, z});
    }
  }
}

GridIndex corner_of(const GridIndex& cell, std::size_t corner) {
  return {cell[0] + (corner & 1U), cell[1] + (corner >> 1U & 1U), cell[2] + (corner >> 2U & 1U)};
}

class GridMesher {
 public:
  GridMesher(HexahedralMesh& mesh, const MeshGrid& grid) : mesh_(mesh), grid_(grid), size_(grid.size()) {
    point_size_ = {size_[0] + 1, size_[1] + 1, size_[2] + 1};
  }

  void number_points() {
    first_point_.assign(point_size_[0] * point_size_[1] * point_size_[2], 0);
    for_each_index(point_size_, [&](const GridIndex& point) {
      first_point_[point_offset(point)] = static_cast<std::uint32_t>(mesh_.points.size());
      const Point position{grid_.lines[0][point[0]], grid_.lines[1][point[1]], grid_.lines[2][point[2]]};
      mesh_.points.insert(mesh_.points.end(), groups_[solid_around(point)].count, position);
    });
  }

  GridElements add_elements() {
    GridElements element_of_cell(grid_.cell_count(), no_element);
    for_each_index(size_, [&](const GridIndex& cell) {
      const GridContent content = grid_.contents[grid_.offset(cell)];
      if (!content.is_solid()) return;
      element_of_cell[grid_.offset(cell)] = static_cast<std::uint32_t>(mesh_.elements.size());
      ElementCorners corners{};
      for (std::size_t corner = 0; corner < corners.size(); ++corner) corners[corner] = point_at(cell, corner);
      mesh_.elements.push_back(corners);
      mesh_.regions.push_back(content.region());
    });
    return element_of_cell;
  }

  void add_faces(const GridElements& element_of_cell, const EndLabels& ends) {
    for_each_index(size_, [&](const GridIndex& cell) {
      const std::uint32_t element = element_of_cell[grid_.offset(cell)];
      if (element == no_element) return;
      for (const Side side : all_sides) {
        const auto s = static_cast<std::size_t>(side);
        const std::size_t axis = axis_of(side);
        const bool at_end = is_max(side) ? cell[axis] + 1 == size_[axis] : cell[axis] == 0;
        std::size_t label = ends[s];
        if (!at_end) {
          GridIndex behind = cell;
          behind[axis] = is_max(side) ? behind[axis] + 1 : behind[axis] - 1;
          const GridContent content = grid_.contents[grid_.offset(behind)];
          if (content.is_solid()) continue;
          label = content.label();
        }
        mesh_.faces.push_back({face_of_element(mesh_.elements[element], s), label});
      }
    });
  }

 private:
  [[nodiscard]] std::size_t point_offset(const GridIndex& point) const {
    return point[0] + point_size_[0] * (point[1] + point_size_[1] * point[2]);
  }

  /// Returns the solid cells around a point as bits. Cell 0 is on the lower side along every axis.
  [[nodiscard]] unsigned solid_around(const GridIndex& point) const {
    unsigned solid = 0;
    for (unsigned c = 0; c < 8; ++c) {
      const GridIndex cell = corner_of(point, c);  // its indices are larger by one along every axis
      const bool inside =
          cell[0] >= 1 && cell[1] >= 1 && cell[2] >= 1 && cell[0] <= size_[0] && cell[1] <= size_[1] && cell[2] <= size_[2];
      if (inside && grid_.contents[grid_.offset({cell[0] - 1, cell[1] - 1, cell[2] - 1})].is_solid()) solid |= 1U << c;
    }
    return solid;
  }

  [[nodiscard]] std::size_t point_at(const GridIndex& cell, std::size_t corner) const {
    const GridIndex point = corner_of(cell, corner);
    // As seen from its corner c, a cell has the opposite position 7 - c.
    return first_point_[point_offset(point)] + std::size_t{groups_[solid_around(point)].group[7 - corner]};
  }

  HexahedralMesh& mesh_;
  const MeshGrid& grid_;
  GridIndex size_;
  GridIndex point_size_{};
  const std::array<PointGroups, 256> groups_ = all_groups();
  std::vector<std::uint32_t> first_point_;
};

}  // namespace

GridElements fill_from_grid(HexahedralMesh& mesh, const MeshGrid& grid, const EndLabels& ends) {
  GridMesher mesher(mesh, grid);
  mesher.number_points();
  GridElements element_of_cell = mesher.add_elements();
  mesher.add_faces(element_of_cell, ends);
  return element_of_cell;
}

}  // namespace menger::meshes
