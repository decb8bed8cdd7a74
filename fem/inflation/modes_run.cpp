#include "fem/inflation/modes_run.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "fem/inflation/inflation_problem.h"
#include "fem/inflation/modes_files.h"
#include "fem/inflation/observables.h"
#include "fem/inflation/wall_points.h"
#include "fem/statics/path_drives.h"
#include "io/process/interrupt.h"
#include "io/process/run_folder.h"
#include "io/text/input_error.h"
#include "io/text/number_text.h"
#include "io/text/toml_text.h"
#include "io/text/whole_file.h"

namespace menger::fem {
namespace {

namespace fs = std::filesystem;

/// The least number of modes in the frequency response. The response reaches up to 1.5 times the first frequency. Its truncation
/// error falls with the sixth power of that frequency over the frequency of the last mode.
constexpr int modes_of_response = 20;

/// Returns the study with the path that the options ask for.
InflationStudy with_pressure(InflationStudy study, const ModesOptions& options) {
  if (options.pressure_Pa) {
    study.drives = {{"", {.kind = DriveKind::pressure, .values = {0.0, *options.pressure_Pa}}}};
    study.path.stations.clear();
    study.path.ends_at = {};  // the state that is asked for may lie beyond a limit point of the replaced path
    for (StudyPlate& plate : study.plates) plate.drive = {};  // its knots are those of the replaced path
  }
  return study;
}

void require_density(const InflationStudy& study, const StudyMaterial& material, const std::string& key) {
  if (material.density_kg_per_m3) return;
  throw io::InputError(study.file.string() + ": " + key + ".density_kg_per_m3: missing, and " + material.name +
                       " has none; give a density for vibrations");
}

/// Returns the frequencies of the response: the band in which soft robots walk, 0.5 to 5 Hz, and from there on past the first
/// resonance.
std::vector<double> response_frequencies_Hz(double first_Hz) {
  constexpr int steps_in_band = 45;
  constexpr int steps_beyond = 200;
  std::vector<double> frequencies;
  for (int n = 0; n <= steps_in_band; ++n) frequencies.push_back(0.5 + 0.1 * n);
  const double last_Hz = 1.5 * first_Hz;
  for (int n = 1; n <= steps_beyond && last_Hz > 5.0; ++n) frequencies.push_back(5.0 + (last_Hz - 5.0) * n / steps_beyond);
  return frequencies;
}

/// Returns the sum of fields. @param fields at least one
std::vector<double> sum_of(const std::vector<std::vector<double>>& fields) {
  std::vector<double> sum(fields.front().size(), 0.0);
  for (const std::vector<double>& field : fields)
    std::transform(sum.begin(), sum.end(), field.begin(), sum.begin(), std::plus<>());
  return sum;
}

/// Returns the body without its point supports. Nodes that are held only against drifting carry no force in equilibrium. Under
/// inertia they would, and the whole body would swing about them. Without these supports the drifts are rigid motions.
Body without_point_supports(Body body) {
  body.point_supports.clear();
  return body;
}

/// Makes the problem. Two bodies are kept at once: the one that is inflated, and the one that vibrates.
InflationProblem checked_problem(const InflationStudy& study) {
  InflationProblem problem = make_problem(study);
  require_memory(study, problem.mesh, 2);
  return problem;
}

class ModesRun {
 public:
  ModesRun(const InflationStudy& study, const fs::path& folder, const ModesOptions& options)
      : study_(with_pressure(study, options)),
        folder_("menger-modes", folder),
        options_(options),
        problem_(checked_problem(study_)),
        space_(make_space(problem_.mesh, study_.space_degree(), study_.refinements, MPI_COMM_SELF)),
        points_(locate_points(space_, problem_.points)),
        equilibrium_(space_, problem_.body, study_.solver),
        vibrating_body_(without_point_supports(problem_.body)),
        vibrating_(space_, vibrating_body_, study_.solver) {
    result_.plenum_names = problem_.mesh.plenum_names;
    result_.elements = space_.element_count;
    result_.unknowns = 3 * static_cast<std::size_t>(space_.node_count);
    result_.linear_solver = equilibrium_.linear_choice().text();
    result_.notes = study_.notes;
    result_.notes.insert(result_.notes.end(), problem_.notes.begin(), problem_.notes.end());
    result_.notes.emplace_back(
        "pressures are constant while the body vibrates, as if its chambers were open to a large reservoir; air has no mass");
  }

