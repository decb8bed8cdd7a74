#include "io/text/near_miss.h"

#include <algorithm>
#include <numeric>
#include <vector>

namespace menger::io {
namespace {

/// Returns the number of letters to replace, add or remove, and of neighbours to swap ("wakl" for "walk": optimal string
/// alignment).
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  std::vector<std::size_t> before;  // the row before that
  for (std::size_t i = 0; i < a.size(); ++i) {
    const std::vector<std::size_t> last = row;
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = last[j] + (a[i] == b[j] ? 0 : 1);
      row[j + 1] = std::min({replaced, row[j] + 1, last[j + 1] + 1});
      if (i > 0 && j > 0 && a[i] == b[j - 1] && a[i - 1] == b[j]) row[j + 1] = std::min(row[j + 1], before[j - 1] + 1);
    }
    before = last;
  }
  return row.back();
}

/// Returns the word that is the written one and more after an underscore, if there is only one.
std::optional<std::string> the_only_one_that_goes_on(std::string_view written, std::span<const std::string> words) {
  const std::string beginning = std::string(written) + "_";
  const auto goes_on = [&](const std::string& word) { return word.starts_with(beginning); };
  if (written.empty() || std::ranges::count_if(words, goes_on) != 1) return std::nullopt;
  return *std::ranges::find_if(words, goes_on);
}

}  // namespace

std::optional<std::string> near_miss(std::string_view written, std::span<const std::string> words) {
  std::size_t fewest = std::min<std::size_t>(3, 1 + written.size() / 5) + 1;
  std::optional<std::string> nearest;
  for (const std::string& word : words) {
    const std::size_t distance = edit_distance(word, written);
    if (distance >= fewest) continue;
    fewest = distance;
    nearest = word;
  }
  return nearest ? nearest : the_only_one_that_goes_on(written, words);
}

}  // namespace menger::io
