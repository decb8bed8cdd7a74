#include "evolution/trade_off/trade_off_study.h"

#include <algorithm>
#include <array>
#include <cassert>

#include "evolution/trade_off/trade_off_variant.h"
#include "io/study/study_reader.h"
#include "io/study/study_text.h"
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

/// Adds a scene or study, and the voxel parameters and the silicone that it names, to the inputs.
void note_variant(TradeStudy& study, const fs::path& file) {
  io::note_input(study.inputs, file);
  const TomlVariant variant(file);
  for (const auto& [copy, path] : variant.files()) io::note_input(study.inputs, path);
}

const io::Words<std::string> number_words{{"float64", "float64"}, {"float32", "float32"}};
const io::Words<std::string> damping_words{{"increments", "increments"}, {"velocity", "velocity"}};
const io::Words<std::string> chamber_words{{"single", "single"}, {"per-phase", "per-phase"}};

constexpr io::Count some{.fewest = 1};

/// Checks that no value of a list is there twice: every combination is run.
template <class Value>
void require_different(const io::StudyVisitor& visitor, std::string_view key, const std::vector<Value>& values) {
  for (auto value = values.begin(); value != values.end(); ++value)
    visitor.check(std::find(values.begin(), value, *value) == value, key, "is given twice",
                  {static_cast<std::size_t>(value - values.begin())});
}

void describe_numbers(io::StudyVisitor& visitor, const io::Key& key, std::vector<double>& values, const io::Range& range) {
  visitor.numbers(key, values, range, some);
  require_different(visitor, key.name, values);
}

void describe_integers(io::StudyVisitor& visitor, const io::Key& key, std::vector<int>& values, const io::Range& range,
                       const io::Count& count = some) {
  visitor.integers(key, values, range, count);
  require_different(visitor, key.name, values);
}

template <class Value>
void describe_words(io::StudyVisitor& visitor, const io::Key& key, std::vector<Value>& values, const io::Words<Value>& words,
                    const io::Count& count = some) {
  visitor.words(key, values, words, count);
  require_different(visitor, key.name, values);
}

bool is_depth(const std::string& word) {
  if (word == "off") return true;
  const bool has_digits = !word.empty() && word.size() <= 6 && word.find_first_not_of("0123456789") == std::string::npos;
  return has_digits && word.front() != '0';
}

void describe_body(io::StudyVisitor& visitor, TradeStudy& study) {
  std::optional<fs::path> file;
  meshes::describe_design(visitor, study.design, file);
  if (file) io::note_input(study.inputs, *file);
  visitor.number({"wall_thickness_m", "Thickness of every outer wall.", "", "/wall_thickness_m"}, study.wall_thickness_m,
                 io::positive());
  visitor.word({"chambers", "single: all cells of a module share one chamber; per-phase: the cells of each phase share one.", "",
                "/chambers"},
               study.chambers, chamber_words);
  visitor.integer({"level", "Level of the fractal: 1 is the design itself, in 2 each cell is a copy of it.", "", "/level"},
                  study.level, io::within(1, 3));
}

void describe_elements(io::StudyVisitor& visitor, ElementChoice& choice) {
  describe_words(visitor, {"thin_walls", "Fidelities of thin-wall elements; [] for none."}, choice.thin_walls,
                 fem::fidelity_words(), {});
  describe_integers(visitor, {"degrees", "Three-field elements: Q1/P0 or Q2/P1."}, choice.degrees, io::within(1, 2));
  describe_integers(visitor,
                    {"elements_through_wall", "Three-field elements: how many lie in a wall, from one face to the other."},
                    choice.elements_through_wall, io::within(1, 64));
  describe_numbers(visitor, {"bulk_ratios", "Bulk modulus divided by shear modulus, at rest."}, choice.bulk_ratios,
                   io::within(1.0, 1e6));
  describe_numbers(visitor, {"force_tolerances", "Relative tolerances of Newton's method."}, choice.force_tolerances,
                   {.lowest = 0.0, .highest = 1e-2, .lowest_excluded = true});
  visitor.number({"largest_unknowns", "Fidelities with more unknowns are not run; the table lists them as skipped."},
                 choice.largest_unknowns, io::positive());
  visitor.number({"time_limit_s", "Wall time of a run."}, choice.time_limit_s, io::positive());
}

void describe_voxels(io::StudyVisitor& visitor, VoxelChoice& choice) {
  describe_words(visitor, {"numbers", "Number types of the computation."}, choice.numbers, number_words);
  describe_words(visitor, {"dampings", "Damping from increments or velocities; increments need float64."}, choice.dampings,
                 damping_words);
  describe_numbers(visitor, {"time_step_fractions", "Time steps as fractions of the recommended one."},
                   choice.time_step_fractions, io::within(1e-3, 1.5));
  visitor.texts({"exclusion_depths",
                 "Collisions: \"off\", or in quotes an exclusion depth: voxels at most so many beams apart never collide."},
                choice.exclusion_depths, some);
  for (std::size_t n = 0; n < choice.exclusion_depths.size(); ++n)
    visitor.check(is_depth(choice.exclusion_depths[n]), "exclusion_depths", "must be \"off\" or an integer >= 1 in quotes", {n});
  require_different(visitor, "exclusion_depths", choice.exclusion_depths);
  visitor.number({"time_limit_s", "Wall time of a run."}, choice.time_limit_s, io::positive());
}

