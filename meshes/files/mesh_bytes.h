#pragma once

#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "meshes/hexahedra/hexahedral_mesh.h"
#include "meshes/hexahedra/mesh_assembly.h"

namespace menger::meshes {

template <class Transfer, class Value>
void transfer(Transfer& stream, Value& value);

/// Appends the parts of a mesh as bytes, for a process on the same machine.
class MeshWriter {
 public:
  template <class Value>
  void operator()(const Value& value) requires std::is_trivially_copyable_v<Value> {
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);  // NOLINT(cppcoreguidelines-pro-type-reinterpret-cast)
  }
  void operator()(const std::string& text) {
    (*this)(text.size());
    bytes_ += text;
  }
  template <class Value>
  void operator()(const std::vector<Value>& values) {
    (*this)(values.size());
    for (const Value& value : values) transfer(*this, value);
  }
  [[nodiscard]] std::string bytes() && { return std::move(bytes_); }

 private:
  std::string bytes_;
};

/// Reads them in the same order. @throws std::runtime_error if there are fewer bytes
class MeshReader {
 public:
  explicit MeshReader(std::string_view bytes) : bytes_(bytes) {}

  template <class Value>
  void operator()(Value& value) requires std::is_trivially_copyable_v<Value> {
    const std::string_view part = taken(sizeof value);
    std::memcpy(&value, part.data(), sizeof value);
  }
  void operator()(std::string& text) {
    std::size_t size = 0;
    (*this)(size);
    text = taken(size);
  }
  template <class Value>
  void operator()(std::vector<Value>& values) {
    std::size_t size = 0;
    (*this)(size);
    if (size > bytes_.size()) throw std::runtime_error("the bytes of a mesh end early");
    values.resize(size);
    for (Value& value : values) transfer(*this, value);
  }

 private:
  std::string_view taken(std::size_t size) {
    if (size > bytes_.size()) throw std::runtime_error("the bytes of a mesh end early");
    const std::string_view part = bytes_.substr(0, size);
    bytes_.remove_prefix(size);
    return part;
  }

  std::string_view bytes_;
};

// The members of each part, named once for writing and reading: then Value is const or not.

template <class Transfer, class Value>
void transfer(Transfer& stream, Value& value) {
  using Plain = std::remove_const_t<Value>;
  if constexpr (std::is_same_v<Plain, Cap>) {
    auto& [rim] = value;
    stream(rim);
  } else if constexpr (std::is_same_v<Plain, Chamber>) {
    auto& [name, labels, caps, plenum] = value;
    stream(name), stream(labels), stream(caps), stream(plenum);
  } else if constexpr (std::is_same_v<Plain, NamedCap>) {
    auto& [name, rim] = value;
    stream(name), stream(rim);
  } else if constexpr (std::is_same_v<Plain, HexahedralMesh>) {
    auto& [points, elements, regions, faces, region_names, label_names, plenum_names, chambers, geometry] = value;
    stream(points), stream(elements), stream(regions), stream(faces), stream(region_names), stream(label_names);
    stream(plenum_names), stream(chambers), stream(geometry);
  } else if constexpr (std::is_same_v<Plain, NamedHexahedra>) {
    auto& [points, elements, regions, region_names, faces, label_names, caps] = value;
    stream(points), stream(elements), stream(regions), stream(region_names), stream(faces), stream(label_names), stream(caps);
  } else {
    stream(value);
  }
}

/// Returns a mesh, or hexahedra of another program, as bytes.
template <class Mesh>
std::string mesh_bytes(const Mesh& mesh) {
  MeshWriter writer;
  transfer(writer, mesh);
  return std::move(writer).bytes();
}

/// Returns what mesh_bytes was given. @throws std::runtime_error if the bytes end early
template <class Mesh>
Mesh mesh_of_bytes(std::string_view bytes) {
  Mesh mesh;
  MeshReader reader(bytes);
  transfer(reader, mesh);
  return mesh;
}

}  // namespace menger::meshes
