#include "fem/load_cases/load_case_set.h"

#include <algorithm>
#include <array>
#include <ctime>
#include <optional>
#include <string_view>
#include <system_error>

#include "fem/load_cases/load_case_body.h"
#include "fem/load_cases/load_case_chart.h"
#include "fem/load_cases/load_case_fields.h"
#include "fem/load_cases/pressure_range.h"
#include "fem/space/rank_agreement.h"
#include "io/process/run_folder.h"
#include "io/study/study_text.h"
#include "io/text/content_hash.h"
#include "io/text/version.h"
#include "io/text/whole_file.h"
#include "materials/laws/law_file.h"
#include "meshes/design/kept_geometry.h"
#include "meshes/load_cases/load_case_file.h"

namespace menger::fem {
namespace {

namespace fs = std::filesystem;
using meshes::ResponseCurve;

double processor_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// The meanings that the measures of an inflation have had under the same names. They are part of the keys of cached responses. A
/// new meaning is appended and increases the version by one, so that responses with an earlier meaning are not found.
constexpr std::array<std::string_view, 2> meanings_of_inflation_measures{"", "extents and top without rotation\n"};
constexpr int inflation_measures_version = 1;
static_assert(inflation_measures_version + 1 == static_cast<int>(meanings_of_inflation_measures.size()));

/// Returns the part of the key of a cached response that depends on the meaning of its measures.
std::string_view measures_of(meshes::LoadCaseKind kind) {
  return kind == meshes::LoadCaseKind::inflation ? meanings_of_inflation_measures[inflation_measures_version] : "";
}

/// Returns an inflation of the body of a case that finds its own pressures.
CaseRequest inflation_of(const CaseRequest& request) {
  CaseRequest inflation = request;
  inflation.load_case.kind = meshes::LoadCaseKind::inflation;
  inflation.load_case.pressures_Pa.clear();
  inflation.load_case.imposed.clear();
  inflation.pressure_fractions.clear();
  inflation.state_count = CaseRequest{}.state_count;
  return inflation;
}

class SetRun {
 public:
  SetRun(const LoadCaseStudy& study, const fs::path& folder, const SetOptions& options)
      : study_(study), folder_("menger-load-cases", folder), options_(options) {}

  std::vector<CaseOutcome> run() {
    on_first_rank(options_.communicator, [&] { folder_.begin({}); });
    std::vector<CaseOutcome> outcomes;
    for (index_ = 0; index_ < study_.cases.size(); ++index_) {
      outcomes.push_back(run_case(study_.cases[index_]));
      if (options_.finished) options_.finished(outcomes.back());
      if (outcomes.back().status == io::RunStatus::stopped) break;
    }
    on_first_rank(options_.communicator, [&] { folder_.finish(io::described_text(study_), study_.inputs); });
    return outcomes;
  }

 private:
  CaseOutcome run_case(const CaseRequest& request) {
    CaseOutcome outcome{.name = request.load_case.name, .kind = request.load_case.kind};
    const double start_s = processor_seconds();
    was_computed_ = false;
    CaseRequest resolved = request;
    std::optional<ResponseCurve> curve;
    if (!request.pressure_fractions.empty()) {
      const CaseOutcome range = resolve(resolved);
      if (resolved.pressure_fractions.empty()) curve = response_to(resolved, outcome, options_.fields);
      add_range(range, outcome);
      if (curve) {
        curve->provenance.status = outcome.status;
        curve->provenance.reason = outcome.reason;
      }
    } else {
      curve = response_to(resolved, outcome, options_.fields);
    }
    outcome.from_cache = !was_computed_;
    outcome.seconds = processor_seconds() - start_s;
    if (!curve) {
      if (outcome.status != io::RunStatus::stopped) {
        fields_of(resolved).remove_others();
        remove_earlier(outcome);
      }
      return outcome;
    }
    outcome.states = curve->row_count();
    fields_of(resolved).remove_others();  // before the curve is written, to which they do not belong
    curve->provenance.load_case.name = request.load_case.name;
    curve->provenance.silicone = study_.material.silicone;  // a cached response may have been made under another name
    curve->provenance.relative_uncertainty = study_.relative_uncertainty;
    curve->provenance.inputs = study_.inputs;
    on_first_rank(options_.communicator, [&] {
      meshes::write_response_curve(folder_.path(), *curve);
      const std::string picture = request.load_case.name + ".png";
      folder_.remove({picture});  // of an earlier curve, if none is drawn now
      if (options_.pictures) outcome.missing_picture = draw_response_curve(folder_.file(picture), *curve).missing;
    });
    return outcome;
  }

