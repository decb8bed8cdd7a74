#include "fem/inflation/inflation_run.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>
#include <utility>

#include "fem/inflation/field_output.h"
#include "fem/inflation/inflation_charts.h"
#include "fem/inflation/inflation_picture.h"
#include "fem/inflation/inflation_problem.h"
#include "fem/inflation/inflation_tables.h"
#include "fem/inflation/path_checkpoint.h"
#include "fem/inflation/wall_points.h"
#include "fem/space/rank_agreement.h"
#include "fem/statics/body_ends.h"
#include "io/process/run_folder.h"
#include "io/text/formatted.h"
#include "io/text/input_error.h"
#include "io/text/joined_text.h"
#include "io/text/number_text.h"
#include "io/text/toml_text.h"
#include "io/text/version.h"
#include "io/text/whole_file.h"

namespace menger::fem {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view checkpoint_name = "path.checkpoint";

/// Thrown by the observer to end a path: it has no other means.
struct EndOfPath {
  io::RunStatus status;
  std::string reason;
};

/// Returns whether a drive asks for less air than at rest.
bool is_vacuum(const PlenumDrive& drive) {
  const double rest = drive.kind == DriveKind::pressure ? 0.0 : 1.0;
  return std::any_of(drive.values.begin(), drive.values.end(), [&](double value) { return value < rest; });
}

/// Makes the problem on every rank, and throws on all of them if one fails: a file may be unreadable for one rank only.
InflationProblem agreed_problem(const InflationStudy& study, MPI_Comm communicator) {
  InflationProblem problem;
  on_every_rank(communicator, [&] {
    problem = make_problem(study);
    require_memory(study, problem.mesh);
  });
  return problem;
}

class InflationRun {
 public:
  InflationRun(const InflationStudy& study, const fs::path& folder, const InflationOptions& options)
      : study_(study),
        folder_("menger-inflate", folder),
        options_(options),
        problem_(agreed_problem(study, options.communicator)),
        space_(make_space(problem_.mesh, study.space_degree(), study.refinements, options.communicator)),
        points_(locate_points(space_, problem_.points)),
        ends_(space_, problem_.low, problem_.high),
        equilibrium_(space_, problem_.body, study.solver),
        fields_(folder, options.communicator) {
    MPI_Comm_rank(options.communicator, &rank_);
    MPI_Comm_size(options.communicator, &rank_count_);
    result_.plenum_names = problem_.mesh.plenum_names;
    for (const meshes::Chamber& chamber : problem_.mesh.chambers) result_.chamber_names.push_back(chamber.name);
    for (const LocatedPoint& point : points_) result_.point_names.push_back(point.point.name);
    for (const StudyPlate& plate : study.plates) result_.plate_names.push_back(plate.name);
    result_.elements = space_.element_count;
    result_.unknowns = 3 * static_cast<std::size_t>(space_.node_count);
    result_.linear_solver = equilibrium_.linear_choice().text();
    result_.element_size_m = std::cbrt(problem_.solid_volume_m3 / static_cast<double>(space_.element_count));
    result_.notes = study.notes;
    result_.notes.insert(result_.notes.end(), problem_.notes.begin(), problem_.notes.end());
    on_every_rank(options.communicator, [&] { check_vacuum(); });
  }

  InflationResult run() {
    resume_or_begin();
    if (rank_ == 0 && options_.begun) options_.begun(result_.notes);
    if (const auto refusal = strict_refusal())
      conclude(*refusal);
    else if (progress_.outcome)
      conclude(*progress_.outcome);
    else
      follow();
    note_stretches();
    finish();
    return std::move(result_);
  }

 private:
  [[nodiscard]] bool is_due(int step) const { return study_.output.fields && step % study_.output.fields_every == 0; }

  [[nodiscard]] FieldStep field_step(const PathPoint& point) const {
    return {point.step, point.s, point.pressures_Pa, {problem_.mesh.plenum_names, problem_.mesh.region_names}};
  }

  /// Returns everything that a checkpoint depends on: the path, its named points, the version, and the instruction set. The
  /// pressures of elements are stored in batches as wide as the kernels of the instruction set.
  [[nodiscard]] std::string identity() const {
    std::string text = path_text(study_);
    text += "version = " + std::string(io::version()) + "\n";
    text += "instruction_set = " + std::string(best_element_kernels().instruction_set) + "\n";
    for (const NamedPoint& point : problem_.points) {
      text += point.name;
      for (const double x : point.position) text += " " + io::number_text(x);
      text += "\n";
    }
    return text;
  }

  [[nodiscard]] const StudyMaterial& material_of(std::size_t region) const {
    const auto own = study_.region_materials.find(problem_.mesh.region_names[region]);
    return own != study_.region_materials.end() ? own->second : study_.material;
  }

