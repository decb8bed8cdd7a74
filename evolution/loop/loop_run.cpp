#include "evolution/loop/loop_run.h"

#include <unistd.h>

#include <algorithm>
#include <cassert>
#include <chrono>
#include <iterator>
#include <map>
#include <optional>
#include <ostream>
#include <set>
#include <system_error>
#include <utility>
#include <vector>

#include "evolution/findings/contact_verdict.h"
#include "evolution/findings/loop_verdict.h"
#include "evolution/findings/pressure_verdict.h"
#include "evolution/findings/stage_finding.h"
#include "evolution/loop/loop_forecast.h"
#include "evolution/loop/loop_stages.h"
#include "evolution/loop/loop_state.h"
#include "evolution/loop/loop_verdict_file.h"
#include "evolution/loop/robot_changes.h"
#include "io/process/child_program.h"
#include "io/process/exit_code.h"
#include "io/process/file_lock.h"
#include "io/process/interrupt.h"
#include "io/process/progress.h"
#include "io/process/run_folder.h"
#include "io/process/told_progress.h"
#include "io/shown/shown_quantity.h"
#include "io/study/study_text.h"
#include "io/text/content_hash.h"
#include "io/text/input_error.h"
#include "io/text/is_file.h"
#include "io/text/joined_text.h"
#include "io/text/manifest.h"
#include "io/text/printable.h"
#include "io/text/whole_file.h"
#include "meshes/robot/command_study.h"
#include "meshes/robot/robot_file.h"

namespace menger::evolution {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

/// Lines of a log that are shown where a program failed.
constexpr std::size_t shown_log_lines = 3;

/// Returns the last lines of a log, each after two spaces.
std::string end_of_log(const fs::path& log) {
  if (!io::is_file(log)) return "";
  const std::string text = io::read_whole(log);
  std::vector<std::string> lines;
  for (std::size_t start = 0; start < text.size();) {
    const std::size_t end = std::min(text.find('\n', start), text.size());
    lines.push_back("  " + io::printable(text.substr(start, end - start)) + "\n");
    start = end + 1;
  }
  if (lines.size() > shown_log_lines) lines.erase(lines.begin(), lines.end() - shown_log_lines);
  return io::joined(lines, "");
}

/// The files below a folder, counted from `results`. Archives grow and shrink files of their own.
std::vector<std::string> files_below(const fs::path& folder, const fs::path& results) {
  std::vector<std::string> files;
  std::error_code error;
  for (fs::recursive_directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    const bool is_passing =
        name.find(".sqlite-") != std::string::npos || name.ends_with(".lock") || name.find("checkpoint") != std::string::npos;
    if (entry->is_regular_file(error) && !is_passing) files.push_back(entry->path().lexically_relative(results).string());
  }
  std::sort(files.begin(), files.end());
  return files;
}

/// Removes the checkpoints of a folder. A program that is stopped before it has read its study leaves those of an earlier study,
/// and would refuse them when it goes on.
void remove_checkpoints(const fs::path& folder) {
  std::vector<fs::path> checkpoints;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    if (entry->path().extension() == ".checkpoint") checkpoints.push_back(entry->path());
  }
  for (const fs::path& checkpoint : checkpoints) io::remove_if_there(checkpoint);
}

/// Runs the stages of one loop.
class LoopRun {
 public:
  LoopRun(const LoopRequest& request, meshes::Robot robot, std::ostream& out)
      : request_(request),
        robot_(std::move(robot)),
        places_(fs::absolute(request.robot).lexically_normal(),
                request.results.empty() ? fs::path() : fs::absolute(request.results).lexically_normal()),
        stages_(loop_stages(robot_, places_, io::is_file(request.programs / "menger-report"))),
        out_(out) {
    if (!request_.until.empty()) {
      last_ = &stage_named(stages_, "--until", request_.until);
    }
    if (!request_.only.empty()) only_ = &stage_named(stages_, "--only", request_.only);
    for (const LoopStage& stage : stages_) {
      static_cast<void>(io::program_in(request_.programs, stage.program));
      for (const std::string& helper : stage.helpers) static_cast<void>(io::program_in(request_.programs, helper));
    }
    // Noted before the stages read them: people change files while a long run goes on.
    io::note_input(inputs_, request_.robot);
    io::note_input(inputs_, robot_.silicone_file);
  }

