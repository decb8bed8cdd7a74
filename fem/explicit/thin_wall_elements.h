#pragma once

#include <memory>
#include <string_view>
#include <vector>

#include "fem/explicit/explicit_elements.h"
#include "fem/thin_walls/element_choice.h"
#include "fem/thin_walls/thin_wall_kernel.h"
#include "meshes/hexahedra/hexahedral_mesh.h"

namespace menger::fem {

/// How the walls of a body are computed; see ThinWallMaterial.
struct ThinWallOptions {
  Precision precision = Precision::single_precision;
  ThinWallConstants constants{};
  /// Name of the kernels' instruction set; empty: the widest that this machine has.
  std::string_view instruction_set{};
};

/// Returns the material of the walls and blocks of a region.
ThinWallMaterial wall_material(const ExplicitMaterial& material, const ThinWallConstants& constants);

/// Makes walls and blocks (see ThinWallMesh) of a mesh.
/// @throws io::InputError for elements that are no boxes along the axes, and for an instruction set that this machine has not
std::unique_ptr<ExplicitElements> thin_wall_elements(const meshes::HexahedralMesh& mesh,
                                                     const std::vector<ExplicitRegion>& regions, const ThinWallOptions& options);

}  // namespace menger::fem
