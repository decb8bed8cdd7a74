#pragma once

#include <filesystem>

namespace menger::evolution {

/// Keeps other processes from writing to the same archive (or folder of runs), by a lock on a file of the name `<archive>.lock`
/// beside it. A process that dies, however, lets go of it.
///
/// The lock stands on a file of its own since SQLite forgets its locks as soon as any descriptor of the database is closed.
class ArchiveLock {
 public:
  /// @throws io::InputError if another process holds the lock or the lock file cannot be made
  explicit ArchiveLock(const std::filesystem::path& archive);
  ~ArchiveLock();
  ArchiveLock(ArchiveLock&& other) noexcept;
  ArchiveLock& operator=(ArchiveLock&&) = delete;
  ArchiveLock(const ArchiveLock&) = delete;
  ArchiveLock& operator=(const ArchiveLock&) = delete;

 private:
  std::filesystem::path file_;
  int descriptor_ = -1;
};

}  // namespace menger::evolution
