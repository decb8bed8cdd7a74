#include "meshes/load_cases/load_case.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <limits>
#include <string>

#include "io/text/input_error.h"
#include "meshes/load_cases/load_case_file.h"
#include "tests/support/described_study.h"

namespace menger::meshes {
namespace {

LoadCase bar() {
  return {.name = "bar-3_bending",
          .kind = LoadCaseKind::bending,
          .cells = {3, 1, 1},
          .digits = "120",
          .level = 2,
          .per_phase = true,
          .cell_edge_m = 0.02 / 3.0,
          .wall_thickness_m = 0.002,
          .pressures_Pa = {-1e3 / 3.0, 0.0, 0.1},
          .imposed = {0.1, 0.30000000000000004}};
}

LoadCase read(const std::string& text) {
  const io::TomlTable table = io::parse_toml(text, "case.toml");
  LoadCase load_case = read_load_case(table);
  table.finish();
  return load_case;
}

std::string refusal(const std::string& text) {
  try {
    (void)read(text);
  } catch (const io::InputError& error) {
    return error.what();
  }
  return "accepted";
}

/// The text of a case with one of its lines replaced.
std::string with(const std::string& key, const std::string& value) {
  std::string text = load_case_text(bar());
  const std::size_t start = text.find(key + " = ");
  EXPECT_NE(start, std::string::npos) << key;
  const std::size_t end = text.find('\n', start);
  return text.replace(start, end - start, value);
}

/// A case whose values fit to each other, whatever they are one by one.
struct PossibleCase {
  LoadCase load_case;
};

void describe(io::StudyVisitor& visitor, PossibleCase& possible) {
  LoadCase& load_case = possible.load_case;
  describe(visitor, load_case);
  std::erase_if(load_case.name, [](char sign) { return std::isalnum(static_cast<unsigned char>(sign)) == 0; });
  if (load_case.name.empty()) load_case.name = "a";
  load_case.cells = {static_cast<int>(load_case.digits.size()), 1, 1};
  for (char& digit : load_case.digits) digit = static_cast<char>('1' + digit % 2);
  load_case.wall_thickness_m = std::min(load_case.wall_thickness_m, 0.4 * load_case.cell_edge_m);
}

PossibleCase parse(const std::string& text) { return {read(text)}; }

TEST(LoadCase, EveryKindHasItsWord) {
  for (const auto& [word, kind] : load_case_kind_words()) EXPECT_EQ(to_string(kind), word);
  EXPECT_EQ(load_case_kind_words().size(), 9U);
}

TEST(LoadCase, EveryKindHasAbscissaeAndAtLeastOneOrdinate) {
  for (const auto& [word, kind] : load_case_kind_words()) {
    const std::vector<std::string> columns = response_columns(kind);
    EXPECT_EQ(columns.front(), "pressure_Pa") << word;
    EXPECT_GT(columns.size(), abscissa_count(kind)) << word;
    EXPECT_EQ(imposed_key(kind).empty(), abscissa_count(kind) == 1) << word;
  }
}

TEST(LoadCase, TextGivesTheSameCaseBack) {
  LoadCase load_case = bar();
  for (const auto& [word, kind] : load_case_kind_words()) {
    load_case.kind = kind;
    load_case.imposed = imposed_key(kind).empty() ? std::vector<double>{} : bar().imposed;
    EXPECT_EQ(read(load_case_text(load_case)), load_case) << word;
  }
}

TEST(LoadCase, TemplateAndTextsAreRead) {
  tests::expect_template_is_read<LoadCase>(read);
  tests::expect_texts_are_read_back<PossibleCase>(parse, 300, {}, {"cells", "digits"});
}

TEST(LoadCase, RefusesWhatIsNoCase) {
  EXPECT_EQ(refusal(with("name", "name = \"a/b\"")),
            "case.toml:1: name = \"a/b\": must be a name of letters, digits, \"-\" and \"_\"");
  EXPECT_NE(refusal(with("kind", "kind = \"bend\"")).find("case.toml:2: kind = \"bend\""), std::string::npos);
  EXPECT_NE(refusal(with("cells", "cells = [3, 1]")).find("must be three integers, not 2"), std::string::npos);
  EXPECT_NE(refusal(with("cells", "cells = [3, 1.5, 1]")).find("cells[2] = 1.5: must be an integer"), std::string::npos);
  EXPECT_NE(refusal(with("digits", "digits = \"11\"")).find("one digit for each of 3 cells"), std::string::npos);
  EXPECT_NE(refusal(with("digits", "digits = \"131\"")).find("must contain only 0, 1 and 2"), std::string::npos);
  EXPECT_NE(refusal(with("digits", "digits = \"000\"")).find("the body is empty"), std::string::npos);
  EXPECT_NE(refusal(with("wall_thickness_m", "wall_thickness_m = 0.004")).find("less than half"), std::string::npos);
  EXPECT_NE(refusal(with("pressures_Pa", "pressures_Pa = []")).find("needs at least one of its numbers"), std::string::npos);
  EXPECT_NE(refusal(with("pressures_Pa", "pressures_Pa = [nan]")).find("pressures_Pa[1]"), std::string::npos);
  EXPECT_NE(refusal(with("angle_rad", "angle_rad = []")).find("needs at least one of its numbers"), std::string::npos);
  EXPECT_NE(refusal(with("angle_rad", "angle_deg = [20]")).find("angle_rad is missing"), std::string::npos);
  EXPECT_NE(refusal(with("chambers", "chambers = \"many\"")).find("chambers = \"many\""), std::string::npos);
}

TEST(LongestSideCells, AreThoseOfTheBoxAroundTheOccupiedCells) {
  EXPECT_EQ(longest_side_cells({3, 1, 1}, "111"), 3);
  EXPECT_EQ(longest_side_cells({3, 1, 1}, "010"), 1);
  EXPECT_EQ(longest_side_cells({2, 3, 2}, "111010000000"), 3);  // y runs to 2 in the lower layer
  EXPECT_EQ(longest_side_cells({3, 2, 2}, "100000000001"), 3);
}

TEST(LoadCase, HasModulesByTheCellsOfTheBasalBodyAndItsLevel) {
  EXPECT_EQ(longest_side_modules(3, 1), 1);
  EXPECT_EQ(longest_side_modules(2, 2), 2);
  EXPECT_EQ(longest_side_modules(3, 4), 27);
  EXPECT_EQ(longest_side_modules(1000, 10), std::numeric_limits<int>::max());
}

}  // namespace
}  // namespace menger::meshes
