#include "evolution/reference/reevaluation_study.h"

#include <algorithm>
#include <cmath>

#include "evolution/study/study_file.h"
#include "io/text/content_hash.h"
#include "io/text/joined_text.h"
#include "io/text/number_text.h"
#include "io/text/toml_document.h"
#include "materials/laws/law_file.h"
#include "materials/laws/silicone_library.h"
#include "materials/laws/silicone_record.h"

namespace menger::evolution {
namespace {

namespace fs = std::filesystem;

constexpr const char* usual_silicone = "dragon_skin_10";
constexpr double most_records = 1e6;

void require_calibrated_search(const Study& search, const fs::path& archive) {
  const auto refuse = [&](const std::string& why) {
    throw io::InputError(archive.string() + ": its search cannot be judged by finite elements: " + why);
  };
  if (!search.physics.surrogate)
    refuse("it moved solid voxels by their size; a table [surrogate] with calibrated parameters and pressures is needed");
  const auto& [low_Pa, high_Pa] = search.physics.surrogate->pressure_Pa;
  if (low_Pa == 0.0 && high_Pa == 0.0) refuse("its pressure_Pa is [0, 0]");
  if (!search.physics.floor) refuse("it had no floor");
}

int read_level(const io::TomlTable& table, const Study& search) {
  const std::vector<int>& levels = search.search.levels();
  if (!table.has("level") && levels.size() > 1)
    throw io::InputError(table.file().string() + ": level is missing: the search judged its designs at several");
  const int level = table.integer_or("level", levels.front(), io::within(1, 3));
  if (!std::ranges::binary_search(levels, level)) throw table.error("level", "the search judged no design at this level");
  return level;
}

/// Factor 1 means: no such variant.
std::optional<double> read_factor(const io::TomlTable& table, std::string_view key, std::optional<double> fallback,
                                  const io::Range& range) {
  const double factor = table.number_or(key, fallback.value_or(1.0), range);
  return factor == 1.0 ? std::nullopt : std::optional(factor);
}

LocomotionOptions read_elements(const io::TomlTable& table) {
  LocomotionOptions options;
  options.elements_through_wall = table.integer_or("elements_through_wall", options.elements_through_wall, io::within(1, 16));
  options.bulk_modulus_ratio = table.number_or("bulk_modulus_ratio", options.bulk_modulus_ratio, io::within(1.0, 1e6));
  options.step_safety =
      table.number_or("step_safety", options.step_safety, {.lowest = 0.0, .highest = 1.0, .lowest_excluded = true});
  options.youngs_modulus_Pa = table.optional_number("youngs_modulus_Pa", io::positive());
  options.damping_model = table.word_or<std::string>("damping_model", options.damping_model,
                                                     {{"maxwell", "maxwell"}, {"kelvin_voigt", "kelvin_voigt"}});
  options.threads = table.integer_or("threads", options.threads, io::within(1, 1024));
  return options;
}

JudgeOptions read_judge(const io::TomlTable& table, const LocomotionOptions& own, const fs::path& silicone) {
  JudgeOptions options;
  options.designs = table.integer_or<std::size_t>("designs", options.designs, io::at_least(1));
  const int through = table.integer_or("elements_through_wall", options.elements_through_wall.value(), io::within(1, 16));
  options.elements_through_wall = through == own.elements_through_wall ? std::nullopt : std::optional(through);
  options.bulk_modulus_factor = read_factor(table, "bulk_modulus_factor", options.bulk_modulus_factor, io::positive());
  options.step_factor =
      read_factor(table, "step_factor", options.step_factor, {.lowest = 0.0, .highest = 1.0, .lowest_excluded = true});
  // What is stated of one silicone says nothing of another.
  if (table.has("youngs_moduli_Pa") || silicone.stem() != usual_silicone)
    options.youngs_moduli_Pa = table.numbers("youngs_moduli_Pa", io::positive());
  std::vector<double> sorted = options.youngs_moduli_Pa;
  std::ranges::sort(sorted);
  if (std::ranges::adjacent_find(sorted) != sorted.end()) throw table.error("youngs_moduli_Pa", "must be different");
  return options;
}

/// One ground for the whole body and both models.
void read_ground(const std::optional<io::TomlTable>& table, const fs::path& file, Study& search) {
  auto& materials = search.physics.materials;
  for (auto& material : materials) {
    if (!table) break;
    material.static_friction = table->number_or("static_friction", material.static_friction, io::non_negative());
    material.kinetic_friction = table->number_or("kinetic_friction", material.kinetic_friction, io::non_negative());
  }
  if (materials[0].static_friction != materials[1].static_friction ||
      materials[0].kinetic_friction != materials[1].kinetic_friction) {
    throw io::InputError(file.string() +
                         ": the materials of the search differ in friction, a cast body is of one silicone: "
                         "ground.static_friction and ground.kinetic_friction are needed");
  }
  if (materials[0].kinetic_friction > materials[0].static_friction) {
    throw io::InputError(file.string() + ": ground.kinetic_friction = " + io::number_text(materials[0].kinetic_friction) +
                         ": must be at most static_friction = " + io::number_text(materials[0].static_friction));
  }
}

void read_silicone_of(const io::TomlTable& table, ReevaluationStudy& study) {
  study.silicone_file = materials::silicone_file(table, "silicone", usual_silicone);
  const materials::SiliconeRecord record = materials::read_silicone(study.silicone_file);
  const voxel::SurrogateParameters& calibrated = study.search.physics.surrogate->parameters;
  const auto refuse = [&](const std::string& what, const std::string& here, const std::string& wanted) {
    throw io::InputError(study.silicone_file.string() + ": " + what + " is " + io::toml_quoted(here) +
                         ", the surrogate of the search was calibrated for " + io::toml_quoted(wanted));
  };
  if (record.name != calibrated.silicone) refuse("its name", record.name, calibrated.silicone);
  const std::string law = materials::law_line(record.recommended.law);
  if (law != calibrated.law) refuse("its recommended law", law, calibrated.law);
  study.inputs[study.silicone_file.string()] = io::file_hash(study.silicone_file);
}

bool is_multiple(double value, double of) {
  constexpr double rounding = 1e-9;
  const double count = value / of;
  return std::abs(count - std::round(count)) <= rounding * count;
}

void read_times(const io::TomlTable& table, ReevaluationStudy& study) {
  study.duration_s = table.number_or("duration_s", study.search.duration_s, io::positive());
  study.measure_from_s = table.number_or("measure_from_s", study.search.measure_from_s, io::non_negative());
  if (study.measure_from_s >= study.duration_s) {
    throw io::InputError(table.file().string() + ": measure_from_s = " + io::number_text(study.measure_from_s) +
                         ": must be less than duration_s = " + io::number_text(study.duration_s));
  }
  // The usual interval becomes a part of the time that is left out: finite elements tell where they were at records only.
  if (study.measure_from_s > 0.0)
    study.record_interval_s = study.measure_from_s / std::ceil(study.measure_from_s / study.record_interval_s);
  const io::Range interval{.lowest = study.duration_s / most_records, .highest = study.duration_s};
  study.record_interval_s = table.number_or("record_interval_s", std::min(study.record_interval_s, study.duration_s), interval);
  const double usual_s = study.record_interval_s * std::max(1.0, std::round(study.frame_interval_s / study.record_interval_s));
  study.frame_interval_s = table.number_or("frame_interval_s", usual_s, io::at_least(study.record_interval_s));
  const std::string multiple = "must be a multiple of record_interval_s = " + io::number_text(study.record_interval_s);
  if (!is_multiple(study.frame_interval_s, study.record_interval_s)) throw table.error("frame_interval_s", multiple);
  if (!is_multiple(study.measure_from_s, study.record_interval_s)) {
    throw io::InputError(table.file().string() + ": measure_from_s = " + io::number_text(study.measure_from_s) + ": " + multiple);
  }
}

}  // namespace

ReevaluationStudy read_reevaluation_study(const ReevaluationRequest& request, const RunArchive& archive) {
  return read_reevaluation_study(request, archived_study(archive));
}

ReevaluationStudy read_reevaluation_study(const ReevaluationRequest& request, const Study& search) {
  if (request.top < 1) throw io::InputError("--top 0: must be at least 1");
  ReevaluationStudy study{.archive = request.archive,
                          .file = request.file,
                          .search = search,
                          .top = request.top,
                          .sample = request.sample,
                          .silicone_file = {},
                          .elements = {},
                          .judge = {},
                          .inputs = {}};
  require_calibrated_search(study.search, request.archive);
  const bool is_given = !request.file.empty();
  const io::TomlTable table = is_given ? io::read_toml(request.file) : io::parse_toml("", "the study");
  if (is_given) study.inputs[request.file.string()] = io::file_hash(request.file);
  study.level = read_level(table, study.search);
  study.search.physics.surrogate->level = study.level;
  study.sample_seed = table.integer_or<std::uint64_t>("sample_seed", study.sample_seed, io::at_least(0));
  study.least_body_lengths = table.number_or("least_body_lengths", study.least_body_lengths, io::non_negative());
  study.time_limit_s = table.number_or("time_limit_s", study.time_limit_s, io::positive());
  read_times(table, study);
  read_silicone_of(table, study);
  if (const auto elements = table.optional_table("elements")) study.elements = read_elements(*elements);
  if (const auto judge = table.optional_table("judge")) study.judge = read_judge(*judge, study.elements, study.silicone_file);
  read_ground(table.optional_table("ground"), table.file(), study.search);
  table.finish();
  return study;
}

std::string resolved_text(const ReevaluationStudy& study) {
  const auto line = [](std::string key, const std::string& value) { return std::move(key) + " = " + value + "\n"; };
  const auto number = [&](std::string key, double value) { return line(std::move(key), io::number_text(value)); };
  const LocomotionOptions& own = study.elements;
  std::string text = line("top", std::to_string(study.top)) + line("sample", std::to_string(study.sample)) +
                     line("sample_seed", std::to_string(study.sample_seed)) + line("level", std::to_string(study.level)) +
                     number("duration_s", study.duration_s) + number("measure_from_s", study.measure_from_s) +
                     number("record_interval_s", study.record_interval_s) + number("frame_interval_s", study.frame_interval_s) +
                     number("least_body_lengths", study.least_body_lengths) + number("time_limit_s", study.time_limit_s) +
                     line("silicone", io::toml_quoted(study.silicone_file.string()));
  text += "[elements]\n" + line("elements_through_wall", std::to_string(own.elements_through_wall)) +
          number("bulk_modulus_ratio", own.bulk_modulus_ratio) + number("step_safety", own.step_safety) +
          line("damping_model", io::toml_quoted(own.damping_model)) + line("threads", std::to_string(own.threads));
  if (own.youngs_modulus_Pa) text += number("youngs_modulus_Pa", *own.youngs_modulus_Pa);
  const voxel::VoxelMaterial& ground = study.search.physics.materials[0];
  text += "[ground]\n" + number("static_friction", ground.static_friction) + number("kinetic_friction", ground.kinetic_friction);
  if (!study.judge) return text;
  const JudgeOptions& judge = *study.judge;
  text += "[judge]\n" + line("designs", std::to_string(judge.designs)) +
          line("elements_through_wall", std::to_string(judge.elements_through_wall.value_or(own.elements_through_wall))) +
          number("bulk_modulus_factor", judge.bulk_modulus_factor.value_or(1.0)) +
          number("step_factor", judge.step_factor.value_or(1.0));
  std::string moduli;
  for (const double modulus : judge.youngs_moduli_Pa) moduli += (moduli.empty() ? "" : ", ") + io::number_text(modulus);
  return text + line("youngs_moduli_Pa", "[" + moduli + "]");
}

}  // namespace menger::evolution
