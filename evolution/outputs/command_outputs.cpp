#include "evolution/outputs/command_outputs.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string_view>
#include <system_error>

#include "evolution/outputs/json_parts.h"
#include "io/text/input_error.h"
#include "io/text/is_file.h"
#include "io/text/whole_file.h"

namespace menger::evolution {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr int deepest_folder = 8;  ///< below the folder of the report

bool is_manifest_name(std::string_view name) {
  return name == "manifest.json" || name.ends_with(".manifest.json") || name.ends_with("_manifest.json");
}

/// Whether a folder holds a run that a command made as a part of its work: it has a hash for a name, in a folder `runs`.
bool is_inner_run(const fs::path& folder) {
  constexpr std::string_view of_search = "search-";
  constexpr std::size_t digits = 16;
  if (folder.parent_path().filename() != "runs") return false;
  std::string name = folder.filename().string();
  if (name.starts_with(of_search)) name = name.substr(of_search.size());
  return name.size() == digits && name.find_first_not_of("0123456789abcdef") == std::string::npos;
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
    if (entry.is_directory(ignored) && !name.starts_with(".") && !is_inner_run(entry.path()))
      found.folders.push_back(entry.path());
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
        output->place = manifest.lexically_relative(root).parent_path().generic_string();
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

std::string parameters_of_menger(const CommandOutput& output) {
  for (const auto& [name, hash] : output.inputs) {
    const fs::path file(name);
    if (file.extension() == ".toml" && file.parent_path().filename() == "parameters") return file.filename().string();
  }
  return {};
}

const CommandOutput* loop_of(const std::vector<CommandOutput>& outputs) {
  const auto loop = std::ranges::find_if(
      outputs, [](const CommandOutput& output) { return command_of(output) == "loop" && output.place.empty(); });
  return loop == outputs.end() ? nullptr : &*loop;
}

std::string name_in_validation(const std::string& body, const CommandOutput& validation, const CommandOutput* loop) {
  const bool is_of_loop = loop != nullptr && !loop->robot_name.empty() && body == "robot" &&
                          io::is_file(validation.folder / "curves/robot_inflation.toml");
  return is_of_loop ? loop->robot_name : body;
}

std::string command_of(const CommandOutput& output) {
  constexpr std::string_view before = "menger-";
  return output.program.starts_with(before) ? output.program.substr(before.size()) : output.program;
}

std::string file_of(const CommandOutput& output, const std::string& file) {
  return (fs::path(output.place) / file).generic_string();
}

std::string body_or_place(const CommandOutput& output) {
  if (!output.body_name.empty()) return output.body_name;
  if (!output.name.empty()) return output.name;
  std::error_code ignored;
  return fs::weakly_canonical(output.folder, ignored).filename().string();
}

std::optional<CommandOutput> read_command_output(const fs::path& manifest) {
  const json content = parsed(io::read_whole(manifest));
  if (!content.is_object() || text_of(content, "program").empty()) return std::nullopt;
  CommandOutput output{.program = text_of(content, "program"),
                       .folder = manifest.parent_path(),
                       .manifest = manifest,
                       .place = {},
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
    if (const json* design = object_of(*parameters, "design")) output.body_name = text_of(*design, "name");
    output.stated = stated_run(*parameters);
    output.is_calibrated = object_of(*parameters, "surrogate") != nullptr;
    output.is_in_phase = drives_in_phase(*parameters);
    if (command_of(output) == "loop") {
      if (const json* robot = object_of(*parameters, "robot")) output.robot_name = text_of(*robot, "name");
      if (const json* walk = object_of(*parameters, "walk"))
        output.robot_walks = walk->value("present", json(true)) != json(false);
    }
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
