#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace menger::io {
struct ProgramJob;
}

namespace menger::evolution {

struct VoxelFidelity;

/// A TOML file of the user with some keys changed: a scene or study at another fidelity. File names in it (`design.file`,
/// `surrogate.parameters`) become absolute, so that the text can be in any folder.
class TomlVariant {
 public:
  TomlVariant();  ///< begins with an empty file
  /// @throws io::InputError if the file cannot be read or is not TOML
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

  /// Returns the absolute path of the file that `surrogate.parameters` names, if there is one.
  [[nodiscard]] std::optional<std::filesystem::path> parameters() const;

  [[nodiscard]] std::string text() const;

 private:
  struct Content;
  template <class Value>
  void put(const std::vector<std::string_view>& path, const Value& value);

  std::unique_ptr<Content> content_;
};

/// Sets the tables [collisions] and [integration] to a fidelity.
void set_integration(TomlVariant& variant, const VoxelFidelity& fidelity);

/// Adds the text to a job as its input `name`, with a copy of the voxel parameters that the text names. The content of the
/// parameters is part of the job's hash. @throws io::InputError if they cannot be read
void add_input(io::ProgramJob& job, const std::string& name, TomlVariant variant);

}  // namespace menger::evolution
