#include "voxel/validation/validation_run.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "io/shown/shown_column.h"
#include "io/shown/shown_quantity.h"
#include "io/text/formatted.h"
#include "io/text/whole_file.h"
#include "voxel/statics/load_case_slopes.h"
#include "voxel/validation/kept_fields.h"
#include "voxel/validation/validation_charts.h"
#include "voxel/validation/validation_scene.h"
#include "voxel/validation/validation_tables.h"

namespace menger::voxel {

namespace {

namespace fs = std::filesystem;
using meshes::LoadCaseKind;

/// Fractions of the work, roughly by time.
constexpr double comparing = 0.6;
constexpr double explaining = 0.3;

void tell(const ValidationRunOptions& options, double done, const std::string& note) {
  if (options.progress) options.progress(done, note);
}

bool is_stopped(const ValidationRunOptions& options) { return options.stop != nullptr && options.stop->load(); }

void compare_all(ValidationResult& result, const SurrogateParameters& parameters, const std::vector<HeldOutCurve>& curves,
                 const ValidationRunOptions& options) {
  std::vector<meshes::ResponseCurve> plain;
  plain.reserve(curves.size());
  for (const HeldOutCurve& held_out : curves) plain.push_back(held_out.curve);
  const std::vector<std::string> bodies = body_names(plain);
  const Responder responder = respond;
  for (std::size_t i = 0; i < plain.size(); ++i) {
    if (is_stopped(options)) {
      result.status = io::RunStatus::stopped;
      return;
    }
    tell(options, comparing * static_cast<double>(i) / static_cast<double>(plain.size()), plain[i].provenance.load_case.name);
    result.comparisons.push_back(compare(plain[i], bodies[i], parameters, responder));
  }
}

/// Returns which of two ends says less about the surrogate: contact of walls is a result of it, no convergence a failure.
io::RunStatus worse_of(io::RunStatus a, io::RunStatus b) {
  using enum io::RunStatus;
  constexpr std::array order{completed, wall_contact, limit_point};
  const auto rank = [&](io::RunStatus status) { return std::find(order.begin(), order.end(), status) - order.begin(); };
  return rank(a) < rank(b) ? b : a;
}

/// "wall_contact, two walls touch"
std::string end_text(io::RunStatus status, const std::string& reason) {
  return std::string(io::to_string(status)) + (reason.empty() ? "" : ", " + reason);
}

void add_notes(ValidationResult& result, const FitRecord& record) {
  if (record.curve_count == 0) {
    result.notes.emplace_back(
        "the file of parameters does not name the curves of its fit: it is not known whether these are held out");
  } else if (record.subjects.size() < record.curve_count) {
    result.notes.emplace_back(
        "the file of parameters names some curves of its fit only by their content, as older versions did: it is not known "
        "whether the same bodies and loads are among these under other names");
  }
  for (const CurveComparison& comparison : result.comparisons) {
    const std::string& name = comparison.load_case().name;
    const meshes::CurveProvenance& provenance = comparison.curve.provenance;
    if (provenance.status != io::RunStatus::completed) {
      result.notes.push_back(name + ": finite elements ended early (" + end_text(provenance.status, provenance.reason) +
                             "): " + std::to_string(comparison.curve.row_count()) + " states are compared");
    }
    if (comparison.response.status == io::RunStatus::completed) continue;
    result.status = worse_of(result.status, comparison.response.status);
    result.notes.push_back(name + ": the surrogate ends after " + std::to_string(comparison.response.values.front().size()) +
                           " of " + std::to_string(comparison.curve.row_count()) + " states (" +
                           end_text(comparison.response.status, comparison.response.reason) + ")");
  }
}

void add_actuations(ValidationResult& result) {
  std::vector<std::string> known;
  for (const CurveComparison& comparison : result.comparisons) {
    const bool is_known = std::find(known.begin(), known.end(), comparison.body) != known.end();
    if (comparison.load_case().kind != LoadCaseKind::inflation || is_known) continue;
    known.push_back(comparison.body);
    result.actuations.push_back(volume_actuation(comparison.curve, comparison.body, result.actuation));
  }
}

void note_picture(ValidationResult& result, const io::PictureOutcome& outcome) {
  if (!outcome.written) result.notes.push_back("no picture: " + outcome.missing);
}

void draw_charts(ValidationResult& result, double aim, const fs::path& folder) {
  const io::PictureOutcome outcome = draw_errors(folder / "errors.png", result.comparisons, aim);
  if (!outcome.written) return note_picture(result, outcome);  // other pictures would fail for the same reason
  for (const CurveComparison& comparison : result.comparisons)
    note_picture(result, draw_curve(folder / ("curve_" + comparison.load_case().name + ".png"), comparison));
}

/// The row of an error in its curve. For a slope it is the row of the largest imposed value.
std::size_t row_of(const CurveComparison& comparison, const ObservableError& error) {
  const std::vector<std::vector<double>> states = states_of(comparison.curve);
  std::size_t found = 0;
  for (std::size_t row = 0; row < states.size(); ++row) {
    const bool same_imposed = !error.imposed || states[row][1] == *error.imposed;
    if (states[row][0] == error.pressure_Pa && same_imposed) found = row;
  }
  return found;
}

/// "furthest off, 1.3 mm: the extent along y changes by -0.9 mm in finite elements, by 0.4 mm in the surrogate"; what is wrong in
/// a pictured state
std::string told(const ObservableError& error) {
  const auto value = [&](double number) {
    if (error.kind == ObservableKind::displacement) return io::millimetres(number);
    return error.kind == ObservableKind::volume ? io::percents(number) : io::shown(number);
  };
  const std::string reference = value(error.reference) + " in finite elements, ";
  const std::string surrogate = value(error.surrogate) + " in the surrogate";
  if (error.kind != ObservableKind::displacement)
    return io::shown_column(error.observable).quantity + ": " + reference + surrogate;
  return "furthest off, " + io::millimetres(std::abs(error.surrogate - error.reference)) + ": " +
         io::displacement_words(error.observable) + " changes by " + reference + "by " + surrogate;
}

/// @param worst the state to show
void show_worst(ValidationResult& result, const ErrorPlace& worst, const SurrogateParameters& parameters,
                const fs::path& curve_file, const fs::path& folder, bool pictures) {
  const CurveComparison& comparison = result.comparisons[worst.comparison];
  const SideBySide sides{.comparison = &comparison,
                         .parameters = parameters,
                         .fields = field_collection(curve_file, comparison.load_case().name),
                         .pictured_row = row_of(comparison, comparison.errors[worst.error]),
                         .finding = told(comparison.errors[worst.error])};
  const SideBySideOutcome outcome = write_side_by_side(folder, sides, pictures);
  result.notes.insert(result.notes.end(), outcome.notes.begin(), outcome.notes.end());
  if (pictures && outcome.states > 0) note_picture(result, outcome.picture);
}

/// The bodies that have displacements or volumes inside the range of validity; the worst body if there are none.
std::vector<std::string> bodies_to_explain(const std::vector<CurveComparison>& comparisons, const std::string& worst) {
  std::vector<std::string> bodies;
  for (const std::string& body : bodies_of(comparisons)) {
    const std::vector<ErrorSummary> summaries = summarise(comparisons, body);
    const auto has = [&](ObservableKind kind) {
      const ErrorSummary* summary = find_summary(summaries, kind);
      return summary != nullptr && summary->count > 0;
    };
    if (has(ObservableKind::displacement) || has(ObservableKind::volume)) bodies.push_back(body);
  }
  return bodies.empty() ? std::vector{worst} : bodies;
}

/// Sets the causes, or the status if the run is stopped.
void explain(ValidationResult& result, const std::string& worst, const SurrogateParameters& parameters,
             const ValidationRunOptions& options) {
  const std::vector<std::string> bodies = bodies_to_explain(result.comparisons, worst);
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    CauseOptions cause{.stop = options.stop};
    cause.begin = [&](OwnPart part) {
      const double done = static_cast<double>(b) + 0.25 * static_cast<double>(part);
      tell(options, comparing + explaining * done / static_cast<double>(bodies.size()),
           bodies[b] + ": " + std::string(to_string(part)) + " fitted to this body");
    };
    result.causes.push_back(explain_miss(result.comparisons, bodies[b], parameters, equilibrium_responder(), cause));
    if (!is_stopped(options)) continue;
    result.status = io::RunStatus::stopped;
    return;
  }
}

}  // namespace