  /// Removes files that an earlier run of another set left under the name of a case that reached no state. They must not be
  /// mistaken for its response.
  void remove_earlier(CaseOutcome& outcome) const {
    int removed = 0;
    on_first_rank(options_.communicator, [&] {
      for (const std::string_view extension : {".toml", ".csv", ".png"}) {
        const fs::path file = folder_.file(outcome.name + std::string(extension));
        std::error_code error;
        removed += fs::remove(file, error) ? 1 : 0;
        if (error) throw io::InputError(file.string() + ": cannot be removed: " + error.message());
      }
    });
    MPI_Bcast(&removed, 1, MPI_INT, 0, options_.communicator);
    if (removed > 0) outcome.reason += "; the curve of an earlier run under this name was removed";
  }

  /// Replaces the pressure fractions of a case by pressures.
  /// @return how the inflation ended that finds their range; if it reached no state, the fractions stay
  CaseOutcome resolve(CaseRequest& request) {
    CaseOutcome range{.name = request.load_case.name};
    const auto inflation = response_to(inflation_of(request), range, false);
    if (!inflation) {
      range.reason = "the range of pressures could not be found: " + range.reason;
      if (range.status == io::RunStatus::completed) range.status = io::RunStatus::not_converged;
      return range;
    }
    const std::vector<double>& reached = inflation->column("pressure_Pa");
    const double lowest = inflation->provenance.contact_pressure_Pa.value_or(std::min(reached.front(), 0.0));
    const auto& limit = inflation->provenance.limit_pressure_Pa;
    const double highest = limit ? safe_share * *limit : std::max(reached.back(), 0.0);
    request.load_case.pressures_Pa = pressures_at(request.pressure_fractions, lowest, highest);
    request.pressure_fractions.clear();
    if (range.status != io::RunStatus::completed) {
      range.reason = "the inflation that gives its pressures ended early (" + std::string(io::to_string(range.status)) +
                     "): " + range.reason;
    }
    return range;
  }

  /// Passes the status and the reason of the range to the case. A case whose range ended early did not get the intended
  /// pressures, even if it completed at them.
  static void add_range(const CaseOutcome& range, CaseOutcome& outcome) {
    if (range.status == io::RunStatus::completed) return;
    if (outcome.status == io::RunStatus::completed) outcome.status = range.status;
    outcome.reason = range.reason + (outcome.reason.empty() ? "" : "; " + outcome.reason);
  }

