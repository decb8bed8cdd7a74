#include "io/text/manifest.h"

#include <toml++/toml.h>

#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "io/text/content_hash.h"
#include "io/text/is_file.h"
#include "io/text/version.h"
#include "io/text/whole_file.h"

namespace menger::io {
namespace {

/// A TOML document as JSON; numbers that JSON has no word for become texts ("Infinity"). What is not TOML, since a file name has
/// bytes that are not UTF-8, stays text: it must not stop a finished job.
nlohmann::json json_of(const std::string& toml) {
  try {
    const toml::table table = toml::parse(toml);
    std::ostringstream text;
    text << toml::json_formatter(table);
    return nlohmann::json::parse(text.str());
  } catch (const toml::parse_error&) {
    return toml;
  }
}

/// Returns the JSON in a file; no object if there is no such file, or it is no JSON.
nlohmann::json json_in(const std::filesystem::path& file) {
  std::error_code error;
  if (!std::filesystem::exists(file, error)) return {};
  return nlohmann::json::parse(read_whole(file), nullptr, false);
}

}  // namespace

std::string manifest_text(const Manifest& manifest) {
  nlohmann::json json{{"program", manifest.program},
                      {"version", version()},
                      {"parameters", json_of(manifest.parameters)},
                      {"seconds", manifest.seconds},
                      {"inputs_sha256", manifest.inputs}};
  if (manifest.seed) json["seed"] = *manifest.seed;
  if (!manifest.notes.empty()) json["notes"] = manifest.notes;
  // a file name or comment in another encoding than UTF-8 must not stop a finished job: its bytes are replaced
  return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

std::string program_of_manifest(const std::filesystem::path& file) {
  const nlohmann::json json = json_in(file);
  if (!json.is_object() || !json.contains("program") || !json.at("program").is_string()) return {};
  return json.at("program").get<std::string>();
}

double seconds_of_manifest(const std::filesystem::path& file, const std::string& program) {
  const nlohmann::json json = json_in(file);
  if (!json.is_object() || json.value("program", nlohmann::json()) != program) return 0.0;
  const nlohmann::json seconds = json.value("seconds", nlohmann::json());
  return seconds.is_number() ? seconds.get<double>() : 0.0;
}

std::string hash_of_results(const std::filesystem::path& file) {
  if (!is_file(file)) return {};
  const std::string text = read_whole(file);
  nlohmann::json json = nlohmann::json::parse(text, nullptr, false);
  if (!json.is_object()) return content_hash(text);
  json.erase("seconds");
  if (const auto inputs = json.find("inputs_sha256"); inputs != json.end() && inputs->is_object()) {
    std::multiset<std::string> contents;
    for (const auto& content : *inputs) contents.insert(content.dump());
    *inputs = contents;
  }
  return content_hash(json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
}

void write_manifest_file(const std::filesystem::path& file, const Manifest& manifest) {
  write_whole(file, manifest_text(manifest));
}

void write_manifest(const std::filesystem::path& folder, const Manifest& manifest) {
  write_manifest_file(folder / "manifest.json", manifest);
}

}  // namespace menger::io
