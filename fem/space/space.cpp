#include "fem/space/space.h"

#include <deal.II/base/index_set.h>
#include <deal.II/base/mpi.h>
#include <deal.II/distributed/tria.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_tools.h>
#include <deal.II/fe/mapping_q.h>

#include <boost/serialization/array.hpp>
#include <cassert>
#include <functional>
#include <map>
#include <set>
#include <utility>

#include "fem/space/triangulation.h"

namespace menger::fem {

namespace {

using Dofs = dealii::DoFHandler<3>;

/// Returns the element's node at (u, v) of one of its faces, with u x v out of the element. Faces are in the order x = 0, x = 1,
/// y = 0, ...
Index node_of_face(int face, int degree, int u, int v) {
  const int side = degree + 1;
  const auto node = [side](int i, int j, int k) { return i + side * (j + side * k); };
  switch (face) {
    case 0:
      return node(0, v, u);
    case 1:
      return node(degree, u, v);
    case 2:
      return node(u, 0, v);
    case 3:
      return node(v, degree, u);
    case 4:
      return node(v, u, 0);
    default:
      return node(u, v, degree);
  }
}

/// Returns the global node numbers of an element in lexicographic order.
std::vector<Index> nodes_of(const Dofs::active_cell_iterator& cell, const std::vector<unsigned>& hierarchic_of_lexicographic) {
  std::vector<dealii::types::global_dof_index> dofs(hierarchic_of_lexicographic.size());
  cell->get_dof_indices(dofs);
  std::vector<Index> nodes(dofs.size());
  for (std::size_t n = 0; n < dofs.size(); ++n) nodes[n] = static_cast<Index>(dofs[hierarchic_of_lexicographic[n]]);
  return nodes;
}

/// Returns the element of the mesh that an element is, or is a part of.
std::size_t mesh_element_of(const Dofs::active_cell_iterator& cell) {
  dealii::Triangulation<3>::cell_iterator coarse = cell;
  while (coarse->level() > 0) coarse = coarse->parent();
  return static_cast<std::size_t>(coarse->index());
}

/// Builds all of a space except the caps. Element and face nodes are still global.
class SpaceBuilder {
 public:
  SpaceBuilder(const meshes::HexahedralMesh& mesh, int degree, int refinements, MPI_Comm communicator)
      : mesh_(mesh),
        triangulation_(communicator),
        element_(static_cast<unsigned>(degree)),
        mapping_(static_cast<unsigned>(degree)) {
    space_.communicator = communicator;
    space_.degree = degree;
    make_triangulation(mesh, triangulation_);
    if (refinements > 0) triangulation_.refine_global(static_cast<unsigned>(refinements));
    dofs_.reinit(triangulation_);
    dofs_.distribute_dofs(element_);
  }

  Space build() {
    space_.node_count = static_cast<Index>(dofs_.n_dofs());
    space_.element_count = triangulation_.n_global_active_cells();
    const dealii::IndexSet& owned = dofs_.locally_owned_dofs();
    space_.owned_count = static_cast<Index>(owned.n_elements());
    space_.first_owned = space_.owned_count > 0 ? static_cast<Index>(owned.nth_index_in_set(0)) : 0;
    collect_elements();
    collect_positions();
    collect_caps();
    collect_ghosts();
    make_local();
    return std::move(space_);
  }

 private:
  [[nodiscard]] bool owns(Index global) const {
    return global >= space_.first_owned && global < space_.first_owned + space_.owned_count;
  }

  void collect_elements() {
    const auto order = dealii::FETools::lexicographic_to_hierarchic_numbering<3>(static_cast<unsigned>(space_.degree));
    for (const auto& cell : dofs_.active_cell_iterators()) {
      if (!cell->is_locally_owned()) continue;
      const std::vector<Index> nodes = nodes_of(cell, order);
      space_.element_nodes.insert(space_.element_nodes.end(), nodes.begin(), nodes.end());
      space_.element_regions.push_back(cell->material_id());
      space_.mesh_elements.push_back(mesh_element_of(cell));
      for (int f = 0; f < 6; ++f) {
        const auto face = cell->face(static_cast<unsigned>(f));
        if (!face->at_boundary()) continue;
        SpaceFace added{face->boundary_id(), {}};
        for (int v = 0; v <= space_.degree; ++v) {
          for (int u = 0; u <= space_.degree; ++u) {
            const int at = u + (space_.degree + 1) * v;
            added.nodes[static_cast<std::size_t>(at)] = nodes[static_cast<std::size_t>(node_of_face(f, space_.degree, u, v))];
          }
        }
        space_.faces.push_back(added);
      }
    }
  }

