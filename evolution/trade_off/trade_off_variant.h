#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace menger::io {
struct ProgramJob;
}

namespace menger::evolution {

struct VoxelFidelity;

/// A TOML file of the user with some keys changed: a scene or study at another fidelity. File names in it (`design.file`,
/// `surrogate.parameters`, `material.silicone`) become absolute, also those that stand for files of menger, so that the text can
/// be in any folder.
class TomlVariant {
 public:
  TomlVariant();  ///< begins with an empty file
  /// @throws io::InputError if the file cannot be read or is not TOML, or names parameters or a silicone that there are not
  explicit TomlVariant(const std::filesystem::path& file);
  ~TomlVariant();
  TomlVariant(const TomlVariant&) = delete;
  TomlVariant& operator=(const TomlVariant&) = delete;
  TomlVariant(TomlVariant&&) noexcept;
  TomlVariant& operator=(TomlVariant&&) noexcept;

  /// Sets the value of a key. @param path names of tables, then the key
  /// @throws io::InputError if one of the tables is not a table
  void set(const std::vector<std::string_view>& path, std::string_view text);
  void set(const std::vector<std::string_view>& path, const char* text) { set(path, std::string_view(text)); }
  void set(const std::vector<std::string_view>& path, double number);
  void set(const std::vector<std::string_view>& path, int number);
  void set(const std::vector<std::string_view>& path, bool value);

  /// Removes a table or key at the top level, if there is one.
  void remove(std::string_view name);

  /// Returns the absolute paths of the files that decide results and that jobs get copies of, by the names of those copies:
  /// "parameters.toml" of `surrogate.parameters`, "silicone.toml" of `material.silicone`. Those that the text names.
  [[nodiscard]] std::map<std::string, std::filesystem::path> files() const;

  [[nodiscard]] std::string text() const;

 private:
  struct Content;
  template <class Value>
  void put(const std::vector<std::string_view>& path, const Value& value);

  std::unique_ptr<Content> content_;
};

/// Sets the tables [collisions] and [integration] to a fidelity.
void set_integration(TomlVariant& variant, const VoxelFidelity& fidelity);

/// Adds the text to a job as its input `name`, with copies of the voxel parameters and of the silicone that the text names. Their
/// content is part of the job's hash. @throws io::InputError if they cannot be read
void add_input(io::ProgramJob& job, const std::string& name, TomlVariant variant);

}  // namespace menger::evolution