  int write_studies() {
    io::require_writable_folder(places_.results);
    const io::FileLock lock(places_.results / "loop");
    state_.emplace(places_.results / loop_state_name);
    refuse_other_robot();
    meshes::take_champion(robot_, places_);
    std::vector<meshes::RobotStudy> studies;
    for (const meshes::RobotStudy study : meshes::robot_studies()) {
      if (meshes::missing_because(robot_, study).empty() && (robot_.has_body() || !needs_body(study))) studies.push_back(study);
    }
    meshes::write_studies(robot_, studies, places_);
    for (const meshes::RobotStudy study : studies) {
      const bool has_stage = std::ranges::any_of(
          stages_, [&](const LoopStage& stage) { return std::ranges::find(stage.studies, study) != stage.studies.end(); });
      out_ << shown(places_.study(study)) << (has_stage ? "" : "  (menger comes with these parameters; fitted with --fit)")
           << '\n';
    }
    if (!robot_.has_body()) out_ << "the other studies need the body, which the stages evolve and export find\n";
    out_ << "menger loop runs these commands, one after the other, in the folder of the results:\n  cd " << shown(places_.results)
         << "\n";
    for (const LoopStage& stage : stages_) {
      const bool is_report = stage.program == "menger-report";
      out_ << "  menger " << stage.program.substr(std::string("menger-").size()) << ' '
           << (is_report ? "." : io::joined(stage.arguments, " ")) << '\n';
    }
    out_ << std::flush;
    return io::exit_code::done;
  }

  int run() {
    refuse_other_results();
    io::refuse_results_of_another(places_.results, "menger-loop");
    io::require_writable_folder(places_.results);  // first: people named this one
    io::require_writable_folder(places_.results / "logs");
    const io::FileLock lock(places_.results / "loop");
    state_.emplace(places_.results / loop_state_name);
    refuse_other_robot();
    tell_plan();
    io::ask_for_progress(told_file());
    int code = io::exit_code::done;
    for (std::size_t n = 0; n < stages_.size(); ++n) {
      const LoopStage& stage = stages_[n];
      if (only_ == nullptr && stage.program == "menger-report") {
        note_verdict();
        write_manifest();  // of which the page tells
      }
      if (only_ == nullptr || only_ == &stage) {
        const int ended = run_stage(stage, n);
        if (ended == io::exit_code::interrupted) return leave_interrupted();
        code = worse(code, ended);
      }
      if (last_ == &stage) break;
    }
    io::remove_if_there(told_file());
    if (only_ != nullptr) {
      take_other_stages();
    } else if (last_ != nullptr && last_->program != "menger-report") {
      take_other_stages();
      note_verdict();
    }
    write_manifest();
    tell_end(code);
    return code;
  }

 private:
  /// A path as a person who stands in the present folder writes it.
  static std::string shown(const fs::path& path) {
    const fs::path near = path.lexically_proximate(fs::current_path());
    return (near.empty() || *near.begin() == ".." ? path : near).string();
  }

  [[nodiscard]] fs::path told_file() const { return places_.results / "logs" / ".progress"; }
  [[nodiscard]] fs::path log_of(const LoopStage& stage) const { return places_.results / "logs" / (stage.name + ".txt"); }
  [[nodiscard]] fs::path from_results(const fs::path& path) const { return path.is_absolute() ? path : places_.results / path; }

  static int worse(int one, int other) {
    for (const int code : {1, io::exit_code::bad_input, io::exit_code::numerical}) {
      if (one == code || other == code) return code;
    }
    return io::exit_code::done;
  }

