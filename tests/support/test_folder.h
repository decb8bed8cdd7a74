#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <exception>
#include <filesystem>
#include <iostream>
#include <string>
#include <system_error>

namespace menger::tests {

/// A new, empty folder of one test, below testing::TempDir(); a member of a fixture or a local variable.
///
/// Its name holds the suite, the test and the process, so that it shows whose it is; a number follows where that name is taken:
/// by another folder of the same test, or by one that an earlier process left. Outside a test (SetUpTestSuite) the suite names
/// it.
///
/// Its end removes it, also after GTEST_SKIP. It is kept, and its path printed, if the test has failed so far or if an exception
/// ends its scope; so a folder does not belong into a scope that an expected exception leaves. A test that is killed leaves it.
/// A child process has to be waited for while the folder lives: the end of a child's copy of it does nothing.
///
/// @throws std::filesystem::filesystem_error where it cannot be made
class TestFolder {
 public:
  TestFolder() {
    const std::filesystem::path parent = std::filesystem::absolute(testing::TempDir());
    std::filesystem::create_directories(parent);
    const std::string name = name_of_test() + "." + std::to_string(owner_);
    path_ = parent / name;
    // Creation tells who was first: nothing is there between a look and a creation that another process could use.
    for (int number = 2; !std::filesystem::create_directory(path_); ++number)
      path_ = parent / (name + "." + std::to_string(number));
  }

  ~TestFolder() {
    if (getpid() != owner_) return;
    if (has_failed()) {
      std::cout << "kept: " << path_.string() << std::endl;
      return;
    }
    std::error_code error;
    std::filesystem::remove_all(path_, error);
    if (error) std::cout << "not removed: " << path_.string() << ": " << error.message() << std::endl;
  }

  TestFolder(const TestFolder&) = delete;
  TestFolder& operator=(const TestFolder&) = delete;

  /// Absolute.
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] std::filesystem::path operator/(const std::filesystem::path& name) const { return path_ / name; }

  // NOLINTNEXTLINE(google-explicit-constructor,hicpp-explicit-conversions): a folder is used where its path is asked for
  operator const std::filesystem::path&() const { return path_; }

 private:
  /// Suite and test in letters that every file system takes: names of parameterised tests hold slashes.
  static std::string name_of_test() {
    const testing::UnitTest& program = *testing::UnitTest::GetInstance();
    std::string name = "program";
    if (const testing::TestInfo* test = program.current_test_info()) {
      name = std::string(test->test_suite_name()) + "." + test->name();
    } else if (const testing::TestSuite* suite = program.current_test_suite()) {
      name = suite->name();
    }
    std::replace_if(
        name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) == 0 && c != '.'; }, '_');
    return name;
  }

  [[nodiscard]] bool has_failed() const {
    if (std::uncaught_exceptions() > exceptions_) return true;
    const testing::UnitTest& program = *testing::UnitTest::GetInstance();
    if (program.current_test_info() != nullptr) return testing::Test::HasFailure();
    const testing::TestSuite* suite = program.current_test_suite();
    return suite != nullptr && suite->Failed();
  }

  pid_t owner_ = getpid();
  int exceptions_ = std::uncaught_exceptions();
  std::filesystem::path path_;
};

}  // namespace menger::tests
