#include "fem/locomotion/locomotion_run.h"

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "fem/contact/body_overlap.h"
#include "fem/locomotion/locomotion_checkpoint.h"
#include "fem/locomotion/locomotion_frames.h"
#include "fem/locomotion/locomotion_picture.h"
#include "io/process/interrupt.h"
#include "io/process/run_folder.h"
#include "io/text/formatted.h"
#include "io/text/input_error.h"
#include "io/text/number_text.h"
#include "io/text/toml_text.h"
#include "io/text/version.h"
#include "io/text/whole_file.h"

namespace menger::fem {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

/// Records between two restart points, for methods that can be resumed only from some states: each restart point costs a
/// factorisation.
constexpr std::size_t records_per_restart = 10;

constexpr std::string_view checkpoint_name = "locomotion.checkpoint";

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// Runs one study, record by record.
class LocomotionRun {
 public:
  LocomotionRun(const LocomotionStudy& study, const fs::path& folder, const LocomotionRunOptions& options)
      : study_(study),
        folder_("menger-locomote", folder),
        options_(options),
        dynamics_(options.make(study, options.stop)),
        overlaps_(study.mesh),
        times_s_(record_times_s(study)),
        frames_(folder) {
    result_.elements = study.mesh.elements.size();
    result_.nodes = study.mesh.points.size();
    result_.body_length_m = body_length_m(study.design, study.hollow.level);
    result_.ground_height_m = study.ground.height_m;
    result_.plenum_names = study.mesh.plenum_names;
    for (const meshes::Chamber& chamber : study.mesh.chambers) result_.chamber_names.push_back(chamber.name);
    result_.notes = study.notes;
    identity_ = locomotion_text(study) + "version = " + std::string(io::version()) +
                "\ninstruction_set = " + dynamics_->machine_text() + "\n";
    if (!options.restart) earlier_ = read_locomotion_checkpoint(folder / checkpoint_name, identity_);
  }

  LocomotionResult run() {
    begin_or_resume();
    if (result_.records.empty()) record();
    if (outcome_)
      conclude(*outcome_);
    else
      follow();
    finish();
    return std::move(result_);
  }

 private:
  [[nodiscard]] bool is_due(std::size_t record) const {
    return study_.output.frames && record % study_.output.records_per_frame == 0;
  }

  void begin_or_resume() {
    // From here on no file of an earlier run may pass for one of this run, also if this one is killed.
    folder_.begin({"locomotion.toml", "trajectory.csv", "robot.png", "trajectory.png"});
    std::vector<double> frame_times_s;
    if (earlier_) {
      dynamics_->set_state(std::move(earlier_->state));
      result_.records = std::move(earlier_->records);
      folder_.add_seconds(earlier_->seconds);
      result_.seconds = earlier_->seconds;
      if (earlier_->outcome) outcome_ = checked(std::move(*earlier_->outcome));
      for (std::size_t r = 0; r < result_.records.size(); ++r) {
        // The end of a run always has a frame.
        if (is_due(r) || (study_.output.frames && outcome_ && r + 1 == result_.records.size()))
          frame_times_s.push_back(result_.records[r].time_s);
      }
    } else {
      folder_.remove({checkpoint_name});
    }
    frames_.keep_only(frame_times_s);
  }

  void follow() {
    if (options_.started) options_.started(dynamics_->time_s());
    LocomotionOutcome outcome;
    while (outcome.status == io::RunStatus::completed && result_.records.size() <= times_s_.size()) {
      make_restart_point();
      outcome = checked(dynamics_->advance_to(times_s_[result_.records.size() - 1]));
      if (outcome.status == io::RunStatus::stopped) break;
      const bool is_last = outcome.status != io::RunStatus::completed || result_.records.size() == times_s_.size();
      // The time reached by a failed run may have a record already, but not the frame of an end.
      if (dynamics_->time_s() > result_.records.back().time_s)
        record(is_last);
      else if (is_last && study_.output.frames && !is_due(result_.records.size() - 1))
        add_frame();
      if (options_.progress) options_.progress(dynamics_->time_s());
      if (!is_last && seconds_since(last_checkpoint_) >= options_.checkpoint_interval_seconds) write_checkpoint();
    }
    conclude(outcome);
    if (outcome.status == io::RunStatus::stopped)
      io::come_to_stop();
    else
      outcome_ = outcome;
    result_.seconds = write_checkpoint();
  }

  /// Changes the outcome to `diverged` if the body has passed through itself.
  [[nodiscard]] LocomotionOutcome checked(LocomotionOutcome outcome) const {
    if (outcome.status != io::RunStatus::completed) return outcome;
    const std::optional<BodyOverlap> overlap = overlaps_.find(dynamics_->displacements_m());
    if (!overlap) return outcome;
    return {io::RunStatus::diverged, overlaps_.text_of(*overlap) + " at " + io::number_text(dynamics_->time_s()) + " s"};
  }