  /// Refuses a folder, named with -o, that has what the loop would replace and no loop has made.
  void refuse_other_results() const {
    if (request_.results.empty() || io::is_file(places_.results / loop_state_name)) return;
    std::vector<std::string> names;
    std::error_code error;
    for (const char* file : {"manifest.json", "report.html"})
      if (fs::exists(places_.results / file, error)) names.emplace_back(file);
    for (const LoopStage& stage : stages_)
      if (fs::exists(places_.results / stage.name, error)) names.push_back(stage.name);
    if (!names.empty())
      throw io::InputError("-o " + shown(places_.results) + ": holds " + io::joined(names) +
                           ", which no loop has made and this one would replace: name another folder, or remove them");
  }

  /// Refuses a folder with the results of another robot that is still there: they would be replaced one by one.
  void refuse_other_robot() {
    const fs::path file = fs::absolute(request_.robot).lexically_normal();
    const fs::path own = file.lexically_relative(places_.results);  // so that a copy of robot and results keeps them
    const fs::path other = (places_.results / state_->robot()).lexically_normal();
    std::error_code error;
    const bool is_other = !state_->robot().empty() && io::is_file(other) && !fs::equivalent(other, file, error);
    if (is_other) {
      throw io::InputError(shown(places_.results) + ": has the results of " + shown(other) +
                           ", which this loop would replace: name another folder with -o, as in -o " +
                           shown(file.parent_path() / (file.stem().string() + "_results")));
    }
    state_->set_robot(own);
  }

  void tell_plan() {
    out_ << meshes::summary_of(robot_) << "; results in " << shown(places_.results) << '\n';
    for (const std::string& line : forecast(false)) out_ << line << '\n';
    for (const std::string& change : robot_changes(places_.results / "manifest.json", io::described_text(robot_)))
      out_ << "changed since the last finished run: " << change << '\n';
    out_ << std::flush;
  }

  /// What is to be expected of the robot, as far as it is known now: a fit and a validation tell more.
  /// @param is_found whether this run found the body of a robot that evolves
  [[nodiscard]] std::vector<std::string> forecast(bool is_found) const {
    meshes::Robot body = robot_;
    meshes::take_champion(body, places_);
    return loop_forecast(body, places_, is_found);
  }

  std::string label(std::size_t n) const {
    const std::string whole = std::to_string(stages_.size());
    std::string number = std::to_string(n + 1);
    number.insert(0, whole.size() - number.size(), ' ');
    std::string name = stages_[n].name;
    std::size_t width = 0;
    for (const LoopStage& stage : stages_) width = std::max(width, stage.name.size());
    name.resize(width, ' ');
    return number + " of " + whole + "  " + name;
  }

  /// Returns what decides the results of a stage. A change of any of it changes the text.
  std::string key_of(const LoopStage& stage) {
    std::string text = stage.program + " " + io::joined(stage.arguments, " ") + "\n" + program_hash(stage.program) + "\n";
    for (const std::string& helper : stage.helpers) text += helper + " " + program_hash(helper) + "\n";
    // A name decides nothing but what the page is called.
    if (stage.program == "menger-report") text += robot_.design.name + "\n";
    meshes::Robot unnamed = robot_;
    unnamed.design.name.clear();
    for (const meshes::RobotStudy study : stage.studies) text += study_text(unnamed, study, places_) + "\n";
    for (const fs::path& file : stage.reads) {
      const fs::path whole = from_results(file);
      text += file.string() + " " + (io::is_file(whole) ? io::file_hash(whole) : "missing") + "\n";
    }
    for (const std::string& name : stage.follows) {
      const StageRecord* record = state_->find(name);
      text += name + " " + (record == nullptr ? "missing" : record->key + " " + std::string(to_string(record->status))) + "\n";
    }
    return io::content_hash(text);
  }

  std::string program_hash(const std::string& program) {
    std::string& hash = program_hashes_[program];
    if (hash.empty()) hash = io::file_hash(request_.programs / program);
    return hash;
  }

