#include "io/text/joined_text.h"

namespace menger::io {

std::string joined(const std::vector<std::string>& texts, std::string_view separator) {
  std::string all;
  for (std::size_t n = 0; n < texts.size(); ++n) all.append(n == 0 ? "" : separator).append(texts[n]);
  return all;
}

}  // namespace menger::io
