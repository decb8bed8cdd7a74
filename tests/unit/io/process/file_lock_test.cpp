#include "io/process/file_lock.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <optional>
#include <string>

#include "io/text/input_error.h"
#include "io/text/whole_file.h"
#include "tests/support/test_folder.h"

namespace menger::io {
namespace {

namespace fs = std::filesystem;

TEST(FileLock, KeepsOthersOutUntilItIsReleased) {
  const tests::TestFolder folder;
  {
    const FileLock lock(folder / "a");
    EXPECT_THROW(FileLock(folder / "a"), InputError);
  }
  const FileLock lock(folder / "a");
}

TEST(FileLock, CanBeTried) {
  const tests::TestFolder folder;
  {
    const std::optional<FileLock> lock = FileLock::if_free(folder / "a");
    ASSERT_TRUE(lock);
    EXPECT_FALSE(FileLock::if_free(folder / "a"));
    EXPECT_TRUE(FileLock::if_free(folder / "b"));
  }
  EXPECT_TRUE(FileLock::if_free(folder / "a"));
  EXPECT_THROW((void)FileLock::if_free(folder / "none/a"), InputError) << "it is not held, but cannot be taken";
}

TEST(FileLock, BelongsToTheFileAndNotToItsName) {
  const tests::TestFolder folder;
  fs::create_directory(folder / "real");
  fs::create_symlink("real/a", folder / "link");
  const fs::path real = "real";
  fs::create_directory_symlink(real, folder / "folder");
  const FileLock lock(folder / "real/a");
  EXPECT_THROW(FileLock(folder / "link"), InputError);
  EXPECT_THROW(FileLock(folder / "folder/a"), InputError);
  EXPECT_THROW(FileLock(folder / "real/../real/a"), InputError);
}

TEST(FileLock, LeavesTheLockOfAnotherHolderWhereItsFolderWasRenamed) {
  const tests::TestFolder folder;
  fs::create_directory(folder / "run");
  std::optional<FileLock> first = FileLock::if_free(folder / "run/a");
  ASSERT_TRUE(first);
  fs::rename(folder / "run", folder / "earlier");
  fs::create_directory(folder / "run");
  const FileLock second(folder / "run/a");
  first.reset();
  EXPECT_TRUE(fs::exists(folder / "run/a.lock"));
  EXPECT_FALSE(FileLock::if_free(folder / "run/a")) << "the second one holds it";
}

TEST(FileLock, RefusesAFileOfSeveralNames) {
  const tests::TestFolder folder;
  write_whole(folder / "a", "content");
  { const FileLock lock(folder / "a"); }
  fs::create_hard_link(folder / "a", folder / "b");
  for (const char* name : {"a", "b"}) {
    try {
      const FileLock lock(folder / name);
      ADD_FAILURE() << name << " was locked";
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("has 2 names"), std::string::npos) << error.what();
    }
    EXPECT_FALSE(fs::exists(folder / (std::string(name) + ".lock")));
  }
  fs::remove(folder / "b");
  const FileLock lock(folder / "a");
}

}  // namespace
}  // namespace menger::io
