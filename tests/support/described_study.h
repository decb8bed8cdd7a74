#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <set>
#include <string>

#include "io/study/study_template.h"
#include "io/study/study_text.h"
#include "io/text/input_error.h"
#include "tests/support/random_study.h"

namespace menger::tests {

/// The template of a study is read to what it says: the defaults, and the same with each alternative in turn.
/// @param parse makes a study of the text of a file; may throw io::InputError
/// @param refused alternatives that mean nothing without another change: "integration.number = \"float32\""
/// @param adopt gives the first study what the second one, which was read, has from files that the template names
template <class Study, class Parse>
void expect_template_is_read(
    const Parse& parse, const std::set<std::string>& refused = {},
    const std::function<void(Study&, const Study&)>& adopt = [](Study&, const Study&) {}) {
  std::size_t count = 0;
  std::set<std::string> found;
  for (std::size_t n = 0; n <= count; ++n) {
    Study told;
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

/// Texts of random studies are read back to the same study.
/// @param fewest studies of the 300 that must be possible: their keys are drawn one by one, demands on several may not hold
/// @param kept names of keys that keep their defaults, see RandomStudy
template <class Study, class Parse>
void expect_texts_are_read_back(const Parse& parse, std::size_t fewest = 30,
                                const std::set<std::string, std::less<>>& kept = {}) {
  std::size_t possible = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    Study study;
    RandomStudy random(seed, kept);
    describe(random, study);
    const std::string text = io::described_text(study);
    try {
      EXPECT_EQ(io::described_text(parse(text)), text);
      ++possible;
    } catch (const io::InputError&) {
    }
  }
  EXPECT_GE(possible, fewest);
}

}  // namespace menger::tests
