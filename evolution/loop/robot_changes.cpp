#include "evolution/loop/robot_changes.h"

#include <map>
#include <nlohmann/json.hpp>

#include "io/text/is_file.h"
#include "io/text/manifest.h"
#include "io/text/whole_file.h"

namespace menger::evolution {
namespace {

using Values = std::map<std::string, std::string>;

/// Adds the values of a table by their keys. @param prefix of its keys: "drive."
void add_values(const nlohmann::json& table, const std::string& prefix, Values& values) {
  for (const auto& [key, value] : table.items()) {
    if (value.is_object()) {
      add_values(value, prefix + key + ".", values);
    } else {
      values[prefix + key] = value.dump();
    }
  }
}

Values values_of(const std::string& manifest) {
  Values values;
  const nlohmann::json whole = nlohmann::json::parse(manifest, nullptr, false);  // no object where it is no JSON
  if (!whole.is_object()) return values;
  if (const auto parameters = whole.find("parameters"); parameters != whole.end() && parameters->is_object())
    add_values(*parameters, "", values);
  return values;
}

}  // namespace

std::vector<std::string> robot_changes(const std::filesystem::path& manifest, const std::string& parameters) {
  if (!io::is_file(manifest) || io::program_of_manifest(manifest) != "menger-loop") return {};
  const Values before = values_of(io::read_whole(manifest));
  if (before.empty()) return {};
  const Values now = values_of(io::manifest_text({.program = {}, .parameters = parameters, .seed = std::nullopt, .inputs = {}}));
  Values all = before;
  all.insert(now.begin(), now.end());
  const auto told = [](const Values& values, const std::string& key) {
    const auto found = values.find(key);
    return found == values.end() ? std::string("none") : found->second;
  };
  std::vector<std::string> changes;
  for (const auto& [key, value] : all) {
    const std::string first = told(before, key);
    const std::string second = told(now, key);
    if (first != second) changes.push_back(std::string(key).append(" ").append(first).append(" -> ").append(second));
  }
  return changes;
}

}  // namespace menger::evolution
