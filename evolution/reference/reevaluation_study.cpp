#include "evolution/reference/reevaluation_study.h"

#include <algorithm>
#include <cmath>

#include "evolution/study/study_file.h"
#include "evolution/study/walk_evaluator.h"
#include "fem/locomotion/locomotion_study.h"
#include "io/study/study_reader.h"
#include "io/study/study_text.h"
#include "io/text/content_hash.h"
#include "io/text/number_text.h"
#include "io/text/toml_document.h"
#include "io/text/toml_text.h"
#include "materials/laws/law_file.h"
#include "materials/laws/silicone_library.h"
#include "materials/laws/silicone_record.h"

namespace menger::evolution {
namespace {

namespace fs = std::filesystem;

constexpr const char* usual_silicone = "dragon_skin_10";
constexpr double most_records = 1e6;

/// Returns the range of a factor that is at most 1: (0, 1].
io::Range part_of_one() { return {.lowest = 0.0, .highest = 1.0, .lowest_excluded = true}; }

void require_calibrated_search(const Study& search, const fs::path& archive) {
  const auto refuse = [&](const std::string& why) {
    throw io::InputError(archive.string() + ": its search cannot be evaluated by finite elements: " + why);
  };
  if (!is_of_silicone(search)) {
    refuse(
        "it drove solid voxels by changing their size; a search with a table [surrogate] with calibrated parameters and "
        "pressures is needed, or one on finite elements");
  }
  const auto [low_Pa, high_Pa] = module_of(search).pressure_Pa;
  if (low_Pa == 0.0 && high_Pa == 0.0) refuse("its pressure_Pa is [0, 0]");
  if (!search.physics.floor) refuse("it had no floor");
}

/// Describes a value that is that of the search unless a file gives it. @param describe describes the key
template <class Value, class Describe>
void describe_own(bool has_search, Value& value, const Describe& describe) {
  std::optional<Value> given;
  if (has_search) given = value;
  describe(given);
  if (given) value = *given;
}

void describe_level(io::StudyVisitor& visitor, bool has_search, ReevaluationStudy& study) {
  std::optional<int> level;
  if (has_search && study.level > 0) level = study.level;
  visitor.optional_integer(
      {"level", "Level of the bodies that are evaluated; default: that of the search, if it has only one.", "1"}, level,
      io::within(1, 3));
  if (level) study.level = *level;
  const io::TomlTable* table = visitor.source();
  if (table == nullptr) return;
  if (!level) throw table->missing("level", "give one, because the search has several levels");
  visitor.check(std::ranges::binary_search(study.search.search.levels(), *level), "level",
                "the search evaluated no design at this level");
}

void describe_comparison(io::StudyVisitor& visitor, ReevaluationStudy& study) {
  visitor.word({"compare_with",
                "What the finite elements are compared with: the model of the search, or voxels with the parameters of its "
                "[surrogate], also if finite elements decided the search."},
               study.compare_with, io::words_of(ComparedModel::search, ComparedModel::voxels));
  visitor.check(study.compare_with == ComparedModel::search || study.search.physics.surrogate, "compare_with",
                "the search has no parameters of voxels, as [surrogate] parameters");
}

bool has_usual_silicone(const ReevaluationStudy& study) {
  return study.silicone_file.empty() ? !uses_elements(study.search) : study.silicone_file.stem() == usual_silicone;
}

/// The silicone that the surrogate of the search was calibrated for.
fs::path silicone_of_search(const io::TomlTable& table, const ReevaluationStudy& study) {
  const std::string& name = study.search.physics.surrogate->parameters.silicone;
  if (const auto file = materials::silicone_with_record_name(name)) return *file;
  throw table.missing("silicone", "the surrogate of the search was calibrated for " + io::toml_quoted(name) +
                                      ", which is not a silicone of menger: give its file");
}

void describe_silicone(io::StudyVisitor& visitor, ReevaluationStudy& study) {
  std::optional<std::string> silicone;
  if (!study.silicone_file.empty()) silicone = study.silicone_file.string();
  visitor.optional_text(
      {"silicone", "Name of a silicone of menger, or a silicone file; default: that of the search.", "\"dragon_skin_10\""},
      silicone);
  if (const io::TomlTable* table = visitor.source()) {
    if (table->has("silicone"))
      study.silicone_file = materials::silicone_file(*table, "silicone");
    else if (!uses_elements(study.search))
      study.silicone_file = silicone_of_search(*table, study);
  }
}

bool is_multiple(double value, double of) {
  constexpr double rounding = 1e-9;
  const double count = value / of;
  return std::abs(count - std::round(count)) <= rounding * count;
}

/// Returns the error for a wrong time, which the study or the search has given.
io::InputError fault(const io::TomlTable& table, std::string_view key, double value, const std::string& reason) {
  if (table.has(key)) return table.error(key, reason);
  return io::InputError(table.file().string() + ": time." + std::string(key) + " = " + io::number_text(value) +
                        " (from the search): " + reason);
}

/// Returns the default record interval. It divides the periods that are measured, or the time before displacement counts, because
/// finite elements give positions at records only.
double usual_record_interval_s(const ReevaluationStudy& study) {
  double interval_s = ReevaluationStudy{}.record_interval_s;
  const auto last = measured_periods(study.search);
  if (uses_elements(study.search) && (last || is_multiple(study.measure_from_s, record_interval_s(study.search))))
    return std::min(record_interval_s(study.search), study.duration_s);
  if (last)
    interval_s = last->period_s / std::ceil(last->period_s / interval_s);
  else if (study.measure_from_s > 0.0)
    interval_s = study.measure_from_s / std::ceil(study.measure_from_s / interval_s);
  return std::min(interval_s, study.duration_s);
}

double usual_frame_interval_s(const ReevaluationStudy& study) {
  const auto frequency_Hz = fem::stroke_frequency_Hz(pressure_drive(study.search));
  return study.record_interval_s *
         static_cast<double>(fem::usual_records_per_frame(study.record_interval_s, study.duration_s, frequency_Hz));
}

/// Describes an interval. A file may leave it out: then it has its usual value.
template <class Usual>
void describe_interval(io::StudyVisitor& visitor, const io::Key& key, bool has_search, double& interval_s, const io::Range& range,
                       const Usual& usual) {
  const bool is_read = visitor.source() != nullptr;
  std::optional<double> given;
  if (has_search && !is_read) given = interval_s;
  visitor.optional_number(key, given, range);
  if (given)
    interval_s = *given;
  else if (is_read)
    interval_s = usual();
}

void describe_times(io::StudyVisitor& visitor, bool has_search, ReevaluationStudy& study) {
  describe_own(has_search, study.duration_s, [&](std::optional<double>& given) {
    visitor.optional_number({"duration_s", "Simulated time in both models; default: that of the search.", "2", "/duration_s"},
                            given, io::positive());
  });
  describe_own(has_search, study.measure_from_s, [&](std::optional<double>& given) {
    visitor.optional_number(
        {"measure_from_s", "Displacement is measured from this time on; default: that of the search.", "0.5", "/measure_from_s"},
        given, io::non_negative());
  });
  const io::TomlTable* table = visitor.source();
  if (table != nullptr && study.measure_from_s >= study.duration_s)
    throw fault(*table, "measure_from_s", study.measure_from_s,
                "must be less than duration_s = " + io::number_text(study.duration_s));
  describe_interval(visitor,
                    {"record_interval_s",
                     "Time between records; measure_from_s, or the period of a search that measures the last ones, "
                     "must be a multiple of it. Default: about 0.02 s.",
                     "0.02", "/record_interval_s"},
                    has_search, study.record_interval_s,
                    has_search ? io::within(study.duration_s / most_records, study.duration_s) : io::positive(),
                    [&] { return usual_record_interval_s(study); });
  describe_interval(visitor,
                    {"frame_interval_s",
                     "Time between frames, a multiple of record_interval_s; default: an eighth of a stroke of the drive, at most "
                     "0.1 s, at least a record, and no more than 300 frames",
                     "0.1", "/frame_interval_s"},
                    has_search, study.frame_interval_s, has_search ? io::at_least(study.record_interval_s) : io::positive(),
                    [&] { return usual_frame_interval_s(study); });
  const std::string multiple = "must be a multiple of record_interval_s = " + io::number_text(study.record_interval_s);
  visitor.check(is_multiple(study.frame_interval_s, study.record_interval_s), "frame_interval_s", multiple);
  if (table == nullptr) return;
  if (const auto last = measured_periods(study.search)) {
    visitor.check(
        is_multiple(last->period_s, study.record_interval_s), "record_interval_s",
        "must divide the period of the drive, " + io::number_text(last->period_s) + " s: the search measures the last ones");
  } else if (!is_multiple(study.measure_from_s, study.record_interval_s))
    throw fault(*table, "measure_from_s", study.measure_from_s, multiple);
}

void describe_elements(io::StudyVisitor& visitor, LocomotionOptions& options) {
  evolution::describe_elements(visitor, options.elements, options.elements_through_wall);
  visitor.number({"bulk_modulus_ratio", "Bulk modulus divided by shear modulus, at rest."}, options.bulk_modulus_ratio,
                 io::within(1.0, 1e6));
  describe_step_safety(visitor, options.step_safety);
  visitor.optional_number({"youngs_modulus_Pa", "Young's modulus at rest; default: that of the silicone.", "150000"},
                          options.youngs_modulus_Pa, io::positive());
  visitor.word({"damping_model", "Damping model of the silicone."}, options.damping_model,
               {{"maxwell", fem::DampingModel::maxwell}, {"kelvin_voigt", fem::DampingModel::kelvin_voigt}});
  visitor.integer({"threads", "Threads of one run; results do not depend on them."}, options.threads, io::within(1, 1024));
}

/// Describes the ground, which is the same for the whole body and for both models.
void describe_ground(io::StudyVisitor& visitor, bool has_search, Study& search) {
  auto& [first, second] = search.physics.materials;
  const auto describe_friction = [&](const io::Key& key, double& own, double& other) {
    if (const io::TomlTable* table = visitor.source(); table != nullptr && own != other && !table->has(key.name))
      throw table->missing(
          key.name, "the two materials of the search have different values, but a cast body is of one silicone: give a value");
    describe_own(has_search, own, [&](std::optional<double>& given) { visitor.optional_number(key, given, io::non_negative()); });
    other = own;
  };
  describe_friction({"static_friction", "Coefficient of static friction in both models; default: that of the search.", "1"},
                    first.static_friction, second.static_friction);
  describe_friction({"kinetic_friction", "Coefficient of kinetic friction in both models; default: that of the search.", "0.5"},
                    first.kinetic_friction, second.kinetic_friction);
  const io::TomlTable* table = visitor.source();
  if (table == nullptr || first.kinetic_friction <= first.static_friction) return;
  throw io::InputError(table->file().string() + ": ground.kinetic_friction = " + io::number_text(first.kinetic_friction) +
                       ": must be at most static_friction = " + io::number_text(first.static_friction));
}

void describe_variants(io::StudyVisitor& visitor, bool is_usual_silicone, fem::ElementKind kind, VariantOptions& options) {
  visitor.integer({"designs", "Number of best designs that are evaluated with every variant."}, options.designs, io::at_least(1));
  visitor.boolean({"finer_elements", "Whether finer elements are a variant: the next fidelity, or more elements through a wall."},
                  options.finer_elements);
  visitor.only_if(kind == fem::ElementKind::three_field, "elements.kind = \"three_field\"", [&] {
    visitor.integer({"elements_through_wall", "Elements through a wall in this variant."}, options.elements_through_wall,
                    io::within(1, 16));
  });
  visitor.number({"bulk_modulus_factor", "Factor on the bulk modulus of the evaluation; 1: no such variant."},
                 options.bulk_modulus_factor, io::positive());
  visitor.number({"step_factor", "Factor on the time step of the evaluation; 1: no such variant."}, options.step_factor,
                 part_of_one());
  visitor.number({"friction_factor", "Factor on the friction of the ground; 1: no such variant."}, options.friction_factor,
                 io::positive());
  visitor.number({"pressure_factor", "Factor on the pressures of the drive; 1: no such variant."}, options.pressure_factor,
                 io::positive());
  // moduli stated for one silicone do not hold for another
  visitor.numbers({"youngs_moduli_Pa", "Young's moduli that are stated for the silicone; each is a variant.",
                   is_usual_silicone ? "" : "[107000, 264000]"},
                  options.youngs_moduli_Pa, io::positive());
  std::vector<double> sorted = options.youngs_moduli_Pa;
  std::ranges::sort(sorted);
  visitor.check(std::ranges::adjacent_find(sorted) == sorted.end(), "youngs_moduli_Pa", "must be different");
}

/// Returns the finite elements of the search, on which its robots are evaluated again more finely.
LocomotionOptions elements_of_search(const Study& search) {
  const SiliconePhysics& physics = search.silicone;
  LocomotionOptions options{.elements = physics.elements,
                            .elements_through_wall = physics.elements_through_wall,
                            .bulk_modulus_ratio = physics.silicone.bulk_modulus_ratio,
                            .step_safety = physics.step_safety,
                            .youngs_modulus_Pa = physics.silicone.youngs_modulus_Pa,
                            .damping_model = physics.silicone.damping_model.value_or(fem::DampingModel::maxwell)};
  options.elements.fidelity = fem::ElementChoice{}.fidelity;
  return options;
}

void require_silicone_of_search(ReevaluationStudy& study) {
  if (study.silicone_file.empty()) return;
  const materials::SiliconeRecord record = materials::read_silicone(study.silicone_file);
  const std::string here = materials::law_line(record.recommended.law);
  const std::string wanted = materials::law_line(study.search.silicone.silicone.law.law);
  if (here != wanted) {
    throw io::InputError(study.silicone_file.string() + ": its recommended law is " + io::toml_quoted(here) +
                         ", the search had " + io::toml_quoted(wanted));
  }
  io::note_input(study.inputs, study.silicone_file);
}

void require_calibrated_silicone(ReevaluationStudy& study) {
  const materials::SiliconeRecord record = materials::read_silicone(study.silicone_file);
  const voxel::SurrogateParameters& calibrated = study.search.physics.surrogate->parameters;
  const auto refuse = [&](const std::string& what, const std::string& here, const std::string& wanted) {
    throw io::InputError(study.silicone_file.string() + ": " + what + " is " + io::toml_quoted(here) +
                         ", the surrogate of the search was calibrated for " + io::toml_quoted(wanted));
  };
  if (record.name != calibrated.silicone) refuse("its name", record.name, calibrated.silicone);
  const std::string law = materials::law_line(record.recommended.law);
  if (law != calibrated.law) refuse("its recommended law", law, calibrated.law);
  io::note_input(study.inputs, study.silicone_file);
}

void require_enough_periods(const ReevaluationStudy& study) {
  Study search = study.search;
  search.duration_s = study.duration_s;
  search.measure_from_s = study.measure_from_s;
  const std::string problem = unmeasurable_periods(search);
  if (problem.empty()) return;
  throw io::InputError((study.file.empty() ? study.archive : study.file).string() + ": the search measures the last " +
                       std::to_string(search.measure_periods) + " periods: " + problem);
}

}  // namespace

std::string_view to_string(ComparedModel model) { return model == ComparedModel::search ? "search" : "voxels"; }

void describe(io::StudyVisitor& visitor, ReevaluationStudy& study) {
  // without a search there are no values to use: keys are shown as ones that may be left out
  const bool has_search = is_of_silicone(study.search);
  describe_level(visitor, has_search, study);
  describe_comparison(visitor, study);
  describe_silicone(visitor, study);
  visitor.integer({"sample_seed", "Seed of the sample."}, study.sample_seed, io::at_least(0));
  visitor.number({"least_body_lengths", "A design that moves less, in either model, has no direction."}, study.least_body_lengths,
                 io::non_negative());
  visitor.number({"time_limit_s", "Wall time of a run of finite elements, over all calls."}, study.time_limit_s, io::positive());
  visitor.table({"time", "Simulated time and records."}, [&] { describe_times(visitor, has_search, study); });
  visitor.table({"elements", "The finite elements."}, [&] { describe_elements(visitor, study.elements); });
  visitor.table({"ground", "Friction of the ground."}, [&] { describe_ground(visitor, has_search, study.search); });
  visitor.optional_table(
      {"variants",
       "Evaluates the best designs again, each time with one thing changed, to estimate the uncertainty of the finite elements.",
       "", "judge"},
      study.variants, [&](VariantOptions& variants) {
        describe_variants(visitor, has_usual_silicone(study), study.elements.elements.kind, variants);
      });
}

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
                          .variants = {},
                          .inputs = {}};
  require_calibrated_search(study.search, request.archive);
  const bool is_given = !request.file.empty();
  const io::TomlTable table = is_given ? io::read_toml(request.file) : io::parse_toml("", "the study");
  if (is_given) io::note_input(study.inputs, request.file);
  const std::vector<int>& levels = study.search.search.levels();
  study.level = levels.size() == 1 ? levels.front() : 0;
  study.duration_s = study.search.duration_s;
  study.measure_from_s = study.search.measure_from_s;
  if (uses_elements(search)) study.elements = elements_of_search(search);
  io::read_described(table, study);
  if (study.search.physics.surrogate) study.search.physics.surrogate->level = study.level;
  const auto require_silicone = [&] {
    uses_elements(search) ? require_silicone_of_search(study) : require_calibrated_silicone(study);
  };
  table.has("silicone") ? table.reading("silicone", require_silicone) : require_silicone();
  require_enough_periods(study);
  return study;
}

std::string resolved_text(const ReevaluationStudy& study) {
  return io::TomlText().add("top", study.top).add("sample", study.sample).lines(io::described_text(study)).text();
}

}  // namespace menger::evolution