  void check_vacuum() {
    const bool vacuum = std::any_of(problem_.drives.begin(), problem_.drives.end(), is_vacuum);
    for (std::size_t region = 0; vacuum && region < problem_.mesh.region_names.size(); ++region) {
      const StudyMaterial& material = material_of(region);
      if (material.smallest_stretch < 1.0) continue;
      const std::string note = "the path goes below ambient pressure, and the law of region \"" +
                               problem_.mesh.region_names[region] + "\" (" + material.name +
                               ") was fitted to stretch alone (smallest_stretch = 1): how it is compressed is not known";
      if (options_.strict) throw io::InputError(study_.file.string() + ": " + note);
      result_.notes.push_back(note);
    }
  }

  /// Returns why what a checkpoint holds cannot be the progress of this path, empty if it can: its hash says that the file is
  /// whole, but not what was written.
  [[nodiscard]] std::string misfit_of(const PathProgress& progress) {
    const PathRestart& restart = progress.restart;
    const std::size_t plena = problem_.body.plenum_count;
    const std::size_t count = restart.points.size();
    if (restart.states.size() != restart.s.size() || restart.states.empty() != restart.points.empty())
      return "it has " + std::to_string(restart.states.size()) + " states of " + std::to_string(count) + " points";
    if (progress.observations.size() != count || progress.extent_changes_m.size() != count)
      return "it has other observations than points";
    for (std::size_t n = 0; n < count; ++n) {
      const PathPoint& point = restart.points[n];
      const bool fits = point.pressures_Pa.size() == plena && point.plenum_volumes_m3.size() == plena &&
                        point.work_volumes_m3.size() == plena &&
                        point.chamber_volumes_m3.size() == problem_.mesh.chambers.size() &&
                        point.plates.size() == study_.plates.size() && progress.observations[n].size() == points_.size();
      if (!fits || !std::isfinite(point.s)) return "it has a point of another body";
    }
    for (const BodyState& state : restart.states)
      if (!can_be_of_body(state)) return "it has a state of another size, or with a number that is not finite";
    const auto has_all_plena = [&](const std::vector<LimitPoint>& found) {
      return std::ranges::all_of(found, [&](const LimitPoint& limit) { return limit.plenum < plena; });
    };
    if (!has_all_plena(restart.limit_points) || (progress.outcome && !has_all_plena(progress.outcome->limit_points)))
      return "it has a limit point of a plenum that is not there";
    const bool has_times = std::ranges::all_of(restart.s, [](double s) { return std::isfinite(s); }) &&
                           std::isfinite(restart.next_step) && !std::isnan(restart.failed_s);
    return has_times ? "" : "it has a step whose length is not a number";
  }

  [[nodiscard]] bool can_be_of_body(const BodyState& state) {
    const auto are_finite = [](const std::vector<double>& numbers) {
      return std::ranges::all_of(numbers, [](double number) { return std::isfinite(number); });
    };
    const bool has_size = state.displacements_m.size() == 3 * space_.positions.size() &&
                          state.plenum_pressures_Pa.size() == problem_.body.plenum_count &&
                          (state.element_pressures_Pa.empty() ||
                           state.element_pressures_Pa.size() == equilibrium_.assembly().elements().pressure_count());
    return has_size && are_finite(state.displacements_m) && are_finite(state.plenum_pressures_Pa) &&
           are_finite(state.element_pressures_Pa);
  }

  void resume_or_begin() {
    const fs::path checkpoint = folder_.file(checkpoint_name);
    if (!options_.restart) {
      const auto misfit = [this](const PathProgress& progress) { return misfit_of(progress); };
      if (auto earlier = read_checkpoint(checkpoint, identity(), options_.communicator, misfit)) progress_ = std::move(*earlier);
    }
    result_.resumed_points = progress_.restart.points.size();
    result_.path.points = progress_.restart.points;
    result_.observations = progress_.observations;
    result_.extent_changes_m = progress_.extent_changes_m;
    // from here on no file of an earlier run may be mistaken for one of this run, even if this one is killed
    const bool ended = progress_.outcome.has_value();
    on_first_rank(options_.communicator, [&] {
      folder_.begin({"result.toml"});
      if (!ended || study_.output.pictures)
        folder_.remove({"chamber.png", "pv_curve.png", "displacement.png"});  // else those of an ended path stay true
      if (progress_.restart.points.empty()) folder_.remove({checkpoint_name, "curves.csv"});
    });
    if (ended && !study_.output.fields) return;  // the same holds for its fields
    std::vector<FieldStep> kept;
    for (const PathPoint& point : progress_.restart.points) {
      if (is_due(point.step)) kept.push_back(field_step(point));
    }
    fields_.keep_only(kept);
  }

