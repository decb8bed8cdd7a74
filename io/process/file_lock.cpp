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

}  // namespace

FileLock::FileLock(const std::filesystem::path& target) : file_(target.string() + ".lock") {
  while (true) {
    descriptor_ = ::open(file_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);  // NOLINT(cppcoreguidelines-pro-type-vararg)
    if (descriptor_ < 0) {
      throw InputError(file_.string() + ": cannot be written: " + std::generic_category().message(errno));
    }
    if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0) {
      const int error = errno;
      ::close(descriptor_);
      if (error == EWOULDBLOCK) throw InputError(target.string() + ": another process is writing to it");
      throw InputError(file_.string() + ": cannot be locked: " + std::generic_category().message(error));
    }
    if (is_file(descriptor_, file_)) return;
    ::close(descriptor_);
  }
}

FileLock::FileLock(FileLock&& other) noexcept
    : file_(std::move(other.file_)), descriptor_(std::exchange(other.descriptor_, -1)) {}

FileLock::~FileLock() {
  if (descriptor_ < 0) return;
  std::error_code ignored;
  std::filesystem::remove(file_, ignored);  // while the lock is held, so that the file of another holder is never removed
  ::close(descriptor_);
}

}  // namespace menger::io
