#pragma once

#include <filesystem>
#include <optional>
#include <utility>

namespace menger::io {

/// A lock that keeps other processes from writing to the same file or folder. It locks a file named `<target>.lock` beside the
/// target, or beside the file that a symbolic link leads to.
///
/// The lock is released when the process ends, even if it crashes. The lock needs a file of its own because SQLite loses its
/// locks as soon as any descriptor of the database is closed.
class FileLock {
 public:
  /// @throws InputError if another process holds the lock, the lock file cannot be created or the target is a file with several
  ///     names (hard links)
  explicit FileLock(const std::filesystem::path& target);

  /// Returns the lock; nothing if it is held, by another process or in this one. @throws InputError otherwise as the constructor
  [[nodiscard]] static std::optional<FileLock> if_free(const std::filesystem::path& target);

  ~FileLock();
  FileLock(FileLock&& other) noexcept;
  FileLock& operator=(FileLock&&) = delete;
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;

 private:
  FileLock(std::filesystem::path file, int descriptor) : file_(std::move(file)), descriptor_(descriptor) {}

  std::filesystem::path file_;
  int descriptor_ = -1;
};

}  // namespace menger::io
