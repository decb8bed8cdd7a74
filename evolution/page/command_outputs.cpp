#include "evolution/page/command_outputs.h"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <string_view>
#include <system_error>

#include "io/text/input_error.h"
#include "io/text/whole_file.h"

namespace menger::evolution {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr int deepest_folder = 8;  ///< below the folder of the report

bool is_manifest_name(std::string_view name) {
  return name == "manifest.json" || name.ends_with(".manifest.json") || name.ends_with("_manifest.json");
}

/// Whether a folder holds parts of one command's work, which are no results of their own.
bool is_inner_folder(std::string_view name) {
  constexpr std::array inner{"runs", "cache", "frames", "fields"};
  return name.starts_with(".") || std::ranges::find(inner, name) != inner.end();
}

std::string text_of(const json& object, const char* key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_string() ? found->get<std::string>() : std::string();
}

std::optional<double> number_of(const json& object, const char* key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_number() ? std::optional(found->get<double>()) : std::nullopt;
}

/// The member of an object that is an object itself; null if there is none.
const json* object_of(const json& object, const char* key) {
  if (!object.is_object()) return nullptr;
  const auto found = object.find(key);
  return found != object.end() && found->is_object() ? &*found : nullptr;
}

std::optional<ManifestBody> body_of(const json& design) {
  if (const auto level = number_of(design, "level"); level && *level != 1.0) return std::nullopt;
  const auto edge = number_of(design, "cell_edge_m");
  const auto layers = design.find("layers");
  if (!edge || layers == design.end() || !layers->is_array()) return std::nullopt;
  ManifestBody body{.layers = {}, .cell_edge_m = *edge};
  for (const json& layer : *layers) {
    if (!layer.is_array()) return std::nullopt;
    std::vector<std::string> rows;
    for (const json& row : layer) {
      if (!row.is_string()) return std::nullopt;
      rows.push_back(row.get<std::string>());
    }
    body.layers.push_back(std::move(rows));
  }
  return body;
}

/// What must be equal for two models to be driven alike.
std::string drive_of(const json& drive) {
  json same;
  for (const char* key : {"mode", "pressure_Pa", "frequency_Hz"})
    if (const auto found = drive.find(key); found != drive.end()) same[key] = *found;
  return same.dump(-1, ' ', false, json::error_handler_t::replace);
}

/// Whether parameters, or those of the search in them, say that all cells are driven at once.
bool drives_in_phase(const json& parameters) {
  for (const char* table : {"design", "surrogate", "body"})
    if (const json* found = object_of(parameters, table); found != nullptr && text_of(*found, "chambers") == "single")
      return true;
  if (const json* drive = object_of(parameters, "drive"); drive != nullptr && text_of(*drive, "mode") == "in_phase") return true;
  const json* search = object_of(parameters, "search");
  return search != nullptr && drives_in_phase(*search);
}

/// Parses JSON; values nested deeper than any manifest are left out, since writing them again could overflow the stack.
json parsed(const std::string& text) {
  constexpr int deepest = 64;
  return json::parse(
      text, [](int depth, json::parse_event_t /*event*/, json& /*value*/) { return depth <= deepest; }, false);
}

/// Where manifests and folders are, in order of their names.
struct Found {
  std::vector<fs::path> manifests;
  std::vector<fs::path> folders;
};

Found list(const fs::path& folder) {
  Found found;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    std::error_code ignored;
    if (entry.is_symlink(ignored)) continue;
    if (entry.is_regular_file(ignored) && is_manifest_name(name)) found.manifests.push_back(entry.path());
    if (entry.is_directory(ignored) && !is_inner_folder(name)) found.folders.push_back(entry.path());
  }
  std::ranges::sort(found.manifests);
  std::ranges::sort(found.folders);
  return found;
}

/// The name under which people know an output.
std::string name_of(const fs::path& manifest, const fs::path& root) {
  const fs::path relative = manifest.lexically_relative(root);
  return relative.filename() == "manifest.json" ? relative.parent_path().generic_string() : relative.generic_string();
}

void collect(const fs::path& folder, const fs::path& root, int depth, std::vector<CommandOutput>& outputs,
             std::vector<std::string>& notes) {
  const Found found = list(folder);
  for (const fs::path& manifest : found.manifests) {
    try {
      if (std::optional<CommandOutput> output = read_command_output(manifest)) {
        output->name = name_of(manifest, root);
        outputs.push_back(std::move(*output));
      } else {
        notes.push_back(manifest.string() + ": is no manifest of a command of menger, and is left out");
      }
    } catch (const io::InputError& error) {
      notes.emplace_back(error.what());
    }
  }
  if (depth >= deepest_folder) return;
  for (const fs::path& inner : found.folders) {
    try {
      collect(inner, root, depth + 1, outputs, notes);
    } catch (const fs::filesystem_error& error) {
      notes.push_back(inner.string() + ": cannot be read: " + error.code().message());
    }
  }
}

}  // namespace

std::string command_of(const CommandOutput& output) {
  constexpr std::string_view before = "menger-";
  return output.program.starts_with(before) ? output.program.substr(before.size()) : output.program;
}

std::optional<CommandOutput> read_command_output(const fs::path& manifest) {
  const json content = parsed(io::read_whole(manifest));
  if (!content.is_object() || text_of(content, "program").empty()) return std::nullopt;
  CommandOutput output{.program = text_of(content, "program"),
                       .folder = manifest.parent_path(),
                       .manifest = manifest,
                       .name = {},
                       .version = text_of(content, "version"),
                       .seconds = number_of(content, "seconds")};
  if (const auto seed = content.find("seed"); seed != content.end() && seed->is_number_unsigned())
    output.seed = seed->get<std::uint64_t>();
  if (const json* inputs = object_of(content, "inputs_sha256")) {
    for (const auto& [file, hash] : inputs->items())
      if (hash.is_string()) output.inputs.emplace(file, hash.get<std::string>());
  }
  if (const auto notes = content.find("notes"); notes != content.end() && notes->is_array()) {
    for (const json& note : *notes)
      if (note.is_string()) output.notes.push_back(note.get<std::string>());
  }
  if (const auto parameters = content.find("parameters"); parameters != content.end()) {
    output.parameters = parameters->dump(1, ' ', false, json::error_handler_t::replace);
    if (const json* design = object_of(*parameters, "design")) {
      output.body_name = text_of(*design, "name");
      output.body = body_of(*design);
    }
    output.is_calibrated = object_of(*parameters, "surrogate") != nullptr;
    output.is_in_phase = drives_in_phase(*parameters);
    if (const json* drive = object_of(*parameters, "drive")) output.drive = drive_of(*drive);
  }
  return output;
}

std::vector<CommandOutput> find_command_outputs(const fs::path& folder, std::vector<std::string>& notes) {
  std::error_code ignored;
  if (!fs::is_directory(folder, ignored)) throw io::InputError(folder.string() + ": is no folder");
  std::vector<CommandOutput> outputs;
  try {
    collect(folder, folder, 0, outputs, notes);
  } catch (const fs::filesystem_error& error) {
    throw io::InputError(folder.string() + ": cannot be read: " + error.code().message());
  }
  std::ranges::stable_sort(outputs, {}, &CommandOutput::name);
  return outputs;
}

}  // namespace menger::evolution
