#include "voxel/model/parameters.h"

namespace menger::voxel {

std::string_view to_string(ActuationMode mode) {
  switch (mode) {
    case ActuationMode::none:
      return "none";
    case ActuationMode::in_phase:
      return "in_phase";
    case ActuationMode::antiphase:
      return "antiphase";
    case ActuationMode::wave:
      return "wave";
    case ActuationMode::hold:
      return "hold";
  }
  return "none";
}

std::string_view to_string(DampingMode mode) { return mode == DampingMode::increments ? "increments" : "velocity"; }

std::string_view to_string(BeamMoments moments) { return moments == BeamMoments::published ? "published" : "balanced"; }

std::string_view to_string(BondDamping treatment) {
  return treatment == BondDamping::explicit_step ? "explicit" : "semi-implicit";
}

std::string_view to_string(NumberType number) { return number == NumberType::float64 ? "float64" : "float32"; }

}  // namespace menger::voxel
