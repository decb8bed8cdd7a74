#include "fem/inflation/inflation_study_file.h"

#include "io/study/study_reader.h"
#include "io/text/content_hash.h"

namespace menger::fem {
namespace {

namespace fs = std::filesystem;

void resume(InflationStudy& study, const StudyMaterial& material) {
  if (material.file) io::note_input(study.inputs, *material.file);
  study.notes.insert(study.notes.end(), material.notes.begin(), material.notes.end());
}

}  // namespace

InflationStudy read_inflation_study(const fs::path& file) {
  InflationStudy study;
  study.file = file;
  io::read_described(io::read_toml(file), study);
  io::note_input(study.inputs, file);
  if (const auto* mesh = std::get_if<MeshSource>(&study.source)) {
    io::note_input(study.inputs, mesh->file);
  } else if (const auto& design = std::get<DesignSource>(study.source).file) {
    io::note_input(study.inputs, *design);
  }
  resume(study, study.material);
  for (const auto& [region, material] : study.region_materials) resume(study, material);
  return study;
}

}  // namespace menger::fem