  void record(bool is_last = false) {
    result_.records.push_back(dynamics_->record());
    if (is_due(result_.records.size() - 1) || (is_last && study_.output.frames)) add_frame();
  }

  void add_frame() {
    const std::vector<double> displacements = dynamics_->displacements_m();
    const std::vector<double> velocities = dynamics_->velocities_m_per_s();
    const LocomotionRecord& record = result_.records.back();
    frames_.add(study_.mesh, {record.time_s, displacements, velocities, record.plenum_pressures_Pa});
  }

  /// Keeps a state from which the run can be resumed, and continues from it as a resumed run would.
  void make_restart_point() {
    if (dynamics_->goes_on_from_any_state() || (result_.records.size() - 1) % records_per_restart != 0) return;
    restart_.emplace(dynamics_->state());
    dynamics_->set_state(*restart_);
    restart_records_ = result_.records.size();
  }

  /// Writes the checkpoint.
  /// @return the wall time written in it
  double write_checkpoint() {
    const double seconds = folder_.seconds();
    LocomotionProgress progress{dynamics_->state(), result_.records, outcome_, seconds};
    if (restart_ && !outcome_) {
      progress.state = *restart_;
      progress.records.resize(restart_records_);
    }
    write_locomotion_checkpoint(folder_.file(checkpoint_name), identity_, progress);
    last_checkpoint_ = Clock::now();
    return seconds;
  }

  void conclude(const LocomotionOutcome& outcome) {
    result_.status = outcome.status;
    result_.reason = outcome.reason;
  }

  void finish() {
    result_.time_s = dynamics_->time_s();
    result_.steps = dynamics_->steps();
    trajectory_table(result_).write(folder_.file("trajectory.csv"));
    if (study_.output.pictures && result_.status != io::RunStatus::stopped) draw();
    folder_.finish(io::TomlText().add("notes", result_.notes).lines(locomotion_text(study_)).text(), study_.inputs);
    io::write_whole(folder_.file("locomotion.toml"), result_text(result_));
  }

  void draw() {
    const LocomotionRecord& last = result_.records.back();
    const Point moved = difference(last.centre_of_mass_m, result_.records.front().centre_of_mass_m);
    const std::string caption = study_.design.name + " after " + io::shown(result_.time_s, 3) + " s: its centre moved by (" +
                                io::formatted("%.2f", 1e3 * moved[0]) + ", " + io::formatted("%.2f", 1e3 * moved[1]) + ") mm";
    const std::vector<double> displacements = dynamics_->displacements_m();
    const std::vector<double> velocities = dynamics_->velocities_m_per_s();
    const io::PictureOutcome robot =
        draw_moved_body(folder_.file("robot.png"), study_.mesh,
                        {result_.time_s, displacements, velocities, last.plenum_pressures_Pa}, result_, caption);
    if (!robot.written) {
      result_.notes.push_back("no pictures: " + robot.missing);
      return;
    }
    if (const auto plot = plot_locomotion(folder_.file("trajectory.png"), result_); !plot.written)
      result_.notes.push_back("no plot of the trajectory: " + plot.missing);
  }

  const LocomotionStudy& study_;
  io::RunFolder folder_;
  const LocomotionRunOptions& options_;
  Clock::time_point last_checkpoint_ = Clock::now();
  std::unique_ptr<LocomotionDynamics> dynamics_;
  std::optional<LocomotionState> restart_;  ///< of the last restart point, if the method needs them
  std::size_t restart_records_ = 0;         ///< records up to it
  BodyOverlapSearch overlaps_;
  std::vector<double> times_s_;
  LocomotionFrames frames_;
  std::string identity_;
  std::optional<LocomotionProgress> earlier_;
  std::optional<LocomotionOutcome> outcome_;
  LocomotionResult result_;
};

void begin(std::optional<LocomotionRun>& run, const LocomotionStudy& study, const fs::path& folder,
           const LocomotionRunOptions& options) {
  try {
    run.emplace(study, folder, options);
  } catch (const UnresolvedRelaxation& error) {
    throw io::InputError(study.file.string() +
                         ": material.loss_frequency_Hz = " + io::number_text(study.material.loss.frequency_Hz) + ": " +
                         error.what() + "; choose damping_model = \"kelvin_voigt\", which has no relaxation");
  } catch (const io::InputError& error) {
    throw io::InputError(study.file.string() + ": " + error.what());
  }
}

}  // namespace

LocomotionResult run_locomotion(const LocomotionStudy& study, const fs::path& folder, const LocomotionRunOptions& options) {
  std::optional<LocomotionRun> run;
  begin(run, study, folder, options);
  io::require_writable_folder(folder);
  return run->run();
}

void check_locomotion(const LocomotionStudy& study, const fs::path& folder, const LocomotionRunOptions& options) {
  std::optional<LocomotionRun> run;
  begin(run, study, folder, options);
}

}  // namespace menger::fem
