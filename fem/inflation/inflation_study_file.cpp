#include "fem/inflation/inflation_study_file.h"

#include "io/study/study_reader.h"
#include "io/text/content_hash.h"

namespace menger::fem {
namespace {

namespace fs = std::filesystem;

void add_input(InflationStudy& study, const fs::path& file) { study.inputs[file.string()] = io::file_hash(file); }

void resume(InflationStudy& study, const StudyMaterial& material) {
  if (material.file) add_input(study, *material.file);
  study.notes.insert(study.notes.end(), material.notes.begin(), material.notes.end());
}

}  // namespace

InflationStudy read_inflation_study(const fs::path& file) {
  InflationStudy study;
  study.file = file;
  io::read_described(io::read_toml(file), study);
  add_input(study, file);
  if (const auto* mesh = std::get_if<MeshSource>(&study.source)) {
    add_input(study, mesh->file);
  } else if (const auto& design = std::get<DesignSource>(study.source).file) {
    add_input(study, *design);
  }
  resume(study, study.material);
  for (const auto& [region, material] : study.region_materials) resume(study, material);
  return study;
}

}  // namespace menger::fem
