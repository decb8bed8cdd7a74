#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace menger::io {

/// A file that appears under its name only when it is complete: it is written under a temporary name in the same folder, flushed
/// to disk and renamed.
///
/// For writers of other libraries that want a file name: let them write `temporary()`, then call `commit()`. Without commit the
/// temporary file is removed and what stood under the name before stays untouched.
class PendingFile {
 public:
  /// Creates the folder of `target` if there is none. @throws InputError if it cannot be written to
  explicit PendingFile(std::filesystem::path target);
  ~PendingFile();
  PendingFile(const PendingFile&) = delete;
  PendingFile& operator=(const PendingFile&) = delete;

  /// Name to write to, with the extension of the target.
  [[nodiscard]] const std::filesystem::path& temporary() const { return temporary_; }

  /// Gives the file its name, in place of one that was there. @throws InputError naming path and reason
  void commit();

 private:
  std::filesystem::path target_;
  std::filesystem::path temporary_;
  bool committed_ = false;
};

/// Writes a file whole or not at all. @throws InputError naming path and reason
void write_whole(const std::filesystem::path& file, std::string_view content);

/// Removes a file, or an empty folder, if it is there. @throws InputError naming path and reason
void remove_if_there(const std::filesystem::path& file);

/// Removes files that are there. Names count from the folder; the last part of a name may hold one `*`: "frames/frame_*.vtu".
/// @throws InputError naming path and reason
void remove_files(const std::filesystem::path& folder, const std::vector<std::string_view>& names);

/// All bytes of a file. @throws InputError if it is missing, a folder or unreadable
std::string read_whole(const std::filesystem::path& file);

/// Creates the folder with its parents and makes sure that a file can be made in it. @throws InputError naming path and reason
void require_writable_folder(const std::filesystem::path& folder);

}  // namespace menger::io
