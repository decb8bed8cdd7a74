#include "io/vtk_file.h"

#include <fstream>
#include <string>
#include <string_view>

#include "io/input_error.h"

namespace menger::io {
namespace {

bool is_ended(const std::filesystem::path& file) {
  constexpr std::string_view end_tag = "</VTKFile>";
  constexpr std::streamoff longest_end = 32;  // room for line ends behind the tag
  std::ifstream stream(file, std::ios::binary | std::ios::ate);
  const std::streamoff size = stream.tellg();
  if (!stream || size <= 0) return false;
  stream.seekg(size > longest_end ? size - longest_end : 0);
  const std::string end{std::istreambuf_iterator<char>(stream), {}};
  const std::size_t last = end.find_last_not_of(" \t\r\n");
  return last != std::string::npos && std::string_view(end).substr(0, last + 1).ends_with(end_tag);
}

}  // namespace

void commit_vtk_file(PendingFile& pending, const std::filesystem::path& target, const VtkOutcome& outcome) {
  if (outcome.written == 0 || outcome.error_code != 0 || !is_ended(pending.temporary()))
    throw InputError(target.string() + ": cannot be written to its end; is the disk full?");
  pending.commit();
}

}  // namespace menger::io
