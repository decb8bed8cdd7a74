#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace menger::evolution {

/// A stream of random numbers that can be saved and restored. Its draws depend on its state alone.
///
/// The generator is xoshiro256** (period 2^256 − 1). Its state is four words, so that a saved stream is one short line of text;
/// the state of std::mt19937_64 takes 312 words. The distributions are implemented here because those of the standard library
/// differ between implementations.
class RandomStream {
 public:
  /// Makes the stream named `purpose` of a study with this seed. Streams of different purposes or seeds start at unrelated
  /// states.
  RandomStream(std::uint64_t seed, std::string_view purpose);

  /// Draws 64 uniform bits.
  std::uint64_t bits();

  /// Draws a uniform integer of 0, ..., count − 1, by rejection (no modulo bias). Precondition: count > 0.
  std::size_t below(std::size_t count);

  /// Draws a uniform double of [0, 1): 53 random bits times 2^−53.
  double uniform();

  /// Returns true with probability `probability`.
  bool chance(double probability) { return uniform() < probability; }

  /// Draws a normal deviate by Marsaglia's polar method. The second deviate of each pair is dropped, so that the stream has no
  /// state beside that of the generator.
  double normal(double mean, double standard_deviation);

  /// Puts the items into a uniformly random order (Fisher-Yates, from the last item down).
  template <class Item>
  void shuffle(std::vector<Item>& items) {
    for (std::size_t last = items.size(); last > 1; --last) std::swap(items[last - 1], items[below(last)]);
  }

  /// Returns the state as text: "xoshiro256** " and four hexadecimal words.
  [[nodiscard]] std::string to_text() const;

  /// Returns a stream with the state that to_text wrote. @throws io::InputError if `text` is not such a state
  static RandomStream from_text(std::string_view text);

  bool operator==(const RandomStream&) const = default;

 private:
  RandomStream() = default;

  std::array<std::uint64_t, 4> state_{};
};

}  // namespace menger::evolution
