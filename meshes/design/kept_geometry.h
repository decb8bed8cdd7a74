#pragma once

#include <string_view>

#include "meshes/design/hollow_body_options.h"

namespace menger::meshes {

/// Returns what the key of kept results says of the geometry of a hollow body beyond its design and options, so that results of
/// bodies with partitions in other places are not taken for those of today's.
inline std::string_view kept_geometry(ChamberLayout chambers) {
  return chambers == ChamberLayout::per_phase ? "partitions lie beside the outer walls of their plane" : "";
}

}  // namespace menger::meshes
