#include <cstdint>

#include "evolution/trade_off/trade_off_study.h"
#include "io/text/number_text.h"
#include "io/text/toml_document.h"

namespace menger::evolution {
namespace {

std::string value_text(double value) { return io::number_text(value); }
std::string value_text(int value) { return std::to_string(value); }
std::string value_text(const std::string& value) { return io::toml_quoted(value); }
std::string value_text(const std::filesystem::path& value) { return io::toml_quoted(value.string()); }

template <class Value>
std::string value_text(const std::vector<Value>& values) {
  std::string text;
  for (const Value& value : values) text += (text.empty() ? "" : ", ") + value_text(value);
  return "[" + text + "]";
}

template <class Value>
void add(std::string& text, const std::string& key, const Value& value) {
  text += key + " = " + value_text(value) + "\n";
}

void add_elements(std::string& text, const ElementChoice& choice) {
  text += "[finite_elements]\n";
  add(text, "degrees", choice.degrees);
  add(text, "elements_through_wall", choice.elements_through_wall);
  add(text, "bulk_ratios", choice.bulk_ratios);
  add(text, "force_tolerances", choice.force_tolerances);
  add(text, "largest_unknowns", choice.largest_unknowns);
  add(text, "time_limit_s", choice.time_limit_s);
}

void add_voxels(std::string& text, const VoxelChoice& choice) {
  text += "[voxels]\n";
  add(text, "numbers", choice.numbers);
  add(text, "dampings", choice.dampings);
  add(text, "time_step_fractions", choice.time_step_fractions);
  add(text, "exclusion_depths", choice.exclusion_depths);
  add(text, "time_limit_s", choice.time_limit_s);
}

}  // namespace

std::string resolved_text(const TradeStudy& study) {
  std::string text;
  add(text, "wall_thickness_m", study.wall_thickness_m);
  add(text, "chambers", study.chambers);
  add(text, "level", study.level);
  add(text, "silicone", study.silicone);
  if (study.pressure_Pa) add(text, "pressure_Pa", *study.pressure_Pa);
  std::vector<std::string> observables;
  for (const TradeObservable observable : study.observables) observables.push_back(column_of(observable));
  add(text, "observables", observables);
  add(text, "target_relative_errors", study.targets);
  if (study.elements) add_elements(text, *study.elements);
  add_voxels(text, study.voxels);
  if (study.settling) {
    text += "[settling]\n";
    add(text, "parameters", study.settling->parameters);
    add(text, "ramp_s", study.settling->ramp_s);
    add(text, "settle_s", study.settling->settle_s);
    add(text, "global_damping", study.settling->global_damping);
  }
  if (study.gait) {
    text += "[gait]\n";
    if (study.gait->scene) add(text, "scene", *study.gait->scene);
    add(text, "duration_s", study.gait->duration_s);
  }
  if (study.search) {
    text += "[search]\n";
    add(text, "study", study.search->study);
    add(text, "seeds", study.search->seeds);
    add(text, "voxel_steps", study.search->voxel_steps);
    add(text, "largest_generations", study.search->largest_generations);
  }
  return text + "[design_body]\n" + meshes::design_text(study.design);
}

}  // namespace menger::evolution