  [[nodiscard]] std::string manifest_hash(const LoopStage& stage) const {
    return stage.manifest.empty() ? "" : io::hash_of_results(places_.results / stage.manifest);
  }

  /// Whether a stage has ended before with the same key, and its files are still there, or those of the same command by hand.
  [[nodiscard]] bool is_current(const LoopStage& stage, const StageRecord* record, const std::string& key) const {
    return record != nullptr && record->has_ended() && record->key == key && record->manifest_hash == manifest_hash(stage) &&
           std::all_of(record->files.begin(), record->files.end(),
                       [&](const std::string& file) { return io::is_file(places_.results / file); });
  }

  /// Whether the results of a stage are those that it would give now.
  [[nodiscard]] bool is_up_to_date(const LoopStage& stage) {
    return current_.contains(stage.name) || (is_current(stage, state_->find(stage.name), key_of(stage)) && lacks(stage).empty());
  }

  /// Returns which stage that this one needs has no result that is up to date; empty if none.
  [[nodiscard]] std::string lacks(const LoopStage& stage) {
    for (const std::string& name : stage.needs) {
      const auto needed = std::ranges::find(stages_, name, &LoopStage::name);
      const StageRecord* record = state_->find(name);
      const bool is_usable = record != nullptr && (record->status == StageStatus::done ||
                                                   (record->status == StageStatus::numerical && needed->is_usable_early));
      if (is_usable && is_up_to_date(*needed) && !(name == "export" && !io::is_file(places_.champion()))) continue;
      return name;
    }
    return "";
  }

  /// Returns why a stage cannot run, or says nothing of this robot; empty if it runs.
  [[nodiscard]] std::string left_out_because(const LoopStage& stage) {
    if (const std::string lacking = lacks(stage); !lacking.empty()) {
      std::string reason = "needs a result of " + lacking;
      if (only_ != nullptr)
        throw io::InputError("--only " + stage.name + ": " + reason + ": first menger loop --until " + lacking);
      return reason;
    }
    if (stage.needs_body && is_body_refused_) return "mesh refused the body";
    if (only_ == nullptr && stage.name == "report" && current_.empty()) return "no stage has results";
    if (stage.needs_body) meshes::take_champion(robot_, places_);
    for (const meshes::RobotStudy study : stage.studies) {
      // Of a body that a search found this is known only now.
      if (std::string reason = meshes::missing_because(robot_, study); !reason.empty()) return reason;
    }
    const bool is_limit_known = current_.contains("inflate") && current_.contains("limit");
    if (only_ == nullptr && stage.is_driven && is_limit_known) {
      if (std::string reason = overdrive(places_.results, robot_); !reason.empty()) return reason;
    }
    const bool is_validation = std::ranges::find(stage.studies, meshes::RobotStudy::validate) != stage.studies.end();
    return is_validation && current_.contains("inflate") ? early_contact(places_.results, robot_) : "";
  }

  /// Notes that a stage has no results of this robot. What an earlier robot or a run that was stopped left in its folder loses
  /// its manifest, so that no report takes it for results.
  void hide_results(const LoopStage& stage) const {
    // Archives go on from what they have, and are set aside for another study.
    if (!stage.manifest.empty() && !stage.is_set_aside) io::remove_if_there(places_.results / stage.manifest);
  }

  /// @return the exit code of the stage
  int run_stage(const LoopStage& stage, std::size_t n) {
    if (const std::string reason = left_out_because(stage); !reason.empty()) {
      hide_results(stage);
      out_ << label(n) << "  left out: " << reason << std::endl;
      state_->set(stage.name, {.status = StageStatus::left_out, .finding = reason});
      return io::exit_code::done;  // the stage that decided this has told its own
    }
    meshes::write_studies(robot_, stage.studies, places_);
    const std::string key = key_of(stage);
    const StageRecord* earlier = state_->find(stage.name);
    if (is_current(stage, earlier, key)) {
      current_.insert(stage.name);
      // Told anew: what a stage found is compared with the drive, which may have changed since.
      const std::string finding = stage_finding(stage.name, places_.results, robot_);
      out_ << label(n) << "  as before" << (finding.empty() ? "" : ": " + finding) << std::endl;
      return earlier->status == StageStatus::numerical ? io::exit_code::numerical : io::exit_code::done;
    }
    return run_program(stage, n, key);
  }

