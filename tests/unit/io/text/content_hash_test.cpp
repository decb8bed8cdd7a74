#include "io/text/content_hash.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "io/text/input_error.h"
#include "io/text/whole_file.h"
#include "tests/support/test_folder.h"

namespace menger::io {
namespace {

// the three values are the examples that FIPS 180-4 gives for SHA-256
TEST(ContentHash, IsSha256) {
  EXPECT_EQ(content_hash(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(content_hash("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(content_hash("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
            "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
}

TEST(ContentHash, CountsZeroBytes) { EXPECT_NE(content_hash(std::string_view("a\0b", 3)), content_hash("a")); }

TEST(ContentHash, OfAFileIsThatOfItsBytes) {
  const tests::TestFolder folder;
  const std::filesystem::path file = folder / "abc.bin";
  write_whole(file, "abc");
  EXPECT_EQ(file_hash(file), content_hash("abc"));
  EXPECT_THROW(file_hash(file / "absent"), InputError);
}

TEST(NotedInput, HasTheHashOfWhatTheFileHoldsOrOfWhatWasRead) {
  const tests::TestFolder folder;
  const std::filesystem::path file = folder / "study.toml";
  write_whole(file, "a = 1\n");
  std::map<std::string, std::string> inputs;
  note_input(inputs, file);
  EXPECT_EQ(inputs, (std::map<std::string, std::string>{{file.string(), content_hash("a = 1\n")}}));
  note_input(inputs, file, "a = 2\n");
  EXPECT_EQ(inputs, (std::map<std::string, std::string>{{file.string(), content_hash("a = 2\n")}}));
}

TEST(NotedInput, IsRefusedIfItIsMissing) {
  const tests::TestFolder folder;
  std::map<std::string, std::string> inputs;
  EXPECT_THROW(note_input(inputs, folder / "absent.toml"), InputError);
  EXPECT_TRUE(inputs.empty());
}

}  // namespace
}  // namespace menger::io
