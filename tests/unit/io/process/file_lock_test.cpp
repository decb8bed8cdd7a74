#include "io/process/file_lock.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "io/text/input_error.h"
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

}  // namespace
}  // namespace menger::io