  int run_program(const LoopStage& stage, std::size_t n, const std::string& key) {
    const StageRecord* earlier = state_->find(stage.name);
    const bool goes_on = earlier != nullptr && earlier->key == key && !earlier->has_ended();
    StageRecord record{.key = key};
    if (goes_on) record.seconds = earlier->seconds;
    record.takes_over = goes_on ? earlier->takes_over : earlier != nullptr;
    const bool has_ended_before = earlier != nullptr && earlier->has_ended() && earlier->seconds > 0.0;
    const double expected_s = has_ended_before ? std::max(earlier->seconds, 1.0) : stage.expected_s;
    earlier_time_ = has_ended_before ? io::duration_text(earlier->seconds) : "";
    if (stage.may_restart && !goes_on) remove_checkpoints(places_.results / stage.name);
    state_->set(stage.name, record);
    std::vector<std::string> arguments = stage.arguments;
    if (stage.may_restart && !goes_on) arguments.emplace_back("--restart");
    begin_line(n, ::isatty(STDERR_FILENO) != 1);

    io::ChildOutcome outcome = start(stage, n, arguments, expected_s);
    // A program also refuses a lock or a full disk: only results of another study make way.
    const bool makes_way = outcome.exit_code == io::exit_code::bad_input && stage.is_set_aside && record.takes_over;
    if (const std::optional<fs::path> aside = makes_way ? set_aside(stage, n) : std::nullopt) {
      outcome = start(stage, n, arguments, expected_s);
      if (outcome.exit_code == io::exit_code::bad_input) {
        put_back(stage, n, *aside);
      } else {
        record.takes_over = false;
        begin_line(n);
        out_ << "(its earlier results are now in " << shown(*aside) << ") ";
      }
    }
    record.seconds += outcome.wall_s;
    record.status = status_of(outcome);
    const bool has_ended = record.has_ended();
    if (has_ended) {
      current_.insert(stage.name);
      record.takes_over = false;
      record.finding = stage_finding(stage.name, places_.results, robot_);
      record.manifest_hash = manifest_hash(stage);
      record.files = files_below(places_.results / stage.name, places_.results);
    } else {
      record.finding = std::string(to_string(record.status));
      hide_results(stage);
      if (stage.name == "mesh" && record.status == StageStatus::refused) is_body_refused_ = true;
    }
    state_->set(stage.name, record);

    begin_line(n);
    if (goes_on && record.has_ended() && !stage.begins_anew) out_ << "(went on from where it was stopped) ";
    tell(stage, record, outcome);
    is_line_begun_ = false;
    if (record.status == StageStatus::interrupted) return io::exit_code::interrupted;
    if (record.status == StageStatus::refused) return io::exit_code::bad_input;
    if (record.status == StageStatus::failed) return 1;
    return outcome.exit_code;
  }

  /// Begins the line of a stage, unless it has begun. @param is_shown whether it is; at a terminal a bar takes its place first
  void begin_line(std::size_t n, bool is_shown = true) {
    if (is_shown && !is_line_begun_) out_ << label(n) << "  " << std::flush;
    is_line_begun_ = is_shown;
  }

