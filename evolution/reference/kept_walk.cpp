#include "evolution/reference/kept_walk.h"

#include <chrono>
#include <memory>
#include <string>
#include <utility>

#include "fem/locomotion/locomotion_checkpoint.h"
#include "fem/walk/walk.h"
#include "io/text/input_error.h"

namespace menger::evolution {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr double checkpoint_interval_s = 20.0;  // of wall time

/// The checkpoint of a walk in its folder.
class Keeper {
 public:
  Keeper(const fs::path& folder, std::string identity) : identity_(std::move(identity)) {
    if (!folder.empty()) file_ = folder / "locomotion.checkpoint";
  }

  void resume(fem::Walk& walk) {
    if (file_.empty()) return;
    try {
      earlier_s_ = fem::resume_from_checkpoint(walk, file_, identity_).value_or(0.0);
    } catch (const io::InputError&) {  // the walk can be made anew
    }
  }

  void keep_now_and_then(const fem::Walk& walk) {
    if (std::chrono::duration<double>(Clock::now() - last_).count() >= checkpoint_interval_s) keep(walk);
  }

  void keep(const fem::Walk& walk) {
    if (file_.empty()) return;
    fem::WalkProgress progress = walk.progress();
    progress.seconds = seconds();
    fem::write_locomotion_checkpoint(file_, identity_, progress);
    last_ = Clock::now();
  }

  /// Returns the wall time with that of the calls before.
  [[nodiscard]] double seconds() const { return earlier_s_ + std::chrono::duration<double>(Clock::now() - start_).count(); }

 private:
  fs::path file_;
  std::string identity_;
  double earlier_s_ = 0.0;
  Clock::time_point start_ = Clock::now();
  Clock::time_point last_ = start_;
};

}  // namespace

fem::LocomotionResult kept_walk(const LocomotionJob& job, const fs::path& folder, const std::atomic<bool>& stop) {
  fem::LocomotionStudy study = job.study;
  fem::prepare(study);
  const std::unique_ptr<fem::WalkDynamics> dynamics = fem::explicit_walk_dynamics(study, &stop);
  fem::Walk walk(study, *dynamics);
  Keeper keeper(folder, fem::locomotion_identity(study, *dynamics));
  keeper.resume(walk);
  walk.start();
  while (walk.is_under_way()) {
    walk.go_on();
    keeper.keep_now_and_then(walk);
  }
  if (walk.is_stopped()) keeper.keep(walk);
  fem::LocomotionResult result = fem::named_result(study, walk.result());
  result.seconds = keeper.seconds();
  return result;
}

}  // namespace menger::evolution
