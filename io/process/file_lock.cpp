#include "io/process/file_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <string>
#include <system_error>
#include <utility>

#include "io/text/input_error.h"

namespace menger::io {

namespace {

/// Whether the descriptor still refers to the file of this name. The last holder may have removed the file before our lock was
/// granted.
bool is_file(int descriptor, const std::filesystem::path& file) {
  struct stat held {};
  struct stat named {};
  return ::fstat(descriptor, &held) == 0 && ::stat(file.c_str(), &named) == 0 && held.st_ino == named.st_ino &&
         held.st_dev == named.st_dev;
}

/// Returns the name of the lock: beside the file itself, so that all symbolic links to it have the same lock.
std::filesystem::path lock_of(const std::filesystem::path& target) {
  constexpr int most_links = 40;
  std::error_code error;
  std::filesystem::path file = target;
  // A link may lead to a file that is yet to be made.
  for (int link = 0; link < most_links && std::filesystem::is_symlink(file, error); ++link)
    file = file.parent_path() / std::filesystem::read_symlink(file, error);
  const std::filesystem::path real = std::filesystem::weakly_canonical(file, error);
  return error ? target.string() + ".lock" : real.string() + ".lock";
}

/// Refuses a file with several names (hard links). Each name would have a lock of its own, so that two processes could write to
/// the file at once; SQLite, too, keeps its journal beside the name.
void require_one_name(const std::filesystem::path& target) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(target, error)) return;
  const auto names = std::filesystem::hard_link_count(target, error);
  if (error || names <= 1) return;
  throw InputError(target.string() + ": has " + std::to_string(names) +
                   " names (hard links), through which two processes could write to it: give the run a copy (cp)");
}

}  // namespace

FileLock::FileLock(const std::filesystem::path& target) {
  std::optional<FileLock> lock = if_free(target);
  if (!lock) throw InputError(target.string() + ": another process is writing to it");
  file_ = std::move(lock->file_);
  descriptor_ = std::exchange(lock->descriptor_, -1);
}

std::optional<FileLock> FileLock::if_free(const std::filesystem::path& target) {
  require_one_name(target);
  std::filesystem::path file = lock_of(target);
  while (true) {
    const int descriptor = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);  // NOLINT(cppcoreguidelines-pro-type-vararg)
    if (descriptor < 0) throw InputError(file.string() + ": cannot be written: " + std::generic_category().message(errno));
    if (::flock(descriptor, LOCK_EX | LOCK_NB) != 0) {
      const int error = errno;
      ::close(descriptor);
      if (error == EWOULDBLOCK) return std::nullopt;
      throw InputError(file.string() + ": cannot be locked: " + std::generic_category().message(error));
    }
    if (is_file(descriptor, file)) return FileLock(std::move(file), descriptor);
    ::close(descriptor);
  }
}

FileLock::FileLock(FileLock&& other) noexcept
    : file_(std::move(other.file_)), descriptor_(std::exchange(other.descriptor_, -1)) {}

FileLock::~FileLock() {
  if (descriptor_ < 0) return;
  // While the lock is held, and only what is locked: a folder that was renamed may have made way for the file of another holder.
  std::error_code ignored;
  if (is_file(descriptor_, file_)) std::filesystem::remove(file_, ignored);
  ::close(descriptor_);
}

}  // namespace menger::io