  /// Says how far a stage is, where no terminal has a bar that shows it. A stage is several jobs, and its program tells of one at
  /// a time: how long the others take is known from an earlier run alone.
  /// @param told by its program, if it has told anything
  void tell_waiting(const LoopStage& stage, std::size_t n, double seconds, const std::optional<io::ToldProgress>& told) {
    if (::isatty(STDERR_FILENO) == 1 || seconds < next_told_s_) return;
    next_told_s_ = seconds + request_.tell_every_s;
    std::string text = "runs for " + io::duration_text(seconds);
    if (!earlier_time_.empty()) text += ", took " + earlier_time_ + " before";
    if (told && told->part > 0.0 && told->part < 1.0) text += ", " + io::percents(told->part) + " of its present job are done";
    if (told && !told->note.empty()) text += " (" + told->note + ")";
    begin_line(n);
    out_ << text << "; see " << shown(log_of(stage)) << std::endl;
    is_line_begun_ = false;
  }

  io::ChildOutcome start(const LoopStage& stage, std::size_t n, const std::vector<std::string>& arguments, double expected_s) {
    io::remove_if_there(told_file());
    next_told_s_ = request_.tell_every_s;
    io::ChildProgram child{.program = request_.programs / stage.program,
                           .arguments = arguments,
                           .folder = places_.results,
                           .out = log_of(stage),
                           .err = log_of(stage)};
    child.stop = request_.stop;
    io::Progress bar(label(n), 1.0);
    child.waiting = [&](double seconds) {
      // A program may need longer for what it has than this one would be given: its checkpoint, or its walks.
      if (request_.stop != nullptr && *request_.stop) io::come_to_stop();
      const std::optional<io::ToldProgress> told = io::told_progress(told_file());
      // A program that has told nothing yet is taken to need as long as expected.
      tell_waiting(stage, n, seconds, told);
      bar.update(told ? told->part : std::min(seconds / expected_s, 0.99), told ? told->note : "");
    };
    return io::run_child(child);
  }

  static StageStatus status_of(const io::ChildOutcome& outcome) {
    if (outcome.end == io::ChildEnd::stopped || outcome.exit_code == io::exit_code::interrupted) return StageStatus::interrupted;
    if (outcome.end != io::ChildEnd::exited) return StageStatus::failed;
    if (outcome.exit_code == io::exit_code::done) return StageStatus::done;
    if (outcome.exit_code == io::exit_code::numerical) return StageStatus::numerical;
    return outcome.exit_code == io::exit_code::bad_input ? StageStatus::refused : StageStatus::failed;
  }

  void tell(const LoopStage& stage, const StageRecord& record, const io::ChildOutcome& outcome) {
    const std::string log = shown(log_of(stage));
    switch (record.status) {
      case StageStatus::done:
      case StageStatus::numerical:
        out_ << io::duration_text(record.seconds) << (record.finding.empty() ? "" : ": " + record.finding);
        if (record.status == StageStatus::numerical) out_ << " (ended early; see " << log << ")";
        out_ << '\n';
        break;
      case StageStatus::interrupted:
        out_ << "stopped\n";
        break;
      case StageStatus::refused:
      case StageStatus::failed:
        out_ << (record.status == StageStatus::refused ? "refused its input" : "failed");
        if (outcome.signal != 0) out_ << " by signal " << outcome.signal;
        out_ << "; the end of " << log << ":\n" << end_of_log(log_of(stage));
        break;
      case StageStatus::begun:
      case StageStatus::left_out:
        break;
    }
    out_ << std::flush;
  }

  /// The file that the program of a stage writes to, and locks.
  [[nodiscard]] fs::path output_of(const LoopStage& stage) const {
    const auto option = std::ranges::find(stage.arguments, "-o");
    assert(stage.arguments.end() - option > 1);
    return from_results(*std::next(option));
  }

  /// Returns the lock of the archive in the folder of a stage; nothing, and says so, if another process writes to it: a search
  /// that was started by hand.
  std::optional<io::FileLock> lock_of_archive(const LoopStage& stage, std::size_t n) {
    const fs::path archive = output_of(stage);
    std::string reason = "is in use by another process";
    try {
      if (std::optional<io::FileLock> lock = io::FileLock::if_free(archive)) return lock;
    } catch (const io::InputError&) {  // such as an archive of two names: whether anything writes to it is not known
      reason = "cannot be locked";
    }
    begin_line(n);
    out_ << "(the archive " << shown(archive) << ' ' << reason << ": its folder stays where it is) ";
    return std::nullopt;
  }

