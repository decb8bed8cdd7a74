#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>

#include "io/study/study_reader.h"
#include "io/study/study_template.h"
#include "io/study/study_text.h"
#include "io/text/input_error.h"
#include "tests/support/random_study.h"

namespace menger::tests {

/// A template whose keys, comments too, are checked: each must be shown with a value that it accepts.
class CheckedTemplate : public io::StudyTemplateWriter {
 public:
  using io::StudyTemplateWriter::StudyTemplateWriter;

 protected:
  void visit(const io::StudyEntry& entry, std::optional<io::StudyValue>& value) override {
    StudyTemplateWriter::visit(entry, value);
    const std::string lines = lines_so_far();
    const std::string line = std::string(entry.key.name) + " = ";
    const std::size_t at = lines.rfind(line);
    ASSERT_NE(at, std::string::npos) << entry.key.name;
    const std::string shown = lines.substr(at + line.size(), lines.size() - at - line.size() - 1);
    EXPECT_FALSE(entry.is_required() && (shown == "\"\"" || shown == "[]")) << entry.key.name << " = " << shown;
    if (entry.kind == io::ValueKind::path) return;  // names a file that may not be there
    try {
      static_cast<void>(io::read_study_value(io::parse_toml(std::string(entry.key.name) + " = " + shown, "template"), entry));
    } catch (const io::InputError& error) {
      ADD_FAILURE() << "the template breaks its own rule: " << error.what();
    }
  }
};

/// Expects that reading the template of a study gives the study that was described: with the defaults, and with each alternative
/// in turn. Expects of every value that the template shows, comments too, that its key accepts it.
/// @param parse makes a study from the text of a file; may throw io::InputError
/// @param refused alternatives that are invalid without another change: "integration.number = \"float32\""
/// @param adopt copies to the first study what the second one, which was read, has from files that the template names
template <class Study, class Parse>
void expect_template_is_read(
    const Parse& parse, const std::set<std::string>& refused = {},
    const std::function<void(Study&, const Study&)>& adopt = [](Study&, const Study&) {}) {
  std::size_t count = 0;
  std::set<std::string> found;
  for (std::size_t n = 0; n <= count; ++n) {
    Study told;
    if (n == 0) {
      Study shown;
      CheckedTemplate checked;
      describe(checked, shown);
    }
    io::StudyTemplateWriter writer(n == 0 ? std::nullopt : std::optional(n - 1));
    describe(writer, told);
    if (n == 0) count = writer.alternative_count();
    const std::string name = n == 0 ? "the defaults" : writer.enabled_name();
    try {
      const Study read = parse(writer.text());
      adopt(told, read);
      EXPECT_EQ(io::described_text(read), io::described_text(told)) << name;
    } catch (const io::InputError& error) {
      found.insert(name);
      EXPECT_TRUE(refused.contains(name)) << name << ": " << error.what() << "\n" << writer.text();
    }
  }
  EXPECT_EQ(found, refused) << "of " << count << " alternatives";
}

/// Returns the path of a key without the numbers of entries: "case.digits" of "case[3].digits".
inline std::string path_in_any_entry(std::string path) {
  for (std::size_t at = path.find('['); at != std::string::npos; at = path.find('[')) path.erase(at, path.find(']', at) - at + 1);
  return path;
}

/// Expects that reading the text of a random study gives the same study, and that a study holds every value that its keys were
/// given: a key whose value is not stored would let two different studies share a text.
/// @param fewest how many of the 300 studies must be valid; keys are drawn one by one, so conditions on several keys may fail
/// @param kept names of keys that keep their defaults, see RandomStudy
/// @param replaced names of keys whose value the study of the test itself replaces
template <class Study, class Parse>
void expect_texts_are_read_back(const Parse& parse, std::size_t fewest = 30, const std::set<std::string, std::less<>>& kept = {},
                                const std::set<std::string, std::less<>>& replaced = {"schema_version"}) {
  std::size_t possible = 0;
  std::map<std::string, std::size_t> given;          ///< studies that have a key, by its path in any entry
  std::map<std::string, std::size_t> held_as_given;  ///< those of them that hold the very value: others may be brought into range
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    Study study;
    RandomStudy random(seed, kept);
    describe(random, study);
    const std::string text = io::described_text(study);
    HeldValues held;
    describe(held, study);
    for (const auto& [path, value] : random.given()) {
      const auto found = held.values().find(path);
      if (found == held.values().end()) continue;
      const std::string key = path_in_any_entry(path);
      ++given[key];
      held_as_given[key] += found->second == value ? 1U : 0U;
    }
    try {
      EXPECT_EQ(io::described_text(parse(text)), text);
      ++possible;
    } catch (const io::InputError&) {
    }
  }
  EXPECT_GE(possible, fewest);
  for (const auto& [path, count] : given) {
    if (replaced.contains(path.substr(path.rfind('.') + 1))) continue;
    EXPECT_GT(held_as_given[path], 0U) << path << " never holds what it was given in " << count << " studies";
  }
}

}  // namespace menger::tests