ValidationResult run_validation(const ValidationStudy& study, const SurrogateParameters& parameters, const FitRecord& record,
                                const std::vector<HeldOutCurve>& curves, const fs::path& folder,
                                const ValidationRunOptions& options) {
  assert(!curves.empty());
  ValidationResult result;
  result.actuation = actuation_aim(study.actuation_pressure_Pa, study.actuation_amplitude);
  compare_all(result, parameters, curves, options);
  if (result.status == io::RunStatus::stopped) return result;
  add_notes(result, record);
  add_actuations(result);
  const std::optional<ErrorPlace> worst = worst_error(result.comparisons);
  if (options.explain && worst) {
    explain(result, result.comparisons[worst->comparison].body, parameters, options);
    if (result.status == io::RunStatus::stopped) return result;
  }
  tell(options, comparing + explaining, "files");
  if (options.pictures) draw_charts(result, study.aim, folder);
  if (const auto furthest = furthest_off(result.comparisons))
    show_worst(result, *furthest, parameters, curves[furthest->comparison].file, folder, options.pictures);
  errors_table(result.comparisons).write(folder / "errors.csv");
  summary_table(result.comparisons).write(folder / "summary.csv");
  signs_table(result.comparisons).write(folder / "signs.csv");
  result.expected = expected_errors(result.comparisons, parameters);
  expected_errors_table(result.expected).write(folder / "expected_errors.csv");
  actuation_table(result.actuations, result.actuation).write(folder / "volume_actuation.csv");
  std::string text;
  for (const std::string& line : report_lines(result, study.aim)) text += line + "\n";
  io::write_whole(folder / "report.txt", text);
  return result;
}

std::vector<std::string> report_lines(const ValidationResult& result, double aim) {
  std::vector<std::string> lines = summary_lines(result.comparisons);
  lines.emplace_back(
      "errors are relative to the largest magnitude of the observable in its curve; \"pointwise\" is the median relative to the "
      "value itself");
  for (const std::string& sentence : aim_sentences(result.comparisons, aim)) lines.push_back(sentence);
  if (std::string sentence = furthest_sentence(result.comparisons); !sentence.empty()) lines.push_back(std::move(sentence));
  for (const bool inside : {true, false})
    if (std::string sentence = sign_sentence(result.comparisons, inside); !sentence.empty()) lines.push_back(std::move(sentence));
  if (!result.actuations.empty()) {
    lines.push_back("change of the outer volume by pressure, on finite elements, beside that by which solid voxels are driven (" +
                    io::formatted("%+.3g %%", 100.0 * result.actuation.largest_change) + "):");
    for (const VolumeActuation& actuation : result.actuations) {
      for (const std::string& sentence : actuation_sentences(actuation, result.actuation))
        lines.push_back("  " + actuation.body + ": " + sentence);
    }
  }
  for (const std::string& line : cause_lines(result.causes)) lines.push_back(line);
  for (const std::string& note : result.notes) lines.push_back("note: " + note);
  return lines;
}

}  // namespace menger::voxel