  /// Moves the folder of a stage to earlier/, so that another study can take its place. A folder with an archive that is in use
  /// stays. @return where it is; empty if there was none, or it stays
  std::optional<fs::path> set_aside(const LoopStage& stage, std::size_t n) {
    const fs::path folder = places_.results / stage.name;
    std::error_code error;
    if (!fs::is_directory(folder, error) || fs::is_empty(folder, error)) return std::nullopt;
    const std::optional<io::FileLock> lock = lock_of_archive(stage, n);
    if (!lock) return std::nullopt;
    fs::path aside;
    for (int number = 1; aside.empty() || fs::exists(aside, error); ++number)
      aside = places_.results / set_aside_folder / (stage.name + "_" + std::to_string(number));
    fs::create_directories(aside.parent_path(), error);
    fs::rename(folder, aside, error);
    if (error) throw io::InputError(folder.string() + ": cannot be moved to " + aside.string() + ": " + error.message());
    // The lock does not find its file by its new name.
    fs::remove(aside / (output_of(stage).filename().string() + ".lock"), error);
    return aside;
  }

  /// Moves what set_aside() moved back, in place of what a refused start left. It stays where another search has begun meanwhile.
  void put_back(const LoopStage& stage, std::size_t n, const fs::path& aside) {
    const fs::path folder = places_.results / stage.name;
    std::error_code error;
    const bool is_there = fs::is_directory(folder, error);
    const std::optional<io::FileLock> lock = is_there ? lock_of_archive(stage, n) : std::nullopt;
    if (is_there && !lock) {
      out_ << "(its earlier results are now in " << shown(aside) << ") ";
      return;
    }
    fs::remove_all(folder, error);
    fs::rename(aside, folder, error);
    if (error) throw io::InputError(aside.string() + ": cannot be moved back to " + folder.string() + ": " + error.message());
    fs::remove(aside.parent_path(), error);  // only where it is empty
  }

  int leave_interrupted() {
    io::come_to_stop();
    io::remove_if_there(told_file());
    out_ << "Stopped. Finished stages are kept. Run the same command again to go on." << std::endl;
    return io::exit_code::interrupted;
  }

  void write_manifest() const {
    io::Manifest manifest{
        .program = "menger-loop", .parameters = io::described_text(robot_), .seed = std::nullopt, .inputs = inputs_};
    if (robot_.search) manifest.seed = robot_.search->seed;
    for (const LoopStage& stage : stages_) {
      if (const StageRecord* record = state_->find(stage.name)) manifest.seconds += record->seconds;
    }
    io::write_manifest(places_.results, manifest);
  }

  /// Counts the results of stages that this call left alone among those of this robot, where they are.
  void take_other_stages() {
    meshes::take_champion(robot_, places_);
    for (const LoopStage& stage : stages_) {
      if (current_.contains(stage.name) || (stage.needs_body && !robot_.has_body()) || stage.program == "menger-report") continue;
      if (lacks(stage).empty() && is_current(stage, state_->find(stage.name), key_of(stage))) current_.insert(stage.name);
    }
  }

  /// What came out. It is found once, so that the report and the terminal say it in the same words.
  const std::vector<std::string>& verdict() {
    if (!verdict_) {
      verdict_ = loop_verdict(places_.results, robot_, current_);
      if (const std::string missing = not_computed(); !missing.empty()) verdict_->insert(verdict_->begin(), missing);
    }
    return *verdict_;
  }

  /// Which stages have no results, although they were to have some.
  std::string not_computed() {
    std::vector<std::string> names;
    for (const LoopStage& stage : stages_) {
      const StageRecord* record = state_->find(stage.name);
      const bool has_failed =
          record != nullptr && (record->status == StageStatus::refused || record->status == StageStatus::failed);
      if (has_failed && stage.program != "menger-report") names.push_back(stage.name);
    }
    if (names.empty()) return "";
    return "Not computed: " + io::joined(names) + ". The end of logs/" + names.front() + ".txt says why.";
  }