  ModesResult run() {
    remove_earlier_files();
    follow();
    for (std::size_t n = 0; n < states_.size(); ++n) {
      if (options_.stop != nullptr && options_.stop->load()) {
        io::come_to_stop();
        fail(io::RunStatus::stopped, "stopped by the user");
        break;
      }
      vibrate(n);
    }
    finish();
    return std::move(result_);
  }

 private:
  void fail(io::RunStatus status, const std::string& reason) {
    if (result_.status != io::RunStatus::completed) return;
    result_.status = status;
    result_.reason = reason;
  }

  void tell(double part, const std::string& note) const {
    if (options_.progress) options_.progress(part, note);
  }

  void remove_earlier_files() const {
    folder_.begin({"modes.csv", "frequency_response.csv", "frequency_response.png", "result.toml"});
    remove_mode_shapes(folder_.file("modes"));
  }

  [[nodiscard]] double end() const { return static_cast<double>(problem_.drives.front().values.size()) - 1.0; }

  [[nodiscard]] bool is_wanted(double s) const {
    if (options_.pressure_Pa) return s >= end() - 1e-12;
    return s >= 0.0 && is_knot_or_station(s, study_.path.stations);  // before, the dead loads are still growing
  }

  void follow() {
    const PathObserver observer = [this](const PathPoint& point, const BodyState& state, const PathRestart&) {
      tell(0.5 * std::max(point.s, 0.0) / std::max(end(), 1.0), "inflating");
      if (is_wanted(point.s))
        states_.push_back(
            {{point.step, point.s, point.pressures_Pa, {problem_.mesh.plenum_names, problem_.mesh.region_names}}, state});
    };
    const PathReport report = follow_path(equilibrium_, PathDrives{.plena = problem_.drives, .plates = problem_.plate_drives},
                                          study_.path, observer, options_.stop);
    if (report.status != io::RunStatus::completed) fail(report.status, report.reason);
    if (report.status == io::RunStatus::completed && report.points.back().s < end() - 1e-12)
      result_.notes.push_back("path.end_at_limit_point: the path ended at s = " + io::number_text(report.points.back().s) +
                              ", and no state beyond has modes");
  }

  void vibrate(std::size_t n) {
    const auto& [step, state] = states_[n];
    LinearisedBody body(vibrating_, state);
    const bool is_last = n + 1 == states_.size();
    const int count = is_last ? std::max(options_.mode_count, modes_of_response) : options_.mode_count;
    VibrationReport report = vibrations(body, {.mode_count = count});
    if (report.status != io::RunStatus::completed)
      fail(report.status, "at s = " + io::number_text(step.s) + ": " + report.reason);
    const bool has_modes = report.status == io::RunStatus::completed;
    if (is_last && has_modes) respond(body, report, state);
    const auto kept = std::min(report.modes.size(), static_cast<std::size_t>(options_.mode_count));
    report.frequencies_Hz.resize(kept);
    report.modes.resize(kept);
    if (is_last && has_modes) {
      write_mode_shapes(folder_.file("modes"), space_, state.displacements_m,
                        nodal_fields(vibrating_.assembly(), state.displacements_m, state.plenum_pressures_Pa), step, report);
    }
    report.modes.clear();  // the shapes of all states may be large, and only the last are written
    result_.states.push_back({step.s, step.plenum_pressures_Pa, std::move(report)});
    tell(0.5 + 0.5 * static_cast<double>(n + 1) / static_cast<double>(states_.size()), "modes");
  }

