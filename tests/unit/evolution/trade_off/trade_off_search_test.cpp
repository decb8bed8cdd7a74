#include "evolution/trade_off/trade_off_search.h"

#include <gtest/gtest.h>

#include "evolution/archive/run_archive.h"
#include "evolution/genome/offspring.h"
#include "evolution/report/study_view.h"
#include "evolution/study/study_file.h"
#include "io/text/csv_table.h"
#include "io/text/input_error.h"
#include "io/text/whole_file.h"
#include "tests/support/test_folder.h"

namespace menger::evolution {
namespace {

namespace fs = std::filesystem;

const VoxelFidelity coarse{"float32", "velocity", 0.9, "off", {}};
const VoxelFidelity fine{"float64", "increments", 0.09, "1", {}};

/// Returns searches whose champions have these displacements on the finest surrogate.
SearchTrade trade_of(const std::vector<double>& coarse_walks, const std::vector<double>& fine_walks) {
  SearchTrade trade{.voxel_steps = 1e6, .finest = fine};
  const auto add = [&](const VoxelFidelity& fidelity, const std::vector<double>& walks) {
    for (std::size_t n = 0; n < walks.size(); ++n) {
      SearchRow row{.fidelity = fidelity, .seed = static_cast<int>(n + 1)};
      row.finest_body_lengths = walks[n];
      row.extent_change_x_m = 0.001;
      row.status = "completed";
      row.element_status = "completed";
      trade.rows.push_back(row);
    }
  };
  add(coarse, coarse_walks);
  add(fine, fine_walks);
  return trade;
}

TEST(SearchTrade, ADifferenceWithinTheSpreadIsNotResolved) {
  // means 2 and 3, both with standard deviation 1: t = 1.22, and the limit is 2.78 for four degrees of freedom
  const std::string text = search_text(trade_of({1, 2, 3}, {2, 3, 4}));
  EXPECT_NE(
      text.find("2 +- 1 (3 seeds); not significant: differs from the finest by -1; the spread over seeds explains up to 2.267"),
      std::string::npos)
      << text;
}

TEST(SearchTrade, ADifferenceBeyondTheSpreadIsResolved) {
  const std::string text = search_text(trade_of({1, 2, 3}, {5, 6, 7}));
  EXPECT_NE(text.find("significant: differs from the finest by -4; the spread over seeds explains only 2.267"), std::string::npos)
      << text;
  EXPECT_EQ(text.find("not significant: differs from the finest by -4"), std::string::npos);
}

TEST(SearchTrade, OneChampionTellsNothing) {
  EXPECT_NE(search_text(trade_of({1}, {5, 6, 7})).find("too few champions"), std::string::npos);
}

TEST(SearchTrade, TableAndPicturesHoldEverySearch) {
  SearchTrade trade = trade_of({1, 2, 3}, {5, 6, 7});
  trade.rows[0].finest_body_lengths.reset();
  trade.rows[0].status = "failed";
  trade.rows[0].reason = "exit code 1";
  trade.rows[0].element_status = "skipped";
  const std::string text = search_text(trade);
  EXPECT_NE(text.find("5 of 6 searches found a champion; 5 of these"), std::string::npos) << text;
  EXPECT_NE(text.find("seed 1, float32, damping from velocities, time step fraction 0.9, collisions off: failed, exit code 1"),
            std::string::npos)
      << text;
  const io::CsvContents csv = io::parse_csv(search_csv(trade).text(), "search.csv");
  EXPECT_EQ(csv.row_count(), 6U);
  EXPECT_EQ(csv.text(0, "status"), "failed");
  EXPECT_EQ(csv.text(0, "finest_body_lengths"), "");
  EXPECT_EQ(csv.number(5, "finest_body_lengths"), 7.0);
  const io::Chart chart = search_chart(trade);
  ASSERT_EQ(chart.panels.size(), 2U);
  EXPECT_EQ(chart.panels[0].series[0].y, (std::vector<double>{2, 3, 5, 6, 7}));
  EXPECT_EQ(chart.panels[0].series[1].y, (std::vector<double>{2.5, 6}));
}

TEST(SearchTrade, VoxelStepsAreSummedOverTheArchive) {
  const tests::TestFolder folder;
  const fs::path file = folder / "run.sqlite";
  io::write_whole(folder / "study.toml", "preset = \"paper\"\n[evaluation]\nstand = true\n[body]\nlevels = [1, 2]\n");
  const Study study = read_study(folder / "study.toml");
  Individual individual;
  individual.phenotype.body = meshes::Polycube::from_digits(3, 3, 3, "000000000111000000000000000");  // does not touch the ground
  const Phenotype standing = as_simulated(study.search, individual.phenotype);
  ASSERT_NE(standing, individual.phenotype);
  OffspringOptions offspring;
  RandomStream random(1, "individuals");
  individual.genome = random_offspring(offspring, random).genome;
  {
    RunArchive archive = RunArchive::open(file, identity_text(study), 0);
    const std::string physics_hash = view_of(archive, study).physics_hashes().front();
    Evaluation result;
    result.status = io::RunStatus::completed;
    result.displacement_m = {0.1, 0.0, 0.0};
    result.steps = 100;
    archive.add_evaluation({design_hash(standing, 1), 1, physics_hash}, {0, result});
    result.steps = 10;
    archive.add_evaluation({design_hash(standing, 2), 2, physics_hash}, {0, result});
    const PoolMember member{.id = 0, .age = 0, .fitness = 0.1, .fitness_bound = {}, .survivor_rank = 0};
    archive.add_generation({}, std::vector{individual}, std::vector{member});
  }
  EXPECT_EQ(archived_voxel_steps(file), 100U * 3U + 10U * 9U);
  io::write_whole(folder / "other", "no archive");
  EXPECT_THROW((void)archived_voxel_steps(folder / "other"), io::InputError);
}

}  // namespace
}  // namespace menger::evolution
