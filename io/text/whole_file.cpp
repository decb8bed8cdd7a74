#include "io/text/whole_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <fstream>
#include <limits>
#include <mutex>
#include <new>
#include <set>
#include <stdexcept>
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

/// Whether a file has the form of a temporary name: ".stem.PROCESS-NUMBER.partial.extension".
bool is_temporary_name(const std::string& name) {
  const auto end = name.rfind(".partial");
  if (!name.starts_with('.') || end == std::string::npos) return false;
  const auto begin = name.rfind('.', end - 1);
  if (end == 0 || begin == std::string::npos) return false;
  const std::string numbers = name.substr(begin + 1, end - begin - 1);
  const auto dash = numbers.find('-');
  const auto is_number = [](const std::string& text) {
    return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) { return '0' <= c && c <= '9'; });
  };
  return dash != std::string::npos && is_number(numbers.substr(0, dash)) && is_number(numbers.substr(dash + 1));
}

/// Whether a descriptor still belongs to the file of this name: another process may have removed it.
bool is_file(int descriptor, const fs::path& file) {
  struct stat held {};
  struct stat named {};
  return ::fstat(descriptor, &held) == 0 && ::lstat(file.c_str(), &named) == 0 && held.st_ino == named.st_ino &&
         held.st_dev == named.st_dev;
}

/// Makes a temporary file and locks it, where the file system has locks. @return its descriptor
int locked_file(const fs::path& temporary, const fs::path& target) {
  while (true) {
    const int flags = O_RDWR | O_CREAT | O_CLOEXEC;
    const int descriptor = ::open(temporary.c_str(), flags, 0666);  // NOLINT(cppcoreguidelines-pro-type-vararg)
    if (descriptor < 0) throw InputError(target.string() + ": cannot be written: " + reason_of(errno));
    const bool is_locked = ::flock(descriptor, LOCK_EX) == 0;
    if (!is_locked || is_file(descriptor, temporary)) return descriptor;
    ::close(descriptor);
  }
}

/// Removes the temporary files of a folder that no process holds, once for each folder.
void remove_left_over_files(const fs::path& folder) {
  static std::mutex mutex;
  static std::set<fs::path> cleaned;
  {
    const std::lock_guard lock(mutex);
    if (!cleaned.insert(folder).second) return;
  }
  std::vector<fs::path> found;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error); !error && entry != fs::directory_iterator(); entry.increment(error))
    if (is_temporary_name(entry->path().filename().string())) found.push_back(entry->path());
  for (const fs::path& file : found) {
    const int flags = O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK;
    const int descriptor = ::open(file.c_str(), flags);  // NOLINT(cppcoreguidelines-pro-type-vararg)
    if (descriptor < 0) continue;
    const bool is_left_over = ::flock(descriptor, LOCK_EX | LOCK_NB) == 0 && is_file(descriptor, file);
    if (is_left_over) fs::remove(file, error);
    ::close(descriptor);
  }
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

/// A file descriptor that is closed at the end of its scope.
class OpenFile {
 public:
  explicit OpenFile(int number) : number_(number) {}
  ~OpenFile() { ::close(number_); }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;

 private:
  int number_;
};

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
  remove_left_over_files(folder_of(target_));
  const std::lock_guard lock(pending_mutex);
  lock_ = locked_file(temporary_, target_);
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
  ::close(lock_);
}

void PendingFile::commit(bool may_be_empty) {
  flush_to_disk(temporary_, O_RDWR);
  std::error_code error;
  if (!may_be_empty && fs::file_size(temporary_, error) == 0)
    throw InputError(target_.string() + ": cannot be written: nothing was written to it");
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
  pending.commit(content.empty());
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

std::string read_whole(const fs::path& file) { return read_start(file, std::numeric_limits<std::size_t>::max()); }

std::string read_start(const fs::path& file, std::size_t most_bytes) {
  const auto fault = [&](const std::string& reason) { return InputError(file.string() + ": cannot be read: " + reason); };
  const int number = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);  // NOLINT(cppcoreguidelines-pro-type-vararg): POSIX
  if (number < 0) throw fault(reason_of(errno));
  const OpenFile in(number);
  struct stat known {};
  if (::fstat(number, &known) != 0) throw fault(reason_of(errno));
  if (S_ISDIR(known.st_mode)) throw fault("it is a folder");
  try {
    std::string content;
    if (S_ISREG(known.st_mode)) content.reserve(std::min(most_bytes, static_cast<std::size_t>(known.st_size)));
    std::vector<char> piece(std::size_t{1} << 16U);
    while (content.size() < most_bytes) {
      const ssize_t got = ::read(number, piece.data(), std::min(piece.size(), most_bytes - content.size()));
      if (got == 0) break;
      if (got < 0 && errno == EINTR) continue;
      if (got < 0) throw fault(reason_of(errno));
      content.append(piece.data(), static_cast<std::size_t>(got));
    }
    return content;
  } catch (const std::bad_alloc&) {
    throw fault("it does not fit into memory");
  } catch (const std::length_error&) {
    throw fault("it does not fit into memory");
  }
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
