#include "io/text/toml_substitution.h"

#include <gtest/gtest.h>

#include <string>

#include "io/text/toml_document.h"
#include "tests/support/input_error_message.h"

namespace menger::io {
namespace {

using tests::message_of;

TEST(TomlSubstitution, ChangesOneNumberAndNothingElse) {
  const std::string text = "# sizes \xc3\xa4\nlength = 1.5 # mm\n[ground]\n\"\xc3\xb6\" = 1\nfriction = -0.5e-1\nother = 0.05\n";
  EXPECT_EQ(with_number(text, "length", 2.0, "a.toml"),
            "# sizes \xc3\xa4\nlength = 2 # mm\n[ground]\n\"\xc3\xb6\" = 1\nfriction = -0.5e-1\nother = 0.05\n");
  EXPECT_EQ(with_number(text, "ground.friction", 0.25, "a.toml"),
            "# sizes \xc3\xa4\nlength = 1.5 # mm\n[ground]\n\"\xc3\xb6\" = 1\nfriction = 0.25\nother = 0.05\n");
}

TEST(TomlSubstitution, FindsNumbersInInlineTablesAndAtTheEnd) {
  EXPECT_EQ(with_number("a = {b = 1, c = {d = 2}}\n", "a.c.d", 3.5, "a.toml"), "a = {b = 1, c = {d = 3.5}}\n");
  EXPECT_EQ(with_number("a.b = 1_000", "a.b", 7.0, "a.toml"), "a.b = 7");
  EXPECT_EQ(with_number("\"\xc3\xa4\" = 1\nx = {\"\xc3\xa4\xc3\xb6\" = 1, y = 0x1F}\n", "x.y", 2.0, "a.toml"),
            "\"\xc3\xa4\" = 1\nx = {\"\xc3\xa4\xc3\xb6\" = 1, y = 2}\n");
}

TEST(TomlSubstitution, KeepsTheValueExactly) {
  const double value = 0.1 + 0.2;
  const std::string text = with_number("a = 1\r\nb = 2\r\n", "b", value, "a.toml");
  EXPECT_EQ(parse_toml(text, "a.toml").number("b"), value);
}

TEST(TomlSubstitution, RefusesWhatIsNoNumberThere) {
  const auto message = [](const std::string& text, const std::string& key) {
    return message_of([&] { (void)with_number(text, key, 1.0, "a.toml"); });
  };
  EXPECT_EQ(message("a = 1\n", "b"), "a.toml: b: the file does not contain this number");
  EXPECT_EQ(message("a = 1\n", "a.b"), "a.toml: a.b: the file does not contain this number");
  EXPECT_EQ(message("[a]\nb = 1\n", "a"), "a.toml: a: must be a number");
  EXPECT_EQ(message("a = \"x\"\n", "a"), "a.toml: a: must be a number");
  EXPECT_NE(message("a = = 1\n", "a").find("not TOML"), std::string::npos);
  EXPECT_EQ(message("a = 1\n", ""), "a.toml: : the file does not contain this number");
}

}  // namespace
}  // namespace menger::io
