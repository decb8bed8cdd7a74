// Runs every row of a part as a separate test: the fast rows or the slow ones.

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <iostream>

#include "tests/extremes/part.h"

namespace menger::extremes {

/// Prints the name of a row in lists of tests. GoogleTest requires this name of the function.
// NOLINTNEXTLINE(readability-identifier-naming)
static void PrintTo(const Row& row, std::ostream* out) { *out << row.name; }

namespace {

std::vector<Row> rows_of_speed() {
  std::vector<Row> rows = part().rows;
  std::erase_if(rows, [](const Row& row) { return row.is_slow != MENGER_SLOW_ROWS; });
  return rows;
}

/// "modulus ratio 1e6" becomes ModulusRatio1e6.
std::string test_name(const testing::TestParamInfo<Row>& info) {
  std::string name;
  bool is_first = true;
  for (const char letter : info.param.name) {
    const auto code = static_cast<unsigned char>(letter);
    if (std::isalnum(code) != 0) name += is_first ? static_cast<char>(std::toupper(code)) : letter;
    is_first = letter == ' ';
  }
  return name;
}

class Extreme : public testing::TestWithParam<Row> {};

TEST_P(Extreme, EndsAsStatedBeforehand) {
  const RowResult result = run_row(GetParam());
  std::cout << "  " << result.happened << '\n';
  if (result.energy_error) std::cout << "  energy error " << *result.energy_error << '\n';
  EXPECT_TRUE(result.is_as_expected) << result.done << "\nexpected: " << result.expected << "\nhappened: " << result.happened;
}

INSTANTIATE_TEST_SUITE_P(Row, Extreme, testing::ValuesIn(rows_of_speed()), test_name);

#ifdef MENGER_ALL_ROWS_ARE_FAST
TEST(Part, WithoutTestOfSlowRowsHasNone) {
  for (const Row& row : part().rows) EXPECT_FALSE(row.is_slow) << row.name << " would never run as a test";
}
#endif

}  // namespace
}  // namespace menger::extremes
