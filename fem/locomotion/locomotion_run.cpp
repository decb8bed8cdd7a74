#include "fem/locomotion/locomotion_run.h"

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "fem/locomotion/locomotion_checkpoint.h"
#include "fem/locomotion/locomotion_frames.h"
#include "fem/locomotion/locomotion_picture.h"
#include "fem/walk/walk.h"
#include "io/process/interrupt.h"
#include "io/process/run_folder.h"
#include "io/text/input_error.h"
#include "io/text/number_text.h"
#include "io/text/toml_text.h"
#include "io/text/whole_file.h"
#include "meshes/load_cases/walk_agreement.h"

namespace menger::fem {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

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
        walk_(study, *dynamics_),
        frames_(folder, study.mesh, study.material.law) {
    identity_ = locomotion_identity(study, *dynamics_);
    if (!options.restart) earlier_s_ = resume_from_checkpoint(walk_, folder / checkpoint_name, identity_);
  }

  LocomotionResult run() {
    begin_or_resume();
    if (walk_.start() && study_.output.frames) add_frame();
    if (walk_.is_under_way()) follow();
    finish();
    return std::move(result_);
  }

 private:
  [[nodiscard]] std::size_t last_record() const { return walk_.records().size() - 1; }
  [[nodiscard]] bool is_due(std::size_t record) const { return record % study_.output.records_per_frame == 0; }

  void begin_or_resume() {
    // From here on no file of an earlier run may pass for one of this run, also if this one is killed.
    folder_.begin({locomotion_files.begin(), locomotion_files.end()});
    std::vector<double> frame_times_s;
    if (earlier_s_) {
      folder_.add_seconds(*earlier_s_);
      seconds_ = *earlier_s_;
      for (std::size_t r = 0; study_.output.frames && r < walk_.records().size(); ++r) {
        // The end of a run always has a frame.
        if (is_due(r) || (walk_.outcome() && r == last_record())) frame_times_s.push_back(walk_.records()[r].time_s);
      }
    } else {
      folder_.remove({checkpoint_name});
    }
    frames_.keep_only(frame_times_s);
  }

  void follow() {
    if (options_.started) options_.started(dynamics_->time_s());
    while (walk_.is_under_way()) {
      const bool is_new = walk_.go_on();
      if (walk_.is_stopped()) break;
      // The end always has a frame, also where its record was there before.
      if (study_.output.frames && (is_due(last_record()) ? is_new : !walk_.is_under_way())) add_frame();
      if (options_.progress) options_.progress(dynamics_->time_s());
      if (walk_.is_under_way() && seconds_since(last_checkpoint_) >= options_.checkpoint_interval_seconds) write_checkpoint();
    }
    if (walk_.is_stopped()) io::come_to_stop();
    seconds_ = write_checkpoint();
  }

  void add_frame() {
    const std::vector<double> displacements = dynamics_->displacements_m();
    const std::vector<double> velocities = dynamics_->velocities_m_per_s();
    const WalkRecord& record = walk_.records().back();
    frames_.add({record.time_s, displacements, velocities, record.plenum_pressures_Pa});
  }

  /// Writes the checkpoint.
  /// @return the wall time written in it
  double write_checkpoint() {
    WalkProgress progress = walk_.progress();
    progress.seconds = folder_.seconds();
    write_locomotion_checkpoint(folder_.file(checkpoint_name), identity_, progress);
    last_checkpoint_ = Clock::now();
    return progress.seconds;
  }

  void finish() {
    result_ = named_result(study_, walk_.result());
    result_.notes = study_.notes;
    result_.seconds = seconds_;
    trajectory_table(result_).write(folder_.file("trajectory.csv"));
    if (study_.output.pictures && result_.status != io::RunStatus::stopped) draw();
    io::write_whole(folder_.file("locomotion.toml"), result_text(result_));
    folder_.finish(io::TomlText().add("notes", result_.notes).lines(locomotion_text(study_)).text(), study_.inputs);
  }

  void draw() {
    const WalkRecord& last = result_.records.back();
    const Point moved = difference(last.centre_of_mass_m, result_.records.front().centre_of_mass_m);
    const std::string caption = meshes::moved_text(study_.design.name, result_.time_s, moved[0], moved[1]);
    const std::vector<double> displacements = dynamics_->displacements_m();
    const std::vector<double> velocities = dynamics_->velocities_m_per_s();
    const io::PictureOutcome robot =
        draw_moved_body(folder_.file("robot.png"), study_.mesh,
                        {result_.time_s, displacements, velocities, last.plenum_pressures_Pa}, result_, caption);
    if (!robot.written) {
      result_.notes.push_back("no pictures: " + robot.missing);
      return;
    }
    if (const auto plot = plot_locomotion(folder_.file("trajectory.png"), result_, study_.design.name); !plot.written)
      result_.notes.push_back("no plot of the trajectory: " + plot.missing);
  }

  const LocomotionStudy& study_;
  io::RunFolder folder_;
  const LocomotionRunOptions& options_;
  Clock::time_point last_checkpoint_ = Clock::now();
  std::unique_ptr<WalkDynamics> dynamics_;
  Walk walk_;
  LocomotionFrames frames_;
  std::string identity_;
  std::optional<double> earlier_s_;  ///< wall time of an earlier run that goes on
  double seconds_ = 0.0;             ///< wall time when the last checkpoint was written
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