  void follow() {
    const PathObserver observer = [this](const PathPoint& point, const BodyState& state, const PathRestart& restart) {
      accept(point, state, restart);
    };
    const PathRestart resumed = progress_.restart;
    const bool goes_on = !resumed.points.empty();
    PathOutcome outcome;
    try {
      const PathReport report = follow_path(equilibrium_, PathDrives{.plena = problem_.drives, .plates = problem_.plate_drives},
                                            study_.path, observer, options_.stop, goes_on ? &resumed : nullptr);
      outcome = {report.status, report.reason, report.limit_points, report.rejected_steps};
      result_.path.factorisations = report.factorisations;
      is_told_to_stop_ = report.status == io::RunStatus::stopped;
    } catch (const EndOfPath& end) {
      outcome = ended_here(end.status, end.reason);
    }
    conclude(outcome);
    if (outcome.status == io::RunStatus::stopped) return;
    progress_.outcome = std::move(outcome);
    if (!progress_.restart.points.empty())
      write_checkpoint(folder_.file(checkpoint_name), identity(), progress_, options_.communicator);
  }

  void conclude(const PathOutcome& outcome) {
    result_.path.status = outcome.status;
    result_.path.reason = outcome.reason;
    result_.path.limit_points = outcome.limit_points;
    result_.path.rejected_steps = outcome.rejected_steps;
  }

  /// Returns an outcome that ends the path at the last point that was reached.
  [[nodiscard]] PathOutcome ended_here(io::RunStatus status, const std::string& reason) const {
    return {status, reason, progress_.restart.limit_points, progress_.restart.rejected_steps};
  }

  /// Returns the outcome with `strict` if a point of an earlier run has left the range of a law. It applies to this run only: the
  /// checkpoint keeps how the path itself ended.
  [[nodiscard]] std::optional<PathOutcome> strict_refusal() const {
    if (!options_.strict) return std::nullopt;
    for (const auto& observations : progress_.observations) {
      if (const auto excess = largest_excess(observations)) return ended_here(io::RunStatus::stopped, excess->text);
    }
    return std::nullopt;
  }

  void accept(const PathPoint& point, const BodyState& state, const PathRestart& restart) {
    const NodalFields fields = nodal_fields(equilibrium_.assembly(), state.displacements_m, state.plenum_pressures_Pa);
    progress_.restart = restart;
    progress_.observations.push_back(observe(space_, points_, state.displacements_m, fields));
    if (study_.has_thin_walls()) add_wall_rises(equilibrium_.assembly(), points_, state, progress_.observations.back());
    progress_.extent_changes_m.push_back(extent_changes_m(state));
    result_.path.points = restart.points;
    result_.observations = progress_.observations;
    result_.extent_changes_m = progress_.extent_changes_m;
    if (is_due(point.step)) fields_.add(space_, state.displacements_m, fields, field_step(point));
    write_curves();
    write_checkpoint(folder_.file(checkpoint_name), identity(), progress_, options_.communicator);
    if (rank_ == 0 && options_.progress) {
      options_.progress(point, restart.points.front().s, static_cast<double>(problem_.drives.front().values.size()) - 1.0);
    }
    end_where_strict(progress_.observations.back());
  }

  [[nodiscard]] std::optional<Point> extent_changes_m(const BodyState& state) const {
    if (!ends_.are_faces()) return std::nullopt;
    return study_.supports.kind == SupportKind::free ? ends_.extent_changes_without_rotation_m(state.displacements_m)
                                                     : ends_.extent_changes_m(state.displacements_m);
  }

  void end_where_strict(const std::vector<PointObservation>& observations) const {
    if (!options_.strict) return;
    if (const auto excess = largest_excess(observations)) throw EndOfPath{io::RunStatus::stopped, excess->text};
  }

  void write_curves() const {
    on_first_rank(options_.communicator, [&] { curves_table(result_).write(folder_.file("curves.csv")); });
  }

  struct Excess {
    double factor;
    std::string text;
  };

  /// Returns the named point whose stretch exceeds the range of its law most, if any does.
  [[nodiscard]] std::optional<Excess> largest_excess(const std::vector<PointObservation>& observations) const {
    std::optional<Excess> largest;
    for (std::size_t p = 0; p < points_.size(); ++p) {
      const StudyMaterial& material = material_of(points_[p].region);
      const double factor = observations[p].largest_stretch / material.largest_stretch;
      if (factor <= 1.0 || (largest && factor <= largest->factor)) continue;
      largest = {factor, "the stretch at \"" + points_[p].point.name + "\" reaches " +
                             io::shown(observations[p].largest_stretch) + ", beyond the range of its law (" + material.name +
                             "): largest_stretch = " + io::shown(material.largest_stretch)};
    }
    return largest;
  }