  /// Returns the curve of a case from the cache, or computes and caches it. Empty if no state was reached or the user stopped it.
  /// @param with_fields do not use a cached response without fields
  std::optional<ResponseCurve> response_to(const CaseRequest& request, CaseOutcome& outcome, bool with_fields) {
    const std::string key = key_of(request);
    LoadCaseFields fields = fields_of(request);
    auto known = from_cache(key);
    if (known && (!with_fields || fields.are_kept())) {
      outcome.status = known->provenance.status;
      outcome.reason = known->provenance.reason;
      return known;
    }
    was_computed_ = true;
    CaseOptions options{.stop = options_.stop, .communicator = options_.communicator};
    if (options_.progress) {
      options.progress = [&](double part, const std::string& note) {
        options_.progress(index_, part, request.load_case.name + ", " + note);
      };
    }
    if (with_fields) {
      options.observer = [&](std::size_t place, Equilibrium& equilibrium, const PathPoint& point, const BodyState& state) {
        fields.add(place, equilibrium, point, state);
      };
    }
    const CaseResponse response = run_load_case(request, study_.material, options);
    outcome.status = response.status;
    outcome.reason = response.reason;
    if (response.rows.empty() || response.status == io::RunStatus::stopped) {
      if (with_fields) fields.discard();
      return std::nullopt;
    }
    if (with_fields) fields.publish();
    ResponseCurve curve = curve_of(request, response);
    curve.provenance.load_case.name = key;
    on_first_rank(options_.communicator, [&] { meshes::write_response_curve(folder_.file("cache"), curve); });
    return curve;
  }

  [[nodiscard]] std::string key_of(const CaseRequest& request) const {
    const auto chambers = request.load_case.per_phase ? meshes::ChamberLayout::per_phase : meshes::ChamberLayout::single;
    return io::content_hash(case_text(request, study_.material) + std::string(measures_of(request.load_case.kind)) +
                            std::string(meshes::kept_geometry(chambers)) + std::string(io::version()));
  }

  [[nodiscard]] LoadCaseFields fields_of(const CaseRequest& request) const {
    return {folder_.path(), request.load_case.name, key_of(request), options_.communicator};
  }

  [[nodiscard]] std::optional<ResponseCurve> from_cache(const std::string& key) const {
    const fs::path file = folder_.file("cache") / (key + ".toml");
    std::error_code ignored;
    if (!fs::exists(file, ignored)) return std::nullopt;
    try {
      return meshes::read_response_curve(file);
    } catch (const io::InputError&) {  // damaged: computed again and overwritten
      return std::nullopt;
    }
  }

  [[nodiscard]] ResponseCurve curve_of(const CaseRequest& request, const CaseResponse& response) const {
    ResponseCurve curve;
    meshes::CurveProvenance& provenance = curve.provenance;
    provenance.load_case = request.load_case;
    provenance.load_case.pressures_Pa = response.pressures_Pa;
    provenance.silicone = study_.material.silicone;
    provenance.law = materials::law_line(study_.material.law);
    provenance.shear_modulus_Pa = materials::shear_modulus_at_rest_Pa(study_.material.law);
    provenance.density_kg_m3 = *study_.material.density_kg_per_m3;
    provenance.model = elements_text(request.elements) + ", " + std::to_string(response.unknowns) + " unknowns";
    if (response.linear == LinearMethod::iterative) provenance.model += ", iterative solver";
    provenance.relative_uncertainty = study_.relative_uncertainty;
    provenance.status = response.status;
    provenance.reason = response.reason;
    provenance.limit_pressure_Pa = response.limit_pressure_Pa;
    provenance.contact_pressure_Pa = response.contact_pressure_Pa;
    curve.columns = meshes::response_columns(request.load_case);
    curve.values.resize(curve.columns.size());
    for (const std::vector<double>& row : response.rows)
      for (std::size_t column = 0; column < row.size(); ++column) curve.values[column].push_back(row[column]);
    return curve;
  }

  const LoadCaseStudy& study_;
  io::RunFolder folder_;
  const SetOptions& options_;
  std::size_t index_ = 0;
  bool was_computed_ = false;
};

}  // namespace

std::vector<CaseOutcome> run_load_case_set(const LoadCaseStudy& study, const fs::path& folder, const SetOptions& options) {
  // checked first, before other cases run for hours
  for (const CaseRequest& request : study.cases) require_meshable(request.load_case, request.elements);
  on_first_rank(options.communicator, [&] {
    io::refuse_results_of_another(folder, "menger-load-cases");
    io::require_writable_folder(folder / "cache");
  });
  return SetRun(study, folder, options).run();
}

}  // namespace menger::fem
