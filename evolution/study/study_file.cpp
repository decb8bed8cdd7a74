#include "evolution/study/study_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <string>
#include <utility>

#include "evolution/study/scenarios.h"
#include "evolution/study/walk_evaluator.h"
#include "fem/walk/walk_silicone_file.h"
#include "io/study/installed_folders.h"
#include "io/study/study_reader.h"
#include "io/study/study_text.h"
#include "io/text/formatted.h"
#include "io/text/number_text.h"
#include "io/text/toml_document.h"
#include "io/text/toml_text.h"
#include "materials/laws/law_file.h"
#include "materials/laws/silicone_library.h"
#include "voxel/engine/scale_check.h"
#include "voxel/scene/calibrated_body_file.h"
#include "voxel/scene/physics_file.h"
#include "voxel/scene/scene.h"

namespace menger::evolution {

namespace {

constexpr double largest_population = 1e6;
constexpr double basal_cell_count = 27;
constexpr double fewest_measured_periods = 5;

/// Which keys of a study are described.
enum class Part {
  whole,
  identity  ///< those that decide the search
};

void describe_population(io::StudyVisitor& visitor, Part part, SearchPlan& plan) {
  visitor.integer(
      {"survivors",
       "Number of survivors of each generation, and of individuals in the first. With [map_elites] as many survive as "
       "niches have a body with a fitness, whatever this number."},
      plan.survivors, io::within(1, largest_population));
  visitor.integer({"mutants", "Children of the survivors in each generation."}, plan.mutants, io::within(0, largest_population));
  visitor.integer({"newcomers", "Random individuals in each generation."}, plan.newcomers, io::within(0, largest_population));
  // Archives of generational searches say nothing of it.
  if (part == Part::identity && plan.selection_time == SelectionTime::generational) return;
  visitor.word(
      {"selection",
       "When survivors are selected. generational: when all new individuals of a generation are evaluated; steady_state: "
       "whenever one is, so that no worker waits for the end of a generation. The search then follows from the order of "
       "results, which its archive has. Not with [map_elites], [robust], [check_dt], model = \"both\", shorter_walks or "
       "pruning."},
      plan.selection_time, io::words_of(SelectionTime::generational, SelectionTime::steady_state));
}

void describe_genome(io::StudyVisitor& visitor, Part part, OffspringOptions& options) {
  VariationOptions& variation = options.variation;
  ExpressionOptions& expression = options.decoder.expression;
  visitor.word(
      {"encoding",
       "Kind of body: fractal (the same arrangement at every level), nonfractal (arrangements evolved for each level), "
       "nonfractal-two-scales (the same without an arrangement for level 3), single-actuator (fractal of one material)."},
      options.decoder.plan,
      io::words_of(BodyPlan::fractal, BodyPlan::nonfractal, BodyPlan::nonfractal_two_scales, BodyPlan::single_actuator));
  visitor.word({"activations", "Activation functions that nodes may have."}, variation.activations,
               io::words_of(ActivationSet::paper, ActivationSet::released_code));
  visitor.word({"output_function", "Whether the functions of outputs may be mutated."}, variation.output_function,
               io::words_of(OutputFunction::kept, OutputFunction::mutable_));
  visitor.word({"expression", "Whether all consumers of a node get its activated value, or only the first."},
               expression.expression, io::words_of(Expression::every_consumer_activated, Expression::first_consumer_activated));
  visitor.word({"axes", "Axes of the body that the network inputs x, y and z stand for."}, expression.axes,
               io::words_of(AxisMap::xyz, AxisMap::zyx));
  visitor.integer({"largest_tries", "Mutations that are tried until a body is valid."}, options.largest_tries, io::at_least(1));
  // Archives of searches that limit no mutants say nothing of limits.
  const std::size_t networks = networks_of(options.decoder.plan).size();
  if (part != Part::identity || options.most_changed_cells < networks * basal_cells) {
    visitor.integer({"most_changed_cells",
                     "Most cells, of the basal body and of arrangements together, that appear, vanish or change material in a "
                     "mutant. A mutant that largest_tries do not suffice for equals its parent."},
                    options.most_changed_cells, io::within(1, largest_array_cells));
  }
  if (part != Part::identity || !options.mutants_may_keep_body) {
    visitor.only_if(networks > 1, "encoding = \"nonfractal\" or \"nonfractal-two-scales\"", [&] {
      visitor.boolean({"mutants_may_keep_body",
                       "Whether a mutant may differ from its parent in its arrangements alone. If not, it is given another basal "
                       "body, too; one that largest_tries do not suffice for equals its parent."},
                      options.mutants_may_keep_body);
    });
  }
}

/// Returns whether a study has calibrated parameters, also if they are still to be read. @param visitor at the top of the study
bool has_parameters(const io::StudyVisitor& visitor, const Study& study) {
  return study.physics.surrogate || (visitor.source() != nullptr && visitor.source()->has("surrogate"));
}

void describe_body(io::StudyVisitor& visitor, bool is_calibrated, Study& study) {
  SearchPlan& plan = study.search;
  ConstraintOptions& constraints = plan.offspring.constraints;
  visitor.number({"cell_edge_m", "Edge of a cell."}, plan.cell_edge_m, io::positive());
  visitor.integers({"levels", "Levels at which each body is evaluated, ascending: 1, 2, 3 are 3, 9, 27 cells per side."},
                   constraints.levels, io::within(1, 100), {.fewest = 1});
  const bool is_ascending =
      std::ranges::adjacent_find(constraints.levels, std::ranges::greater_equal{}) == constraints.levels.end();
  visitor.check(is_ascending, "levels", "must ascend");
  visitor.integer({"smallest_body_cells", "Least number of cells of a basal body."}, constraints.smallest_body,
                  io::within(1, basal_cell_count));
  visitor.integer({"largest_body_cells", "Largest number of cells of a basal body."}, constraints.largest_body,
                  io::within(1, basal_cell_count));
  visitor.integer(
      {"smallest_arranged_body_cells", "Least number of cells of a nonfractal body at level 3, or at level 2 with two scales."},
      constraints.smallest_arranged_body, io::within(1, 19683));
  visitor.word({"disconnected", "What happens to bodies that fall apart."}, constraints.disconnected,
               io::words_of(DisconnectedPolicy::reject, DisconnectedPolicy::penalise, DisconnectedPolicy::allow));
  visitor.boolean({"castable",
                   "Whether only bodies are valid that can be cast: in one piece, with no cells that touch only along an edge or "
                   "at a corner."},
                  constraints.castable);
  visitor.only_if(uses_elements(study) && !is_calibrated, "evaluation.model = \"finite_elements\" without [surrogate]",
                  [&] { describe_module(visitor, study.silicone.module); });
}

void describe_time(io::StudyVisitor& visitor, Study& study) {
  visitor.number({"duration_s", "Simulated time of an evaluation.", "", "/evaluation.duration_s"}, study.duration_s,
                 io::positive());
  visitor.number({"measure_from_s", "Displacement is measured from this time on.", "", "/evaluation.measure_from_s"},
                 study.measure_from_s, io::non_negative());
}

void describe_screening(io::StudyVisitor& visitor, ScreeningPlan& screening) {
  const io::Range share{.lowest = 0.0, .highest = 1.0, .lowest_excluded = true};
  visitor.number(
      {"least_passing_share",
       "Share of new bodies that pass the surrogate, or go on after half of their walk, if these rank as whole walks on finite "
       "elements do. More pass the less they do; without rank correlation all pass."},
      screening.least_share, share);
  visitor.number(
      {"drawn_share", "Share of the others that is drawn and walks all the same, to learn how well bodies are ranked."},
      screening.drawn_share, share);
}

/// Describes which new bodies walk, or walk to the end.
void describe_which_walk(io::StudyVisitor& visitor, Study& study) {
  ScreeningPlan screening = study.search.screening.value_or(ScreeningPlan{});
  bool are_halved = study.search.screening && screening.by == Screener::half_walks;
  const bool can_be_halved = study.model == EvaluationModel::finite_elements && study.measure == Measure::last_periods;
  visitor.only_if(can_be_halved, "model = \"finite_elements\" with measure = \"last_periods\"", [&] {
    visitor.boolean({"shorter_walks",
                     "Whether new bodies walk for half of the time first, and only those that rank best then, and some that are "
                     "drawn, go on to the end. The others have no fitness."},
                    are_halved);
  });
  are_halved = are_halved && can_be_halved;
  const bool is_screened = study.model == EvaluationModel::both || are_halved;
  visitor.only_if(is_screened, "model = \"both\" or shorter_walks = true", [&] { describe_screening(visitor, screening); });
  screening.by = are_halved ? Screener::half_walks : Screener::surrogate;
  study.search.screening.reset();
  if (is_screened) study.search.screening = screening;
}

void describe_evaluation(io::StudyVisitor& visitor, Part part, Study& study) {
  using enum EvaluationModel;
  SearchPlan& plan = study.search;
  visitor.word({"model",
                "What moves bodies. voxels: point masses and beams; finite_elements: elements of hollow bodies of silicone, for "
                "single modules, or aggregates of them (body.levels = [2]); both: voxels with the parameters of [surrogate] "
                "choose which new bodies walk on finite elements, which alone decide who survives."},
               study.model, io::words_of(voxels, finite_elements, both));
  // Archives of earlier versions do not have this key, and go on with it at its default.
  if (part == Part::whole || study.device != io::Device::cpu) {
    visitor.word({"device",
                  "What evaluates bodies. cpu: the processor; cuda: a graphics processor, which takes the voxels of a whole "
                  "generation at once, or walks of thin walls, as many as there are threads. Results of the two differ by "
                  "rounding."},
                 study.device, io::words_of(io::Device::cpu, io::Device::cuda));
  }
  visitor.word({"measure",
                "What is measured of a motion. net_displacement: from time.measure_from_s to the end; last_periods: the "
                "displacement in one period of the drive, from the last ones, so that neither the start nor a fall counts."},
               study.measure, io::words_of(Measure::net_displacement, Measure::last_periods));
  visitor.only_if(study.measure == Measure::last_periods, "measure = \"last_periods\"", [&] {
    visitor.integer({"measure_periods", "Number of the last whole periods that count. With fewer than 5, a fall would count."},
                    study.measure_periods, io::at_least(fewest_measured_periods));
    // Archives of earlier versions do not have this key for voxels, whose bodies did not fall, and go on without falls.
    if (part == Part::identity && !uses_elements(study) && study.largest_lean_deg >= 180.0) return;
    visitor.number({"largest_lean_deg",
                    "A body whose upright axis, at the end of a period, leans more than this from where it was at the end of "
                    "the first has fallen and has no fitness. 180: none has. With model = \"both\" finite elements tell."},
                   study.largest_lean_deg, {.lowest = 0.0, .highest = 180.0, .lowest_excluded = true});
  });
  describe_which_walk(visitor, study);
  visitor.only_if(part == Part::whole && uses_elements(study), "model = \"finite_elements\" or \"both\"", [&] {
    visitor.integer({"confirm",
                     "How many of the best robots walk on standard and fine elements at the end of a search. Must be 0, or not "
                     "given, where no elements are finer: with elements.kind = \"three_field\" or fidelity = \"fine\"."},
                    study.confirm, io::within(0, largest_population));
  });
  visitor.boolean({"stand", "Whether bodies stand on the ground from the start."}, plan.stand);
  visitor.word({"objective", "How a displacement becomes a fitness."}, plan.objective,
               io::words_of(Objective::body_lengths, Objective::squared_metres_per_scale));
  visitor.word(
      {"duplicates",
       "What happens to a new individual with the body of an earlier one. archived-result: it has its result; culled: it has "
       "no fitness; redrawn: it is varied, or drawn, until it has a body that none had before, and has the earlier result if "
       "genome.largest_tries do not suffice. One that the surrogate, or half of its walk, left out is no earlier one. Not "
       "redrawn with population.selection = \"steady_state\"."},
      plan.duplicates, io::words_of(DuplicatePolicy::archived_result, DuplicatePolicy::culled, DuplicatePolicy::redrawn));
  visitor.boolean({"pruning", "Whether evaluations that cannot change the survivors are skipped."}, plan.pruning);
}

void describe_robust(io::StudyVisitor& visitor, bool has_elements, RobustOptions& robust) {
  const auto check_different = [&](std::vector<double> values, const char* key) {
    std::ranges::sort(values);
    visitor.check(std::ranges::adjacent_find(values) == values.end(), key, "must be different");
  };
  visitor.numbers(
      {"frictions",
       "Coefficients of friction, static and kinetic alike, of a robot on the ground and on itself. A robot walks with each "
       "of them."},
      robust.frictions, io::non_negative(), {.fewest = 1});
  check_different(robust.frictions, "frictions");
  visitor.only_if(has_elements, "evaluation.model = \"finite_elements\" or \"both\"", [&] {
    visitor.numbers({"loss_factors", "Loss factors of the silicone, at its loss_frequency_Hz. A robot walks with each of them."},
                    robust.loss_factors, io::non_negative(), {.fewest = 1});
    check_different(robust.loss_factors, "loss_factors");
  });
  visitor.number({"quantile", "Share of the scenarios, the worst ones, that do not count. 0: the worst one is the score."},
                 robust.quantile, {.lowest = 0.0, .highest = 1.0, .highest_excluded = true});
}

void describe_map_elites(io::StudyVisitor& visitor, MapElitesPlan& elites) {
  visitor.integer({"cells_per_niche", "How many numbers of cells share a niche."}, elites.cells_per_niche,
                  io::within(1, basal_cell_count));
}

void describe_budget(io::StudyVisitor& visitor, bool has_voxels, Budget& budget) {
  visitor.number({"element_steps",
                  "No generation begins once the search has cost as many steps times finite elements. Steps of voxels are "
                  "counted at voxel_steps_per_element_step.",
                  "1e10"},
                 budget.element_steps, io::positive());
  visitor.only_if(has_voxels, "model = \"voxels\" or \"both\"", [&] {
    visitor.number({"voxel_steps_per_element_step", "What a step of a finite element costs in steps of a voxel.", "0.5"},
                   budget.voxel_steps_per_element_step, io::positive());
  });
}

void describe_step_checks(io::StudyVisitor& visitor, StepCheckPlan& checks) {
  visitor.integer({"every", "Generations from one check to the next."}, checks.every, io::at_least(1));
  visitor.integer({"designs", "Best survivors that are checked each time."}, checks.designs, io::within(1, largest_population));
}

/// Returns the silicone that the calibrated parameters of a study are of.
materials::StudyLaw silicone_of_parameters(const io::TomlTable& table, const Study& study) {
  const voxel::SurrogateParameters& parameters = study.physics.surrogate->parameters;
  const std::string of = "the parameters of [surrogate] are of " + io::toml_quoted(parameters.silicone);
  const auto file = materials::silicone_with_record_name(parameters.silicone);
  if (!file) throw table.missing("material", of + ", which is not a silicone of menger: give it in [material]");
  materials::StudyLaw law = materials::recommended_law(*file);
  if (materials::law_line(law.law) != parameters.law)
    throw table.missing("material", of + " with another law than its record recommends: give the silicone in [material]");
  return law;
}

/// Describes the silicone. Beside calibrated parameters a study need not state it.
void describe_silicone(io::StudyVisitor& visitor, Study& study) {
  fem::WalkSilicone& silicone = study.silicone.silicone;
  const io::TomlTable* table = visitor.source();
  const bool is_stated = table == nullptr || table->has("material");
  const bool has_law = materials::shear_modulus_at_rest_Pa(silicone.law.law) > 0.0;
  if (!is_stated && has_law) return;  // overrides of the command line
  if (!is_stated && study.physics.surrogate) {
    silicone.law = silicone_of_parameters(*table, study);
    silicone.is_ratio_assumed = true;
  } else {
    visitor.table({"material", "The silicone of the bodies. Default: that of the parameters of [surrogate]."},
                  [&] { fem::describe(visitor, silicone); });
  }
}

/// Returns whether the table that is read states the model. Then the drive may be that of another model.
bool states_model(const io::StudyVisitor& visitor) {
  return visitor.source() != nullptr && visitor.source()->table_or_empty("evaluation").has("model");
}

/// Describes what moves the bodies.
void describe_physics(io::StudyVisitor& visitor, Part part, Study& study) {
  const bool has_elements = uses_elements(study);
  voxel::describe(visitor, study.physics,
                  {.has_voxels = study.model != EvaluationModel::finite_elements,
                   .pressure_Pa = has_elements ? &study.silicone.module.pressure_Pa : nullptr,
                   .pressure_condition = "[surrogate], or evaluation.model = \"finite_elements\" or \"both\"",
                   .brings_pressure = has_elements && states_model(visitor),
                   .is_identity = part == Part::identity});
  visitor.only_if(has_elements, "evaluation.model = \"finite_elements\" or \"both\"", [&] {
    visitor.table({"elements", "The finite elements."}, [&] {
      describe_elements(visitor, study.silicone.elements, study.silicone.elements_through_wall);
      describe_step_safety(visitor, study.silicone.step_safety);
    });
    describe_silicone(visitor, study);
  });
}

/// Describes keys, without the number of generations.
void describe_but_generations(io::StudyVisitor& visitor, Part part, Study& study) {
  SearchPlan& plan = study.search;
  visitor.integer({"seed", "Seed of the random numbers."}, plan.seed, io::at_least(0));
  visitor.table({"population", "Size of the population."}, [&] { describe_population(visitor, part, plan); });
  visitor.table({"genome", "Genomes and how they vary."}, [&] { describe_genome(visitor, part, plan.offspring); });
  visitor.table({"evaluation", "How bodies are evaluated and scored."}, [&] { describe_evaluation(visitor, part, study); });
  const bool is_calibrated = has_parameters(visitor, study);
  visitor.table({"body", "Which bodies are valid."}, [&] { describe_body(visitor, is_calibrated, study); });
  visitor.table({"time", "Simulated time."}, [&] { describe_time(visitor, study); });
  visitor.optional_table(
      {"map_elites",
       "An archive of elites: the fittest body of every niche survives, by number of cells, number of feet and height; "
       "population.survivors does not limit them. Without this table bodies survive by age and fitness."},
      plan.map_elites, [&](MapElitesPlan& elites) { describe_map_elites(visitor, elites); });
  if (part == Part::whole) {
    visitor.optional_table(
        {"budget",
         "What the search may cost, counted in steps and not in time: it ends then, or after its generations. "
         "A search that has ended goes on with a larger one."},
        study.budget, [&](Budget& budget) { describe_budget(visitor, study.model != EvaluationModel::finite_elements, budget); });
  }
  visitor.optional_table(
      {"check_dt",
       "Checks of the time step: the best survivors are evaluated again with half of it. The search does not change."},
      plan.step_checks, [&](StepCheckPlan& checks) { describe_step_checks(visitor, checks); });
  visitor.optional_table({"robust",
                          "Robots walk in several scenarios, all pairs of frictions and loss factors, in place of the friction "
                          "of [ground] and the loss factor of [material]; as voxels they have no loss factor. The worst one is "
                          "the score. Walks of a robot end once it can no longer survive."},
                         study.robust, [&](RobustOptions& robust) { describe_robust(visitor, uses_elements(study), robust); });
  visitor.check(!study.robust || uses_elements(study) || plan.levels() == std::vector{1}, "robust",
                "needs body.levels = [1]: single modules");
  visitor.check(!study.robust || uses_elements(study) || !plan.step_checks, "robust",
                "cannot be combined with [check_dt]: there is no one walk to be checked");
  plan.scenarios = study.robust ? scenarios_of(study).size() : 1;
  plan.quantile = study.robust ? study.robust->quantile : 0.0;
  describe_physics(visitor, part, study);
}

/// Refuses a key of earlier versions, which could have one value only.
void refuse_poissons_ratio(const io::TomlTable& table) {
  const io::TomlTable materials = table.table_or_empty("materials");
  if (!materials.asks_for("poissons_ratio")) return;
  throw materials.error("poissons_ratio",
                        "is not a key any more. It had to be 0 (the paper states 0.5, its released files simulated 0). "
                        "Use lateral_coupling for lateral contraction");
}

/// The names that the table of corrections by finite elements had.
constexpr std::array corrections{"reference", "judge"};

/// Refuses a table of earlier versions.
void refuse_corrections(const io::TomlTable& table) {
  for (const char* name : corrections) {
    if (!table.has(name)) continue;
    throw table.error(name,
                      "is not a table any more: finite elements do not correct the scores of voxels. Leave the table out, and "
                      "write [evaluation] model = \"both\": then voxels screen new bodies, and finite elements decide");
  }
}

void apply(const StudyOverrides& values, Study& study) {
  // The overrides pass the same checks as the file, with "command line" as their file name.
  io::TomlText text;
  if (values.generations) text.add("generations", *values.generations);
  if (values.seed) text.add("seed", *values.seed);
  if (values.levels) text.table("body").add("levels", std::vector<std::int64_t>(values.levels->begin(), values.levels->end()));
  if (values.duration_s) text.table("time").add("duration_s", *values.duration_s);
  if (values.device) text.table("evaluation").add("device", std::string(to_string(*values.device)));
  io::read_described(io::parse_toml(text.text(), "command line"), study);
}

std::string gibibytes(std::size_t bytes) { return io::formatted("%.3g GiB", static_cast<double>(bytes) / 1073741824.0); }

/// Refuses robots to be confirmed where no elements are finer, and sets none where the study does not say how many.
void settle_confirmation(const io::TomlTable& table, Study& study) {
  if (!uses_elements(study) || !finer_fidelities(study).empty()) return;
  const io::TomlTable evaluation = table.table_or_empty("evaluation");
  if (evaluation.has("confirm") && study.confirm > 0) {
    const bool is_fine = study.silicone.elements.kind == fem::ElementKind::thin_wall;
    throw evaluation.error("confirm", std::string("must be 0: menger evolve has no finer elements than those of [elements] ") +
                                          (is_fine ? "fidelity = \"fine\"" : "kind = \"three_field\""));
  }
  study.confirm = 0;
}

/// Refuses what a steady-state search cannot be combined with, and lets it evaluate all that is born.
void settle_steady_state(const io::TomlTable& table, Study& study) {
  SearchPlan& plan = study.search;
  if (plan.selection_time == SelectionTime::generational) return;
  const std::string given = "population.selection = \"" + std::string(to_string(plan.selection_time)) + "\"";
  const auto refuse_with = [&](bool is_there, const char* other) {
    if (is_there) throw io::InputError(table.file().string() + ": " + given + ": cannot be combined with " + other);
  };
  refuse_with(plan.map_elites.has_value(), "[map_elites]");
  refuse_with(study.robust.has_value(), "[robust]");
  refuse_with(plan.step_checks.has_value(), "[check_dt]");
  refuse_with(study.model == EvaluationModel::both, "evaluation.model = \"both\"");
  refuse_with(plan.screening.has_value(), "evaluation.shorter_walks = true");
  refuse_with(plan.duplicates == DuplicatePolicy::redrawn, "evaluation.duplicates = \"redrawn\"");
  refuse_with(plan.mutants == 0 && plan.newcomers == 0, "population.mutants = 0 and newcomers = 0: no robot would be born");
  const io::TomlTable evaluation = table.table_or_empty("evaluation");
  if (evaluation.has("pruning") && plan.pruning)
    throw evaluation.error("pruning", "must be false, or not given, with " + given + ": no evaluation waits for others there");
  plan.pruning = false;
}

/// Checks requirements that involve several keys.
void check_whole(const io::TomlTable& table, const Study& study, std::size_t memory_bytes) {
  const SearchPlan& plan = study.search;
  const auto body = table.optional_table("body");
  const auto fault = [&](const std::string& reason) {
    const std::string levels = "levels up to " + std::to_string(plan.levels().back());
    if (body && body->has("levels")) return body->error("levels", levels + ": " + reason);
    return io::InputError(table.file().string() + ": body." + levels + ": " + reason);
  };
  if (study.measure_from_s >= study.duration_s) {
    throw io::InputError(table.file().string() + ": time.measure_from_s = " + io::number_text(study.measure_from_s) +
                         ": must be less than duration_s = " + io::number_text(study.duration_s));
  }
  const ConstraintOptions& constraints = plan.offspring.constraints;
  if (constraints.largest_body < constraints.smallest_body) {
    throw io::InputError(table.file().string() + ": body.largest_body_cells = " + std::to_string(constraints.largest_body) +
                         ": must be at least smallest_body_cells = " + std::to_string(constraints.smallest_body));
  }
  if (const int largest = largest_level(plan.offspring.decoder.plan); plan.levels().back() > largest) {
    throw fault("the highest level of a " + std::string(to_string(plan.offspring.decoder.plan)) + " body is " +
                std::to_string(largest));
  }
  if (const std::size_t needed = estimated_memory_bytes(study, 1); needed > memory_bytes) {
    throw fault("one evaluation may need about " + gibibytes(needed) + " of memory, this machine has " + gibibytes(memory_bytes));
  }
}

/// Returns why bodies of a study cannot be evaluated on its device, or an empty text. Whether there is such a device is not
/// asked.
std::string unusable_device(const Study& study) {
  const bool are_walls = study.silicone.elements.kind == fem::ElementKind::thin_wall;
  if (study.device == io::Device::cpu || !uses_elements(study) || are_walls) return "";
  return "evaluation.device = \"" + std::string(to_string(study.device)) +
         "\": of finite elements only thin walls move there: choose elements.kind = \"thin_wall\"";
}

/// Returns why hollow modules cannot be driven as a study says, or an empty text.
std::string undrivable_modules(const Study& study) {
  const SearchPlan& plan = study.search;
  const voxel::ActuationMode mode = study.physics.actuation.mode;
  const std::string given = "drive.mode = \"" + std::string(to_string(mode)) + "\": ";
  if (mode == voxel::ActuationMode::wave) return given + "one chamber cannot have cells of different phases";
  if (mode == voxel::ActuationMode::antiphase && module_of(study).chambers == meshes::ChamberLayout::single) {
    return given +
           "with chambers = \"single\" all voxels of a module share a phase; use \"in_phase\" or chambers = \"per-phase\"";
  }
  if (plan.offspring.constraints.disconnected == DisconnectedPolicy::allow)
    return "body.disconnected = \"allow\": a body in pieces has no chambers that could be driven together";
  if (largest_level(plan.offspring.decoder.plan) <= largest_arranged_level && plan.levels().back() > 1)
    return "genome.encoding = \"" + std::string(to_string(plan.offspring.decoder.plan)) +
           "\": only a fractal has modules that are hollow bodies of one kind";
  return "";
}

/// Returns why a study cannot use its calibrated parameters, or an empty text.
std::string unusable_surrogate(const Study& study) {
  const voxel::CalibratedBody& body = *study.physics.surrogate;
  if (std::string problem = voxel::unusable_parameters(body, study.search.cell_edge_m); !problem.empty()) return problem;
  if (body.outside_range == voxel::OutsideRange::refuse && study.model != EvaluationModel::finite_elements) {
    if (const std::vector<std::string> faults = outside_validity_of_all(study); !faults.empty()) return faults.front();
  }
  return undrivable_modules(study);
}

/// Says where parameters of voxels for the silicone and the cells of a study come from: a name that menger has, or the command
/// that fits them.
std::string source_of_parameters(const Study& study) {
  constexpr double rounding = 1e-9;
  const std::string law = materials::law_line(study.silicone.silicone.law.law);
  for (const std::filesystem::path& file : io::data_files(io::parameter_data)) {
    const io::TomlTable subject = io::read_toml(file).table("holds_for");
    const double cell_edge_m = subject.number("cell_edge_m");
    const bool is_whole = subject.integer_or<int>("voxels_per_cell", 1) == 1;
    if (is_whole && subject.text("law") == law && std::abs(cell_edge_m - study.search.cell_edge_m) <= rounding * cell_edge_m)
      return "; menger comes with some: parameters = " + io::toml_quoted(file.stem().string());
  }
  return "; menger loop fits some: menger init NAME, then this silicone and these cells in NAME/robot.toml, then menger loop "
         "NAME/robot.toml --until calibrate";
}

/// Returns why voxels cannot screen the bodies of a study, or an empty text.
std::string unusable_screening(const Study& study) {
  if (study.model != EvaluationModel::both) return "";
  const std::string given = "evaluation.model = \"both\": ";
  if (!study.physics.surrogate)
    return given + "needs parameters of voxels for this silicone, as [surrogate] parameters" + source_of_parameters(study);
  const std::string& calibrated = study.physics.surrogate->parameters.law;
  const std::string law = materials::law_line(study.silicone.silicone.law.law);
  if (law == calibrated) return "";
  return given + "the parameters of [surrogate] are for " + io::toml_quoted(calibrated) + ", the silicone of [material] is " +
         io::toml_quoted(law) + source_of_parameters(study);
}

/// Returns why bodies of the levels of a study cannot walk on finite elements, or an empty text.
std::string unusable_levels(const Study& study) {
  const std::vector<int>& levels = study.search.levels();
  if (levels == std::vector{1}) return "";
  if (levels != std::vector{2}) return "body.levels: must be [1], single modules, or [2], aggregates of these";
  const std::string given = "body.levels = [2]: ";
  const BodyPlan plan = study.search.offspring.decoder.plan;
  if (plan != BodyPlan::fractal && plan != BodyPlan::single_actuator)
    return given + "genome.encoding = \"" + std::string(to_string(plan)) +
           "\" needs voxels: all modules of an aggregate of silicone are alike";
  if (study.model == EvaluationModel::both) return given + "evaluation.model = \"both\" needs [1], single modules";
  if (study.device != io::Device::cpu)
    return given + "evaluation.device = \"" + std::string(to_string(study.device)) + "\" needs [1], single modules";
  return "";
}

/// Returns why a body of one cell cannot walk as a study says, or an empty text. What stands against it stands against all
/// bodies.
std::string refused_walk(const Study& study) {
  try {
    fem::PreparedWalk walk{walk_of(study, meshes::Polycube::from_digits(1, 1, 1, "1"), study.search.first_level())};
    fem::check(walk);
    fem::prepare(walk);
  } catch (const io::InputError& error) {
    return std::string("finite elements refuse all bodies: ") + error.what();
  }
  return "";
}

/// Returns why finite elements cannot evaluate the bodies of a study, or an empty text.
std::string unusable_elements(const Study& study) {
  const SearchPlan& plan = study.search;
  if (std::string problem = unusable_levels(study); !problem.empty()) return problem;
  if (!plan.stand) return "evaluation.stand = false: must be true: finite elements put every body on the ground";
  if (!study.physics.floor) return "ground.present = false: must be true";
  if (std::string problem = unusable_screening(study); !problem.empty()) return problem;
  if (study.robust && plan.step_checks) return "[check_dt]: beside [robust] there is no one walk to be checked";
  const auto& [first, second] = study.physics.materials;
  if (first.static_friction != second.static_friction || first.kinetic_friction != second.kinetic_friction)
    return "materials: a cast body is of one silicone: both materials must have the same friction";
  if (first.kinetic_friction > first.static_friction) {
    return "ground.kinetic_friction = " + io::number_text(first.kinetic_friction) +
           ": must be at most static_friction = " + io::number_text(first.static_friction);
  }
  const double thickness_m = module_of(study).wall_thickness_m;
  if (2.0 * thickness_m >= plan.cell_edge_m) {
    const std::string given =
        study.physics.surrogate ? "[surrogate] parameters: wall_thickness_m = " : "body.wall_thickness_m = ";
    return given + io::number_text(thickness_m) +
           ": must be less than half of cell_edge_m = " + io::number_text(plan.cell_edge_m);
  }
  if (study.duration_s / record_interval_s(study) > voxel::largest_record_count) {
    return "time.duration_s = " + io::number_text(study.duration_s) + ": makes more than a million records of " +
           io::number_text(record_interval_s(study)) + " s";
  }
  if (std::string problem = undrivable_modules(study); !problem.empty()) return problem;
  return refused_walk(study);
}

}  // namespace

std::string unmeasurable_periods(const Study& study) {
  const auto last = measured_periods(study);
  if (!last) return "";
  const double counted_from_s =
      static_cast<double>(whole_periods(study.duration_s, last->period_s)) - static_cast<double>(last->count);
  const std::string given = "evaluation.measure_periods = " + std::to_string(last->count) + ": ";
  if (counted_from_s < 1.0) {
    return given + "time.duration_s = " + io::number_text(study.duration_s) + " must hold one whole period more, of " +
           io::number_text(last->period_s) + " s, so that the first one does not count";
  }
  if (counted_from_s * last->period_s < study.measure_from_s * (1.0 - 1e-9))
    return given + "they begin before time.measure_from_s = " + io::number_text(study.measure_from_s);
  return "";
}

void describe(io::StudyVisitor& visitor, Study& study) {
  visitor.integer({"generations", "Generations after the first."}, study.search.generations, io::at_least(0));
  describe_but_generations(visitor, Part::whole, study);
}

PresetStudy::PresetStudy() : study(study_from_text(preset_text(preset), preset + ".toml")) {}

void describe(io::StudyVisitor& visitor, PresetStudy& file) {
  const io::Words<std::string> presets{{"paper", "paper"}, {"released-code", "released-code"}};
  const std::string before = file.preset;
  visitor.word({"preset", "Preset with the values of all keys that are not given.", "\"paper\""}, file.preset, presets);
  if (visitor.source() != nullptr || file.preset != before)
    file.study = study_from_text(preset_text(file.preset), file.preset + ".toml");
  visitor.defaults_from("preset", [&] { describe(visitor, file.study); });
}

std::string resolved_text(const Study& study) { return io::described_text(study); }

std::string identity_text(const Study& study) {
  Study described = study;
  io::StudyTextWriter writer;
  describe_but_generations(writer, Part::identity, described);
  return writer.text();
}

Study study_from_text(std::string_view text, const std::filesystem::path& file) {
  Study study;
  io::read_described(io::parse_toml(text, file), study);
  return study;
}

Study read_study(const std::filesystem::path& file, const StudyOverrides& overrides) {
  return read_study(file, overrides, voxel::machine_memory_bytes());
}

Study read_study(const std::filesystem::path& file, const StudyOverrides& overrides, std::size_t memory_bytes) {
  const io::TomlTable table = io::read_toml(file);
  refuse_poissons_ratio(table);
  refuse_corrections(table);
  PresetStudy over_preset;
  io::read_described(table, over_preset);
  Study study = std::move(over_preset.study);
  apply(overrides, study);
  if (uses_elements(study)) state_what_the_record_has(study.silicone.silicone);
  settle_confirmation(table, study);
  settle_steady_state(table, study);
  check_whole(table, study, memory_bytes);
  const auto require_none = [&](const std::string& problem) {
    if (!problem.empty()) throw io::InputError(file.string() + ": " + problem);
  };
  require_none(unmeasurable_periods(study));
  require_none(unusable_device(study));
  if (study.physics.surrogate) {
    if (const std::string problem = unusable_surrogate(study); !problem.empty())
      throw io::InputError(file.string() + ": surrogate: " + problem);
  }
  if (uses_elements(study)) {
    require_none(unusable_elements(study));
    if (study.model == EvaluationModel::finite_elements) return study;
  }
  voxel::check_friction(table, study.physics);
  if (const std::string problem = voxel::unusable_scales(study.physics, study.search.cell_edge_m, study.duration_s);
      !problem.empty()) {
    throw io::InputError(file.string() + ": " + problem);
  }
  return study;
}

Study archived_study(const RunArchive& archive) {
  const io::TomlTable table = io::parse_toml(archive.study(), archive.file());
  // archives of earlier versions have this key, always 0
  (void)table.table_or_empty("materials").asks_for("poissons_ratio");
  for (const char* name : corrections) (void)table.asks_for(name);
  Study study;
  io::read_described(table, study, io::StudyReader::EarlierNames::read);
  // Walks of archives without this key were measured whether or not the body had fallen.
  const bool tells_falls = table.table_or_empty("evaluation").has("largest_lean_deg");
  if (study.measure == Measure::last_periods && !tells_falls) study.largest_lean_deg = 180.0;
  study.search.generations = archive.generation_goal();
  return study;
}

bool was_corrected(const RunArchive& archive) {
  const io::TomlTable table = io::parse_toml(archive.study(), archive.file());
  return std::ranges::any_of(corrections, [&](const char* name) { return table.has(name); });
}

std::vector<std::filesystem::path> study_inputs(const std::filesystem::path& file) {
  std::vector<std::filesystem::path> files{file};
  const io::TomlTable table = io::read_toml(file);
  if (const auto parameters = voxel::parameters_file(table)) files.push_back(*parameters);
  if (const auto material = table.optional_table("material"); material && material->has("silicone"))
    files.push_back(materials::silicone_file(*material, "silicone"));
  return files;
}

}  // namespace menger::evolution