  void note_stretches() {
    std::optional<Excess> largest;
    for (const auto& observations : result_.observations) {
      auto excess = largest_excess(observations);
      if (excess && (!largest || excess->factor > largest->factor)) largest = std::move(excess);
    }
    if (largest) result_.notes.push_back(largest->text);
  }

  void finish() {
    if (!result_.path.points.empty() && !is_told_to_stop_) {
      const BodyState& last = progress_.restart.states.back();
      const NodalFields fields = nodal_fields(equilibrium_.assembly(), last.displacements_m, last.plenum_pressures_Pa);
      const PathPoint& point = result_.path.points.back();
      if (study_.output.fields && !is_due(point.step)) fields_.add(space_, last.displacements_m, fields, field_step(point));
      write_curves();
      if (study_.output.pictures) draw(last, fields);
    }
    result_.seconds = folder_.seconds();
    on_first_rank(options_.communicator, [&] {
      io::write_whole(folder_.file("result.toml"), result_text(result_));
      folder_.finish(io::TomlText()
                         .add("processes", rank_count_)
                         .add("linear_solver", result_.linear_solver)
                         .lines(resolved_text(study_))
                         .text(),
                     study_.inputs);
    });
  }

  void draw(const BodyState& last, const NodalFields& fields) {
    const DeformedBody body = gather_deformed_body(space_, last.displacements_m, fields);
    on_first_rank(options_.communicator, [&] {
      const io::PictureOutcome chamber = draw_deformed_body(folder_.file("chamber.png"), body, caption());
      if (!chamber.written) {
        result_.notes.push_back("no pictures: " + chamber.missing);
        return;
      }
      const io::PictureOutcome curve = draw_pressure_volume(folder_.file("pv_curve.png"), result_);
      if (!curve.written) result_.notes.push_back("no plot of pressure over volume: " + curve.missing);
      const io::PictureOutcome moved = draw_displacements(folder_.file("displacement.png"), result_);
      if (!moved.written) result_.notes.push_back("no plot of displacements: " + moved.missing);
    });
  }

  /// "2.5 kPa", or which plena have which pressure where two pressures are left, or their range
  [[nodiscard]] std::string pressures_text(const std::vector<double>& pressures_Pa) const {
    const auto [low, high] = std::ranges::minmax(pressures_Pa);
    const auto kilopascals = [](double pressure_Pa) { return io::shown(1e-3 * pressure_Pa); };
    if (low == high) return kilopascals(low) + " kPa";
    constexpr std::size_t most_named = 4;
    std::vector<std::string> at_low;
    std::vector<std::string> at_high;
    for (std::size_t n = 0; n < pressures_Pa.size(); ++n) {
      if (pressures_Pa[n] == low) at_low.push_back(result_.plenum_names[n]);
      if (pressures_Pa[n] == high) at_high.push_back(result_.plenum_names[n]);
    }
    if (pressures_Pa.size() > most_named || at_low.size() + at_high.size() < pressures_Pa.size())
      return kilopascals(low) + " to " + kilopascals(high) + " kPa";
    return kilopascals(low) + " kPa in " + io::joined(at_low) + ", " + kilopascals(high) + " kPa in " + io::joined(at_high);
  }

  [[nodiscard]] std::string caption() const {
    const PathPoint& first = result_.path.points.front();
    const PathPoint& last = result_.path.points.back();
    double before = 0.0;
    double after = 0.0;
    for (const double volume : first.plenum_volumes_m3) before += volume;
    for (const double volume : last.plenum_volumes_m3) after += volume;
    return pressures_text(last.pressures_Pa) +
           (last.plenum_volumes_m3.size() > 1 ? ", volume of all chambers " : ", chamber volume ") +
           io::formatted("%+.3g", 100.0 * (after / before - 1.0)) + " %";
  }

  const InflationStudy& study_;
  io::RunFolder folder_;
  const InflationOptions& options_;
  InflationProblem problem_;
  Space space_;
  std::vector<LocatedPoint> points_;
  BodyEnds ends_;
  Equilibrium equilibrium_;
  FieldSeries fields_;
  int rank_ = 0;
  int rank_count_ = 1;
  bool is_told_to_stop_ = false;  ///< what is not needed to resume is then left out, since the user waits
  PathProgress progress_;
  InflationResult result_;
};

}  // namespace

InflationResult run_inflation(const InflationStudy& study, const fs::path& folder, const InflationOptions& options) {
  on_first_rank(options.communicator, [&] {
    io::refuse_results_of_another(folder, "menger-inflate");
    io::require_writable_folder(folder);
  });
  return InflationRun(study, folder, options).run();
}

}  // namespace menger::fem
