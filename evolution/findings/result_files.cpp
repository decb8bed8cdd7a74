#include "evolution/findings/result_files.h"

#include "io/text/is_file.h"
#include "io/text/whole_file.h"

namespace menger::evolution {

namespace fs = std::filesystem;

std::optional<io::TomlTable> table_at(const fs::path& file) {
  if (!io::is_file(file)) return std::nullopt;
  return io::read_toml(file);
}

std::string early_end(const io::TomlTable& result) {
  const std::string status = result.text("status");
  const std::string reason = result.text_or("reason", "");
  return status == "completed" ? "" : status + (reason.empty() ? "" : ": " + reason);
}

std::string log_line(const fs::path& log, const std::string& beginning) {
  if (!io::is_file(log)) return "";
  const std::string text = "\n" + io::read_whole(log);
  const std::size_t start = text.rfind("\n" + beginning);
  if (start == std::string::npos) return "";
  return text.substr(start + 1, text.find('\n', start + 1) - start - 1);
}

}  // namespace menger::evolution
