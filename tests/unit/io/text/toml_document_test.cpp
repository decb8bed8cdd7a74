#include "io/text/toml_document.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>

#include "io/text/toml_substitution.h"
#include "io/text/whole_file.h"
#include "tests/support/test_folder.h"

namespace menger::io {
namespace {

namespace fs = std::filesystem;

TomlTable parsed(std::string_view text) { return parse_toml(text, "folder/study.toml"); }

template <class Action>
std::string message(const Action& action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

/// The message with which reading `text` by `read` is refused.
template <class Read>
std::string refusal(std::string_view text, const Read& read) {
  const TomlTable table = parsed(text);
  return message([&] { (void)read(table); });
}

enum class Colour { red, green };
const Words<Colour> colours{{"red", Colour::red}, {"green", Colour::green}};

TEST(TomlTable, ReadsEveryKindOfValue) {
  const TomlTable table = parsed(R"(
number = 0.5
integer = 7
truth = true
text = "a"
numbers = [1, 2.5]
texts = ["a", "b"]
rows = [["a"], ["b", "c"]]
colour = "green"
[inner]
value = 1
[[item]]
id = 1
[[item]]
id = 2
)");
  EXPECT_EQ(table.number("number"), 0.5);
  EXPECT_EQ(table.number("integer"), 7.0) << "an integer where a number is asked for";
  EXPECT_EQ(table.integer("integer"), 7);
  EXPECT_TRUE(table.boolean("truth"));
  EXPECT_EQ(table.text("text"), "a");
  EXPECT_EQ(table.numbers("numbers"), (std::vector<double>{1.0, 2.5}));
  EXPECT_EQ(table.texts("texts"), (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(table.text_rows("rows"), (std::vector<std::vector<std::string>>{{"a"}, {"b", "c"}}));
  EXPECT_EQ(table.word("colour", colours), Colour::green);
  EXPECT_EQ(table.table("inner").integer("value"), 1);
  const std::vector<TomlTable> items = table.tables("item");
  ASSERT_EQ(items.size(), 2U);
  EXPECT_EQ(items[0].integer("id"), 1);
  EXPECT_EQ(items[1].integer("id"), 2);
  EXPECT_NO_THROW(table.finish());
}

TEST(TomlTable, FallsBackWhereAKeyIsMissing) {
  const TomlTable table = parsed("");
  EXPECT_EQ(table.number_or("a", 1.5), 1.5);
  EXPECT_EQ(table.optional_number("a"), std::nullopt);
  EXPECT_EQ(table.integer_or("a", 3), 3);
  EXPECT_TRUE(table.boolean_or("a", true));
  EXPECT_EQ(table.text_or("a", "b"), "b");
  EXPECT_EQ(table.word_or("a", Colour::red, colours), Colour::red);
  EXPECT_EQ(table.optional_path("a"), std::nullopt);
  EXPECT_FALSE(table.optional_table("a").has_value());
  EXPECT_TRUE(table.optional_tables("a").empty());
  EXPECT_FALSE(table.has("a"));
}

TEST(TomlTable, PrefersTheFileToTheFallback) {
  const TomlTable table = parsed("n = 2\ni = 4\nb = false\nt = \"x\"\nw = \"green\"\n");
  EXPECT_EQ(table.number_or("n", 1.5), 2.0);
  EXPECT_EQ(table.integer_or("i", 3), 4);
  EXPECT_FALSE(table.boolean_or("b", true));
  EXPECT_EQ(table.text_or("t", "b"), "x");
  EXPECT_EQ(table.word_or("w", Colour::red, colours), Colour::green);
}

TEST(TomlTable, NamesFileLineKeyAndValueOutsideTheRange) {
  EXPECT_EQ(refusal("[physics]\n\nyoungs_modulus_Pa = -3\n",
                    [](const TomlTable& t) { return t.table("physics").number("youngs_modulus_Pa", positive()); }),
            "folder/study.toml:3: physics.youngs_modulus_Pa = -3: must be > 0");
  EXPECT_EQ(refusal("a = 1.5", [](const TomlTable& t) { return t.number_or("a", 0.5, within(0, 1)); }),
            "folder/study.toml:1: a = 1.5: must be in [0, 1]");
  EXPECT_EQ(refusal("a = -1", [](const TomlTable& t) { return t.integer("a", non_negative()); }),
            "folder/study.toml:1: a = -1: must be >= 0");
  EXPECT_EQ(refusal("a = [1, -1]", [](const TomlTable& t) { return t.numbers("a", positive()); }),
            "folder/study.toml:1: a[2] = -1: must be > 0");
}

TEST(TomlTable, NamesAMissingKey) {
  EXPECT_EQ(refusal("\n[physics]\n", [](const TomlTable& t) { return t.table("physics").number("density_kg_m3"); }),
            "folder/study.toml:2: physics.density_kg_m3 is missing: a number is needed");
  EXPECT_NE(refusal("", [](const TomlTable& t) { return t.table("physics"); }).find("physics is missing: a table is needed"),
            std::string::npos);
}

TEST(TomlTable, NamesTheUnitWhereANumberIsWrittenWithOne) {
  const auto reason = [](const std::string& key, const std::string& value) {
    const std::string text = refusal(
        key + " = " + value, [&](const TomlTable& t) { return value.starts_with("[") ? t.numbers(key).front() : t.number(key); });
    return text.substr(text.rfind(": ") + 2);
  };
  EXPECT_EQ(reason("cell_edge_m", "\"12mm\""), "must be a number (metres)");
  EXPECT_EQ(reason("pressure_Pa", "[0, \"3 kPa\"]"), "must be a number (pascals)");
  EXPECT_EQ(reason("stiffness_Pa_per_m", "\"1\""), "must be a number");
  EXPECT_EQ(reason("factor", "\"1\""), "must be a number");
}

TEST(TomlTable, RefusesAWrongType) {
  const auto wrong = [](std::string_view value, const auto& read) {
    const std::string text = refusal("a = " + std::string(value), read);
    const std::string start = "folder/study.toml:1: a";
    return text.substr(0, start.size()) == start ? text.substr(start.size()) : text;
  };
  EXPECT_EQ(wrong("\"1\"", [](const TomlTable& t) { return t.number("a"); }), " = \"1\": must be a number");
  EXPECT_EQ(wrong("true", [](const TomlTable& t) { return t.number("a"); }), " = true: must be a number");
  EXPECT_EQ(wrong("1.0", [](const TomlTable& t) { return t.integer("a"); }), " = 1.0: must be an integer");
  EXPECT_EQ(wrong("1", [](const TomlTable& t) { return t.boolean("a"); }), " = 1: must be true or false");
  EXPECT_EQ(wrong("1", [](const TomlTable& t) { return t.text("a"); }), " = 1: must be a text in quotes");
  EXPECT_EQ(wrong("1", [](const TomlTable& t) { return t.path("a"); }), " = 1: must be a text in quotes");
  EXPECT_EQ(wrong("1", [](const TomlTable& t) { return t.numbers("a"); }), " = 1: must be an array of numbers");
  EXPECT_EQ(wrong("[1, \"2\"]", [](const TomlTable& t) { return t.numbers("a"); }), "[2] = \"2\": must be a number");
  EXPECT_EQ(wrong("[1]", [](const TomlTable& t) { return t.texts("a"); }), "[1] = 1: must be a text in quotes");
  EXPECT_EQ(wrong("[\"1\"]", [](const TomlTable& t) { return t.text_rows("a"); }), "[1] = \"1\": must be an array of strings");
  EXPECT_EQ(wrong("1", [](const TomlTable& t) { return t.table("a"); }), " = 1: must be a table");
  EXPECT_EQ(wrong("[1]", [](const TomlTable& t) { return t.tables("a"); }), "[1] = 1: must be a table");
  EXPECT_EQ(wrong("{}", [](const TomlTable& t) { return t.tables("a"); }), " = {...}: must be an array of tables");
  EXPECT_EQ(wrong("[]", [](const TomlTable& t) { return t.tables("a"); }), " = []: needs at least one table");
}

TEST(TomlTable, RefusesNanAndInfinity) {
  EXPECT_EQ(refusal("a = nan", [](const TomlTable& t) { return t.number("a"); }),
            "folder/study.toml:1: a = nan: must be a finite number");
  EXPECT_EQ(refusal("a = -inf", [](const TomlTable& t) { return t.number("a"); }),
            "folder/study.toml:1: a = -inf: must be a finite number");
  EXPECT_EQ(refusal("a = [inf]", [](const TomlTable& t) { return t.numbers("a"); }),
            "folder/study.toml:1: a[1] = inf: must be a finite number");
}

TEST(TomlTable, RefusesIntegersThatDoNotFitTheirType) {
  EXPECT_EQ(refusal("a = 2147483648", [](const TomlTable& t) { return t.integer("a"); }),
            "folder/study.toml:1: a = 2147483648: must be at most 2147483647");
  EXPECT_EQ(refusal("a = -1", [](const TomlTable& t) { return t.integer<std::uint64_t>("a"); }),
            "folder/study.toml:1: a = -1: must be at least 0");
  EXPECT_EQ(parsed("a = 9223372036854775807").integer<std::uint64_t>("a"), 9223372036854775807U);
  EXPECT_EQ(parsed("a = -9223372036854775808").integer<std::int64_t>("a"), INT64_MIN);
}

TEST(TomlTable, ReadsIntegersOfAListExactly) {
  const auto read = [](const TomlTable& t) { return t.integers("a", within(-1e19, 1e19), limits_of<std::int64_t>()); };
  EXPECT_EQ(read(parsed("a = [9007199254740993, 9223372036854775807, -9223372036854775808]")),
            (std::vector<std::int64_t>{9007199254740993, INT64_MAX, INT64_MIN}));
  EXPECT_EQ(refusal("a = 1", read), "folder/study.toml:1: a = 1: must be an array of integers");
  EXPECT_EQ(refusal("a = [1, 2.0]", read), "folder/study.toml:1: a[2] = 2.0: must be an integer");
  EXPECT_EQ(refusal("a = [\"1\"]", read), "folder/study.toml:1: a[1] = \"1\": must be an integer");
  EXPECT_EQ(refusal("a = [3]", [](const TomlTable& t) { return t.integers("a", at_least(4), {}); }),
            "folder/study.toml:1: a[1] = 3: must be >= 4");
  EXPECT_EQ(refusal("a = [0, -1]", [](const TomlTable& t) { return t.integers("a", {}, limits_of<std::uint8_t>()); }),
            "folder/study.toml:1: a[2] = -1: must be at least 0");
}

TEST(TomlTable, ListsTheAllowedWords) {
  EXPECT_EQ(refusal("a = \"blue\"", [](const TomlTable& t) { return t.word("a", colours); }),
            "folder/study.toml:1: a = \"blue\": must be \"red\" | \"green\"");
  EXPECT_EQ(refusal("a = 1", [](const TomlTable& t) { return t.word_or("a", Colour::red, colours); }),
            "folder/study.toml:1: a = 1: must be \"red\" | \"green\"");
  EXPECT_NE(
      refusal("", [](const TomlTable& t) { return t.word("a", colours); }).find("a is missing: \"red\" | \"green\" is needed"),
      std::string::npos);
}

TEST(TomlTable, ReportsEveryKeyNeverAskedFor) {
  const TomlTable table = parsed("duration_S = 5\nextra = 1\n[inner]\nodd = 2\n[[item]]\nid = 1\nodd = 3\n[unread]\nx = 1\n");
  (void)table.number_or("duration_s", 1.0);
  (void)table.table("inner");
  (void)table.tables("item")[0].integer("id");
  EXPECT_EQ(message([&] { table.finish(); }),
            "folder/study.toml:1: duration_S: unknown key, did you mean duration_s?\n"
            "folder/study.toml:2: extra: unknown key\n"
            "folder/study.toml:8: unread: unknown key\n"
            "folder/study.toml:4: inner.odd: unknown key\n"
            "folder/study.toml:7: item[1].odd: unknown key");
}

TEST(TomlTable, SuggestsOptionalKeysToo) {
  const TomlTable table = parsed("levl = 1\ncolor = \"red\"\n");
  (void)table.integer_or("level", 1);
  (void)table.word_or("colour", Colour::red, colours);
  EXPECT_EQ(message([&] { table.finish(); }),
            "folder/study.toml:2: color: unknown key, did you mean colour?\n"
            "folder/study.toml:1: levl: unknown key, did you mean level?");
}

TEST(TomlTable, SuggestsTheTableThatHasTheKeyOnceForAllItsEntries) {
  const TomlTable table =
      parsed("[drive]\nsupply = 1\n[[pressure]]\nsupply = 1\n[[pressure]]\nsupply = 2\n[form]\nsupply.a = 1\n");
  (void)table.table("drive").integer_or("supplies", 1);
  (void)table.table("form");
  for (const TomlTable& pressure : table.tables("pressure")) (void)pressure.integer("supply");
  const std::string found = message([&] { table.finish(); });
  EXPECT_NE(found.find("drive.supply: unknown key, did you mean pressure.supply?"), std::string::npos) << found;
  EXPECT_NE(found.find("form.supply: unknown key"), std::string::npos) << found;
  EXPECT_EQ(found.find("form.supply: unknown key, did"), std::string::npos) << "a table is no number: " << found;
}

TEST(TomlTable, SuggestsTheTableThatHasTheKey) {
  const TomlTable table = parsed("[elements]\ndegree = 2\ncount = 1\n");
  (void)table.table("elements").integer_or("size", 1);
  (void)table.table_or_empty("element").integer_or("degree", 1);
  (void)table.table_or_empty("a").integer_or("count", 1);
  (void)table.table_or_empty("b").integer_or("count", 1);
  EXPECT_EQ(message([&] { table.finish(); }),
            "folder/study.toml:3: elements.count: unknown key\n"
            "folder/study.toml:2: elements.degree: unknown key, did you mean element.degree?");
}

TEST(TomlTable, AddsUpWhatTwoHandlesOfOneTableAsked) {
  const TomlTable table = parsed("[inner]\na = 1\nb = 2\n");
  (void)table.table("inner").integer("a");
  EXPECT_THROW(table.finish(), InputError);
  (void)table.table("inner").integer("b");
  EXPECT_NO_THROW(table.finish());
}

TEST(TomlTable, LookingWhetherAKeyExistsDoesNotExcuseIt) {
  const TomlTable table = parsed("a = 1");
  EXPECT_TRUE(table.has("a"));
  EXPECT_THROW(table.finish(), InputError);
}

TEST(TomlTable, IsUnaskedOnItsOwn) {
  const TomlTable table = parsed("a = 1\n[inner]\nb = 2\n");
  const TomlTable other = table.table("inner").unasked();
  EXPECT_EQ(other.integer("b"), 2);
  EXPECT_NO_THROW(other.finish());
  EXPECT_EQ(message([&] { (void)other.text("b"); }), "folder/study.toml:3: inner.b = 2: must be a text in quotes");
  EXPECT_EQ(table.integer("a"), 1);
  EXPECT_NE(message([&] { table.finish(); }).find("inner.b: unknown key"), std::string::npos);
}

TEST(TomlTable, TellsArraysOfTablesFromTables) {
  const TomlTable table = parsed("a = 1\nb = [1]\nc = [{d = 1}]\n[[e]]\n[f]\n");
  for (const char* key : {"a", "b", "f", "none"}) EXPECT_FALSE(table.is_array_of_tables(key)) << key;
  for (const char* key : {"c", "e"}) EXPECT_TRUE(table.is_array_of_tables(key)) << key;
}

TEST(TomlTable, OutlivesTheTableItCameFrom) {
  const TomlTable inner = parsed("[inner]\na = 1\n").table("inner");
  EXPECT_EQ(inner.integer("a"), 1);
}

TEST(TomlTable, CountsRelativePathsFromItsOwnFolder) {
  EXPECT_EQ(parsed("a = \"../designs/l.toml\"").path("a"), fs::path("designs/l.toml"));
  EXPECT_EQ(parsed("a = \"/designs/l.toml\"").path("a"), fs::path("/designs/l.toml"));
  EXPECT_EQ(parse_toml("a = \"l.toml\"", "study.toml").path("a"), fs::path("l.toml"));
  EXPECT_EQ(refusal("a = \"\"", [](const TomlTable& t) { return t.path("a"); }),
            "folder/study.toml:1: a = \"\": must name a file");
}

TEST(TomlTable, LetsItsReaderBlameAValueOrAnEntry) {
  const TomlTable table = parsed("[t]\na = 3\nb = [[\"x\"],\n[\"y\", \"z\"]]\n").table("t");
  EXPECT_STREQ(table.error("a", "must be even").what(), "folder/study.toml:2: t.a = 3: must be even");
  EXPECT_STREQ(table.error("b", "odd", std::array<std::size_t, 2>{1, 1}).what(), "folder/study.toml:4: t.b[2][2] = \"z\": odd");
  EXPECT_STREQ(table.error("c", "is needed with a").what(), "folder/study.toml:1: t.c: is needed with a");
}

TEST(TomlFile, NamesTheLineOfASyntaxError) {
  const std::string text = message([] { (void)parsed("a = 1\nb = = 2\n"); });
  EXPECT_EQ(text.rfind("folder/study.toml:2: not TOML: ", 0), 0U) << text;
}

TEST(TomlFile, RefusesAKeyWrittenTwice) {
  const std::string text = message([] { (void)parsed("a = 1\na = 2\n"); });
  EXPECT_EQ(text.rfind("folder/study.toml:2: not TOML: ", 0), 0U) << text;
}

TEST(TomlFile, NamesAMissingFileAndAFolder) {
  EXPECT_EQ(message([] { (void)read_toml("/nowhere/absent.toml"); }),
            "/nowhere/absent.toml: cannot be read: No such file or directory");
  EXPECT_EQ(message([] { (void)read_toml("/proc"); }), "/proc: cannot be read: it is a folder");
}

TEST(TomlFile, IsReadFromDisk) {
  const tests::TestFolder folder;
  const fs::path file = folder / "study.toml";
  write_whole(file, "a = 1\n");
  const TomlTable table = read_toml(file);
  EXPECT_EQ(table.integer("a"), 1);
  EXPECT_EQ(table.file(), file);
}

std::string repeated(std::string_view part, std::size_t times) {
  std::string text;
  for (std::size_t n = 0; n < times; ++n) text += part;
  return text;
}

TEST(TomlDepth, IsBoundedBeforeTheTextIsParsed) {
  const std::string refused = "folder/study.toml:2: keys, tables or arrays lie more than 100 levels deep";
  const auto message_of = [](const std::string& text) { return message([&] { (void)parsed(text); }); };
  EXPECT_EQ(message_of("b = 1\na" + repeated(".a", 50000) + " = 1\n"), refused) << "dotted keys";
  EXPECT_EQ(message_of("b = 1\n[a" + repeated(" . 'a'", 50000) + "]\n"), refused) << "the name of a table";
  EXPECT_EQ(message_of("b = 1\na = " + repeated("[", 50000)), refused) << "arrays";
  EXPECT_EQ(message_of("b = 1\na = " + repeated("{a.a.a.a = ", 26) + "1" + repeated("}", 26) + "\n"), refused) << "inline tables";
  EXPECT_EQ(message([] { (void)with_number("a" + repeated(".a", 50000) + " = 1\n", "a", 1.0, "b.toml"); }),
            "b.toml:1: keys, tables or arrays lie more than 100 levels deep");
}

TEST(TomlDepth, CountsNoDotsOutsideOfKeys) {
  const std::string dots = repeated(".", 500);
  const std::string quotes(3, '"');
  std::string text = "a = \"" + dots + "\\\"" + dots + "\"\nb = '" + dots + "'\n# " + dots + "\n";
  text.append("c = ").append(quotes).append("\n").append(dots).append("\"\"\n").append(dots).append(quotes).append("\"\n");
  text.append("d = '''").append(dots).append("\n'''\n");
  text.append("e = [").append(repeated("1.5, ", 500)).append("]\n").append(repeated("[[f.g]]\nh = 1.5\n", 200));
  text.append("i = {a.b = 1, c.d = 2}\n");
  EXPECT_EQ(message([&] { (void)parsed(text); }), "");
}

TEST(TomlMessage, ShowsNumbersInTheFewestDigits) {
  const auto read = [](const TomlTable& table) { return table.number("g", positive()); };
  EXPECT_EQ(refusal("g = -9.81", read), "folder/study.toml:1: g = -9.81: must be > 0");
  EXPECT_EQ(refusal("g = -0.1", read), "folder/study.toml:1: g = -0.1: must be > 0");
  EXPECT_EQ(refusal("n = 5.0", [](const TomlTable& table) { return table.integer("n"); }),
            "folder/study.toml:1: n = 5.0: must be an integer");
}

TEST(TomlMessage, QuotesOddKeysAndEscapesControlCharacters) {
  const std::string found = message([] { parsed("\"a\\nb.toml:7: c = 1: \\u001B[2J\" = 1").finish(); });
  EXPECT_EQ(found.find_first_of("\n\x1b"), std::string::npos) << found;
  EXPECT_EQ(found.find("folder/study.toml:1: \"a\\nb.toml:7"), 0U) << found;
}

TEST(TomlText, IsQuotedSoThatItReadsBack) {
  for (const std::string text : {"plain", "a \"b\" \\ c", "line\nbreak\ttab", "'", "", "näme"}) {
    EXPECT_EQ(parsed("a = " + toml_quoted(text)).text("a"), text);
  }
}

}  // namespace
}  // namespace menger::io
