#include "evolution/trade_off/trade_off_variant.h"

#include <toml++/toml.h>

#include <cassert>
#include <sstream>

#include "evolution/trade_off/trade_off_voxels.h"
#include "io/process/program_job.h"
#include "io/text/input_error.h"
#include "io/text/toml_checks.h"
#include "io/text/whole_file.h"

namespace menger::evolution {
namespace {

void make_absolute(toml::node_view<toml::node> name, const std::filesystem::path& folder) {
  auto* const text = name.as_string();
  if (text != nullptr) *text = std::filesystem::absolute(folder / text->get()).lexically_normal().string();
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
  make_absolute(content_->top["design"]["file"], file.parent_path());
  make_absolute(content_->top["surrogate"]["parameters"], file.parent_path());
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

std::optional<std::filesystem::path> TomlVariant::parameters() const {
  return content_->top["surrogate"]["parameters"].value<std::string>();
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
  constexpr const char* copy = "parameters.toml";
  if (const auto parameters = variant.parameters()) {
    job.inputs[copy] = io::read_whole(*parameters);
    variant.set({"surrogate", "parameters"}, copy);
  }
  job.inputs[name] = variant.text();
}

}  // namespace menger::evolution