  /// Leaves what came out for the report.
  void note_verdict() {
    LoopVerdict noted{.lines = verdict(), .forecast = forecast(current_.contains("export"))};
    if (current_.contains("limit")) noted.softest_limit_Pa = softest_limit_Pa(places_.results, robot_);
    for (const LoopStage& stage : stages_) {
      if (stage.program == "menger-report") continue;
      const std::string hash = manifest_hash(stage);
      if (!hash.empty()) (current_.contains(stage.name) ? noted.results : noted.left_behind)[stage.manifest] = hash;
    }
    for (const std::string& name : state_->names()) {
      if (name == "report" || std::ranges::find(stages_, name, &LoopStage::name) != stages_.end()) continue;
      const std::string hash = io::hash_of_results(places_.results / manifest_of(name));
      if (!hash.empty()) noted.left_behind[manifest_of(name).string()] = hash;
    }
    write_loop_verdict(places_.results, noted);
  }

  void tell_end(int code) {
    if (!verdict().empty()) {
      out_ << "\nWhat came out:\n";
      for (const std::string& line : verdict()) out_ << "- " << line << '\n';
    }
    std::vector<std::string> files;
    for (const auto& [stage, file] : {std::pair{"report", "report.html"},
                                      {"inflate", "inflate/chamber.png"},
                                      {"limit", "limit/pv_curve.png"},
                                      {"validate", "validate/worst.png"},
                                      {"locomote", "locomote/robot.png"},
                                      {"locomote", "locomote/frames.pvd"},
                                      {"export", "export/champion.png"}}) {
      if (current_.contains(stage) && io::is_file(places_.results / file)) files.push_back(shown(places_.results / file));
    }
    for (int n = 1; current_.contains("report"); ++n) {
      const fs::path animation = places_.results / ("report.walk_" + std::to_string(n) + ".gif");
      if (!io::is_file(animation)) break;
      files.push_back(shown(animation));
    }
    if (!files.empty() && only_ == nullptr) out_ << "Look at " << io::joined(files) << ".\n";
    if (code == io::exit_code::numerical) out_ << "Some stages ended early; their lines above say why.\n";
    out_ << std::flush;
  }

  const LoopRequest& request_;
  meshes::Robot robot_;
  meshes::RobotPlaces places_;
  std::vector<LoopStage> stages_;
  std::ostream& out_;
  std::optional<LoopState> state_;
  const LoopStage* last_ = nullptr;
  const LoopStage* only_ = nullptr;
  std::map<std::string, std::string> program_hashes_;
  std::map<std::string, std::string> inputs_;  ///< of the manifest
  std::set<std::string> current_;              ///< stages whose results this call has found or made, for the robot as it is now
  bool is_line_begun_ = false;                 ///< whether the last line waits for what its stage found
  std::string earlier_time_{};                 ///< that the stage took before; empty if it never ended
  double next_told_s_ = 0.0;                   ///< time in a stage at which it is told how far it is
  std::optional<std::vector<std::string>> verdict_;  ///< once all stages before the report have ended
  bool is_body_refused_ = false;                     ///< by menger mesh, in this call
};

}  // namespace

int run_loop(LoopRequest request, std::ostream& out) {
  std::error_code ignored;
  if (fs::is_directory(request.robot, ignored)) request.robot /= "robot.toml";
  meshes::Robot robot = meshes::read_robot(request.robot);
  if (request.fits_anew && robot.parameters)
    throw io::InputError("--fit: " + request.robot.string() + ": surrogate.parameters names a file: nothing is fitted");
  if (request.fits_anew) robot.fits_anew = true;
  LoopRun run(request, std::move(robot), out);
  return request.only_studies ? run.write_studies() : run.run();
}

}  // namespace menger::evolution
