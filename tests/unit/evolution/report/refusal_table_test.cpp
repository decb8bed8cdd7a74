#include "evolution/report/refusal_table.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "evolution/report/study_view.h"
#include "io/text/content_hash.h"
#include "io/text/csv_table.h"
#include "tests/support/silicone_archive.h"
#include "tests/support/test_folder.h"
#include "tests/support/walking_study.h"

namespace menger::evolution {
namespace {

const std::string body_in_two_parts = "101000000000000000000000000";
const std::string weak_body = "111101110000000000000000000";
const std::string other_weak_body = "111101011000000000000000000";
const std::string castable_bar = "111000000000000000000000000";

/// Makes an archive of these bodies with their walks.
RunArchive archive_of(const tests::TestFolder& folder, const Study& study, const std::vector<std::string>& bodies) {
  tests::make_archive(folder / "run.sqlite", study, bodies);
  RunArchive archive = RunArchive::open_to_extend(folder / "run.sqlite");
  const auto evaluator = evaluator_of(study);
  const std::atomic<bool> never{false};
  for (const std::string& body : bodies) {
    Phenotype phenotype;
    phenotype.body = meshes::Polycube::from_digits(3, 3, 3, body);
    const Phenotype simulated = as_simulated(study.search, phenotype);
    archive.add_evaluation({design_hash(simulated, 1), 1, io::content_hash(evaluator->physics())},
                           {0, evaluator->evaluate(simulated.body, 1, never)});
  }
  return archive;
}

class RefusalTable : public testing::Test {
 protected:
  RefusalTable() : study_(tests::read_walking_study(folder_ / "study.toml")) { study_.duration_s = 0.03; }

  const tests::TestFolder folder_;
  Study study_;
};

TEST_F(RefusalTable, CountsBodiesAndNamesTheMostFrequentReason) {
  const RunArchive archive = archive_of(folder_, study_, {body_in_two_parts, castable_bar, weak_body, other_weak_body});
  const Refusals refusals = refusals_of(view_of(archive, study_));
  EXPECT_EQ(refusals.bodies, 4U);
  ASSERT_EQ(refusals.refused.size(), 3U);
  const std::string text = refusal_text(refusals);
  EXPECT_TRUE(text.starts_with("finite elements refused 3 of 4 bodies, 2 of them for reasons like this: ")) << text;
  EXPECT_NE(text.find("touch only along an edge"), std::string::npos) << "places of cells make no other reason: " << text;
  const io::CsvContents table = io::parse_csv(refusal_table(refusals).text(), "refused.csv");
  ASSERT_EQ(table.row_count(), 3U);
  EXPECT_EQ(table.text(0, "phenotype"), body_in_two_parts);
  EXPECT_EQ(table.number(0, "individual"), 0.0);
  EXPECT_EQ(table.number(0, "generation"), 0.0);
  EXPECT_EQ(table.number(0, "cells"), 2.0);
  EXPECT_NE(table.text(0, "reason").find("2 parts that are not joined"), std::string::npos);
  EXPECT_EQ(table.number(2, "individual"), 3.0);
}

TEST_F(RefusalTable, IsEmptyWhereAllBodiesWalk) {
  const RunArchive archive = archive_of(folder_, study_, {castable_bar});
  const Refusals refusals = refusals_of(view_of(archive, study_));
  EXPECT_EQ(refusals.bodies, 1U);
  EXPECT_EQ(refusal_text(refusals), "");
  EXPECT_EQ(io::parse_csv(refusal_table(refusals).text(), "refused.csv").row_count(), 0U);
}

TEST_F(RefusalTable, HasOneReasonAlone) {
  const RunArchive archive = archive_of(folder_, study_, {body_in_two_parts, castable_bar});
  const std::string text = refusal_text(refusals_of(view_of(archive, study_)));
  EXPECT_TRUE(text.starts_with("finite elements refused 1 of 2 bodies: design ")) << text;
}

}  // namespace
}  // namespace menger::evolution
