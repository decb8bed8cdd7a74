#include "io/process/checkpoint_file.h"

#include <system_error>
#include <utility>

#include "io/text/content_hash.h"
#include "io/text/input_error.h"
#include "io/text/whole_file.h"

namespace menger::io {
namespace {

constexpr std::size_t hash_length = 64;

}  // namespace

CheckpointFile::CheckpointFile(std::filesystem::path file, std::string_view title, std::string_view identity)
    : file_(std::move(file)), head_(std::string(title) + "\n" + content_hash(identity)) {}

void CheckpointFile::write(std::string_view state) const { write_whole(file_, head_ + content_hash(state) + std::string(state)); }

std::optional<std::string> CheckpointFile::read() const {
  std::error_code ignored;
  if (!std::filesystem::exists(file_, ignored)) return std::nullopt;
  const std::string whole = read_whole(file_);
  const std::size_t title_length = head_.size() - hash_length;
  const bool is_one = whole.size() >= head_.size() + hash_length && whole.starts_with(head_.substr(0, title_length));
  if (!is_one) throw error("is not a checkpoint of this version of menger");
  if (!whole.starts_with(head_)) throw error("belongs to another study or another number of processes");
  std::string state = whole.substr(head_.size() + hash_length);
  if (whole.substr(head_.size(), hash_length) != content_hash(state)) throw error("is damaged");
  return state;
}

InputError CheckpointFile::error(std::string_view reason) const {
  return InputError(file_.string() + ": " + std::string(reason) + "; give --restart to start again from the beginning");
}

}  // namespace menger::io
