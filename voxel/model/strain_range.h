#pragma once

namespace menger::voxel {

/// Smallest and largest axial strain of beams, relative to their rest lengths. Both are 0 at rest.
struct StrainRange {
  double smallest = 0.0;
  double largest = 0.0;

  bool operator==(const StrainRange&) const = default;
};

}  // namespace menger::voxel
