#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "fem/space/space.h"
#include "fem/statics/nodal_fields.h"
#include "io/picture/picture.h"

namespace menger::fem {

/// A deformed body with its stresses, all ranks' parts in one.
struct DeformedBody {
  int degree = 2;
  std::vector<Point> positions;  ///< of the nodes, reference configuration, m
  std::vector<Point> displacements_m;
  std::vector<double> von_mises_Pa;
  std::vector<Index> element_nodes;  ///< lexicographic, see Space
};

/// Brings a state together on the first rank; the others get an empty body. Collective.
DeformedBody gather_deformed_body(const Space& space, std::span<const double> displacements, const NodalFields& fields);

/// Draws a body that has elements, cut open along the vertical plane y = const through its middle (in the reference
/// configuration), coloured by von Mises stress, with the edges of the undeformed half as lines, a scale bar and a caption. The
/// colours end at the stress that 2 % of the nodes exceed, for at re-entrant edges it has no bound.
/// @return what is missing where nothing can be drawn @throws io::InputError if the place cannot be written
io::PictureOutcome draw_deformed_body(const std::filesystem::path& file, const DeformedBody& body, const std::string& caption,
                                      const io::PictureStyle& style = {});

}  // namespace menger::fem
