#include "evolution/outputs/search_tables.h"

#include <gtest/gtest.h>

#include <fstream>
#include <string>
#include <vector>

#include "evolution/archive/archive_files.h"
#include "evolution/archive/run_archive.h"
#include "evolution/outputs/result_facts.h"
#include "io/text/content_hash.h"
#include "tests/support/silicone_archive.h"
#include "tests/support/test_folder.h"

namespace menger::evolution {
namespace {

class SearchesTest : public testing::Test {
 protected:
  /// An archive of a study, as menger evolve leaves it.
  CommandOutput archive(const std::string& name, const std::string& study) {
    (void)RunArchive::open(folder_ / (name + ".sqlite"), study, 1);
    return {.program = "menger-evolve",
            .folder = folder_.path(),
            .manifest = folder_ / (name + ".manifest.json"),
            .name = name + ".manifest.json"};
  }
  /// The export of an archive of a study.
  static CommandOutput exported(const std::string& archive, const std::string& study) {
    return {.program = "menger-export", .name = "of " + study, .inputs = {{archive + " (study)", io::content_hash(study)}}};
  }
  static std::vector<std::string> names_of(const std::vector<CommandOutput>& outputs) {
    std::vector<std::string> names;
    for (const CommandOutput* search : searches_in(outputs)) names.push_back(search->name);
    return names;
  }
  tests::TestFolder folder_;
};

TEST_F(SearchesTest, AreArchivesInsteadOfTheirExports) {
  EXPECT_EQ(names_of({archive("run", "seed = 1\n"), exported("elsewhere/renamed.sqlite", "seed = 1\n")}),
            std::vector<std::string>{"run.manifest.json"});
}

TEST(ArchiveFiles, AreNamedAfterTheirArchive) {
  EXPECT_EQ(beside_archive("out/run.sqlite", ".manifest.json"), "out/run.manifest.json");
  EXPECT_EQ(beside_archive("run.sqlite", ".confirmed.csv"), "run.confirmed.csv");
  EXPECT_EQ(beside_archive("out.1/run", ".manifest.json"), "out.1/run.manifest.json");
  EXPECT_EQ(beside_archive("trial.1", ".manifest.json"), "trial.1.manifest.json");
  EXPECT_NE(beside_archive("trial.1", ".confirmed.csv"), beside_archive("trial.2", ".confirmed.csv"));
  EXPECT_NE(beside_archive("trial.1.sqlite", ".confirmed.csv"), beside_archive("trial.2.sqlite", ".confirmed.csv"));
}

TEST(ArchiveFiles, LeadToTheirArchive) {
  const tests::TestFolder folder;
  for (const char* name : {"run.sqlite", "trial.1", "trial.2", "both.sqlite", "both"}) std::ofstream(folder / name) << "x";
  for (const char* name : {"run.sqlite", "trial.1", "trial.2", "both.sqlite", "lost.sqlite"})
    EXPECT_EQ(archive_beside(beside_archive(folder / name, ".manifest.json"), ".manifest.json"), folder / name);
}

TEST_F(SearchesTest, AreExportsOfOtherArchivesOfTheSameName) {
  EXPECT_EQ(names_of({archive("run", "seed = 1\n"), exported("other/run.sqlite", "seed = 2\n")}),
            (std::vector<std::string>{"run.manifest.json", "of seed = 2\n"}));
}

TEST_F(SearchesTest, AreExportsOfArchivesThatCannotBeRead) {
  CommandOutput lost = archive("run", "seed = 1\n");
  lost.manifest = folder_ / "lost.manifest.json";
  EXPECT_EQ(names_of({lost, exported("run.sqlite", "seed = 1\n")}),
            (std::vector<std::string>{"run.manifest.json", "of seed = 1\n"}));
}

TEST_F(SearchesTest, ShowTheLineageOfTheConfirmedChampionIfAnExportHasIt) {
  const Study study = tests::silicone_study();
  tests::make_archive(folder_ / "run.sqlite", study, {std::string(27, '1'), std::string(26, '1') + "0"});
  const std::string text = RunArchive::open_to_read(folder_ / "run.sqlite").study();
  const CommandOutput evolved{.program = "menger-evolve",
                              .folder = folder_.path(),
                              .manifest = folder_ / "run.manifest.json",
                              .name = "run.manifest.json"};
  CommandOutput of_run = exported("run.sqlite", text);
  of_run.folder = folder_.path();
  std::ofstream(folder_ / "lineage.csv") << "generation,individual\n0,1\n";

  SearchTables tables = read_search_tables(evolved, {evolved});
  EXPECT_EQ(tables.lineage_of, "the fittest robot");
  EXPECT_EQ(tables.lineage->number(0, "individual"), 0.0);

  std::ofstream(folder_ / "generations.csv") << "generation\n0\n";
  tables = read_search_tables(evolved, {evolved, of_run});
  EXPECT_EQ(tables.lineage_of, "the champion");
  EXPECT_EQ(tables.lineage->number(0, "individual"), 1.0);

  std::ofstream(folder_ / "generations.csv") << "generation\n0\n1\n";
  tables = read_search_tables(evolved, {evolved, of_run});
  EXPECT_EQ(tables.lineage_of, "the fittest robot") << "the export is of other generations";
}

TEST_F(SearchesTest, KnowHowFarARobotOfAFitnessWalksWhereTheyHaveTheStudy) {
  Study study = tests::silicone_study();
  study.measure = Measure::last_periods;
  tests::make_archive(folder_ / "run.sqlite", study, {std::string(27, '1')});
  const CommandOutput evolved{.program = "menger-evolve",
                              .folder = folder_.path(),
                              .manifest = folder_ / "run.manifest.json",
                              .name = "run.manifest.json"};
  const SearchTables tables = read_search_tables(evolved, {evolved});
  EXPECT_TRUE(tables.is_of_period);
  EXPECT_NEAR(tables.walk_over_fitness.value(), study.duration_s / measured_periods(study)->period_s, 1e-12);
  EXPECT_TRUE(fitness_unit(tables).ends_with(" in a period of the drive")) << fitness_unit(tables);
  // An export does not say what its fitness is of, so that nothing says that it is no walk.
  CommandOutput alone = exported("run.sqlite", "a study");
  alone.folder = folder_.path();
  std::ofstream(folder_ / "generations.csv") << "generation,best_fitness_body_lengths\n0,0.02\n";
  EXPECT_FALSE(read_search_tables(alone, {alone}).walk_over_fitness);
  std::vector<std::string> notes;
  EXPECT_TRUE(read_facts({alone}, notes).searches.at(0).is_walk);
}

}  // namespace
}  // namespace menger::evolution
