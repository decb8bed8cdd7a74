#include "io/text/manifest.h"

#include <nlohmann/json.hpp>

#include "io/text/content_hash.h"
#include "io/text/version.h"
#include "io/text/whole_file.h"

namespace menger::io {

void add_input(Manifest& manifest, const std::filesystem::path& file) { manifest.inputs[file.string()] = file_hash(file); }

std::string manifest_text(const Manifest& manifest) {
  nlohmann::json json{{"program", manifest.program},
                      {"version", version()},
                      {"parameters", manifest.parameters},
                      {"seconds", manifest.seconds},
                      {"inputs_sha256", manifest.inputs}};
  if (manifest.seed) json["seed"] = *manifest.seed;
  // a file name or comment in another encoding than UTF-8 must not stop a finished job: its bytes are replaced
  return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

void write_manifest_file(const std::filesystem::path& file, const Manifest& manifest) {
  write_whole(file, manifest_text(manifest));
}

void write_manifest(const std::filesystem::path& folder, const Manifest& manifest) {
  write_manifest_file(folder / "manifest.json", manifest);
}

}  // namespace menger::io
