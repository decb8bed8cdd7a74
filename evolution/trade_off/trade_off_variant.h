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

/// A TOML file of the user's with some keys changed: a scene or study at another fidelity. File names in it (`design.file`,
/// `surrogate.parameters`) become absolute, so that the text can lie anywhere.
class TomlVariant {
 public:
  TomlVariant();  ///< of an empty file
  /// @throws io::InputError if the file cannot be read or is not TOML
  explicit TomlVariant(const std::filesystem::path& file);
  ~TomlVariant();
  TomlVariant(const TomlVariant&) = delete;
  TomlVariant& operator=(const TomlVariant&) = delete;
  TomlVariant(TomlVariant&&) noexcept;
  TomlVariant& operator=(TomlVariant&&) noexcept;

  /// Sets a value, in place of what the key holds. @param path names of tables, then the key
  /// @throws io::InputError if one of the tables is something else
  void set(const std::vector<std::string_view>& path, std::string_view text);
  void set(const std::vector<std::string_view>& path, const char* text) { set(path, std::string_view(text)); }
  void set(const std::vector<std::string_view>& path, double number);
  void set(const std::vector<std::string_view>& path, int number);
  void set(const std::vector<std::string_view>& path, bool value);

  /// Takes a table or key of the top away, if there is one.
  void remove(std::string_view name);

  /// The file that `surrogate.parameters` names, absolute; none if it names none.
  [[nodiscard]] std::optional<std::filesystem::path> parameters() const;

  [[nodiscard]] std::string text() const;

 private:
  struct Content;
  template <class Value>
  void put(const std::vector<std::string_view>& path, const Value& value);

  std::unique_ptr<Content> content_;
};

/// Sets [collisions] and [integration].
void set_integration(TomlVariant& variant, const VoxelFidelity& fidelity);

/// Gives a job the text as its input `name`, and a copy of the voxel parameters that it names: their content is part of the job's
/// hash. @throws io::InputError if these cannot be read
void add_input(io::ProgramJob& job, const std::string& name, TomlVariant variant);

}  // namespace menger::evolution
