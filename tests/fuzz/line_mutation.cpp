#include "tests/fuzz/line_mutation.h"

#include <algorithm>
#include <array>
#include <random>
#include <string_view>
#include <vector>

namespace menger::tests {
namespace {

constexpr std::array<std::string_view, 34> odd_values{"0",
                                                      "-1",
                                                      "1",
                                                      "2",
                                                      "3",
                                                      "1e308",
                                                      "-1e308",
                                                      "1e-320",
                                                      "nan",
                                                      "inf",
                                                      "-inf",
                                                      "9223372036854775807",
                                                      "-9223372036854775808",
                                                      "2147483648",
                                                      "1000000",
                                                      "0.5",
                                                      "1e-9",
                                                      "true",
                                                      "false",
                                                      "\"\"",
                                                      "\"x\"",
                                                      "[]",
                                                      "[[]]",
                                                      "[1, 2]",
                                                      "[\"a\"]",
                                                      "{}",
                                                      "[{}]",
                                                      "\"\\u001B[2J\"",
                                                      "\"..\"",
                                                      "\"/\"",
                                                      "",
                                                      "\"1\"",
                                                      "-0.0",
                                                      "1.0"};

using Random = std::minstd_rand;

std::size_t below(Random& random, std::size_t limit) { return limit == 0 ? 0 : random() % limit; }

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::size_t start = 0;
  while (start < text.size()) {
    const std::size_t end = std::min(text.find('\n', start), text.size() - 1);
    lines.push_back(text.substr(start, end + 1 - start));
    start = end + 1;
  }
  return lines;
}

/// Puts an odd value, or one of another line, in place of a value: what stands behind "=" or between commas.
std::string with_value(const std::string& line, std::string_view value, Random& random) {
  std::vector<std::size_t> starts;
  for (std::size_t at = 0; at < line.size(); ++at) {
    if (line[at] == '=' || line[at] == ',' || line[at] == '[') starts.push_back(at + 1);
  }
  const bool has_key = line.find('=') != std::string::npos;
  if (!has_key) starts.push_back(0);
  const std::size_t start = starts[below(random, starts.size())];
  const bool whole = has_key && below(random, 2) == 0;
  const std::size_t first = whole ? line.find('=') + 1 : start;
  const std::size_t end = std::min(line.find_first_of(whole ? "\n#" : ",]\n#", first), line.size());
  return line.substr(0, first) + (has_key ? " " : "") + std::string(value) + line.substr(end);
}

std::string_view value_of(const std::string& line) {
  const std::size_t sign = line.find('=');
  if (sign == std::string::npos) return line.empty() ? std::string_view() : std::string_view(line).substr(0, line.size() - 1);
  return std::string_view(line).substr(sign + 1, line.size() - sign - 2);
}

}  // namespace

std::string mutated_lines(const std::string& text, std::uint32_t seed) {
  Random random(seed);
  random.discard(3);
  std::vector<std::string> lines = lines_of(text);
  if (lines.empty()) lines.emplace_back("\n");
  const std::size_t times = 1 + below(random, 3);
  for (std::size_t n = 0; n < times && !lines.empty(); ++n) {
    const std::size_t at = below(random, lines.size());
    const std::size_t other = below(random, lines.size());
    switch (below(random, 8)) {
      case 0:
        lines.erase(lines.begin() + static_cast<std::ptrdiff_t>(at));
        break;
      case 1:
        lines.insert(lines.begin() + static_cast<std::ptrdiff_t>(other), std::string(lines[at]));
        break;
      case 2:
        std::swap(lines[at], lines[other]);
        break;
      case 3:
        lines[at].resize(below(random, lines[at].size()));
        break;
      case 4:
        lines[at] = with_value(lines[at], std::string(value_of(lines[other])), random);
        break;
      default:
        lines[at] = with_value(lines[at], odd_values.at(below(random, odd_values.size())), random);
        break;
    }
  }
  std::string mutated;
  for (const std::string& line : lines) mutated += line;
  return mutated;
}

}  // namespace menger::tests
