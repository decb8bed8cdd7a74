#include "io/text/csv_table.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <limits>

#include "io/text/whole_file.h"
#include "tests/support/test_folder.h"

namespace menger::io {
namespace {

const std::filesystem::path table_file = "curve.csv";

template <class Action>
std::string table_message(const Action& action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

std::string table_refusal(const std::string& text) {
  return table_message([&] { (void)parse_csv(text, table_file); });
}

TEST(CsvTable, WritesAHeaderAndShortestNumbers) {
  CsvTable table({"time_s", "steps", "status"});
  table.add_row(0.1, 3, "completed");
  table.add_row(1e-9, std::uint64_t{18446744073709551615U}, std::string("stopped"));
  EXPECT_EQ(table.text(), "time_s,steps,status\n0.1,3,completed\n1e-09,18446744073709551615,stopped\n");
  EXPECT_EQ(table.row_count(), 2U);
}

TEST(CsvTable, LeavesCellsEmptyWhereThereIsNoFiniteNumber) {
  CsvTable table({"a", "b", "c", "d"});
  table.add_row(std::optional<double>(), std::optional<double>(2.5), std::numeric_limits<double>::quiet_NaN(),
                std::numeric_limits<double>::infinity());
  EXPECT_EQ(table.text(), "a,b,c,d\n,2.5,,\n");
}

TEST(CsvTable, ReadsBackWhatItWrote) {
  const tests::TestFolder folder;
  const std::filesystem::path file = folder / "table.csv";
  CsvTable table({"x_m", "reason, quoted"});
  table.add_row(0.1 + 0.2, "a \"b\", c\nd");
  table.add_row(-0.0, "");
  table.write(file);
  const CsvContents contents = read_csv(file);
  EXPECT_EQ(contents.columns(), (std::vector<std::string>{"x_m", "reason, quoted"}));
  EXPECT_EQ(contents.row_count(), 2U);
  EXPECT_EQ(contents.number(0, "x_m"), 0.1 + 0.2);
  EXPECT_EQ(contents.text(0, "reason, quoted"), "a \"b\", c\nd");
  EXPECT_EQ(contents.text(1, "reason, quoted"), "");
}

TEST(CsvContents, AcceptWhatSpreadsheetsWrite) {
  const CsvContents contents = parse_csv("\xEF\xBB\xBFstretch, stress_Pa\r\n1.0,\t+2e3 \r\n\r\n\"1.5\",3000\r\n", table_file);
  EXPECT_EQ(contents.columns(), (std::vector<std::string>{"stretch", "stress_Pa"}));
  EXPECT_EQ(contents.numbers("stretch"), (std::vector<double>{1.0, 1.5}));
  EXPECT_EQ(contents.numbers("stress_Pa"), (std::vector<double>{2000.0, 3000.0}));
}

TEST(CsvContents, NeedNoLineBreakAtTheEnd) { EXPECT_EQ(parse_csv("a\n1", table_file).numbers("a"), std::vector<double>{1.0}); }

TEST(CsvContents, TellColumnsApart) {
  const CsvContents contents = parse_csv("a,b\n1,\n", table_file);
  EXPECT_TRUE(contents.has("a"));
  EXPECT_FALSE(contents.has("c"));
  EXPECT_EQ(contents.optional_number(0, "a"), 1.0);
  EXPECT_EQ(contents.optional_number(0, "b"), std::nullopt);
  EXPECT_EQ(table_message([&] { (void)contents.number(0, "c"); }), "curve.csv: no column c");
}

TEST(CsvContents, NameLineColumnAndValueOfABadNumber) {
  const CsvContents contents = parse_csv("stress_Pa,note\n1,x\n-3,\"two\nlines\"\n12kPa,\nnan,\n,\n", table_file);
  EXPECT_EQ(table_message([&] { (void)contents.number(1, "stress_Pa", non_negative()); }),
            "curve.csv:3: stress_Pa = -3: must be >= 0");
  EXPECT_EQ(table_message([&] { (void)contents.number(2, "stress_Pa"); }),
            "curve.csv:5: stress_Pa = 12kPa: must be a finite number");
  EXPECT_EQ(table_message([&] { (void)contents.number(3, "stress_Pa"); }),
            "curve.csv:6: stress_Pa = nan: must be a finite number");
  EXPECT_EQ(table_message([&] { (void)contents.number(4, "stress_Pa"); }), "curve.csv:7: stress_Pa: a number is missing");
  EXPECT_EQ(table_message([&] { (void)contents.numbers("note"); }), "curve.csv:2: note = x: must be a finite number");
}

TEST(CsvContents, CountOnlyWholeNumbers) {
  const CsvContents table = parse_csv("bodies\n0\n9007199254740992\n2.5\n-1\n1e308\n+-1\n", table_file);
  EXPECT_EQ(table.count(0, "bodies"), 0U);
  EXPECT_EQ(table.count(1, "bodies"), 9007199254740992U);
  EXPECT_EQ(table_message([&] { (void)table.count(2, "bodies"); }), "curve.csv:4: bodies = 2.5: must be a whole number");
  for (std::size_t row = 3; row < table.row_count(); ++row) EXPECT_THROW((void)table.count(row, "bodies"), InputError) << row;
}

TEST(CsvContents, RefuseRowsOfAnotherLength) {
  EXPECT_EQ(table_refusal("a,b\n1,2\n3\n"), "curve.csv:3: 1 cells where the header has 2");
  EXPECT_EQ(table_refusal("a,b\n1,2,3\n"), "curve.csv:2: 3 cells where the header has 2");
}

TEST(CsvContents, RefuseABrokenQuote) {
  EXPECT_EQ(table_refusal("a,b\n1,\"2\n3\n"), "curve.csv:2: a quote is not closed");
  EXPECT_EQ(table_refusal("a,b\n1,\"2\"3\n"), "curve.csv:2: text after a closing quote");
}

TEST(CsvContents, RefuseAnEmptyOrMissingFile) {
  EXPECT_EQ(table_refusal(""), "curve.csv: is empty: a header of column names is needed");
  EXPECT_EQ(table_refusal("\n\n"), "curve.csv: is empty: a header of column names is needed");
  EXPECT_THROW((void)read_csv("/nowhere/absent.csv"), InputError);
}

}  // namespace
}  // namespace menger::io
