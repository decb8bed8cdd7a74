#include "io/text/whole_file.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <fstream>
#include <iostream>

#include "io/text/input_error.h"
#include "tests/support/test_folder.h"

namespace menger::io {
namespace {

namespace fs = std::filesystem;

class WholeFile : public testing::Test {
 protected:
  std::size_t files() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
  }

  template <class Action>
  static std::string message(const Action& action) {
    try {
      action();
    } catch (const InputError& error) {
      return error.what();
    }
    return {};
  }

  const tests::TestFolder folder_;
};

TEST_F(WholeFile, HoldsExactlyTheBytesAndNothingElseIsLeft) {
  const std::string content("a\r\n\0b", 5);
  write_whole(folder_ / "a.txt", content);
  EXPECT_EQ(read_whole(folder_ / "a.txt"), content);
  EXPECT_EQ(files(), 1U);
}

TEST_F(WholeFile, MayBeEmpty) {
  write_whole(folder_ / "a.txt", "");
  EXPECT_EQ(read_whole(folder_ / "a.txt"), "");
}

TEST_F(WholeFile, ReplacesAnOlderOne) {
  write_whole(folder_ / "a.txt", "old and longer");
  write_whole(folder_ / "a.txt", "new");
  EXPECT_EQ(read_whole(folder_ / "a.txt"), "new");
}

TEST_F(WholeFile, IsRemovedIfItIsThere) {
  write_whole(folder_ / "a.txt", "x");
  remove_if_there(folder_ / "a.txt");
  EXPECT_EQ(files(), 0U);
  remove_if_there(folder_ / "a.txt");
  write_whole(folder_ / "b/a.txt", "x");
  EXPECT_EQ(message([&] { remove_if_there(folder_ / "b"); }).find((folder_ / "b").string() + ": cannot be removed"), 0U)
      << "a folder that holds something";
}

TEST_F(WholeFile, MakesItsFolder) {
  write_whole(folder_ / "b/c/a.txt", "x");
  EXPECT_EQ(read_whole(folder_ / "b/c/a.txt"), "x");
}

TEST_F(WholeFile, AppearsUnderItsNameOnlyOnCommit) {
  write_whole(folder_ / "a.vtu", "old");
  PendingFile pending(folder_ / "a.vtu");
  EXPECT_EQ(pending.temporary().parent_path(), folder_.path());
  EXPECT_EQ(pending.temporary().extension(), ".vtu");
  std::ofstream(pending.temporary()) << "new";
  EXPECT_EQ(read_whole(folder_ / "a.vtu"), "old");
  pending.commit();
  EXPECT_EQ(read_whole(folder_ / "a.vtu"), "new");
  EXPECT_EQ(files(), 1U);
}

TEST_F(WholeFile, LeavesTheOldOneAndNoRestWithoutCommit) {
  write_whole(folder_ / "a.txt", "old");
  {
    const PendingFile pending(folder_ / "a.txt");
    std::ofstream(pending.temporary()) << "half";
  }
  EXPECT_EQ(read_whole(folder_ / "a.txt"), "old");
  EXPECT_EQ(files(), 1U);
}

TEST_F(WholeFile, HasATemporaryNameOfItsOwn) {
  const PendingFile first(folder_ / "a.txt");
  const PendingFile second(folder_ / "a.txt");
  EXPECT_NE(first.temporary(), second.temporary());
}

TEST_F(WholeFile, CannotBeCommittedUnwritten) {
  PendingFile pending(folder_ / "a.txt");
  EXPECT_THROW(pending.commit(), InputError);
  EXPECT_FALSE(fs::exists(folder_ / "a.txt"));
}

/// Starts to write a file in a process that is killed.
void begin_and_die(const fs::path& file) {
  const pid_t child = fork();
  if (child == 0) {
    const PendingFile pending(file);
    std::ofstream(pending.temporary()) << "half";
    std::raise(SIGKILL);
  }
  int status = 0;
  waitpid(child, &status, 0);
}

TEST_F(WholeFile, OfAKilledProcessIsRemovedByTheNextOne) {
  begin_and_die(folder_ / "a.b.csv");
  ASSERT_EQ(files(), 1U);
  begin_and_die(folder_ / "c");
  ASSERT_EQ(files(), 1U) << "it has removed the first and left its own";
  write_whole(folder_ / "d.txt", "x");
  EXPECT_EQ(files(), 1U);
}

TEST_F(WholeFile, OfARunningProcessStays) {
  const PendingFile pending(folder_ / "a.txt");
  const pid_t child = fork();
  if (child == 0) {
    write_whole(folder_ / "../" / folder_.path().filename() / "b.txt", "x");  // a name of the folder that is new to this process
    std::_Exit(0);
  }
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_TRUE(fs::exists(pending.temporary()));
}

TEST_F(WholeFile, OfAUserWithASimilarNameStays) {
  begin_and_die(folder_ / "a.txt");
  for (const char* name : {".a.partial.txt", ".a.7.partial.txt", ".a.7-x.partial.txt", "a.7-1.partial.txt", ".partial"})
    std::ofstream(folder_ / name) << "mine";
  write_whole(folder_ / "b.txt", "x");
  EXPECT_EQ(files(), 6U);
}

TEST_F(WholeFile, CannotStandBelowAFile) {
  write_whole(folder_ / "file", "old");
  const std::string below = message([&] { write_whole(folder_ / "file/sub/a.txt", "x"); });
  EXPECT_EQ(below, (folder_ / "file/sub").string() + ": cannot be created as a folder: Not a directory");
  EXPECT_EQ(read_whole(folder_ / "file"), "old");
}

TEST_F(WholeFile, CannotReplaceAFolder) {
  fs::create_directory(folder_ / "a");
  EXPECT_EQ(message([&] { write_whole(folder_ / "a", "x"); }), (folder_ / "a").string() + ": cannot be written: it is a folder");
}

TEST_F(WholeFile, CannotBeWrittenWhereTheSystemForbidsFilesEvenToRoot) {
  EXPECT_THROW(write_whole("/proc/self/a.txt", "x"), InputError);
}

TEST_F(WholeFile, FolderThatIsAFileIsReported) {
  write_whole(folder_ / "file", "old");
  EXPECT_EQ(message([&] { require_writable_folder(folder_ / "file"); }),
            (folder_ / "file").string() + ": cannot be created as a folder: Not a directory");
  EXPECT_NE(message([&] { require_writable_folder(folder_ / "file/sub"); }).find("cannot be created as a folder"),
            std::string::npos);
}

TEST_F(WholeFile, FolderIsMadeWithItsParents) {
  require_writable_folder(folder_ / "a/b/c");
  EXPECT_TRUE(fs::is_directory(folder_ / "a/b/c"));
  EXPECT_NO_THROW(require_writable_folder(folder_ / "a/b/c"));
}

TEST_F(WholeFile, ReadingNamesWhatIsMissingOrAFolder) {
  EXPECT_EQ(message([&] { (void)read_whole(folder_ / "absent"); }),
            (folder_ / "absent").string() + ": cannot be read: No such file or directory");
  EXPECT_EQ(message([&] { (void)read_whole(folder_); }), folder_.path().string() + ": cannot be read: it is a folder");
}

TEST_F(WholeFile, IsReadToItsEndOrRefused) {
  EXPECT_EQ(message([&] { (void)read_whole(folder_); }), folder_.path().string() + ": cannot be read: it is a folder");
  EXPECT_EQ(message([] { (void)read_whole("/proc/self/mem"); }), "/proc/self/mem: cannot be read: Input/output error")
      << "there is nothing at address 0";
  EXPECT_EQ(message([&] { (void)read_whole(folder_ / "none"); }),
            (folder_ / "none").string() + ": cannot be read: No such file or directory");
}

TEST_F(WholeFile, ThatDoesNotFitIntoMemoryIsNotReadInPart) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the address sanitizer ends a program that finds no memory";
#endif
  const fs::path file = folder_ / "long.toml";
  {
    std::ofstream out(file);
    out << "a = 1\n";
    const std::string comments = "#" + std::string(std::size_t{1} << 20U, '.') + "\n";
    for (int n = 0; n < 64; ++n) out << comments;
    out << "an error\n";
  }
  const auto read_with_little_memory = [&] {
    std::size_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    const rlim_t used = pages * static_cast<rlim_t>(::sysconf(_SC_PAGESIZE));
    const rlimit limit{used + (rlim_t{16} << 20U), RLIM_INFINITY};
    (void)::setrlimit(RLIMIT_AS, &limit);
    const std::string refusal = message([&] { (void)read_whole(file); });
    std::cerr << refusal;
    ::_exit(refusal.empty() ? 0 : 3);
  };
  EXPECT_EXIT(read_with_little_memory(), testing::ExitedWithCode(3), "long.toml: cannot be read: it does not fit into memory");
}

TEST_F(WholeFile, GivesItsStartAlone) {
  write_whole(folder_ / "a.txt", "0123456789");
  EXPECT_EQ(read_start(folder_ / "a.txt", 4), "0123");
  EXPECT_EQ(read_start(folder_ / "a.txt", 40), "0123456789");
}

}  // namespace
}  // namespace menger::io
