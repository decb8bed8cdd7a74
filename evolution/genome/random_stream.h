#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace menger::evolution {

/// A serialisable stream of random numbers whose draws depend on nothing but its state.
///
/// The generator is xoshiro256** (period 2^256 − 1): its state is four words, so a checkpoint of every stream is one short line,
/// where the state of std::mt19937_64 takes 312 words. The distributions are written out because those of the standard library
/// differ between implementations.
class RandomStream {
 public:
  /// The stream named `purpose` of a study with this seed. Streams of different purposes or seeds start at unrelated states.
  RandomStream(std::uint64_t seed, std::string_view purpose);

  /// 64 uniform bits.
  std::uint64_t bits();

  /// A uniform integer of 0, ..., count − 1, by rejection (no modulo bias). Precondition: count > 0.
  std::size_t below(std::size_t count);

  /// A uniform double of [0, 1): 53 random bits times 2^−53.
  double uniform();

  /// True with probability `probability`.
  bool chance(double probability) { return uniform() < probability; }

  /// A normal deviate by Marsaglia's polar method; the second deviate of each pair is dropped so that the state stays the
  /// generator's.
  double normal(double mean, double standard_deviation);

  /// Puts the items into a uniformly random order (Fisher-Yates, from the last item down).
  template <class Item>
  void shuffle(std::vector<Item>& items) {
    for (std::size_t last = items.size(); last > 1; --last) std::swap(items[last - 1], items[below(last)]);
  }

  /// The state as text: "xoshiro256** " and four hexadecimal words.
  [[nodiscard]] std::string to_text() const;

  /// The stream that continues where the one that wrote `text` stood. @throws io::InputError if it is not such a text
  static RandomStream from_text(std::string_view text);

  bool operator==(const RandomStream&) const = default;

 private:
  RandomStream() = default;

  std::array<std::uint64_t, 4> state_{};
};

}  // namespace menger::evolution