  void respond(LinearisedBody& body, const VibrationReport& modes, const BodyState& state) {
    std::vector<std::vector<double>> gradients;
    for (std::size_t p = 0; p < problem_.body.plenum_count; ++p) gradients.push_back(body.volume_gradient(p));
    const std::vector<double> load = sum_of(gradients);
    body.assembly().read_volume_gradients(state.displacements_m, gradients);
    std::vector<std::string> names{"chamber volume"};
    std::vector<std::vector<double>> observables{sum_of(gradients)};
    std::vector<double> at_once{volume_by_pressure(body.assembly().walls())};
    for (const LocatedPoint& point : points_) {
      const WallRiseSlopes slopes = wall_rise_slopes(body.assembly(), point, state);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        names.push_back(point.point.name + " " + "xyz"[axis]);
        observables.push_back(weights_of(point, slopes, axis));
        at_once.push_back(slopes.by_pressure_m_per_Pa[axis]);
      }
    }
    const std::vector<double> frequencies_Hz = response_frequencies_Hz(modes.frequencies_Hz.front());
    FrequencyResponse response = frequency_response(body, modes, load, observables,
                                                    {.frequencies_Hz = frequencies_Hz, .loss_factor = options_.loss_factor});
    if (response.status != io::RunStatus::completed) {
      fail(response.status, response.reason);
      return;
    }
    result_.frequencies_Hz = frequencies_Hz;
    for (std::size_t w = 0; w < names.size(); ++w) {
      // What pressure does to walls between their nodes follows it as a spring does.
      for (std::optional<std::complex<double>>& amplitude : response.amplitudes[w])
        if (amplitude) *amplitude += at_once[w] / std::complex(1.0, options_.loss_factor);
      result_.curves.push_back({names[w], w == 0 ? "m3" : "m", std::move(response.amplitudes[w])});
    }
  }

  /// Returns how much volume 1 Pa in all plena gives to walls that bulge between their nodes, m^3/Pa.
  [[nodiscard]] double volume_by_pressure(const PressedWalls& walls) const {
    double volume_by_pressure = 0.0;
    for (std::size_t p = 0; p < problem_.body.plenum_count; ++p)
      for (std::size_t q = 0; q < problem_.body.plenum_count; ++q) volume_by_pressure += walls.volume_by_pressure(p, q);
    return volume_by_pressure;
  }

  /// Returns the weights of all components in the displacement of a point along an axis.
  [[nodiscard]] std::vector<double> weights_of(const LocatedPoint& point, const WallRiseSlopes& slopes, std::size_t axis) const {
    std::vector<double> weights(3 * space_.positions.size(), 0.0);
    for (std::size_t a = 0; a < point.nodes.size(); ++a) {
      const std::size_t first = 3 * static_cast<std::size_t>(point.nodes[a]);
      weights[first + axis] += point.weights[a];
      if (!study_.has_thin_walls()) continue;
      for (std::size_t i = 0; i < 3; ++i) weights[first + i] += slopes.by_displacement[axis][3 * a + i];
    }
    return weights;
  }

  void finish() {
    modes_table(result_).write(folder_.file("modes.csv"));
    if (!result_.curves.empty()) {
      frequency_response_table(result_).write(folder_.file("frequency_response.csv"));
      if (study_.output.pictures) {
        const io::PictureOutcome picture = draw_frequency_response(folder_.file("frequency_response.png"), result_);
        if (!picture.written) result_.notes.push_back("no picture: " + picture.missing);
      }
    }
    result_.seconds = folder_.seconds();
    io::write_whole(folder_.file("result.toml"), modes_result_text(result_));
    io::TomlText parameters;
    parameters.add("linear_solver", result_.linear_solver);
    parameters.add("mode_count", options_.mode_count).add("loss_factor", options_.loss_factor).lines(resolved_text(study_));
    folder_.finish(parameters.text(), study_.inputs);
  }

  struct Visited {
    FieldStep step;
    BodyState state;
  };

  InflationStudy study_;
  io::RunFolder folder_;
  const ModesOptions& options_;
  InflationProblem problem_;
  Space space_;
  std::vector<LocatedPoint> points_;
  Equilibrium equilibrium_;
  Body vibrating_body_;
  Equilibrium vibrating_;
  std::vector<Visited> states_;
  ModesResult result_;
};

}  // namespace

ModesResult run_modes(const InflationStudy& study, const fs::path& folder, const ModesOptions& options) {
  require_density(study, study.material, "material");
  for (const auto& [region, material] : study.region_materials)
    require_density(study, material, "material.regions \"" + region + "\"");
  io::require_writable_folder(folder);
  return ModesRun(study, folder, options).run();
}

}  // namespace menger::fem
