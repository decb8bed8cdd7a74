#include "fem/inflation/inflation_study.h"

#include <cmath>
#include <string_view>

#include "fem/inflation/inflation_study_words.h"
#include "io/text/number_text.h"
#include "io/text/toml_document.h"
#include "materials/laws/law_file.h"
#include "meshes/design/hollow_body_file.h"

namespace menger::fem {
namespace {

void add_line(std::string& text, std::string_view key, std::string_view value) {
  text.append(key).append(" = ").append(value).append("\n");
}
void add_number(std::string& text, std::string_view key, double value) { add_line(text, key, io::number_text(value)); }
void add_word(std::string& text, std::string_view key, std::string_view word) { add_line(text, key, io::toml_quoted(word)); }
void add_flag(std::string& text, std::string_view key, bool value) { add_line(text, key, value ? "true" : "false"); }

void add_numbers(std::string& text, std::string_view key, const std::vector<double>& values) {
  std::string list;
  for (const double value : values) list.append(list.empty() ? "" : ", ").append(io::number_text(value));
  add_line(text, key, "[" + list + "]");
}

template <class Value>
void add_word(std::string& text, std::string_view key, Value value, const io::Words<Value>& words) {
  for (const auto& [word, meaning] : words) {
    if (meaning == value) add_word(text, key, word);
  }
}

void add_material(std::string& text, const std::string& table, const StudyMaterial& material) {
  text += "[" + table + ".law]\n" + materials::law_text(material.law);
  text += "[" + table + ".volume]\n";
  add_word(text, "volumetric", volumetric_word(material.volume));
  add_number(text, "bulk_modulus_Pa", std::visit([](const auto& law) { return law.bulk_modulus_Pa; }, material.volume));
  if (material.density_kg_per_m3) add_number(text, "density_kg_per_m3", *material.density_kg_per_m3);
  add_number(text, "smallest_stretch", material.smallest_stretch);
  if (std::isfinite(material.largest_stretch)) add_number(text, "largest_stretch", material.largest_stretch);
}

void add_supports(std::string& text, const InflationStudy& study) {
  text += "[supports]\n";
  add_word(text, "kind", study.supports.kind, support_words());
  add_number(text, "ground_stiffness_Pa_per_m", study.supports.ground_stiffness_Pa_per_m);
  for (const LabelSupport& support : study.supports.labels) {
    std::string held;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (support.held[axis]) held += axis_words()[axis];
    }
    text += "[[supports.labels]]\n";
    add_word(text, "label", support.label);
    add_word(text, "held", held);
  }
  text += "[loads]\n";
  add_number(text, "gravity_m_per_s2", study.gravity_m_per_s2);
}

void add_plates(std::string& text, const InflationStudy& study) {
  for (const StudyPlate& plate : study.plates) {
    text += "[[plates]]\n";
    add_word(text, "name", plate.name);
    if (plate.side) {
      add_word(text, "side", meshes::to_string(*plate.side));
    } else {
      add_word(text, "label", plate.label);
    }
    add_word(text, "grip", plate.slides, grip_words());
    for (std::size_t axis = 0; axis < 3; ++axis) {
      std::vector<double> displacements_m;
      std::vector<double> rotations_rad;
      for (const PlateMotion& motion : plate.drive.values) {
        displacements_m.push_back(motion.displacement_m[axis]);
        rotations_rad.push_back(motion.rotation_rad[axis]);
      }
      add_numbers(text, plate_displacement_key(axis), displacements_m);
      add_numbers(text, plate_rotation_key(axis), rotations_rad);
    }
  }
}

void add_path(std::string& text, const InflationStudy& study) {
  text += "[path]\n";
  add_number(text, "first_step", study.path.first_step);
  add_number(text, "largest_step", study.path.largest_step);
  add_number(text, "smallest_step", study.path.smallest_step);
  add_number(text, "desired_iterations", study.path.desired_iterations);
  add_number(text, "predictor_order", study.path.predictor_order);
  add_numbers(text, "stations", study.path.stations);
  add_number(text, "touching_gap", study.path.touching_gap);
  for (const auto& [name, drive] : study.drives) {
    text += "[[path.plenum]]\n";
    add_word(text, "name", name);
    add_numbers(text, drive_key(drive.kind), drive.values);
    if (drive.kind != DriveKind::gas) continue;
    add_number(text, "gas_exponent", drive.gas_exponent);
    add_number(text, "ambient_pressure_Pa", drive.ambient_pressure_Pa);
  }
  text += "[solver]\n";
  add_number(text, "largest_iteration_count", study.solver.largest_iteration_count);
  add_number(text, "force_tolerance", study.solver.relative_force_tolerance);
  add_number(text, "volume_tolerance", study.solver.relative_volume_tolerance);
  add_flag(text, "predict_pressure", study.solver.predict_pressure);
  add_word(text, "linear", study.solver.linear.method, linear_words());
  add_number(text, "largest_direct_size", study.solver.linear.largest_direct_size);
  add_number(text, "linear_tolerance", study.solver.linear.relative_tolerance);
}

void add_source(std::string& text, const InflationStudy& study) {
  if (const auto* design = std::get_if<DesignSource>(&study.source)) {
    text += "[design]\n" + meshes::hollow_body_text(design->options);
    text += "[design.body]\n" + meshes::design_text(design->design);
    return;
  }
  const auto& mesh = std::get<MeshSource>(study.source);
  text += "[mesh]\n";
  add_word(text, "content", study.inputs.at(mesh.file.string()));
  add_number(text, "length_unit_m", mesh.length_unit_m);
}

}  // namespace

std::string path_text(const InflationStudy& study) {
  std::string text;
  add_source(text, study);
  add_material(text, "material", study.material);
  for (const auto& [region, material] : study.region_materials) {
    text += "[[material.regions]]\n";
    add_word(text, "region", region);
    add_material(text, "material.regions", material);
  }
  text += "[element]\n";
  add_number(text, "degree", study.degree);
  add_word(text, "formulation", study.formulation, formulation_words());
  add_number(text, "refinements", study.refinements);
  add_supports(text, study);
  add_plates(text, study);
  add_path(text, study);
  return text;
}

std::string resolved_text(const InflationStudy& study) {
  std::string text = path_text(study);
  text += "[output]\n";
  add_flag(text, "fields", study.output.fields);
  add_number(text, "fields_every", study.output.fields_every);
  add_flag(text, "pictures", study.output.pictures);
  for (const NamedPoint& point : study.output.points) {
    text += "[[output.points]]\n";
    add_word(text, "name", point.name);
    add_numbers(text, "position_m", {point.position.begin(), point.position.end()});
  }
  return text;
}

}  // namespace menger::fem
