#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace menger::tests {

/// Changes a text as people change theirs, by whole lines and values: takes a line away, doubles, moves or cuts it, or puts an
/// odd value in place of a number, a word or a list. Changes of single bytes mostly make a text that is no TOML or CSV any more,
/// which the first check of a reader finds.
/// @param random decides what is done
std::string mutated_lines(const std::string& text, std::uint32_t random);

}  // namespace menger::tests
