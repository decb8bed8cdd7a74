#include "fem/locomotion/locomotion_checkpoint.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <string>

#include "io/process/checkpoint_file.h"
#include "io/text/whole_file.h"
#include "tests/support/input_error_message.h"
#include "tests/support/test_folder.h"

namespace menger::fem {
namespace {

namespace fs = std::filesystem;
using tests::message_of;

/// Numbers that shorter representations would lose.
WalkProgress awkward_progress() {
  WalkProgress progress;
  ExplicitState& state = progress.state.emplace<ExplicitState>();
  state.time_s = 0.1 + 0.2;
  state.displacements_m = {-0.0, 1.0 / 3.0, std::numeric_limits<double>::denorm_min()};
  state.velocities_m_per_s = {1e300, -2.5, 16777217.0};
  state.last_step_s = 1e-5 / 3.0;
  state.steps = (std::size_t{1} << 40U) + 1;
  state.steps_to_bound = 200;
  state.step_share = 0.1;
  state.steps_since_bound = 17;
  state.stable_step_s = 1e-4 / 3.0;
  state.pressures_Pa = {1e3 / 3.0, -0.0};
  state.pressed_volumes = {{1e-9 / 3.0, -1e-9 / 7.0}, {1e-9 / 11.0, -1e-9 / 13.0}};
  state.work = {0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8};
  state.at_start_J = 1e-17;
  state.turnover_J = 2.0 / 7.0;
  state.pneumatics = PneumaticState{.time_s = 0.3,
                                    .volumes_m3 = {1e-6 / 3.0},
                                    .plenum_air_m3 = {2e-6 / 3.0},
                                    .piston_air_m3 = {},
                                    .source_air_m3 = {-1e-7},
                                    .work = {0.1, 0.2, 0.3, 0.4}};
  state.contact = std::vector<ContactMemory>{{.node = 7,
                                              .face = 9,
                                              .depth_m = 1e-5 / 3.0,
                                              .pressed_m = 1e-6 / 3.0,
                                              .paid_m2 = 1e-12 / 7.0,
                                              .spring_N_per_m = 1.0 / 3.0,
                                              .slip_m = {-0.0, 1e-9, 0.1}},
                                             {.node = 8, .is_sliding = true}};
  state.branches = BranchState{.numbers = AlignedNumbers{1.0 / 3.0, -0.0, 1.0 + 1e-16, 5e-324}, .age_s = 1e-5 / 3.0};
  WalkRecord record{.time_s = 0.1, .centre_of_mass_m = {0.1, 0.2, 0.3}, .plenum_pressures_Pa = {5.0}, .ground_force_N = 1.1};
  record.chamber_volumes_m3 = {1e-6};
  record.upright = {0.6, -0.0, 0.8};
  record.energies.kinetic_J = 1.0 / 3.0;
  record.energies.at_start_J = 1e-17;
  record.energies.work.friction_J = 0.3;
  progress.records = {record, record};
  progress.seconds = 12.5;
  return progress;
}

TEST(LocomotionCheckpoint, GivesEveryBitBack) {
  const WalkProgress written = awkward_progress();
  const tests::TestFolder folder;
  const fs::path file = folder / "run.checkpoint";
  write_locomotion_checkpoint(file, "study", written);
  const auto read = read_locomotion_checkpoint(file, "study");
  ASSERT_TRUE(read && std::holds_alternative<ExplicitState>(read->state));
  const auto& found = std::get<ExplicitState>(read->state);
  const auto& state = std::get<ExplicitState>(written.state);
  EXPECT_EQ(found.time_s, state.time_s);
  EXPECT_EQ(found.displacements_m, state.displacements_m);
  EXPECT_TRUE(std::signbit(found.displacements_m[0]));
  EXPECT_EQ(found.velocities_m_per_s, state.velocities_m_per_s);
  EXPECT_EQ(found.last_step_s, state.last_step_s);
  EXPECT_EQ(found.steps, state.steps);
  EXPECT_EQ(found.steps_to_bound, state.steps_to_bound);
  EXPECT_EQ(found.step_share, state.step_share);
  EXPECT_EQ(found.steps_since_bound, state.steps_since_bound);
  EXPECT_EQ(found.stable_step_s, state.stable_step_s);
  EXPECT_EQ(found.pressures_Pa, state.pressures_Pa);
  EXPECT_EQ(found.pressed_volumes.walls_m3, state.pressed_volumes.walls_m3);
  EXPECT_EQ(found.pressed_volumes.chambers_m3, state.pressed_volumes.chambers_m3);
  const auto& [pressure, wall_pressure, gravity, contact, self_contact, friction, viscous, mass_damping] = found.work;
  EXPECT_EQ((std::array{pressure, wall_pressure, gravity, contact, self_contact, friction, viscous, mass_damping}),
            (std::array{0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8}));
  EXPECT_EQ(found.at_start_J, state.at_start_J);
  EXPECT_EQ(found.turnover_J, state.turnover_J);
  ASSERT_TRUE(found.contact);
  EXPECT_EQ(*found.contact, *state.contact);
  EXPECT_EQ(found.branches, state.branches);
  EXPECT_TRUE(std::signbit(std::get<AlignedNumbers>(found.branches->numbers)[1]));
  ASSERT_TRUE(found.pneumatics);
  EXPECT_EQ(found.pneumatics->source_air_m3, state.pneumatics->source_air_m3);
  EXPECT_EQ(found.pneumatics->work.line_J, 0.4);
  ASSERT_EQ(read->records.size(), 2U);
  EXPECT_EQ(read->records[1].centre_of_mass_m, written.records[1].centre_of_mass_m);
  EXPECT_EQ(read->records[1].energies.kinetic_J, 1.0 / 3.0);
  EXPECT_EQ(read->records[1].energies.work.friction_J, 0.3);
  EXPECT_EQ(read->records[1].ground_force_N, 1.1);
  EXPECT_EQ(read->records[1].upright, (Point{0.6, 0.0, 0.8}));
  EXPECT_FALSE(read->outcome);
  EXPECT_EQ(read->seconds, 12.5);
}

// Elements in single precision have branches of that type.
TEST(LocomotionCheckpoint, GivesNumbersOfSinglePrecisionBack) {
  WalkProgress written = awkward_progress();
  std::get<ExplicitState>(written.state).branches = BranchState{
      .numbers = AlignedVector<float>{1.0F / 3.0F, -0.0F, std::numeric_limits<float>::denorm_min(), 3e38F}, .age_s = 0.5};
  const tests::TestFolder folder;
  const fs::path file = folder / "run.checkpoint";
  write_locomotion_checkpoint(file, "study", written);
  const auto read = read_locomotion_checkpoint(file, "study");
  ASSERT_TRUE(read);
  const auto& found = std::get<ExplicitState>(read->state);
  EXPECT_EQ(found.branches, std::get<ExplicitState>(written.state).branches);
  EXPECT_TRUE(std::signbit(std::get<AlignedVector<float>>(found.branches->numbers)[1]));
}

TEST(LocomotionCheckpoint, KeepsHowARunEndedAndWhatIsNotThere) {
  WalkProgress written = awkward_progress();
  auto& state = std::get<ExplicitState>(written.state);
  state.at_start_J.reset();
  state.pneumatics.reset();
  state.branches.reset();
  written.outcome = {io::RunStatus::diverged, "at 1 s: \"away\""};
  const tests::TestFolder folder;
  const fs::path file = folder / "run.checkpoint";
  write_locomotion_checkpoint(file, "study", written);
  const auto read = read_locomotion_checkpoint(file, "study");
  ASSERT_TRUE(read && read->outcome);
  EXPECT_EQ(read->outcome->status, io::RunStatus::diverged);
  EXPECT_EQ(read->outcome->reason, "at 1 s: \"away\"");
  EXPECT_FALSE(std::get<ExplicitState>(read->state).at_start_J);
  EXPECT_FALSE(std::get<ExplicitState>(read->state).pneumatics);
  EXPECT_FALSE(std::get<ExplicitState>(read->state).branches);
}

TEST(LocomotionCheckpoint, KeepsStatesOfImplicitDynamics) {
  WalkProgress written;
  ImplicitState state;
  state.time_s = 0.1 + 0.2;
  state.displacements_m = {-0.0, 1.0 / 3.0, 1e-300};
  state.velocities_m_per_s = {1.0, 2.0 / 3.0, 3.0};
  state.accelerations_m_per_s2 = {1e5 / 3.0, 0.0, -1.0};
  state.ground_nodes = {{.touches = true, .slides = true, .anchor_m = {0.1, 1.0 / 3.0}, .friction_N = {-0.7, 1e-17}}, {}};
  state.next_step_s = 1e-3 / 3.0;
  state.steps = 7;
  state.rejected_steps = 2;
  state.iterations = 19;
  state.work.friction_J = 0.3;
  state.at_start_J = 1e-17;
  written.state = state;
  const tests::TestFolder folder;
  const fs::path file = folder / "run.checkpoint";
  write_locomotion_checkpoint(file, "study", written);
  const auto read = read_locomotion_checkpoint(file, "study");
  ASSERT_TRUE(read && std::holds_alternative<ImplicitState>(read->state));
  const auto& found = std::get<ImplicitState>(read->state);
  EXPECT_EQ(found.time_s, state.time_s);
  EXPECT_EQ(found.displacements_m, state.displacements_m);
  EXPECT_EQ(found.velocities_m_per_s, state.velocities_m_per_s);
  EXPECT_EQ(found.accelerations_m_per_s2, state.accelerations_m_per_s2);
  ASSERT_EQ(found.ground_nodes.size(), 2U);
  EXPECT_TRUE(found.ground_nodes[0].touches && found.ground_nodes[0].slides);
  EXPECT_FALSE(found.ground_nodes[1].touches || found.ground_nodes[1].slides);
  EXPECT_EQ(found.ground_nodes[0].anchor_m, state.ground_nodes[0].anchor_m);
  EXPECT_EQ(found.ground_nodes[0].friction_N, state.ground_nodes[0].friction_N);
  EXPECT_EQ(found.next_step_s, state.next_step_s);
  EXPECT_EQ(found.steps, 7U);
  EXPECT_EQ(found.rejected_steps, 2U);
  EXPECT_EQ(found.iterations, 19U);
  EXPECT_EQ(found.work.friction_J, 0.3);
  EXPECT_EQ(found.at_start_J, state.at_start_J);
}

TEST(LocomotionCheckpoint, IsNothingWithoutAFile) {
  const tests::TestFolder folder;
  EXPECT_FALSE(read_locomotion_checkpoint(folder / "no.checkpoint", "study"));
}

TEST(LocomotionCheckpoint, RefusesDamageAndOtherStudies) {
  const tests::TestFolder folder;
  const fs::path file = folder / "run.checkpoint";
  write_locomotion_checkpoint(file, "study", awkward_progress());
  const std::string whole = io::read_whole(file);
  const auto message = [&](const std::string& identity) {
    return message_of([&] { (void)read_locomotion_checkpoint(file, identity); });
  };
  EXPECT_NE(message("other").find("belongs to another study or another number of processes; give --restart"), std::string::npos);
  std::string flipped = whole;
  flipped[flipped.size() - 7] ^= 1;
  io::write_whole(file, flipped);
  EXPECT_NE(message("study").find("is damaged"), std::string::npos);
  io::write_whole(file, whole.substr(0, whole.size() / 2));
  EXPECT_NE(message("study").find("is damaged"), std::string::npos);
  io::write_whole(file, "nonsense");
  EXPECT_NE(message("study").find("is not a checkpoint"), std::string::npos);
}

/// A checkpoint whose content is whole and of the study, but may be anything.
std::string refusal_of_content(const fs::path& file, const std::string& content) {
  io::CheckpointFile(file, "menger locomotion checkpoint 8", "study").write(content);
  return message_of([&] { (void)read_locomotion_checkpoint(file, "study"); });
}

TEST(LocomotionCheckpoint, RefusesContentThatNoCheckpointHas) {
  const tests::TestFolder folder;
  const fs::path file = folder / "run.checkpoint";
  const std::string start_again = "; give --restart to start again from the beginning";
  const std::string other_build = file.string() + ": is of another build of menger" + start_again;
  EXPECT_EQ(refusal_of_content(file, ""), other_build);
  EXPECT_EQ(refusal_of_content(file, "\x84\x80\x80\xF6\x00"), other_build);
  // Lists in lists, 200,000 deep: the parser calls itself for each.
  EXPECT_EQ(refusal_of_content(file, std::string(200000, '\x81')),
            file.string() + ": has values inside values to a depth that no checkpoint has" + start_again);
  EXPECT_EQ(refusal_of_content(file, std::string(200000, '\xA1')), other_build) << "objects need keys";
}

}  // namespace
}  // namespace menger::fem
