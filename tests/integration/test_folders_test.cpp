// Tests share nothing: each writes only into its own folder, so that any number of them can run at once and in any order.

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cctype>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <iostream>
#include <memory>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "io/text/whole_file.h"
#include "tests/support/test_folder.h"

namespace menger::tests {
namespace {

namespace fs = std::filesystem;

/// A copy of this process, which writes into files of a folder. Its failures are not failures of this test.
struct Copy {
  const TestFolder folder;

  /// Runs some work in the copy and waits for its end. Its output goes to the file "said".
  void run(const std::function<void()>& work) const {
    std::cout.flush();
    std::fflush(stdout);
    const pid_t child = fork();
    if (child == 0) {
      const bool is_open = std::freopen((folder / "said").c_str(), "w", stdout) != nullptr;
      try {
        work();
      } catch (...) {
        _exit(2);
      }
      std::fflush(stdout);
      _exit(is_open ? 0 : 2);
    }
    int status = -1;
    waitpid(child, &status, 0);
    ASSERT_TRUE(WIFEXITED(status));
    ASSERT_EQ(WEXITSTATUS(status), 0);
  }

  [[nodiscard]] std::string said() const { return io::read_whole(folder / "said"); }
};

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + part.size())) ++n;
  return n;
}

TEST(TestFolder, IsNewAndNamedAfterTestAndProcess) {
  const TestFolder folder;
  EXPECT_TRUE(fs::is_empty(folder));
  EXPECT_TRUE(folder.path().is_absolute());
  EXPECT_EQ(folder.path().filename(), "TestFolder.IsNewAndNamedAfterTestAndProcess." + std::to_string(getpid()));
}

class FolderOfParameters : public testing::TestWithParam<int> {
 protected:
  const TestFolder folder_;
};

TEST_P(FolderOfParameters, HasAPlainName) {
  const std::string test = "Both_FolderOfParameters.HasAPlainName_" + std::to_string(GetParam());
  EXPECT_EQ(folder_.path().filename(), test + "." + std::to_string(getpid()));
  EXPECT_TRUE(fs::equivalent(folder_.path().parent_path(), testing::TempDir()));
}

INSTANTIATE_TEST_SUITE_P(Both, FolderOfParameters, testing::Values(0, 1));

TEST(TestFolder, IsAnotherOneEachTime) {
  const TestFolder one;
  const TestFolder two;
  EXPECT_NE(one.path(), two.path());
  io::write_whole(one / "file", "text");
  EXPECT_TRUE(fs::is_empty(two));
}

TEST(TestFolder, IsAnotherOneThanWhatAKilledProcessLeft) {
  const fs::path left = TestFolder().path();
  io::write_whole(left / "file", "old");
  const TestFolder folder;
  EXPECT_NE(folder.path(), left);
  EXPECT_TRUE(fs::is_empty(folder));
  fs::remove_all(left);
}

TEST(TestFolder, IsRemovedWithAllThatItHolds) {
  fs::path path;
  {
    const TestFolder folder;
    path = folder;
    io::write_whole(folder / "a/b/file", "text");
  }
  EXPECT_FALSE(fs::exists(path));
}

TEST(TestFolder, IsRemovedAfterASkippedTest) {
  const Copy copy;
  copy.run([&] {
    const TestFolder folder;
    io::write_whole(copy.folder / "path", folder.path().string());
    GTEST_SKIP();
  });
  EXPECT_FALSE(fs::exists(io::read_whole(copy.folder / "path")));
  EXPECT_EQ(copy.said().find("kept"), std::string::npos);
}

TEST(TestFolder, IsKeptWhereTheTestHasFailedAndSaidOnce) {
  const Copy copy;
  copy.run([&] {
    const TestFolder folder;
    io::write_whole(copy.folder / "path", folder.path().string());
    io::write_whole(folder / "file", "text");
    ADD_FAILURE();
  });
  const fs::path path = io::read_whole(copy.folder / "path");
  EXPECT_EQ(io::read_whole(path / "file"), "text");
  EXPECT_EQ(count(copy.said(), "kept: " + path.string() + "\n"), 1U) << copy.said();
  fs::remove_all(path);
}

