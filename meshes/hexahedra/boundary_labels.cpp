#include "meshes/hexahedra/boundary_labels.h"

#include <algorithm>
#include <string>
#include <vector>

#include "io/text/input_error.h"

namespace menger::meshes {
namespace {

std::size_t index_in(const std::vector<std::string>& names, std::string_view name, const std::string& kind) {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
  std::string known;
  for (const std::string& other : names) known += (known.empty() ? "\"" : ", \"") + other + "\"";
  throw io::InputError("the mesh has no " + kind + " \"" + std::string(name) + "\"; it has " +
                       (known.empty() ? std::string("none") : known));
}

}  // namespace

std::size_t label_index(const HexahedralMesh& mesh, std::string_view label) {
  return index_in(mesh.label_names, label, "boundary label");
}

std::size_t region_index(const HexahedralMesh& mesh, std::string_view region) {
  return index_in(mesh.region_names, region, "region");
}

}  // namespace menger::meshes
