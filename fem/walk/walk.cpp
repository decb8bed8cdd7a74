#include "fem/walk/walk.h"

#include <cassert>
#include <cmath>
#include <string>
#include <utility>

#include "io/text/input_error.h"
#include "io/text/number_text.h"
#include "meshes/design/design_file.h"

namespace menger::fem {
namespace {

/// Records between two restart points, for methods that can be resumed only from some states: each restart point costs a
/// factorisation.
constexpr std::size_t records_per_restart = 10;

}  // namespace

WalkResult walk(const WalkInput& input, const std::atomic<bool>* stop) {
  check(input);
  PreparedWalk prepared{input};
  prepare(prepared);
  const std::unique_ptr<WalkDynamics> dynamics = explicit_walk_dynamics(prepared, stop);
  Walk walk(prepared, *dynamics);
  walk.start();
  while (walk.is_under_way()) walk.go_on();
  return walk.result();
}

Walk::Walk(const PreparedWalk& walk, WalkDynamics& dynamics)
    : dynamics_(dynamics),
      overlaps_(walk.mesh),
      outermost_(walk.mesh.points),
      times_s_(record_times_s(walk)),
      plena_(walk.mesh.plenum_names.size()),
      chambers_(walk.mesh.chambers.size()) {
  result_.status = io::RunStatus::completed;
  result_.elements = walk.mesh.elements.size();
  result_.nodes = walk.mesh.points.size();
  result_.body_length_m = meshes::body_length_m(walk.design, walk.hollow.level);
  result_.ground_height_m = walk.ground.height_m;
}

/// Returns why what a file holds cannot be the progress of this walk; empty if it can be.
std::string Walk::misfit(const WalkProgress& progress) const {
  if (std::string reason = dynamics_.misfit(progress.state); !reason.empty()) return reason;
  const std::size_t most_records = times_s_.size() + (progress.outcome ? 1 : 0);
  if (progress.records.empty() || progress.records.size() > most_records)
    return "it has " + std::to_string(progress.records.size()) + " records, the walk at most " + std::to_string(most_records);
  double last_s = -1.0;
  for (const WalkRecord& record : progress.records) {
    if (!std::isfinite(record.time_s) || record.time_s <= last_s) return "the times of its records do not ascend";
    if (record.plenum_pressures_Pa.size() != plena_ || record.chamber_volumes_m3.size() != chambers_)
      return "its records are of other chambers";
    last_s = record.time_s;
  }
  return std::isfinite(progress.seconds) && progress.seconds >= 0.0 ? "" : "its wall time is no time";
}

void Walk::resume(WalkProgress progress) {
  if (const std::string reason = misfit(progress); !reason.empty()) throw io::InputError(reason);
  dynamics_.set_state(std::move(progress.state));
  result_.records = std::move(progress.records);
  if (!progress.outcome) return;
  outcome_ = checked(std::move(*progress.outcome));
  result_.status = outcome_->status;
  result_.reason = outcome_->reason;
}

bool Walk::start() {
  if (!result_.records.empty()) return false;
  add_record();
  return true;
}

bool Walk::go_on() {
  assert(is_under_way() && !result_.records.empty());
  make_restart_point();
  WalkOutcome outcome = checked(dynamics_.advance_to(times_s_[result_.records.size() - 1]));
  result_.status = outcome.status;
  result_.reason = outcome.reason;
  if (outcome.status == io::RunStatus::stopped) return false;
  if (outcome.status != io::RunStatus::completed || result_.records.size() == times_s_.size()) outcome_ = std::move(outcome);
  // The time reached by a failed walk may have a record already.
  if (dynamics_.time_s() <= result_.records.back().time_s) return false;
  add_record();
  return true;
}

void Walk::add_record() {
  result_.records.push_back(dynamics_.record());
  result_.records.back().upright = outermost_.upright_axis(dynamics_.displacements_m());
}

WalkProgress Walk::progress() const {
  WalkProgress progress{dynamics_.state(), result_.records, outcome_};
  if (restart_ && !outcome_) {
    progress.state = *restart_;
    progress.records.resize(restart_records_);
  }
  return progress;
}

WalkResult Walk::result() const {
  WalkResult result = result_;
  result.time_s = dynamics_.time_s();
  result.steps = dynamics_.steps();
  return result;
}

/// Changes the outcome to `diverged` if the body has passed through itself.
WalkOutcome Walk::checked(WalkOutcome outcome) const {
  if (outcome.status != io::RunStatus::completed) return outcome;
  const std::optional<BodyOverlap> overlap = overlaps_.find(dynamics_.displacements_m());
  if (!overlap) return outcome;
  return {io::RunStatus::diverged, overlaps_.text_of(*overlap) + " at " + io::number_text(dynamics_.time_s()) + " s"};
}

/// Keeps a state from which the walk can be resumed, and continues from it as a resumed walk would.
void Walk::make_restart_point() {
  if (dynamics_.goes_on_from_any_state() || (result_.records.size() - 1) % records_per_restart != 0) return;
  restart_.emplace(dynamics_.state());
  dynamics_.set_state(*restart_);
  restart_records_ = result_.records.size();
}

}  // namespace menger::fem