TEST(TestFolder, IsKeptWhereAnExceptionEndsItsScope) {
  const Copy copy;
  copy.run([&] {
    try {
      const TestFolder folder;
      io::write_whole(copy.folder / "path", folder.path().string());
      throw std::runtime_error("as a test that does not catch it");
    } catch (const std::runtime_error&) {
      const TestFolder folder;
      io::write_whole(copy.folder / "path of another", folder.path().string());
    }
  });
  const fs::path path = io::read_whole(copy.folder / "path");
  EXPECT_TRUE(fs::exists(path));
  EXPECT_FALSE(fs::exists(io::read_whole(copy.folder / "path of another"))) << "it began later";
  fs::remove_all(path);
}

TEST(TestFolder, OutlivesItsCopyInAChildProcess) {
  auto folder = std::make_unique<TestFolder>();
  io::write_whole(*folder / "file", "text");
  const Copy copy;
  copy.run([&] { folder.reset(); });
  EXPECT_EQ(io::read_whole(*folder / "file"), "text");
}

bool is_letter(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

/// Returns the position behind blanks.
std::size_t skip_blanks(std::string_view text, std::size_t at) {
  while (at < text.size() && std::isspace(static_cast<unsigned char>(text[at])) != 0) ++at;
  return at;
}

/// Returns the sources of some folders, with paths from the root.
std::vector<fs::path> sources(const std::vector<std::string>& folders) {
  const fs::path root = MENGER_SOURCE_DIR;
  std::vector<fs::path> files;
  for (const std::string& folder : folders) {
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root / folder))
      if (entry.path().extension() == ".h" || entry.path().extension() == ".cpp")
        files.push_back(fs::relative(entry.path(), root));
  }
  return files;
}

std::string text_of(const fs::path& source) { return io::read_whole(fs::path(MENGER_SOURCE_DIR) / source); }

/// Returns the expressions in a text that name a folder shared by all processes. Only the two helpers may have these: they make
/// folders of their own in it.
std::set<std::string> shared_places(const std::string& text) {
  std::set<std::string> found;
  for (const char* word : {"TempDir", "temp_directory_path", "TMPDIR", "P_tmpdir", "mkdtemp", "mkstemp", "mkostemp", "tmpnam",
                           "tempnam", "tmpfile", "current_path", "\"/tmp", "\"/var/tmp", "\"/dev/shm"}) {
    if (text.find(word) != std::string::npos) found.insert(word);
  }
  return found;
}

/// Returns the names of everything that makes a file: functions of the libraries that begin with write and have a path as first
/// argument, and others.
std::set<std::string> writers() {
  std::set<std::string> names{"create_directory", "create_directories", "ofstream",    "fopen",           "ProgramRun",
                              "PendingFile",      "FieldSeries",        "FrameSeries", "RunArchive::open"};
  const std::string argument = "(const std::filesystem::path& ";
  for (const fs::path& header : sources({"io", "materials", "meshes", "voxel", "fem", "evolution"})) {
    if (header.extension() != ".h") continue;
    const std::string text = text_of(header);
    for (std::size_t end = text.find(argument); end != std::string::npos; end = text.find(argument, end + 1)) {
      std::size_t begin = end;
      while (begin > 0 && is_letter(text[begin - 1])) --begin;
      const std::string name = text.substr(begin, end - begin);
      if (name.rfind("write_", 0) == 0) names.insert(name);
    }
  }
  return names;
}

