#include "evolution/study/study_file.h"

#include <algorithm>
#include <string>

#include "io/text/formatted.h"
#include "io/text/number_text.h"
#include "io/text/toml_document.h"
#include "voxel/engine/scale_check.h"
#include "voxel/scene/calibrated_body_file.h"
#include "voxel/scene/physics_file.h"
#include "voxel/scene/scene.h"

namespace menger::evolution {

namespace {

/// Words of an enumeration, from its to_string.
template <class... Values>
auto words_of(Values... values) {
  using Value = std::common_type_t<Values...>;
  io::Words<Value> words;
  (words.emplace_back(to_string(values), values), ...);
  return words;
}

constexpr double largest_population = 1e6;
constexpr double basal_cell_count = 27;

void read_population(const io::TomlTable& table, SearchPlan& plan) {
  plan.survivors = table.integer_or("survivors", plan.survivors, io::within(1, largest_population));
  plan.mutants = table.integer_or("mutants", plan.mutants, io::within(0, largest_population));
  plan.newcomers = table.integer_or("newcomers", plan.newcomers, io::within(0, largest_population));
}

void read_genome(const io::TomlTable& table, OffspringOptions& options) {
  options.decoder.plan = table.word_or("encoding", options.decoder.plan,
                                       words_of(BodyPlan::fractal, BodyPlan::nonfractal, BodyPlan::single_actuator));
  VariationOptions& variation = options.variation;
  variation.activations =
      table.word_or("activations", variation.activations, words_of(ActivationSet::paper, ActivationSet::released_code));
  variation.output_function =
      table.word_or("output_function", variation.output_function, words_of(OutputFunction::kept, OutputFunction::mutable_));
  ExpressionOptions& expression = options.decoder.expression;
  expression.expression = table.word_or("expression", expression.expression,
                                        words_of(Expression::every_consumer_activated, Expression::first_consumer_activated));
  expression.axes = table.word_or("axes", expression.axes, words_of(AxisMap::xyz, AxisMap::zyx));
  options.largest_tries = table.integer_or("largest_tries", options.largest_tries, io::at_least(1));
}

std::vector<int> read_levels(const io::TomlTable& table) {
  std::vector<int> levels;
  for (const double level : table.numbers("levels", io::within(1, 100))) {
    if (level != static_cast<int>(level)) throw table.error("levels", "must hold integers");
    levels.push_back(static_cast<int>(level));
  }
  if (levels.empty()) throw table.error("levels", "must hold at least one level");
  const bool ascending = std::ranges::adjacent_find(levels, std::ranges::greater_equal{}) == levels.end();
  if (!ascending) throw table.error("levels", "must ascend");
  return levels;
}

void read_body(const io::TomlTable& table, SearchPlan& plan) {
  ConstraintOptions& constraints = plan.offspring.constraints;
  plan.cell_edge_m = table.number_or("cell_edge_m", plan.cell_edge_m, io::positive());
  if (table.has("levels")) constraints.levels = read_levels(table);
  constraints.smallest_body = table.integer_or("smallest_body_cells", constraints.smallest_body, io::within(1, basal_cell_count));
  constraints.smallest_arranged_body =
      table.integer_or("smallest_arranged_body_cells", constraints.smallest_arranged_body, io::within(1, 19683));
  constraints.disconnected =
      table.word_or("disconnected", constraints.disconnected,
                    words_of(DisconnectedPolicy::reject, DisconnectedPolicy::penalise, DisconnectedPolicy::allow));
  constraints.castable = table.boolean_or("castable", constraints.castable);
}

void read_evaluation(const io::TomlTable& table, Study& study) {
  SearchPlan& plan = study.search;
  study.duration_s = table.number_or("duration_s", study.duration_s, io::positive());
  plan.objective =
      table.word_or("objective", plan.objective, words_of(Objective::body_lengths, Objective::squared_metres_per_scale));
  plan.duplicates =
      table.word_or("duplicates", plan.duplicates, words_of(DuplicatePolicy::archived_result, DuplicatePolicy::culled));
  plan.pruning = table.boolean_or("pruning", plan.pruning);
  plan.stand = table.boolean_or("stand", plan.stand);
  study.measure_from_s = table.number_or("measure_from_s", study.measure_from_s, io::non_negative());
}

void read_judging(const io::TomlTable& table, Study& study) {
  JudgingPlan judging;
  if (table.has("protocol")) {
    judging.protocol = table.text("protocol");
  } else {
    study.judge_file = table.path("study");
  }
  judging.every = table.integer_or("every", judging.every, io::at_least(1));
  judging.designs = table.integer_or("designs", judging.designs, io::within(1, largest_population));
  judging.budget_element_steps = table.number("budget_element_steps", io::non_negative());
  judging.voxel_steps_per_element_step =
      table.number_or("voxel_steps_per_element_step", judging.voxel_steps_per_element_step, io::positive());
  study.search.judging = judging;
}

void read_step_checks(const io::TomlTable& table, SearchPlan& plan) {
  StepCheckPlan checks;
  checks.every = table.integer_or("every", checks.every, io::at_least(1));
  checks.designs = table.integer_or("designs", checks.designs, io::within(1, largest_population));
  plan.step_checks = checks;
}

void read_poissons_ratio(const io::TomlTable& table) {
  if (table.number_or("poissons_ratio", 0.0) == 0.0) return;
  throw table.error("poissons_ratio",
                    "must be 0 (the paper states 0.5, its released files simulated 0); lateral_coupling makes bodies contract");
}

Study read_tables(const io::TomlTable& table, Study study) {
  SearchPlan& plan = study.search;
  plan.generations = table.integer_or("generations", plan.generations, io::at_least(0));
  // TOML has no unsigned integers.
  plan.seed =
      static_cast<std::uint64_t>(table.integer_or<std::int64_t>("seed", static_cast<std::int64_t>(plan.seed), io::at_least(0)));
  if (const auto population = table.optional_table("population")) read_population(*population, plan);
  if (const auto genome = table.optional_table("genome")) read_genome(*genome, plan.offspring);
  if (const auto body = table.optional_table("body")) read_body(*body, plan);
  if (const auto evaluation = table.optional_table("evaluation")) read_evaluation(*evaluation, study);
  if (const auto judge = table.optional_table("judge")) read_judging(*judge, study);
  if (const auto checks = table.optional_table("check_dt")) read_step_checks(*checks, plan);
  if (const auto materials = table.optional_table("materials")) read_poissons_ratio(*materials);
  study.physics = voxel::read_physics(table, study.physics);
  return study;
}

void apply(const StudyOverrides& values, Study& study) {
  // The overrides go through the same checks as the file, under a name that says where they come from.
  std::string text;
  if (values.generations) text += "generations = " + std::to_string(*values.generations) + "\n";
  if (values.seed) text += "seed = " + std::to_string(*values.seed) + "\n";
  if (values.levels) {
    std::string list;
    for (const int level : *values.levels) list.append(list.empty() ? "" : ", ").append(std::to_string(level));
    text += "[body]\nlevels = [" + list + "]\n";
  }
  if (values.duration_s) text += "[evaluation]\nduration_s = " + io::number_text(*values.duration_s) + "\n";
  study = read_tables(io::parse_toml(text, "command line"), study);
}

std::string gibibytes(std::size_t bytes) { return io::formatted("%.3g GiB", static_cast<double>(bytes) / 1073741824.0); }

/// Demands that involve several keys.
void check_whole(const io::TomlTable& table, const Study& study, std::size_t memory_bytes) {
  const SearchPlan& plan = study.search;
  const auto body = table.optional_table("body");
  const auto fault = [&](const std::string& reason) {
    const std::string levels = "levels up to " + std::to_string(plan.levels().back());
    if (body && body->has("levels")) return body->error("levels", levels + ": " + reason);
    return io::InputError(table.file().string() + ": body." + levels + ": " + reason);
  };
  if (plan.judging && plan.levels().size() > 1) throw fault("with a table [judge] there must be one");
  if (study.measure_from_s >= study.duration_s) {
    throw io::InputError(table.file().string() + ": evaluation.measure_from_s = " + io::number_text(study.measure_from_s) +
                         ": must be less than duration_s = " + io::number_text(study.duration_s));
  }
  if (plan.offspring.decoder.plan == BodyPlan::nonfractal && plan.levels().back() > largest_arranged_level) {
    throw fault("a nonfractal body has at most " + std::to_string(largest_arranged_level));
  }
  if (const std::size_t needed = estimated_memory_bytes(study, 1); needed > memory_bytes) {
    throw fault("one evaluation may need about " + gibibytes(needed) + " of memory, this machine has " + gibibytes(memory_bytes));
  }
}

/// What keeps a study from using its calibrated parameters, or an empty text.
std::string unusable_surrogate(const Study& study) {
  const voxel::CalibratedBody& body = *study.physics.surrogate;
  const SearchPlan& plan = study.search;
  if (std::string problem = voxel::unusable_parameters(body, plan.cell_edge_m); !problem.empty()) return problem;
  if (body.outside_range == voxel::OutsideRange::refuse) {
    if (const std::vector<std::string> faults = outside_validity_of_all(study); !faults.empty()) return faults.front();
  }
  const voxel::ActuationMode mode = study.physics.actuation.mode;
  const std::string given = "actuation.mode = \"" + std::string(to_string(mode)) + "\": ";
  if (mode == voxel::ActuationMode::wave) return given + "the cells of a chamber would need different phases";
  if (mode == voxel::ActuationMode::antiphase && body.chambers == meshes::ChamberLayout::single) {
    return given +
           "with chambers = \"single\" all voxels of a module share a phase; use \"in_phase\" or chambers = \"per-phase\"";
  }
  if (plan.offspring.constraints.disconnected == DisconnectedPolicy::allow)
    return "body.disconnected = \"allow\": a body in pieces has no chambers that could be driven together";
  if (plan.offspring.decoder.plan == BodyPlan::nonfractal && plan.levels().back() > 1)
    return "genome.encoding = \"nonfractal\": only a fractal has modules that are hollow bodies of one kind";
  return "";
}

}  // namespace

Study study_from_text(std::string_view text, const std::filesystem::path& file) {
  const io::TomlTable table = io::parse_toml(text, file);
  Study study = read_tables(table, {});
  table.finish();
  return study;
}

Study read_study(const std::filesystem::path& file, const StudyOverrides& overrides) {
  return read_study(file, overrides, voxel::machine_memory_bytes());
}

Study read_study(const std::filesystem::path& file, const StudyOverrides& overrides, std::size_t memory_bytes) {
  const io::TomlTable table = io::read_toml(file);
  const io::Words<std::string_view> presets{{"paper", "paper"}, {"released-code", "released-code"}};
  const std::string_view preset = table.word("preset", presets);
  Study study = read_tables(table, study_from_text(preset_text(preset), std::string(preset) + ".toml"));
  table.finish();
  apply(overrides, study);
  check_whole(table, study, memory_bytes);
  if (study.search.judging && study.judge_file.empty())
    throw io::InputError(file.string() + ": judge.protocol: is that of an archive; a study names its judge by judge.study");
  if (study.physics.surrogate) {
    if (const std::string problem = unusable_surrogate(study); !problem.empty())
      throw io::InputError(file.string() + ": surrogate: " + problem);
  }
  if (const std::string problem = voxel::unusable_scales(study.physics, study.search.cell_edge_m, study.duration_s);
      !problem.empty()) {
    throw io::InputError(file.string() + ": " + problem);
  }
  return study;
}

Study archived_study(const RunArchive& archive) {
  Study study = study_from_text(archive.study(), archive.file());
  study.search.generations = archive.generation_goal();
  return study;
}

std::vector<std::filesystem::path> study_inputs(const std::filesystem::path& file) {
  std::vector<std::filesystem::path> files{file};
  const io::TomlTable table = io::read_toml(file);
  if (const auto parameters = voxel::parameters_file(table)) files.push_back(*parameters);
  if (const auto judge = table.optional_table("judge")) files.push_back(judge->path("study"));
  return files;
}

}  // namespace menger::evolution
