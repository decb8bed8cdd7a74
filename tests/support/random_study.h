#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "io/study/study_text.h"
#include "io/study/study_visitor.h"

namespace menger::tests {

/// Values of keys as TOML, by the path of the key: "time.duration_s", "pressure[2].supply".
using ValueTexts = std::map<std::string, std::string>;

/// Visits a study and notes the path of the key that it is at.
class PathVisitor : public io::StudyVisitor {
 protected:
  [[nodiscard]] std::string path_of(const io::Key& key) const { return prefix_ + std::string(key.name); }
  void inside(const std::string& name, const std::function<void()>& describe) {
    const std::string before = prefix_;
    prefix_ += name + ".";
    describe();
    prefix_ = before;
  }

 private:
  std::string prefix_;
};

/// Collects the values that a study holds.
class HeldValues : public PathVisitor {
 public:
  [[nodiscard]] const ValueTexts& values() const { return values_; }

 protected:
  void visit(const io::StudyEntry& entry, std::optional<io::StudyValue>& value) override {
    values_[path_of(entry.key)] = value ? io::study_value_text(*value) : "";
  }
  void visit_table(const io::Key& key, const std::function<void()>& describe) override {
    inside(std::string(key.name), describe);
  }
  void visit_optional_table(const io::Key& key, bool has, const std::function<void(bool)>&,
                            const std::function<void()>& describe) override {
    if (has) inside(std::string(key.name), describe);
  }
  void visit_tables(const io::Key& key, const io::Count&, std::size_t size, const std::function<void(std::size_t)>&,
                    const std::function<void(std::size_t)>& describe) override {
    for (std::size_t n = 0; n < size; ++n) inside(std::string(key.name) + "[" + std::to_string(n) + "]", [&] { describe(n); });
  }
  void visit_choice(const std::vector<io::Alternative>& alternatives, std::string_view) override {
    for (const io::Alternative& alternative : alternatives)
      if (alternative.is_chosen) return alternative.describe();
  }
  void visit_branch(bool holds, std::string_view, const std::function<void()>& describe) override {
    if (holds) describe();
  }

 private:
  ValueTexts values_;
};

/// Gives every key of a study a random value that the key accepts. Conditions on several keys at once may not hold.
class RandomStudy : public PathVisitor {
 public:
  /// @param kept names of keys that keep their values, because range and words do not describe what they accept
  explicit RandomStudy(std::uint64_t seed, std::set<std::string, std::less<>> kept = {})
      : random_(seed), kept_(std::move(kept)) {}

  /// The values that the keys were given.
  [[nodiscard]] const ValueTexts& given() const { return given_; }

 protected:
  void visit(const io::StudyEntry& entry, std::optional<io::StudyValue>& value) override {
    if (kept_.contains(entry.key.name)) return;
    if (entry.is_optional && is_tossed()) {
      value.reset();
    } else {
      value = random_value(entry);
    }
    given_[path_of(entry.key)] = value ? io::study_value_text(*value) : "";
  }
  void visit_table(const io::Key& key, const std::function<void()>& describe) override {
    inside(std::string(key.name), describe);
  }
  void visit_optional_table(const io::Key& key, bool, const std::function<void(bool)>& set,
                            const std::function<void()>& describe) override {
    const bool has = is_tossed();
    set(has);
    if (has) inside(std::string(key.name), describe);
  }
  void visit_tables(const io::Key& key, const io::Count& count, std::size_t, const std::function<void(std::size_t)>& resize,
                    const std::function<void(std::size_t)>& describe) override {
    const std::size_t size = random_size(count);
    resize(0);
    resize(size);
    for (std::size_t n = 0; n < size; ++n) inside(std::string(key.name) + "[" + std::to_string(n) + "]", [&] { describe(n); });
  }
  void visit_choice(const std::vector<io::Alternative>& alternatives, std::string_view) override {
    const io::Alternative& chosen = alternatives.at(below(alternatives.size()));
    chosen.choose();
    chosen.describe();
  }
  void visit_branch(bool holds, std::string_view, const std::function<void()>& describe) override {
    if (holds) describe();
  }

 private:
  std::size_t below(std::size_t end) { return std::uniform_int_distribution<std::size_t>(0, end - 1)(random_); }
  bool is_tossed() { return below(2) == 0; }
  std::size_t random_size(const io::Count& count) {
    return count.fewest + below(std::min<std::size_t>(count.most - count.fewest, 3) + 1);
  }

  /// Returns a random number in a range. A range without a limit is cut to a width of at most 2000.
  double random_number(const io::Range& range) {
    const double lowest = std::max(range.lowest, range.highest < 1e3 ? range.highest - 1e3 : -1e3);
    const double highest = std::min(range.highest, lowest + 2e3);
    for (;;) {
      const double value = lowest + (highest - lowest) * std::uniform_real_distribution<double>(0.0, 1.0)(random_);
      if (range.contains(value)) return value;
    }
  }
  std::int64_t random_integer(const io::StudyEntry& entry) {
    const io::IntegerLimits& limits = entry.limits;
    io::Range range = entry.range;
    range.lowest = std::max(range.lowest, static_cast<double>(limits.lowest));
    range.highest = std::min(range.highest, static_cast<double>(limits.highest));
    for (;;) {
      const double value = std::floor(random_number(range));
      if (range.contains(value)) return static_cast<std::int64_t>(value);
    }
  }
  std::string random_text(const io::StudyEntry& entry) {
    if (!entry.words.empty()) return std::string(entry.words.at(below(entry.words.size())));
    std::string text;
    for (std::size_t n = 1 + below(8); n > 0; --n) text += "abz 09\"\\#=[]\n\t"[below(14)];
    return text;
  }
  /// Returns the layers of a design: rows of digits, all of the same length.
  std::vector<std::vector<std::string>> random_layers() {
    const std::size_t width = 1 + below(3);
    std::vector<std::vector<std::string>> layers(1 + below(3), std::vector<std::string>(1 + below(3)));
    for (auto& rows : layers) {
      for (std::string& row : rows) {
        for (std::size_t n = 0; n < width; ++n) row += "012"[below(3)];
      }
    }
    return layers;
  }
  io::StudyValue random_value(const io::StudyEntry& entry) {
    using io::ValueKind;
    std::vector<std::int64_t> integers;
    std::vector<double> numbers;
    std::vector<std::string> texts;
    const std::size_t size = random_size(entry.count);
    switch (entry.kind) {
      case ValueKind::boolean:
        return is_tossed();
      case ValueKind::integer:
        if (!entry.words.empty() && is_tossed()) return random_text(entry);
        return random_integer(entry);
      case ValueKind::number:
        return random_number(entry.range);
      case ValueKind::text:
        return random_text(entry);
      case ValueKind::path:
        return std::filesystem::path("folder/file_" + std::to_string(below(1000)));
      case ValueKind::integers:
        for (std::size_t n = 0; n < size; ++n) integers.push_back(random_integer(entry));
        return integers;
      case ValueKind::numbers:
        for (std::size_t n = 0; n < size; ++n) numbers.push_back(random_number(entry.range));
        return numbers;
      case ValueKind::text_rows:
        return random_layers();
      case ValueKind::texts:
        break;
    }
    for (std::size_t n = 0; n < size; ++n) texts.push_back(random_text(entry));
    return texts;
  }

  std::mt19937_64 random_;
  std::set<std::string, std::less<>> kept_;
  ValueTexts given_;
};

}  // namespace menger::tests