/// Returns whether a writer has a fixed place as its first argument: a string, which would be a path in the folder where the test
/// was started, or a place in the source or build folder. The name of the writer, or of the type of an object, ends at `at`.
bool has_fixed_place(std::string_view text, std::size_t at) {
  at = skip_blanks(text, at);
  while (at < text.size() && is_letter(text[at])) ++at;  // the object's name
  at = skip_blanks(text, at);
  if (at == text.size() || (text[at] != '(' && text[at] != '{')) return false;
  at = skip_blanks(text, at + 1);
  for (const std::string_view path : {"std::filesystem::path(", "fs::path("})
    if (text.substr(at, path.size()) == path) at = skip_blanks(text, at + path.size());
  // The empty path and the entry of this process in /proc are not places to write to: tests use them to be refused.
  for (const std::string_view start : {"\"\"", "\"/proc/self/"})
    if (text.substr(at, start.size()) == start) return false;
  for (const std::string_view start : {"\"", "R\"", "MENGER_SOURCE_DIR", "MENGER_PROGRAM_DIR"})
    if (text.substr(at, start.size()) == start) return true;
  return false;
}

/// Returns the calls that write to a place that is the same in every process, with the beginning of their arguments.
std::vector<std::string> fixed_places(const std::string& text, const std::set<std::string>& writers) {
  std::vector<std::string> found;
  for (const std::string& writer : writers) {
    for (std::size_t at = text.find(writer); at != std::string::npos; at = text.find(writer, at + 1)) {
      if (at > 0 && is_letter(text[at - 1])) continue;
      if (has_fixed_place(text, at + writer.size())) found.push_back(text.substr(at, text.find('\n', at) - at));
    }
  }
  return found;
}

TEST(TestFolders, AreTheOnlyPlacesThatTestsWriteTo) {
  const std::set<std::string> names = writers();
  for (const char* name : {"write_whole", "write_design", "write_vtu", "write_response_curve"})
    EXPECT_EQ(names.count(name), 1U) << name << " is gone or has another name: does the search for writers still work?";
  int files = 0;
  int users = 0;
  for (const fs::path& source : sources({"tests"})) {
    if (source == "tests/integration/test_folders_test.cpp") continue;
    ++files;
    const std::string text = text_of(source);
    users += text.find("TestFolder folder") != std::string::npos ? 1 : 0;
    if (source != "tests/support/test_folder.h" && source != "tests/support/temporary_folder.h") {
      for (const std::string& word : shared_places(text)) {
        // It leads TMPDIR to folders that are not there.
        if (word == "TMPDIR" && source == "tests/unit/evolution/page/report_run_test.cpp") continue;
        ADD_FAILURE() << source << " names " << word << ": use TestFolder";
      }
    }
    for (const std::string& call : fixed_places(text, names))
      ADD_FAILURE() << source << " writes to a place that is no test's own: " << call;
  }
  EXPECT_GT(files, 200);
  EXPECT_GT(users, 50);
}

TEST(TestFolders, AreMissedWhereAPlaceIsShared) {
  const std::set<std::string> names{"write_whole", "ofstream"};
  for (const char* text : {"io::write_whole(\"a.toml\", text)", "write_whole(\n    \"a.toml\"", "std::ofstream file(\"a\")",
                           "std::ofstream{fs::path(\"a\")}", "write_whole(fs::path(MENGER_SOURCE_DIR) / \"a\"",
                           "write_whole(MENGER_PROGRAM_DIR \"/a\""})
    EXPECT_EQ(fixed_places(text, names).size(), 1U) << text;
  for (const char* text :
       {"write_whole(folder / \"a\")", "over_write_whole(\"a\")", "std::ofstream(file) << \"a\"", "#include <ofstream>",
        "write_whole(file, \"a\")", "write_whole(\"\", text)", "write_whole(\"/proc/self/a\", text)"})
    EXPECT_TRUE(fixed_places(text, names).empty()) << text;
  EXPECT_EQ(shared_places("fs::path(testing::TempDir()) / \"a\""), std::set<std::string>{"TempDir"});
  EXPECT_EQ(shared_places("read(\"/tmp/a\")"), std::set<std::string>{"\"/tmp"});
  EXPECT_TRUE(shared_places("folder / \"tmp\"").empty());
}

}  // namespace
}  // namespace menger::tests
