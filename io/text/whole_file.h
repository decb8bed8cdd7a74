#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace menger::io {

/// A file that appears under its name only when it is complete. It is written under a temporary name in the same folder, flushed
/// to disk and then renamed.
///
/// A process that is killed leaves its temporary files. The next process that writes into the folder removes them. It knows them
/// by their locks: each process holds those of its own files until it ends.
///
/// Use it for libraries that write to a file name: let them write to `temporary()`, then call `commit()`. Without `commit()` the
/// temporary file is removed, and a file that already had the name stays unchanged.
class PendingFile {
 public:
  /// Creates the folder of `target` if it does not exist. @throws InputError if the folder cannot be written to
  explicit PendingFile(std::filesystem::path target);
  ~PendingFile();
  PendingFile(const PendingFile&) = delete;
  PendingFile& operator=(const PendingFile&) = delete;

  /// Returns the temporary name to write to. It has the extension of the target.
  [[nodiscard]] const std::filesystem::path& temporary() const { return temporary_; }

  /// Renames the file to its target and replaces a file of that name.
  /// @param may_be_empty false: an empty file is an error, since a library may not have written to it
  /// @throws InputError naming path and reason
  void commit(bool may_be_empty = false);

 private:
  std::filesystem::path target_;
  std::filesystem::path temporary_;
  int lock_ = -1;  ///< descriptor of the temporary file
  bool committed_ = false;
  PendingFile* older_ = nullptr;  ///< the next one in the list of all

  friend void remove_pending_files();
};

/// Removes the temporary files of all pending files, for a program that leaves at once. No file appears under its name any more:
/// threads that try to create or to commit one wait until the program has ended.
void remove_pending_files();

/// Writes a file, whole or not at all. @throws InputError naming path and reason
void write_whole(const std::filesystem::path& file, std::string_view content);

/// Removes a file or an empty folder if it exists. @throws InputError naming path and reason
void remove_if_there(const std::filesystem::path& file);

/// Removes the named files if they exist. Names count from the folder. The last part of a name may hold one `*`:
/// "frames/frame_*.vtu".
/// @throws InputError naming path and reason
void remove_files(const std::filesystem::path& folder, const std::vector<std::string_view>& names);

/// Returns all bytes of a file: all or an error, never a part. Every reader of menger takes its files from here.
/// @throws InputError naming path and reason if it is missing, a folder, cannot be read to its end, or does not fit into memory
std::string read_whole(const std::filesystem::path& file);

/// Returns the first bytes of a file, at most `most_bytes`. @throws InputError like read_whole
std::string read_start(const std::filesystem::path& file, std::size_t most_bytes);

/// Creates a folder with its parents and checks that a file can be made in it. @throws InputError naming path and reason
void require_writable_folder(const std::filesystem::path& folder);

}  // namespace menger::io
