#include "evolution/genome/random_stream.h"

#include <array>
#include <bit>
#include <cassert>
#include <charconv>
#include <cmath>
#include <limits>
#include <system_error>

#include "io/text/input_error.h"

namespace menger::evolution {

namespace {

constexpr std::string_view generator_name = "xoshiro256**";

/// SplitMix64, which the authors of xoshiro recommend for filling its state: any two inputs give unrelated words.
std::uint64_t next_seed_word(std::uint64_t& seed) {
  seed += 0x9e3779b97f4a7c15ULL;
  std::uint64_t word = seed;
  word = (word ^ (word >> 30)) * 0xbf58476d1ce4e5b9ULL;
  word = (word ^ (word >> 27)) * 0x94d049bb133111ebULL;
  return word ^ (word >> 31);
}

/// The FNV-1a hash of a text.
std::uint64_t hash_of(std::string_view text) {
  std::uint64_t hash = 0xcbf29ce484222325ULL;
  for (const char character : text) hash = (hash ^ static_cast<unsigned char>(character)) * 0x100000001b3ULL;
  return hash;
}

std::string hexadecimal(std::uint64_t word) {
  std::array<char, 16> digits{};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), word, 16).ptr;
  return {digits.data(), end};
}

}  // namespace

RandomStream::RandomStream(std::uint64_t seed, std::string_view purpose) {
  // The seed is mixed before it is combined with the purpose. Otherwise neighbouring seeds of one purpose could give the stream
  // of another purpose.
  std::uint64_t source = next_seed_word(seed) ^ hash_of(purpose);
  for (std::uint64_t& word : state_) word = next_seed_word(source);
}

std::uint64_t RandomStream::bits() {
  const std::uint64_t result = std::rotl(state_[1] * 5, 7) * 9;
  const std::uint64_t shifted = state_[1] << 17;
  state_[2] ^= state_[0];
  state_[3] ^= state_[1];
  state_[1] ^= state_[2];
  state_[0] ^= state_[3];
  state_[2] ^= shifted;
  state_[3] = std::rotl(state_[3], 45);
  return result;
}

std::size_t RandomStream::below(std::size_t count) {
  assert(count > 0);
  const std::uint64_t range = count;
  // The lowest 2^64 mod range words are rejected: they would make small results more frequent.
  const std::uint64_t surplus = (std::numeric_limits<std::uint64_t>::max() - range + 1) % range;
  std::uint64_t word = bits();
  while (word < surplus) word = bits();
  return static_cast<std::size_t>(word % range);
}

double RandomStream::uniform() { return static_cast<double>(bits() >> 11) * 0x1p-53; }

double RandomStream::normal(double mean, double standard_deviation) {
  for (;;) {
    const double first = 2.0 * uniform() - 1.0;
    const double second = 2.0 * uniform() - 1.0;
    const double square = first * first + second * second;
    if (square >= 1.0 || square == 0.0) continue;
    return mean + standard_deviation * first * std::sqrt(-2.0 * std::log(square) / square);
  }
}

std::string RandomStream::to_text() const {
  std::string text(generator_name);
  for (const std::uint64_t word : state_) text += ' ' + hexadecimal(word);
  return text;
}

RandomStream RandomStream::from_text(std::string_view text) {
  const auto refuse = [text] { return io::InputError("not the state of a random stream: \"" + std::string(text) + "\""); };
  if (!text.starts_with(generator_name)) throw refuse();
  RandomStream stream;
  const char* position = text.data() + generator_name.size();
  const char* const end = text.data() + text.size();
  bool any_bit = false;
  for (std::uint64_t& word : stream.state_) {
    if (position == end || *position != ' ') throw refuse();
    const auto [stop, error] = std::from_chars(position + 1, end, word, 16);
    if (error != std::errc()) throw refuse();
    position = stop;
    any_bit = any_bit || word != 0;
  }
  if (position != end || !any_bit) throw refuse();  // from the state 0 the generator gives zeros for ever
  return stream;
}

}  // namespace menger::evolution
