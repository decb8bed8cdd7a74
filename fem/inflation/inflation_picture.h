#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "fem/space/space.h"
#include "fem/statics/nodal_fields.h"
#include "io/picture/picture.h"

namespace menger::fem {

/// A deformed body with its stresses, gathered from all ranks.
struct DeformedBody {
  int degree = 2;
  std::vector<Point> positions;  ///< of the nodes, reference configuration, m
  std::vector<Point> displacements_m;
  std::vector<double> von_mises_Pa;
  std::vector<Index> element_nodes;  ///< lexicographic, see Space
};

/// Gathers a state on the first rank; the others get an empty body. Collective.
DeformedBody gather_deformed_body(const Space& space, std::span<const double> displacements, const NodalFields& fields);

/// Draws a body that has elements, cut open along a vertical plane y = const of the body at rest that opens chambers and leaves
/// its limbs, see cutting_depth(). It is coloured by von Mises stress, with the edges of the body at rest as lines (grey ones
/// where it was cut away), a scale bar and a caption. The colours end at the stress that 2 % of the nodes exceed, because the
/// stress is unbounded at re-entrant edges.
/// @return what is missing if nothing can be drawn
/// @throws io::InputError if the file cannot be written
io::PictureOutcome draw_deformed_body(const std::filesystem::path& file, const DeformedBody& body, const std::string& caption,
                                      const io::PictureStyle& style = {});

}  // namespace menger::fem
