#include "io/text/whole_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <fstream>
#include <mutex>
#include <sstream>
#include <system_error>
#include <utility>

#include "io/text/input_error.h"

namespace menger::io {

namespace fs = std::filesystem;

namespace {

/// The pending files of this program, as a list. It has no destructor that could run before the last file is gone.
std::mutex pending_mutex;
PendingFile* newest_pending = nullptr;

std::string reason_of(int error) { return std::generic_category().message(error); }

fs::path folder_of(const fs::path& file) { return file.has_parent_path() ? file.parent_path() : fs::path("."); }

/// Returns a temporary name that differs from those of all files that this and other processes are writing.
fs::path temporary_name(const fs::path& target) {
  static std::atomic<unsigned> counter{0};
  std::string name(".");
  name.append(target.stem().string()).append(".").append(std::to_string(::getpid()));
  name.append("-").append(std::to_string(counter++)).append(".partial").append(target.extension().string());
  return folder_of(target) / name;
}

/// Flushes a file or folder to disk. The data must reach the disk before the name does; otherwise a crash could leave an empty
/// file under the final name.
void flush_to_disk(const fs::path& path, int flags) {
  const int descriptor = ::open(path.c_str(), flags | O_CLOEXEC);  // NOLINT(cppcoreguidelines-pro-type-vararg)
  if (descriptor < 0) throw InputError(path.string() + ": cannot be written: " + reason_of(errno));
  const int failed = ::fsync(descriptor);
  const int error = errno;
  ::close(descriptor);
  // Some file systems do not support fsync of a folder and return EINVAL.
  if (failed != 0 && error != EINVAL) throw InputError(path.string() + ": cannot be written: " + reason_of(error));
}

/// Finds the files whose name matches a pattern: the folder of `pattern`, and the text before and after the star of its last
/// part.
std::vector<fs::path> matching_files(const fs::path& pattern) {
  const std::string name = pattern.filename().string();
  const auto star = name.find('*');
  if (star == std::string::npos) return {pattern};
  const std::string start = name.substr(0, star);
  const std::string end = name.substr(star + 1);
  std::vector<fs::path> files;
  std::error_code no_such_folder;
  fs::directory_iterator entry(folder_of(pattern), no_such_folder);
  for (; !no_such_folder && entry != fs::directory_iterator(); entry.increment(no_such_folder)) {
    const std::string found = entry->path().filename().string();
    if (found.size() >= start.size() + end.size() && found.starts_with(start) && found.ends_with(end))
      files.push_back(entry->path());
  }
  return files;
}

}  // namespace

PendingFile::PendingFile(fs::path target) : target_(std::move(target)), temporary_(temporary_name(target_)) {
  if (fs::is_directory(target_)) throw InputError(target_.string() + ": cannot be written: it is a folder");
  require_writable_folder(folder_of(target_));
  const std::lock_guard lock(pending_mutex);
  older_ = newest_pending;
  newest_pending = this;
}

PendingFile::~PendingFile() {
  const std::lock_guard lock(pending_mutex);
  PendingFile** link = &newest_pending;
  while (*link != this) link = &(*link)->older_;
  *link = older_;
  std::error_code ignored;
  if (!committed_) fs::remove(temporary_, ignored);
}

void PendingFile::commit() {
  flush_to_disk(temporary_, O_RDWR);
  std::error_code error;
  {
    const std::lock_guard lock(pending_mutex);
    fs::rename(temporary_, target_, error);
  }
  if (error) throw InputError(target_.string() + ": cannot be written: " + error.message());
  committed_ = true;
  flush_to_disk(folder_of(target_), O_RDONLY | O_DIRECTORY);
}

void remove_pending_files() {
  pending_mutex.lock();  // never unlocked
  std::error_code ignored;
  for (const PendingFile* file = newest_pending; file != nullptr; file = file->older_) fs::remove(file->temporary(), ignored);
}

void write_whole(const fs::path& file, std::string_view content) {
  PendingFile pending(file);
  std::ofstream out(pending.temporary(), std::ios::binary);
  out.write(content.data(), static_cast<std::streamsize>(content.size()));
  out.close();
  if (!out) throw InputError(file.string() + ": cannot be written: " + reason_of(errno));
  pending.commit();
}

void remove_if_there(const fs::path& file) {
  std::error_code error;
  fs::remove(file, error);
  if (error) throw InputError(file.string() + ": cannot be removed: " + error.message());
}

void remove_files(const fs::path& folder, const std::vector<std::string_view>& names) {
  for (const std::string_view name : names) {
    // The files are listed first: it is not defined whether a listing shows files that are removed during it.
    for (const fs::path& file : matching_files(folder / name)) remove_if_there(file);
  }
}

std::string read_whole(const fs::path& file) {
  std::error_code ignored;
  if (fs::is_directory(file, ignored)) throw InputError(file.string() + ": cannot be read: it is a folder");
  std::ifstream in(file, std::ios::binary);
  if (!in) throw InputError(file.string() + ": cannot be read: " + reason_of(errno));
  std::ostringstream content;
  if (in.peek() != std::ifstream::traits_type::eof()) content << in.rdbuf();
  if (in.bad() || content.bad()) throw InputError(file.string() + ": cannot be read: " + reason_of(errno));
  return std::move(content).str();
}

void require_writable_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw InputError(folder.string() + ": cannot be created as a folder: " + error.message());
  if (!fs::is_directory(folder, error))
    throw InputError(folder.string() + ": cannot be created as a folder: a file of this name exists");
  if (::access(folder.c_str(), W_OK | X_OK) != 0)
    throw InputError(folder.string() + ": cannot be written to: " + reason_of(errno));
}

}  // namespace menger::io
