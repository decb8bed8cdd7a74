#include "io/text/content_hash.h"

#include <openssl/evp.h>

#include <array>
#include <stdexcept>

#include "io/text/whole_file.h"

namespace menger::io {

std::string content_hash(std::string_view bytes) {
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned int length = 0;
  if (EVP_Digest(bytes.data(), bytes.size(), digest.data(), &length, EVP_sha256(), nullptr) != 1) {
    throw std::runtime_error("libcrypto has no SHA-256");
  }
  constexpr std::string_view digits = "0123456789abcdef";
  std::string text;
  text.reserve(2 * std::size_t{length});
  for (unsigned int i = 0; i < length; ++i) {
    text += digits[digest.at(i) >> 4U];
    text += digits[digest.at(i) & 15U];
  }
  return text;
}

std::string file_hash(const std::filesystem::path& file) { return content_hash(read_whole(file)); }

void note_input(std::map<std::string, std::string>& inputs, const std::filesystem::path& file) {
  note_input(inputs, file, read_whole(file));
}

void note_input(std::map<std::string, std::string>& inputs, const std::filesystem::path& file, std::string_view content) {
  inputs[file.string()] = content_hash(content);
}

}  // namespace menger::io
