#include "io/text/printable.h"

#include <gtest/gtest.h>

namespace menger::io {
namespace {

TEST(Printable, KeepsWhatATerminalShows) {
  const std::string text = "a.toml:3: k = \"\xC3\xA4 \xE2\x82\xAC \xF0\x9F\x98\x80\\\":\n\tmust be > 0";
  EXPECT_EQ(printable(text), text);
}

TEST(Printable, EscapesControlCharacters) {
  EXPECT_EQ(printable("a\x1b[2Jb\rc\x07\x7f"), "a\\u001B[2Jb\\u000Dc\\u0007\\u007F");
  EXPECT_EQ(printable("\xC2\x9B"
                      "2J"),
            "\\u009B2J")
      << "the start of a command as one character";
  EXPECT_EQ(printable("\xE2\x80\xAE"
                      "txt.exe"),
            "\\u202Etxt.exe")
      << "writes from right to left";
  EXPECT_EQ(printable(std::string("a\0b", 3)), "a\\u0000b");
}

TEST(Printable, EscapesBytesThatAreNotUtf8) {
  EXPECT_EQ(printable("\x9B"
                      "2J"),
            "\\x9B2J");
  EXPECT_EQ(printable("\xC3"), "\\xC3") << "cut off";
  EXPECT_EQ(printable("\xC0\x8A"), "\\xC0\\x8A") << "a line break in two bytes";
  EXPECT_EQ(printable("\xED\xA0\x80"), "\\xED\\xA0\\x80") << "half of a pair of UTF-16";
  EXPECT_EQ(printable("\xF4\x90\x80\x80"), "\\xF4\\x90\\x80\\x80") << "beyond the last character";
}

TEST(Printable, ChangesNothingTheSecondTime) {
  std::string all;
  for (int byte = 0; byte < 256; ++byte) all += static_cast<char>(byte);
  EXPECT_EQ(printable(printable(all)), printable(all));
}

TEST(Printable, FindsACharacterThatIsCutOff) {
  EXPECT_EQ(unfinished_bytes(""), 0U);
  EXPECT_EQ(unfinished_bytes("a\xC3\xA4"), 0U);
  EXPECT_EQ(unfinished_bytes("a\xC3"), 1U);
  EXPECT_EQ(unfinished_bytes("a\xE2\x82"), 2U);
  EXPECT_EQ(unfinished_bytes("\xF0\x9F\x98"), 3U);
  EXPECT_EQ(unfinished_bytes("\x82\x82\x82\x82"), 0U) << "no start";
}

}  // namespace
}  // namespace menger::io
