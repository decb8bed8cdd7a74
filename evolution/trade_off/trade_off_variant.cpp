#include "evolution/trade_off/trade_off_variant.h"

#include <toml++/toml.h>

#include <array>
#include <cassert>
#include <sstream>

#include "evolution/trade_off/trade_off_voxels.h"
#include "io/process/program_job.h"
#include "io/study/installed_folders.h"
#include "io/text/input_error.h"
#include "io/text/toml_checks.h"
#include "io/text/toml_document.h"
#include "io/text/whole_file.h"

namespace menger::evolution {
namespace {

/// A key that names a file, or data that come with menger.
struct FileKey {
  const char* table;
  const char* key;
  std::string_view data;  ///< name of the folder of such data
  const char* copy;       ///< name of the copy that a job gets
};

constexpr std::array file_keys{FileKey{"surrogate", "parameters", io::parameter_data, "parameters.toml"},
                               FileKey{"material", "silicone", io::silicone_data, "silicone.toml"}};

void set_file(toml::node_view<toml::node> name, const std::filesystem::path& file) {
  if (auto* const text = name.as_string()) *text = std::filesystem::absolute(file).lexically_normal().string();
}

}  // namespace

struct TomlVariant::Content {
  std::filesystem::path file;
  toml::table top;
};

TomlVariant::TomlVariant() : content_(std::make_unique<Content>()) {}

TomlVariant::TomlVariant(const std::filesystem::path& file) : content_(std::make_unique<Content>()) {
  content_->file = file;
  const std::string text = io::read_whole(file);
  io::require_shallow_toml(text, file);
  try {
    content_->top = toml::parse(text, file.string());
  } catch (const toml::parse_error& error) {
    throw io::InputError(file.string() + ":" + std::to_string(error.source().begin.line) + ": " +
                         std::string(error.description()));
  }
  const io::TomlTable top = io::parse_toml(text, file);
  const auto names_file = [&](const char* table, const char* key) {
    return top.is_table(table) && top.table(table).is_text(key);
  };
  if (names_file("design", "file")) set_file(content_->top["design"]["file"], top.table("design").path("file"));
  for (const FileKey& named : file_keys) {
    if (!names_file(named.table, named.key)) continue;
    set_file(content_->top[named.table][named.key], io::file_or_data(top.table(named.table), named.key, named.data));
  }
}

TomlVariant::~TomlVariant() = default;
TomlVariant::TomlVariant(TomlVariant&&) noexcept = default;
TomlVariant& TomlVariant::operator=(TomlVariant&&) noexcept = default;

template <class Value>
void TomlVariant::put(const std::vector<std::string_view>& path, const Value& value) {
  assert(!path.empty());
  toml::table* table = &content_->top;
  for (std::size_t n = 0; n + 1 < path.size(); ++n) {
    table = table->emplace<toml::table>(path[n]).first->second.as_table();
    if (table == nullptr) throw io::InputError(content_->file.string() + ": " + std::string(path[n]) + ": must be a table");
  }
  table->insert_or_assign(path.back(), value);
}

void TomlVariant::set(const std::vector<std::string_view>& path, std::string_view text) { put(path, std::string(text)); }
void TomlVariant::set(const std::vector<std::string_view>& path, double number) { put(path, number); }
void TomlVariant::set(const std::vector<std::string_view>& path, int number) { put(path, std::int64_t{number}); }
void TomlVariant::set(const std::vector<std::string_view>& path, bool value) { put(path, value); }

void TomlVariant::remove(std::string_view name) { content_->top.erase(name); }

std::map<std::string, std::filesystem::path> TomlVariant::files() const {
  std::map<std::string, std::filesystem::path> files;
  for (const FileKey& named : file_keys) {
    if (const auto file = content_->top[named.table][named.key].value<std::string>()) files.emplace(named.copy, *file);
  }
  return files;
}

std::string TomlVariant::text() const {
  std::ostringstream text;
  text << content_->top << "\n";
  return text.str();
}

void set_integration(TomlVariant& variant, const VoxelFidelity& fidelity) {
  if (fidelity.exclusion_depth == "off") {
    variant.set({"collisions", "exclusion_depth"}, "off");
  } else {
    variant.set({"collisions", "exclusion_depth"}, std::stoi(fidelity.exclusion_depth));
  }
  variant.set({"integration", "number"}, fidelity.number);
  variant.set({"integration", "damping"}, fidelity.damping);
  variant.set({"integration", "time_step_fraction"}, fidelity.time_step_fraction);
}

void add_input(io::ProgramJob& job, const std::string& name, TomlVariant variant) {
  const std::map<std::string, std::filesystem::path> files = variant.files();
  for (const FileKey& named : file_keys) {
    const auto file = files.find(named.copy);
    if (file == files.end()) continue;
    job.inputs[named.copy] = io::read_whole(file->second);
    variant.set({named.table, named.key}, named.copy);
  }
  job.inputs[name] = variant.text();
}

}  // namespace menger::evolution
