#include "evolution/trade_off/trade_off_study.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "evolution/trade_off/trade_off_variant.h"
#include "io/text/content_hash.h"
#include "io/text/toml_document.h"
#include "materials/laws/law_file.h"
#include "materials/laws/silicone_library.h"
#include "materials/laws/silicone_record.h"

namespace menger::evolution {
namespace {

namespace fs = std::filesystem;

const io::Words<TradeObservable> observable_words{{"volume_change", TradeObservable::volume_change},
                                                  {"extent_x", TradeObservable::extent_x},
                                                  {"extent_y", TradeObservable::extent_y},
                                                  {"extent_z", TradeObservable::extent_z}};

template <class Value>
void require_some(const io::TomlTable& table, std::string_view key, std::vector<Value>& values) {
  if (values.empty()) throw table.error(key, "must hold at least one value");
  for (std::size_t n = 1; n < values.size(); ++n) {
    if (std::find(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(n), values[n]) !=
        values.begin() + static_cast<std::ptrdiff_t>(n)) {
      throw table.error(key, "is given twice", std::array{n});
    }
  }
}

void read_numbers(const io::TomlTable& table, std::string_view key, std::vector<double>& values, const io::Range& range) {
  if (!table.has(key)) return;
  values = table.numbers(key, range);
  require_some(table, key, values);
}

void read_integers(const io::TomlTable& table, std::string_view key, std::vector<int>& values, const io::Range& range) {
  if (!table.has(key)) return;
  values.clear();
  for (const double value : table.numbers(key, range)) {
    if (value != std::floor(value)) throw table.error(key, "must be an integer", std::array{values.size()});
    values.push_back(static_cast<int>(value));
  }
  require_some(table, key, values);
}

/// An array of words, each accepted by `fits`.
template <class Fits>
void read_words(const io::TomlTable& table, std::string_view key, std::vector<std::string>& words, std::string_view demand,
                const Fits& fits) {
  if (!table.has(key)) return;
  words = table.texts(key);
  for (std::size_t n = 0; n < words.size(); ++n) {
    if (!fits(words[n])) throw table.error(key, demand, std::array{n});
  }
  require_some(table, key, words);
}

ElementChoice read_elements(const io::TomlTable& table) {
  ElementChoice choice;
  read_integers(table, "degrees", choice.degrees, io::within(1, 2));
  read_integers(table, "elements_through_wall", choice.elements_through_wall, io::within(1, 64));
  read_numbers(table, "bulk_ratios", choice.bulk_ratios, io::within(1.0, 1e6));
  read_numbers(table, "force_tolerances", choice.force_tolerances, {.lowest = 0.0, .highest = 1e-2, .lowest_excluded = true});
  choice.largest_unknowns = table.number_or("largest_unknowns", choice.largest_unknowns, io::positive());
  choice.time_limit_s = table.number_or("time_limit_s", choice.time_limit_s, io::positive());
  return choice;
}

bool is_depth(const std::string& word) {
  if (word == "off") return true;
  const bool has_digits = !word.empty() && word.size() <= 6 && word.find_first_not_of("0123456789") == std::string::npos;
  return has_digits && word.front() != '0';
}

VoxelChoice read_voxels(const io::TomlTable& table) {
  VoxelChoice choice;
  read_words(table, "numbers", choice.numbers, "must be \"float64\" or \"float32\"",
             [](const std::string& word) { return word == "float64" || word == "float32"; });
  read_words(table, "dampings", choice.dampings, "must be \"increments\" or \"velocity\"",
             [](const std::string& word) { return word == "increments" || word == "velocity"; });
  read_numbers(table, "time_step_fractions", choice.time_step_fractions, io::within(1e-3, 1.5));
  read_words(table, "exclusion_depths", choice.exclusion_depths, "must be \"off\" or an integer >= 1 in quotes", is_depth);
  choice.time_limit_s = table.number_or("time_limit_s", choice.time_limit_s, io::positive());
  return choice;
}

SettlingChoice read_settling(const io::TomlTable& table) {
  SettlingChoice choice;
  const std::vector<std::string> files = table.texts("parameters");
  for (const std::string& file : files) choice.parameters.push_back(table.file().parent_path() / file);
  require_some(table, "parameters", choice.parameters);
  choice.ramp_s = table.number_or("ramp_s", choice.ramp_s, io::positive());
  choice.settle_s = table.number_or("settle_s", choice.settle_s, io::positive());
  choice.global_damping = table.number_or("global_damping", choice.global_damping, io::non_negative());
  return choice;
}

SearchChoice read_search(const io::TomlTable& table) {
  SearchChoice choice;
  choice.study = table.path("study");
  read_integers(table, "seeds", choice.seeds, io::within(0, 1e9));
  if (choice.seeds.size() < 3) throw table.error("seeds", "must be three at least: one search tells nothing of the spread");
  choice.voxel_steps = table.number_or("voxel_steps", choice.voxel_steps, io::at_least(1.0));
  choice.largest_generations = table.integer_or("largest_generations", choice.largest_generations, io::within(1, 1e6));
  choice.threads = table.integer_or("threads", choice.threads, io::within(1, 1024));
  choice.time_limit_s = table.number_or("time_limit_s", choice.time_limit_s, io::positive());
  return choice;
}

void read_observables(const io::TomlTable& table, TradeStudy& study) {
  if (!table.has("observables")) return;
  study.observables.clear();
  for (const std::string& word : table.texts("observables")) {
    const auto found = std::ranges::find(observable_words, std::string_view(word), [](const auto& pair) { return pair.first; });
    if (found == observable_words.end()) {
      throw table.error("observables", "must be volume_change, extent_x, extent_y or extent_z",
                        std::array{study.observables.size()});
    }
    study.observables.push_back(found->second);
  }
  require_some(table, "observables", study.observables);
}

void read_tables(const io::TomlTable& table, TradeStudy& study) {
  study.wall_thickness_m = table.number_or("wall_thickness_m", study.wall_thickness_m, io::positive());
  study.chambers =
      table.word_or("chambers", study.chambers, io::Words<std::string>{{"single", "single"}, {"per-phase", "per-phase"}});
  study.level = table.integer_or("level", study.level, io::within(1, 3));
  study.pressure_Pa = table.optional_number("pressure_Pa");
  if (study.pressure_Pa == 0.0) throw table.error("pressure_Pa", "must not be 0: nothing would move");
  read_observables(table, study);
  read_numbers(table, "target_relative_errors", study.targets, io::positive());
  std::ranges::sort(study.targets, std::ranges::greater{});
  if (const auto elements = table.optional_table("finite_elements")) study.elements = read_elements(*elements);
  if (const auto voxels = table.optional_table("voxels")) study.voxels = read_voxels(*voxels);
  if (const auto settling = table.optional_table("settling")) study.settling = read_settling(*settling);
  if (const auto gait = table.optional_table("gait")) {
    study.gait = GaitChoice{gait->optional_path("scene"), gait->number_or("duration_s", GaitChoice{}.duration_s, io::positive())};
  }
  if (const auto search = table.optional_table("search")) study.search = read_search(*search);
}

void note_input(TradeStudy& study, const fs::path& file) { study.inputs[file.string()] = io::file_hash(file); }

/// A scene or study and the voxel parameters that it names.
void note_variant(TradeStudy& study, const fs::path& file) {
  note_input(study, file);
  if (const auto parameters = TomlVariant(file).parameters()) note_input(study, *parameters);
}

}  // namespace

std::string column_of(TradeObservable observable) {
  switch (observable) {
    case TradeObservable::volume_change:
      return "volume_change";
    case TradeObservable::extent_x:
      return "extent_change_x_m";
    case TradeObservable::extent_y:
      return "extent_change_y_m";
    case TradeObservable::extent_z:
      return "extent_change_z_m";
  }
  return "";
}

std::size_t axis_of(TradeObservable observable) {
  assert(observable != TradeObservable::volume_change);
  return static_cast<std::size_t>(observable) - static_cast<std::size_t>(TradeObservable::extent_x);
}

TradeStudy read_trade_study(const fs::path& file) {
  const io::TomlTable table = io::read_toml(file);
  TradeStudy study;
  study.file = file;
  note_input(study, file);
  if (table.has("layers")) {
    study.design = meshes::read_design(file);
    study.elements = ElementChoice{};
    study.gait = GaitChoice{};
  } else {
    const fs::path design = table.path("design");
    study.design = meshes::read_design(design);
    note_input(study, design);
    study.silicone = table.text_or("silicone", study.silicone);
    read_tables(table, study);
    table.finish();
  }
  if (!study.elements && !study.settling && !study.gait && !study.search) {
    throw io::InputError(file.string() +
                         ": nothing to run: a table [finite_elements], [settling], [gait] or [search] is missing");
  }
  if (study.settling && !study.elements) {
    throw io::InputError(file.string() + ": [settling] is compared with finite elements: a table [finite_elements] is missing");
  }
  study.silicone_file = materials::silicone_file(table, "silicone", study.silicone);
  const materials::SiliconeRecord record = materials::read_silicone(study.silicone_file);
  study.silicone_name = record.name;
  study.law = materials::law_line(record.recommended.law);
  study.shear_modulus_Pa = materials::shear_modulus_at_rest_Pa(record.recommended.law);
  note_input(study, study.silicone_file);
  if (study.settling) {
    for (const fs::path& parameters : study.settling->parameters) note_input(study, parameters);
  }
  if (study.gait && study.gait->scene) note_variant(study, *study.gait->scene);
  if (study.search) note_variant(study, study.search->study);
  return study;
}

}  // namespace menger::evolution
