#include "io/text/toml_text.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "io/text/toml_document.h"

namespace menger::io {
namespace {

TEST(TomlText, IsReadBack) {
  TomlText text;
  text.add("name", "a \"b\"\n").add("count", 3).add("share", 0.1).add("is_open", true).table("ground.plane");
  text.add("numbers", std::vector<double>{1.0, 1e-300}).add("texts", std::vector<std::string>{"x", "y\\"}).comment("why");
  text.entry("marks").raw("list", "[[1], [2]]");
  const TomlTable table = parse_toml(text.text(), "text.toml");
  EXPECT_EQ(table.text("name"), "a \"b\"\n");
  EXPECT_EQ(table.integer("count"), 3);
  EXPECT_EQ(table.number("share"), 0.1);
  EXPECT_TRUE(table.boolean("is_open"));
  const TomlTable plane = table.table("ground").table("plane");
  EXPECT_EQ(plane.numbers("numbers"), (std::vector<double>{1.0, 1e-300}));
  EXPECT_EQ(plane.texts("texts"), (std::vector<std::string>{"x", "y\\"}));
  EXPECT_EQ(table.tables("marks").size(), 1U);
}

}  // namespace
}  // namespace menger::io
