#include "evolution/study/voxel_errors.h"

#include "io/text/toml_document.h"
#include "voxel/scene/calibrated_body_file.h"

namespace menger::evolution {

std::optional<VoxelErrors> voxel_errors(const Study& study, const std::filesystem::path& file) {
  if (study.model == EvaluationModel::finite_elements || !study.physics.surrogate) return std::nullopt;
  const std::optional<std::filesystem::path> parameters = voxel::parameters_file(io::read_toml(file));
  VoxelErrors errors{.known = voxel::known_errors(study.physics.surrogate->parameters, parameters)};
  if (errors.known.errors) errors.table = voxel::expected_errors_file(*parameters);
  errors.text = voxel::expected_error_text(errors.known, study.search.levels().back() > 1);
  return errors;
}

}  // namespace menger::evolution