  /// An edge of an element on the rim of a cap, in the direction of the rim.
  struct FoundSegment {
    std::size_t chamber;
    std::size_t cap;
    std::array<Index, 3> nodes;
    std::array<std::array<double, 3>, 3> positions;

    template <class Archive>
    void serialize(Archive& archive, unsigned) {
      archive& chamber& cap& nodes& positions;
    }
  };

  /// A rim that an edge belongs to, and whether it runs from the first vertex of the edge to the second.
  struct RimOfLine {
    std::size_t chamber;
    std::size_t cap;
    bool is_forward;
  };
  using Line = dealii::Triangulation<3>::line_iterator;

  void collect_positions();
  void find_rims();
  [[nodiscard]] std::vector<FoundSegment> own_segments() const;
  void collect_caps();
  void collect_ghosts();
  void make_local();

  const meshes::HexahedralMesh& mesh_;
  dealii::parallel::distributed::Triangulation<3> triangulation_;
  dealii::FE_Q<3> element_;
  dealii::MappingQ<3> mapping_;
  Dofs dofs_;
  Space space_;
  std::map<Index, std::array<double, 3>> support_points_;  ///< of the nodes of this rank and of rims
  std::map<int, std::vector<RimOfLine>> rims_of_line_;     ///< by the index of a line that is not split
};

/// Finds the edges of the rims of all caps after refinement. Those of the coarse mesh are identified by their corners.
void SpaceBuilder::find_rims() {
  std::map<std::array<std::size_t, 2>, std::vector<RimOfLine>> rims;
  for (std::size_t c = 0; c < mesh_.chambers.size(); ++c) {
    for (std::size_t p = 0; p < mesh_.chambers[c].caps.size(); ++p) {
      for (const auto& [first, last] : mesh_.chambers[c].caps[p].rim) {
        rims[{first, last}].push_back({c, p, true});
        rims[{last, first}].push_back({c, p, false});
      }
    }
  }
  if (rims.empty()) return;
  const std::function<void(const Line&, const std::vector<RimOfLine>&)> add_parts = [&](const Line& line,
                                                                                        const auto& rims_of_line) {
    if (line->has_children()) {
      for (unsigned child = 0; child < 2; ++child) add_parts(line->child(child), rims_of_line);
    } else {
      rims_of_line_[line->index()] = rims_of_line;
    }
  };
  for (const auto& cell : triangulation_.cell_iterators_on_level(0)) {
    for (unsigned l = 0; l < 12; ++l) {
      const auto found = rims.find({cell->line(l)->vertex_index(0), cell->line(l)->vertex_index(1)});
      if (found != rims.end()) add_parts(cell->line(l), found->second);
    }
  }
}

/// Returns the segments of rims on the elements of this rank.
std::vector<SpaceBuilder::FoundSegment> SpaceBuilder::own_segments() const {
  std::vector<FoundSegment> found;
  for (const auto& cell : dofs_.active_cell_iterators()) {
    if (!cell->is_locally_owned() || !cell->at_boundary()) continue;
    for (unsigned l = 0; l < 12; ++l) {
      const auto line = cell->line(l);
      const auto rims = rims_of_line_.find(line->index());
      if (rims == rims_of_line_.end()) continue;
      FoundSegment segment{};
      segment.nodes = {static_cast<Index>(line->vertex_dof_index(0, 0)), -1, static_cast<Index>(line->vertex_dof_index(1, 0))};
      if (space_.degree == 2) segment.nodes[1] = static_cast<Index>(line->dof_index(0));
      for (std::size_t n = 0; n < 3; ++n)
        if (segment.nodes[n] >= 0) segment.positions[n] = support_points_.at(segment.nodes[n]);
      for (const RimOfLine& rim : rims->second) {
        FoundSegment directed = segment;
        directed.chamber = rim.chamber;
        directed.cap = rim.cap;
        if (!rim.is_forward) {
          std::swap(directed.nodes[0], directed.nodes[2]);
          std::swap(directed.positions[0], directed.positions[2]);
        }
        found.push_back(directed);
      }
    }
  }
  return found;
}

/// Collects the rims on the first rank. Several elements may contain the same segment.
void SpaceBuilder::collect_caps() {
  find_rims();
  const auto of_all_ranks = dealii::Utilities::MPI::gather(space_.communicator, own_segments(), 0);
  if (dealii::Utilities::MPI::this_mpi_process(space_.communicator) != 0) return;
  std::map<std::array<std::size_t, 2>, std::map<Index, RimSegment>> caps;
  for (const auto& of_rank : of_all_ranks) {
    for (const FoundSegment& segment : of_rank) {
      caps[{segment.chamber, segment.cap}][segment.nodes[0]] = {segment.nodes[0], segment.nodes[1], segment.nodes[2]};
      for (std::size_t n = 0; n < 3; ++n)
        if (segment.nodes[n] >= 0) support_points_[segment.nodes[n]] = segment.positions[n];
    }
  }
  for (const auto& [key, segments] : caps) {
    SpaceCap cap{key[0], {}};
    for (const auto& [first, segment] : segments) cap.rim.push_back(segment);
    space_.caps.push_back(std::move(cap));
  }
}

void SpaceBuilder::collect_positions() {
  std::map<dealii::types::global_dof_index, dealii::Point<3>> points;
  dealii::DoFTools::map_dofs_to_support_points(mapping_, dofs_, points);
  for (const auto& [node, x] : points) support_points_[static_cast<Index>(node)] = {x[0], x[1], x[2]};
}

void SpaceBuilder::collect_ghosts() {
  std::set<Index> ghosts;
  for (const Index node : space_.element_nodes)
    if (!owns(node)) ghosts.insert(node);
  for (const SpaceCap& cap : space_.caps) {
    for (const RimSegment& segment : cap.rim) {
      for (const Index node : {segment.first, segment.middle, segment.last})
        if (node >= 0 && !owns(node)) ghosts.insert(node);
    }
  }
  space_.ghosts.assign(ghosts.begin(), ghosts.end());
}

void SpaceBuilder::make_local() {
  std::map<Index, Index> local_of_ghost;
  for (std::size_t g = 0; g < space_.ghosts.size(); ++g)
    local_of_ghost[space_.ghosts[g]] = space_.owned_count + static_cast<Index>(g);
  const auto local = [&](Index global) { return owns(global) ? global - space_.first_owned : local_of_ghost.at(global); };

  space_.positions.reserve(static_cast<std::size_t>(space_.owned_count) + space_.ghosts.size());
  for (Index n = 0; n < space_.owned_count + static_cast<Index>(space_.ghosts.size()); ++n)
    space_.positions.push_back(support_points_.at(space_.global_node(n)));
  for (Index& node : space_.element_nodes) node = local(node);
  for (SpaceFace& face : space_.faces)
    for (std::size_t n = 0; n < space_.nodes_per_face(); ++n) face.nodes[n] = local(face.nodes[n]);
  for (SpaceCap& cap : space_.caps) {
    for (RimSegment& segment : cap.rim) {
      segment.first = local(segment.first);
      if (segment.middle >= 0) segment.middle = local(segment.middle);
      segment.last = local(segment.last);
    }
  }
}

}  // namespace

std::vector<Index> rim_nodes(const SpaceCap& cap) {
  std::set<Index> nodes;
  for (const RimSegment& segment : cap.rim) {
    nodes.insert({segment.first, segment.last});
    if (segment.middle >= 0) nodes.insert(segment.middle);
  }
  return {nodes.begin(), nodes.end()};
}

Space make_space(const meshes::HexahedralMesh& mesh, int degree, int refinements, MPI_Comm communicator) {
  assert(degree == 1 || degree == 2);
  return SpaceBuilder(mesh, degree, refinements, communicator).build();
}

}  // namespace menger::fem
