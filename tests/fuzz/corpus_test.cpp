// All files that fuzzers begin with or found, and the same few hundred changes of them in each run, read in the builds that users
// have. A file may be refused; nothing else may happen.

#include <glob.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <random>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "io/text/whole_file.h"
#include "tests/fuzz/line_mutation.h"
#include "tests/fuzz/readers.h"
#include "tests/support/test_folder.h"

namespace menger::tests {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> files_like(const std::string& pattern) {
  glob_t found{};
  std::vector<fs::path> files;
  if (::glob((MENGER_SOURCE_DIR "/" + pattern).c_str(), 0, nullptr, &found) == 0)
    files.assign(found.gl_pathv, found.gl_pathv + found.gl_pathc);
  ::globfree(&found);
  return files;
}

/// Returns the files that tests/fuzz/seeds.txt lists for a reader.
std::vector<fs::path> seeds_of(std::string_view reader) {
  std::vector<fs::path> seeds;
  std::istringstream lines(io::read_whole(MENGER_SOURCE_DIR "/tests/fuzz/seeds.txt"));
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string word;
    if (!(words >> word) || word != reader) continue;
    while (words >> word) {
      const std::vector<fs::path> files = files_like(word);
      EXPECT_FALSE(files.empty()) << "tests/fuzz/seeds.txt: " << word << " names no file";
      seeds.insert(seeds.end(), files.begin(), files.end());
    }
  }
  return seeds;
}

bool is_text(const std::string& content) { return content.find('\0') == std::string::npos; }

/// Changes a text by lines and values, and other files by a few bytes.
std::string mutated(std::string content, std::minstd_rand& random) {
  if (is_text(content)) return mutated_lines(content, static_cast<std::uint32_t>(random()));
  for (std::size_t n = 1 + random() % 4; n > 0 && !content.empty(); --n)
    content[random() % content.size()] = static_cast<char>(random() % 256);
  return content;
}

class FuzzedReaders : public testing::TestWithParam<FuzzedReader> {
 protected:
  [[nodiscard]] std::string refusal_of(const fs::path& input) const { return refusal_of_text(io::read_whole(input)); }
  [[nodiscard]] std::string refusal_of_text(const std::string& content) const {
    return read_fuzzed(GetParam(), folder_, place_, content);
  }

  const TestFolder folder_;
  const fs::path place_ = fuzzed_place(GetParam(), folder_);
};

TEST_P(FuzzedReaders, AcceptASeedAndRefuseOthersByName) {
  const std::vector<fs::path> seeds = seeds_of(GetParam().name);
  std::string refusals;
  bool accepts = false;
  for (const fs::path& seed : seeds) {
    std::string refusal;
    ASSERT_NO_THROW(refusal = refusal_of(seed)) << seed;
    accepts = accepts || refusal.empty();
    refusals += seed.string() + ": " + refusal + "\n";
  }
  EXPECT_TRUE(accepts) << "a fuzzer that begins with files of another form finds nothing\n" << refusals;
}

TEST_P(FuzzedReaders, RefuseOrAcceptWhatFuzzersFound) {
  for (const fs::path& input : files_like("tests/fuzz/corpus/" + std::string(GetParam().name) + "/*"))
    EXPECT_NO_THROW((void)refusal_of(input)) << input;
}

/// Changes pile up from seed to seed, up to four of them on one file.
TEST_P(FuzzedReaders, BearChangesOfSeeds) {
  constexpr std::array<std::string_view, 3> with_child{"frame", "msh", "vtu"};  // a process for each file
  const bool has_child = std::ranges::find(with_child, GetParam().name) != with_child.end();
  const int count = has_child ? 20 : 400;
  const std::vector<fs::path> seeds = seeds_of(GetParam().name);
  ASSERT_FALSE(seeds.empty());
  std::minstd_rand random(1);
  std::string content;
  for (int n = 0; n < count; ++n) {
    if (n % 4 == 0) content = io::read_whole(seeds[random() % seeds.size()]);
    content = mutated(content, random);
    ASSERT_NO_THROW((void)refusal_of_text(content)) << "after change " << n << ":\n" << content;
  }
}

std::string name_of(const testing::TestParamInfo<FuzzedReader>& info) {
  std::string name(info.param.name);
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(All, FuzzedReaders, testing::ValuesIn(fuzzed_readers().begin(), fuzzed_readers().end()), name_of);

TEST(FuzzedCorpus, BelongsToReaders) {
  for (const fs::path& folder : files_like("tests/fuzz/corpus/*"))
    EXPECT_NE(fuzzed_reader(folder.filename().string()), nullptr) << folder << " is of no reader";
}

}  // namespace
}  // namespace menger::tests
