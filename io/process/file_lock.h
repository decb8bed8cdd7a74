#pragma once

#include <filesystem>

namespace menger::io {

/// Keeps other processes from writing to the same file or folder, by a lock on a file of the name `<target>.lock` beside it. A
/// process that dies, however, lets go of it.
///
/// The lock stands on a file of its own since SQLite forgets its locks as soon as any descriptor of the database is closed.
class FileLock {
 public:
  /// @throws InputError if another process holds the lock or the lock file cannot be made
  explicit FileLock(const std::filesystem::path& target);
  ~FileLock();
  FileLock(FileLock&& other) noexcept;
  FileLock& operator=(FileLock&&) = delete;
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;

 private:
  std::filesystem::path file_;
  int descriptor_ = -1;
};

}  // namespace menger::io
