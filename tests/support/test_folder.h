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

/// A new, empty folder of one test, in testing::TempDir(). Use it as a member of a fixture or a local variable.
///
/// Its name contains the suite, the test and the process. If that name is already used, by another folder of the same test or by
/// a folder that an earlier process left, a number follows. Outside a test (SetUpTestSuite) its name contains only the suite and
/// the process.
///
/// The destructor removes it, also after GTEST_SKIP. The folder is kept, and its path printed, if the test has failed so far or
/// if an exception ends its scope. So do not put it into a scope that an expected exception leaves. A test that is killed also
/// leaves its folder. Wait for a child process while the folder exists: the destructor of the child's copy does nothing.
///
/// @throws std::filesystem::filesystem_error if it cannot be made
class TestFolder {
 public:
  TestFolder() {
    const std::filesystem::path parent = std::filesystem::absolute(testing::TempDir());
    std::filesystem::create_directories(parent);
    const std::string name = name_of_test() + "." + std::to_string(owner_);
    path_ = parent / name;
    // create_directory itself shows whether the name was free. A check before it could be outdated by another process.
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

  /// Returns the absolute path.
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] std::filesystem::path operator/(const std::filesystem::path& name) const { return path_ / name; }

  // NOLINTNEXTLINE(google-explicit-constructor,hicpp-explicit-conversions): a folder is used where its path is asked for
  operator const std::filesystem::path&() const { return path_; }

 private:
  /// Returns suite and test in characters that every file system accepts: names of parameterised tests contain slashes.
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