void describe_settling(io::StudyVisitor& visitor, SettlingChoice& choice) {
  std::vector<std::string> names;
  for (const fs::path& file : choice.parameters) names.push_back(file.string());
  visitor.texts({"parameters", "Files of voxel parameters, one for each number of voxels per cell.", "[\"parameters.toml\"]"},
                names, some);
  const io::TomlTable* table = visitor.source();
  choice.parameters.clear();
  for (const std::string& name : names)
    choice.parameters.push_back(table == nullptr ? fs::path(name) : table->file().parent_path() / name);
  require_different(visitor, "parameters", choice.parameters);
  visitor.number({"ramp_s", "Duration of the pressure ramp."}, choice.ramp_s, io::positive());
  visitor.number({"settle_s", "Time after the ramp in which the body settles."}, choice.settle_s, io::positive());
  visitor.number({"global_damping", "Damping ratio; it changes the path to the equilibrium, not the equilibrium."},
                 choice.global_damping, io::non_negative());
}

void describe_gait(io::StudyVisitor& visitor, GaitChoice& choice) {
  visitor.optional_path({"scene", "Scene file with the physics; default: the physics of the paper.", "\"scene.toml\""},
                        choice.scene);
  visitor.number({"duration_s", "Simulated time."}, choice.duration_s, io::positive());
}

void describe_search(io::StudyVisitor& visitor, SearchChoice& choice) {
  visitor.path({"study", "A study of menger evolve.", "\"evolve.toml\""}, choice.study);
  // a single search shows no spread
  describe_integers(visitor, {"seeds", "Seeds of the searches of each fidelity."}, choice.seeds, io::within(0, 1e9),
                    {.fewest = 3});
  visitor.number({"voxel_steps", "Budget of a search in voxel-steps, over all evaluations."}, choice.voxel_steps,
                 io::at_least(1.0));
  visitor.integer({"largest_generations", "A search ends with this generation."}, choice.largest_generations, io::within(1, 1e6));
  visitor.integer({"threads", "Threads of a search; results do not depend on them."}, choice.threads, io::within(1, 1024));
  visitor.number({"time_limit_s", "Wall time of one call of a search."}, choice.time_limit_s, io::positive());
}

/// Checks requirements that involve several tables.
void check_whole(const io::TomlTable& table, const TradeStudy& study) {
  const auto fault = [&](const std::string& reason) { return io::InputError(table.file().string() + ": " + reason); };
  if (!study.elements && !study.settling && !study.gait && !study.search)
    throw fault("nothing to run: a table [finite_elements], [settling], [gait] or [search] is missing");
  if (study.settling && !study.elements)
    throw fault("[settling] is compared with finite elements: a table [finite_elements] is missing");
}

void read_silicone(const io::TomlTable& table, TradeStudy& study) {
  study.silicone_file = materials::silicone_file(table, "silicone", study.silicone);
  const materials::SiliconeRecord record =
      table.reading("silicone", [&] { return materials::read_silicone(study.silicone_file); });
  study.silicone_name = record.name;
  study.law = materials::law_line(record.recommended.law);
  study.shear_modulus_Pa = materials::shear_modulus_at_rest_Pa(record.recommended.law);
  io::note_input(study.inputs, study.silicone_file);
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

void describe(io::StudyVisitor& visitor, TradeStudy& study) {
  visitor.table({.name = "design", .help = "The body and its walls.", .earlier_text = "design.file"},
                [&] { describe_body(visitor, study); });
  visitor.text({"silicone", "Name of a silicone of menger, or a silicone file."}, study.silicone);
  visitor.optional_number(
      {"pressure_Pa",
       "Pressure in all chambers, not 0; default: 6 kPa, or 0.8 of the limit pressure if there is a limit point before.", "3000"},
      study.pressure_Pa);
  visitor.check(study.pressure_Pa != 0.0, "pressure_Pa", "must not be 0: nothing would move");
  describe_words(visitor, {"observables", "Quantities that are compared."}, study.observables, observable_words);
  describe_numbers(visitor, {"target_relative_errors", "Relative errors for which a fidelity is recommended."}, study.targets,
                   io::positive());
  std::ranges::sort(study.targets, std::ranges::greater{});
  visitor.optional_table({"finite_elements", "Inflate the body by finite elements: every combination is run."}, study.elements,
                         [&](ElementChoice& choice) { describe_elements(visitor, choice); });
  visitor.table({"voxels", "Fidelities of the voxel engine: every combination is run."},
                [&] { describe_voxels(visitor, study.voxels); });
  visitor.optional_table({"settling", "Inflate the body by calibrated voxels until it rests."}, study.settling,
                         [&](SettlingChoice& choice) { describe_settling(visitor, choice); });
  visitor.optional_table({"gait", "Let the body walk, by the voxel engine alone."}, study.gait,
                         [&](GaitChoice& choice) { describe_gait(visitor, choice); });
  visitor.optional_table({"search", "Searches of equal cost, one for each fidelity of the voxels and seed."}, study.search,
                         [&](SearchChoice& choice) { describe_search(visitor, choice); });
}

TradeStudy read_trade_study(const fs::path& file) {
  const io::TomlTable table = io::read_toml(file);
  TradeStudy study;
  study.file = file;
  io::note_input(study.inputs, file);
  if (table.has("layers")) {
    io::read_described(table, study.design);
    study.elements = ElementChoice{};
    study.gait = GaitChoice{};
  } else {
    io::read_described(table, study);
    check_whole(table, study);
  }
  read_silicone(table, study);
  if (study.settling) {
    for (const fs::path& parameters : study.settling->parameters) io::note_input(study.inputs, parameters);
  }
  if (study.gait && study.gait->scene) note_variant(study, *study.gait->scene);
  if (study.search) {
    const fs::path& evolved = study.search->study;
    if (io::read_toml(evolved).has("budget"))
      throw io::InputError(evolved.string() + ": budget: would end the searches before search.voxel_steps of " + file.string());
    note_variant(study, evolved);
  }
  return study;
}

std::string resolved_text(const TradeStudy& study) { return io::described_text(study); }

}  // namespace menger::evolution
