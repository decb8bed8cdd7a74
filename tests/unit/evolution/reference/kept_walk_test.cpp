#include "evolution/reference/kept_walk.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <iterator>
#include <variant>
#include <vector>

#include "evolution/reference/reevaluation_runner.h"
#include "fem/locomotion/locomotion_checkpoint.h"
#include "fem/walk/walk.h"
#include "io/text/whole_file.h"
#include "tests/support/silicone_archive.h"
#include "tests/support/test_folder.h"

namespace menger::evolution {
namespace {

namespace fs = std::filesystem;

/// The walk of an L of three cells as a search would ask for it, coarse and short.
LocomotionJob job() {
  ReevaluationStudy study = read_reevaluation_study({.archive = "run.sqlite", .file = {}}, tests::silicone_study());
  study.duration_s = 0.06;
  study.record_interval_s = 0.01;
  study.elements.elements.fidelity = fem::Fidelity::draft;
  return locomotion_job(study, study.elements, meshes::Polycube::from_digits(3, 3, 3, "111000000100000000000000000"), "hook",
                        false);
}

std::vector<fem::Point> centres_of(const fem::WalkResult& result) {
  std::vector<fem::Point> centres;
  std::ranges::transform(result.records, std::back_inserter(centres), &fem::WalkRecord::centre_of_mass_m);
  return centres;
}

TEST(KeptWalk, IsTheWalkOfItsStudyAndKeepsNothingUnlessAsked) {
  const std::atomic<bool> stop{false};
  const fem::LocomotionResult kept = kept_walk(job(), {}, stop);
  ASSERT_EQ(kept.status, io::RunStatus::completed) << kept.reason;
  EXPECT_EQ(kept.plenum_names.size(), 1U);
  EXPECT_GT(kept.seconds, 0.0);
  const fem::WalkResult plain = fem::walk(job().study);
  EXPECT_EQ(centres_of(kept), centres_of(plain));
  EXPECT_EQ(kept.steps, plain.steps);
}

TEST(KeptWalk, GoesOnFromItsCheckpointAndLeavesADamagedOneAside) {
  const tests::TestFolder folder;
  const std::atomic<bool> stop{true};
  const std::atomic<bool> goes_on{false};
  const fem::LocomotionResult whole = kept_walk(job(), {}, goes_on);

  // a checkpoint after three records, as a stop leaves it
  fem::LocomotionStudy prepared = job().study;
  fem::prepare(prepared);
  const auto dynamics = fem::explicit_walk_dynamics(prepared, nullptr);
  fem::Walk begun(prepared, *dynamics);
  begun.start();
  for (int n = 0; n < 3; ++n) begun.go_on();
  fem::WalkProgress progress = begun.progress();
  progress.seconds = 1000.0;
  const fs::path checkpoint = folder / "locomotion.checkpoint";
  fem::write_locomotion_checkpoint(checkpoint, fem::locomotion_identity(prepared, *dynamics), progress);

  const fem::LocomotionResult stopped = kept_walk(job(), folder.path(), stop);
  EXPECT_EQ(stopped.status, io::RunStatus::stopped);
  EXPECT_EQ(stopped.records.size(), 4U) << "those of the checkpoint";
  EXPECT_GT(stopped.seconds, 1000.0);
  const fem::LocomotionResult resumed = kept_walk(job(), folder.path(), goes_on);
  EXPECT_EQ(resumed.status, io::RunStatus::completed);
  EXPECT_EQ(centres_of(resumed), centres_of(whole));
  EXPECT_GT(resumed.seconds, 1000.0);

  std::get<fem::ExplicitState>(progress.state).velocities_m_per_s.clear();
  fem::write_locomotion_checkpoint(checkpoint, fem::locomotion_identity(prepared, *dynamics), progress);
  EXPECT_EQ(centres_of(kept_walk(job(), folder.path(), goes_on)), centres_of(whole)) << "of another body";

  io::write_whole(checkpoint, "damaged");
  const fem::LocomotionResult anew = kept_walk(job(), folder.path(), goes_on);
  EXPECT_EQ(centres_of(anew), centres_of(whole));
  EXPECT_LT(anew.seconds, 1000.0);
}

TEST(KeptWalk, RunsSideBySideAreTheSame) {
  LocomotionJob other = job();
  other.study.step_safety = 0.7;
  const std::vector<LocomotionJob> jobs{job(), other};
  const auto one = run_locomotions(jobs, {.jobs = 1});
  const auto two = run_locomotions(jobs, {.jobs = 2});
  ASSERT_TRUE(one && two);
  for (std::size_t n = 0; n < 2; ++n) {
    ASSERT_TRUE((*one)[n].displacement_m) << (*one)[n].reason;
    EXPECT_EQ((*one)[n].displacement_m, (*two)[n].displacement_m);
    EXPECT_EQ((*one)[n].steps, (*two)[n].steps);
  }
  EXPECT_NE((*one)[0].steps, (*one)[1].steps);
}

}  // namespace
}  // namespace menger::evolution
